"""Published values of other authors that measurements are compared with."""

from typing import NamedTuple

import numpy as np

HARD_DISKS = "Engel et al., Phys. Rev. E 87 (2013) 042134; Bernard & Krauth, Phys. Rev. Lett. 107 (2011) 155704"
"""Source of the values below, from simulations of 1024^2 disks."""


class PressurePoint(NamedTuple):
    """A point of the equation of state of hard disks.

    Attributes:
        area_fraction: nu.
        pressure: P* = P d^2 / kT.
    """

    area_fraction: float
    pressure: float

    @property
    def reduced_pressure(self) -> float:
        """P_0 = P V/E = pi P* / (4 nu) (A Eq. 16)."""
        return np.pi * self.pressure / (4 * self.area_fraction)


PRESSURES = (PressurePoint(0.698, 9.1693), PressurePoint(0.700, 9.1854))
"""The fluid just below its transition, and at it."""

COEXISTENCE = (PressurePoint(0.700, 9.1854), PressurePoint(0.716, 9.1854))
"""Ends of the transition, at one pressure: the fluid on the left, the hexatic phase on the right."""

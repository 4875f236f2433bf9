"""Pressure and collision rate of hard disks (A section 5): the formulas that a run itself needs, for tau.

A file of their own, because a run depends on it: another formula in theory.py simulates nothing again.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

Numbers = NDArray[np.float64]


def contact_value(area_fraction: ArrayLike) -> Numbers:
    """g(2a) = (1 - 7 nu/16) / (1 - nu)^2 (A Eq. 17)."""
    nu = np.asarray(area_fraction, dtype=float)
    return (1 - 7 * nu / 16) / (1 - nu) ** 2


def contact_value_dense(area_fraction: ArrayLike) -> Numbers:
    """g_4 = g - nu^3 / [128 (1 - nu)^4] (Luding 2001), right within .2 % up to nu = .65."""
    nu = np.asarray(area_fraction, dtype=float)
    return contact_value(nu) - nu**3 / (128 * (1 - nu) ** 4)


def reduced_pressure(area_fraction: ArrayLike, g: ArrayLike | None = None) -> Numbers:
    """P_0 = P V / E = 1 + 2 nu g(2a) (A Eq. 16), with A Eq. 17 for g unless another is given."""
    nu = np.asarray(area_fraction, dtype=float)
    return 1 + 2 * nu * (contact_value(nu) if g is None else np.asarray(g))


def rms_speed(energy_per_mass: ArrayLike) -> Numbers:
    """v_bar = sqrt(2 E/M) in m/s (A Eq. 19) from E/M in (m/s)^2; E/M = w^2/3 for components uniform in +-w."""
    return np.sqrt(2 * np.asarray(energy_per_mass, dtype=float))


def prefactor_rate(energy_per_mass: ArrayLike, diameter: float) -> Numbers:
    """w_0 = sqrt(2/pi) v_bar / a in 1/s (A Eq. 19)."""
    return np.sqrt(2 / np.pi) * rms_speed(energy_per_mass) / (diameter / 2)


def enskog_rate(area_fraction: ArrayLike, energy_per_mass: ArrayLike, diameter: float) -> Numbers:
    """1/t_E = 2 d (N/V) sqrt(pi E/M) g(2a) = w_0 (P_0 - 1) in 1/s (A Eq. 19, B Eq. 2)."""
    return prefactor_rate(energy_per_mass, diameter) * (reduced_pressure(area_fraction) - 1)

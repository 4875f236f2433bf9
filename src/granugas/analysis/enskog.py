"""Pressure and collision rate of hard disks, beads and spheres (A section 5): what a run itself needs, for tau.

A file of their own, because a run depends on it: another formula in theory.py simulates nothing again.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

Numbers = NDArray[np.float64]


def contact_value(area_fraction: ArrayLike, dimensions: int = 2) -> Numbers:
    """g(2a) = (1 - 7 nu/16) / (1 - nu)^2 (A Eq. 17); 1D: 1 / (1 - nu) (Tonks 1936); 3D: (1 - nu/2) / (1 - nu)^3
    (Carnahan & Starling 1969)."""
    nu = np.asarray(area_fraction, dtype=float)
    if dimensions == 1:
        return 1 / (1 - nu)
    if dimensions == 3:
        return (1 - nu / 2) / (1 - nu) ** 3
    return (1 - 7 * nu / 16) / (1 - nu) ** 2


def contact_value_dense(area_fraction: ArrayLike) -> Numbers:
    """g_4 = g - nu^3 / [128 (1 - nu)^4] (Luding 2001), right within .2 % up to nu = .65."""
    nu = np.asarray(area_fraction, dtype=float)
    return contact_value(nu) - nu**3 / (128 * (1 - nu) ** 4)


def reduced_pressure(area_fraction: ArrayLike, g: ArrayLike | None = None, dimensions: int = 2) -> Numbers:
    """P_0 = P V / E = 1 + 2 nu g(2a) (A Eq. 16), with `contact_value` for g unless another is given.

    In D dimensions P V / (N k T) = 1 + 2^(D-1) nu g(2a), where E = D N k T / 2.
    """
    nu = np.asarray(area_fraction, dtype=float)
    return 1 + 2 ** (dimensions - 1) * nu * (contact_value(nu, dimensions) if g is None else np.asarray(g))


def rms_speed(energy_per_mass: ArrayLike) -> Numbers:
    """v_bar = sqrt(2 E/M) in m/s (A Eq. 19) from E/M in (m/s)^2, `Scene.energy_per_mass` at the start."""
    return np.sqrt(2 * np.asarray(energy_per_mass, dtype=float))


def prefactor_rate(energy_per_mass: ArrayLike, diameter: float, dimensions: int = 2) -> Numbers:
    """w_0 = sqrt(2/pi) v_bar / a in 1/s (A Eq. 19); in D dimensions times sqrt(D/2): (D/a) sqrt(kT / (pi m))."""
    return np.sqrt(2 / np.pi) * rms_speed(energy_per_mass) / (diameter / 2) * np.sqrt(dimensions / 2)


def enskog_rate(area_fraction: ArrayLike, energy_per_mass: ArrayLike, diameter: float, dimensions: int = 2) -> Numbers:
    """1/t_E = 2 d (N/V) sqrt(pi E/M) g(2a) = w_0 (P_0 - 1) in 1/s (A Eq. 19, B Eq. 2).

    In D dimensions D 2^D nu g(2a) / d sqrt(kT / (pi m)).
    """
    excess = reduced_pressure(area_fraction, dimensions=dimensions) - 1
    return prefactor_rate(energy_per_mass, diameter, dimensions) * excess

"""Hard particles of different sizes in equilibrium: contact values, pressure, collision rate, in one to three dimensions.

The contact values are those of Jenkins & Mancini (J. Appl. Mech. 54 (1987) 27) in two dimensions, which are A Eq. 17 for
equal disks; of Boublik and of Mansoori et al. in three, which are Carnahan's and Starling's for equal spheres; in one they are
exact.
"""

import math

import numpy as np
from numpy.typing import NDArray

from granugas.geometry import SHAPES

Numbers = NDArray[np.float64]

CROWDING = {1: (0.0, 0.0), 2: (9 / 16, 0.0), 3: (3 / 2, 1 / 2)}
"""Coefficients of g_ij = 1/(1 - nu) + c_1 X_ij/(1 - nu)^2 + c_2 X_ij^2/(1 - nu)^3, by dimensions."""

SURFACE = {1: 2.0, 2: 2 * math.pi, 3: 4 * math.pi}
"""S_D of the unit sphere."""

SPECIES = 500
"""Where more diameters differ, so many means of particles next in size stand for all."""


def species(diameter: Numbers) -> tuple[Numbers, Numbers]:
    """(k,) different diameters, ascending, and the number shares x of their particles."""
    found, counts = np.unique(diameter, return_counts=True)
    if len(found) > SPECIES:
        parts = np.array_split(np.sort(diameter), SPECIES)
        found, counts = np.array([part.mean() for part in parts]), np.array([len(part) for part in parts])
    return found, counts / counts.sum()


def mixture_contact_values(fraction: float, d: Numbers, x: Numbers, dimensions: int = 2) -> Numbers:
    """(k, k) g_ij of particles in contact, with X_ij = nu <d^(D-1)>/<d^D> 2 d_i d_j / (d_i + d_j).

    Args:
        fraction: nu.
        d, x: (k,) diameters, in any unit, and number shares.
        dimensions: D.
    """
    first, second = CROWDING[dimensions]
    crowding = fraction * (x @ d ** (dimensions - 1)) / (x @ d**dimensions) * 2 / np.add.outer(1 / d, 1 / d)
    free = 1 - fraction
    return 1 / free + first * crowding / free**2 + second * crowding**2 / free**3


def mixture_pressure(fraction: float, diameter: Numbers, dimensions: int = 2) -> float:
    """P V / (N kT) = 1 + n S_D/(2 D) <s_ij^D g_ij>, with the number density n and s_ij = (d_i + d_j)/2.

    In two dimensions that is 1 + nu (1 + y)/(1 - nu) + 9/8 y nu^2/(1 - nu)^2, y = <d>^2/<d^2>.

    Args:
        fraction: nu.
        diameter: (n,) of the particles, in any unit.
        dimensions: D.
    """
    d, x = species(diameter)
    of_pairs = _reach(d) ** dimensions * mixture_contact_values(fraction, d, x, dimensions)
    return float(1 + _density(fraction, d, x, dimensions) * SURFACE[dimensions] / (2 * dimensions) * (x @ of_pairs @ x))


def mixture_rate(fraction: float, energy_per_mass: float, diameter: Numbers, dimensions: int = 2) -> float:
    """Enskog's mean collision rate of a particle, n S_D <s_ij^(D-1) g_ij sqrt(kT / (2 pi mu_ij))>, in 1/s.

    Args:
        fraction: nu.
        energy_per_mass: E/M in (m/s)^2, in equilibrium; M is the mass of all particles.
        diameter: (n,) of the particles in m; all are of one density, mu_ij the reduced mass of two.
        dimensions: D.
    """
    d, x = species(diameter)
    mass = d**dimensions / (x @ d**dimensions)
    speed = np.sqrt(2 * energy_per_mass / dimensions * np.add.outer(1 / mass, 1 / mass) / (2 * math.pi))
    of_pairs = _reach(d) ** (dimensions - 1) * mixture_contact_values(fraction, d, x, dimensions) * speed
    return float(_density(fraction, d, x, dimensions) * SURFACE[dimensions] * (x @ of_pairs @ x))


def _reach(d: Numbers) -> Numbers:
    return np.add.outer(d, d) / 2


def _density(fraction: float, d: Numbers, x: Numbers, dimensions: int) -> float:
    """n = nu by the mean volume of a particle."""
    first, second = SHAPES[dimensions]
    return fraction * second / (first * (x @ d**dimensions))

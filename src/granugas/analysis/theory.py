"""Closed formulas of both papers for hard disks in two dimensions: A = tc1998, B = cluster1999.

Arguments may be arrays; symbols are the papers': nu area fraction, g(2a) pair correlation at contact, E kinetic energy,
M total mass, d = 2a diameter, r restitution, t_c contact duration, tau = t / t_E(0).
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from granugas.analysis.enskog import (  # noqa: F401 - here is where formulas are looked up
    contact_value,
    contact_value_dense,
    enskog_rate,
    prefactor_rate,
    reduced_pressure,
    rms_speed,
)

Numbers = NDArray[np.float64]

ENERGY_OF_ELASTIC_PARTICLES = 5 / 4
"""e_e / n_e for t_c -> 0 (A Fig. 7), exact in two dimensions: (2D + 1) / (2D)."""

VIRIAL_COEFFICIENTS = (1.0, 1.0, 0.782004, 0.532232, 0.333556)
"""B_k / B_2^(k-1) of hard disks for k = 1 ... 5, where B_2 times the number density is 2 nu."""


def virial_pressure(area_fraction: ArrayLike) -> Numbers:
    """P V / E = sum over k of B_k / B_2^(k-1) (2 nu)^(k-1) up to the fifth virial coefficient: for dilute gases."""
    return np.polynomial.polynomial.polyval(2 * np.asarray(area_fraction, dtype=float), VIRIAL_COEFFICIENTS)


def elastic_particle_fraction(contact_time: ArrayLike, rate: ArrayLike) -> Numbers:
    """n_e = 1 - exp(-t_c / t_E) (A Eq. 20)."""
    return -np.expm1(-np.asarray(contact_time) * np.asarray(rate))


def elastic_collision_fraction(contact_time: ArrayLike, rate: ArrayLike) -> Numbers:
    """c_e = 1 - exp(-2 t_c / t_E) (A Eq. 21): mean field, some per cent too high."""
    return elastic_particle_fraction(2 * np.asarray(contact_time), rate)


def homogeneous_cooling(tau: ArrayLike, restitution: ArrayLike) -> Numbers:
    """K = [1 + (1 - r^2) tau / 4]^-2 (A Eq. 23, where K is called T; B Eq. 1)."""
    return (1 + _dissipation(restitution) * np.asarray(tau) / 4) ** -2


def energy_after_collisions(collisions_per_particle: ArrayLike, restitution: ArrayLike) -> Numbers:
    """K = exp[-(1 - r^2) / 2 * C/N] in homogeneous cooling (B Eq. 3)."""
    return np.exp(-_dissipation(restitution) / 2 * np.asarray(collisions_per_particle))


def collisions_until(tau: ArrayLike, restitution: ArrayLike) -> Numbers:
    """C/N = 4 / (1 - r^2) ln K^(-1/2) in homogeneous cooling (B Eq. 4); tau itself at r = 1."""
    loss, tau = np.broadcast_arrays(_dissipation(restitution) / 4, np.asarray(tau, dtype=float))
    elastic = loss == 0
    return np.where(elastic, tau, np.log1p(loss * tau) / np.where(elastic, 1, loss))


def optical_depth(n_particles: ArrayLike, area_fraction: ArrayLike) -> Numbers:
    """lambda = sqrt(pi N nu) / 2 (A Eq. 22, B Eq. 5)."""
    return np.sqrt(np.pi * np.asarray(n_particles) * np.asarray(area_fraction)) / 2


def collapse_restitution(n_particles: ArrayLike, area_fraction: ArrayLike) -> Numbers:
    """r_c = tan^2[pi/4 (1 - 1/lambda)], below which inelastic collapse is expected without t_c (A Eq. 22, B Eq. 5).

    An estimate; it has a meaning where lambda > 1.
    """
    return np.tan(np.pi / 4 * (1 - 1 / optical_depth(n_particles, area_fraction))) ** 2


def sonine_coefficient(restitution: ArrayLike) -> Numbers:
    """a_2 of the velocities in homogeneous cooling, 16 (1-r)(1-2r^2) / [73 - 41r - 2r^2 (1-r)] (Montanero & Santos).

    The collision rate is (1 - a_2/16) times the Gaussian one, the cooling rate (1 + 3 a_2/16) times.
    """
    r = np.asarray(restitution, dtype=float)
    return 16 * (1 - r) * (1 - 2 * r**2) / (73 - 41 * r - 2 * r**2 * (1 - r))


def _dissipation(restitution: ArrayLike) -> Numbers:
    return 1 - np.asarray(restitution, dtype=float) ** 2

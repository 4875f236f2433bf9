"""Closed formulas of both papers for hard disks in two dimensions: A = tc1998, B = cluster1999.

Arguments may be arrays; symbols are the papers': nu area fraction, g(2a) pair correlation at contact, E kinetic energy,
M total mass, d = 2a diameter, r restitution, t_c contact duration, tau = t / t_E(0).
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from granugas.analysis.bouncing import (  # noqa: F401 - here is where formulas are looked up
    PERIOD_OF_SPRING,
    bounce_period,
    bounce_speed,
    dissipation,
    hits_to_rest,
    released_square_velocity,
    rest_time,
    rest_time_difference,
    rest_time_hard,
    resting_height,
    resting_square_velocity,
    spring_contact_time,
    spring_energy_at_rest,
    staying_period,
    whole_hits_to_rest,
    whole_rest_time_difference,
)
from granugas.analysis.elastic_fractions import (  # noqa: F401 - likewise
    ENERGY_OF_ELASTIC_PARTICLES,
    dissipation_factor,
    elastic_collision_fraction,
    elastic_collision_fraction_shielded,
    elastic_in_company,
    elastic_particle_fraction,
    elastic_within,
    energy_of_elastic_particles,
    loss_after_collision,
    loss_shielding,
    rate_after_collision,
    shielding,
    triplet_excess,
)
from granugas.analysis.enskog import (  # noqa: F401 - likewise
    contact_value,
    contact_value_dense,
    enskog_rate,
    prefactor_rate,
    reduced_pressure,
    rms_speed,
)
from granugas.analysis.mixtures import mixture_contact_values, mixture_pressure, mixture_rate  # noqa: F401 - likewise
from granugas.geometry import INERTIA, ROTATIONS

Numbers = NDArray[np.float64]

VIRIAL_COEFFICIENTS = (1.0, 1.0, 0.782004, 0.532232, 0.333556)
"""B_k / B_2^(k-1) of hard disks for k = 1 ... 5, where B_2 times the number density is 2 nu."""


def virial_pressure(area_fraction: ArrayLike) -> Numbers:
    """P V / E = sum over k of B_k / B_2^(k-1) (2 nu)^(k-1) up to the fifth virial coefficient: for dilute gases."""
    return np.polynomial.polynomial.polyval(2 * np.asarray(area_fraction, dtype=float), VIRIAL_COEFFICIENTS)


def sonine_coefficient_heated(restitution: ArrayLike) -> Numbers:
    """a_2 of the velocities in the steady state of random kicks (van Noije & Ernst, Granular Matter 1 (1998) 57).

    16 (1-r)(1-2r^2) / [73 + 56 D - 24 D r - 105 r + 30 (1-r) r^2], in two dimensions.
    """
    r = np.asarray(restitution, dtype=float)
    return 16 * (1 - r) * (1 - 2 * r**2) / (185 - 153 * r + 30 * r**2 * (1 - r))


def steady_temperature(heating: ArrayLike, restitution: ArrayLike, rate: ArrayLike) -> Numbers:
    """kT/m in (m/s)^2 where kicks put in what collisions dissipate: heating = (1 - r^2) (1 + 3 a_2/16) w kT / (2 m).

    A collision dissipates (1 - r^2) kT on average (<u_n^2> = 4 kT/m), and there are w/2 of them by particle and time.

    Args:
        heating: energy by mass and time in m^2/s^3.
        restitution: r < 1.
        rate: of collisions at kT/m = 1 (m/s)^2 in 1/s; w is this by sqrt(kT/m).
    """
    correction = 1 + 3 * sonine_coefficient_heated(restitution) / 16
    return (2 * np.asarray(heating) / (dissipation(restitution) * correction * np.asarray(rate))) ** (2 / 3)


def kolafa_pressure(volume_fraction: ArrayLike) -> Numbers:
    """P V / (N k T) = [1 + nu + nu^2 - (2/3) nu^3 (1 + nu)] / (1 - nu)^3 of hard spheres (Kolafa; Boublik & Nezbeda 1986)."""
    nu = np.asarray(volume_fraction, dtype=float)
    return (1 + nu + nu**2 - 2 / 3 * nu**3 * (1 + nu)) / (1 - nu) ** 3


def homogeneous_cooling(tau: ArrayLike, restitution: ArrayLike, dimensions: int = 2) -> Numbers:
    """K = [1 + (1 - r^2) tau / 4]^-2 (A Eq. 23, where K is called T; B Eq. 1); in D dimensions (1 - r^2) tau / (2D)."""
    return (1 + dissipation(restitution) * np.asarray(tau) / (2 * dimensions)) ** -2


def energy_after_collisions(collisions_per_particle: ArrayLike, restitution: ArrayLike, dimensions: int = 2) -> Numbers:
    """K = exp[-(1 - r^2) / 2 * C/N] in homogeneous cooling (B Eq. 3); in D dimensions (1 - r^2) / D."""
    return np.exp(-dissipation(restitution) / dimensions * np.asarray(collisions_per_particle))


def collisions_until(tau: ArrayLike, restitution: ArrayLike, dimensions: int = 2) -> Numbers:
    """C/N = 4 / (1 - r^2) ln K^(-1/2) in homogeneous cooling (B Eq. 4), 2D / (1 - r^2) in D dimensions; tau itself at r = 1."""
    loss, tau = np.broadcast_arrays(dissipation(restitution) / (2 * dimensions), np.asarray(tau, dtype=float))
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


def column_restitution(n_particles: ArrayLike) -> Numbers:
    """r_c = tan^2[pi/4 (1 - 1/N)] of a column of N beads that hits a wall, by independent collision waves (A section 2.1).

    chi_c = N (1 - r_c) tends to pi.
    """
    return np.tan(np.pi / 4 * (1 - 1 / np.asarray(n_particles, dtype=float))) ** 2


def cushion_restitution(n_particles: ArrayLike) -> Numbers:
    """The same by the cushion model: chi_c = N (1 - r_c) = ln[4 / (1 - r_c)] (A section 2.1)."""
    n = np.asarray(n_particles, dtype=float)
    chi = np.log(4 * n)
    for _ in range(10):  # Newton's method for chi + ln chi = ln 4N
        chi = chi * (1 + np.log(4 * n) - np.log(chi)) / (1 + chi)
    return 1 - chi / n


def sonine_coefficient(restitution: ArrayLike) -> Numbers:
    """a_2 of the velocities in homogeneous cooling, 16 (1-r)(1-2r^2) / [73 - 41r - 2r^2 (1-r)] (Montanero & Santos).

    The collision rate is (1 - a_2/16) times the Gaussian one, the cooling rate (1 + 3 a_2/16) times.
    """
    r = np.asarray(restitution, dtype=float)
    return 16 * (1 - r) * (1 - 2 * r**2) / (73 - 41 * r - 2 * r**2 * (1 - r))


# Rough particles (Huthmann & Zippelius, Phys. Rev. E 56 (1997) R6275; Luding, Huthmann, McNamara & Zippelius, Phys. Rev. E 58
# (1998) 3416): homogeneous cooling with Maxwellian velocities and spins at the temperatures T_tr and T_rot, each of one degree
# of freedom. beta is the coefficient of tangential restitution; there is no limit of friction.


def rough_rates(
    restitution: ArrayLike, tangential_restitution: ArrayLike, dimensions: int = 2
) -> tuple[Numbers, Numbers, Numbers]:
    """A, B and C of dT_tr = -(4/D) (A T_tr - B T_rot) and dT_rot = (4/D_rot) (B T_tr - C T_rot) per collision of a particle.

    A = (1-r^2)/4 + (D-1) eta (1-eta)/2, B = (D-1) eta^2/(2q), C = (D-1) eta/(2q) (1 - eta/q), eta = q (1+beta)/(2q+2);
    D_rot = 1 in 2D, 3 in 3D. They are the means, over Maxwellian collisions, of what a collision takes and gives.
    """
    q, tangents = INERTIA[dimensions], dimensions - 1
    eta = q * (1 + np.asarray(tangential_restitution, dtype=float)) / (2 * q + 2)
    a = dissipation(restitution) / 4 + tangents * eta * (1 - eta) / 2
    return a, tangents * eta**2 / (2 * q), tangents * eta / (2 * q) * (1 - eta / q)


def rough_temperature_ratio(restitution: ArrayLike, tangential_restitution: ArrayLike, dimensions: int = 2) -> Numbers:
    """R = T_rot/T_tr at which both cool alike: the root of B R^2 + (k C - A) R - k B = 0, k = D / D_rot; beta > -1."""
    a, b, c = rough_rates(restitution, tangential_restitution, dimensions)
    k = dimensions / ROTATIONS[dimensions]
    half = (k * c - a) / 2
    return (np.sqrt(half**2 + k * b**2) - half) / b


def friction_loss(tangential_restitution: float, friction: float, restitution: float) -> float:
    """Energy by kT that the rubbing of two disks dissipates in a collision, on average, while no disk spins yet.

    Maxwellian: u_n^2 / 4T is distributed exponentially, u_t is normal of variance 2T (T = kT/m); surfaces stick where the
    tangential impulse that takes is no more than mu times the normal one, and slide beyond.
    """
    q, share = INERTIA[2], (np.arange(1000) + 0.5) / 1000
    u_n = 2 * np.sqrt(-np.log(share))[:, np.newaxis]
    u_t = np.linspace(0, 10, 2001)
    weight = np.exp(-(u_t**2) / 4)
    change = np.minimum(q * (1 + tangential_restitution) / (1 + q) * u_t, friction * (1 + restitution) * u_n)
    loss = (u_t * change - (1 + 1 / q) / 2 * change**2) / 2
    return float((loss.mean(axis=0) @ weight) / weight.sum())


# Coefficients of restitution that depend on the normal relative velocity u (A section 3.iv).


def viscoelastic_restitution(speed: ArrayLike, viscosity: float) -> Numbers:
    """r = 1 - C1 x + 3/5 C1^2 x^2 with x = A u^(1/5), C1 = 1.15344; `speed` u in m/s, `viscosity` A in (s/m)^(1/5)."""
    x = 1.15344 * viscosity * np.asarray(speed) ** 0.2
    return 1 - x + 0.6 * x**2


def plastic_restitution(speed: ArrayLike, restitution: float, yield_velocity: float) -> Numbers:
    """`restitution` up to the yield velocity (m/s), above it as u^(-1/4)."""
    return restitution * np.minimum(1, (yield_velocity / np.asarray(speed)) ** 0.25)


def cooling_by_velocity(tau: ArrayLike, restitution: Callable[[Numbers], Numbers], temperature: float) -> Numbers:
    """K of a homogeneous gas of disks: d ln K / d tau = -sqrt(K)/2 <(1 - r(u)^2) u^2> / <u^2> over Maxwellian collisions.

    Args:
        tau: up to where K has fallen to 1e-12.
        restitution: r(u), u in m/s.
        temperature: kT/m at t = 0 in (m/s)^2; u^2 / 4T is distributed exponentially.
    """
    y, weight = np.polynomial.laguerre.laggauss(30)
    log_k = np.linspace(0, np.log(1e-12), 4001)
    r = restitution(2 * np.sqrt(y * temperature * np.exp(log_k)[:, np.newaxis]))
    slowness = 2 * np.exp(-log_k / 2) / ((1 - r**2) @ (weight * y))
    passed = np.concatenate([[0], np.cumsum((slowness[1:] + slowness[:-1]) / 2) * (log_k[0] - log_k[1])])
    return np.exp(np.interp(tau, passed, log_k))

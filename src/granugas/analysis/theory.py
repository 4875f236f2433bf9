"""Closed formulas of both papers for hard disks in two dimensions: A = tc1998, B = cluster1999.

Arguments may be arrays; symbols are the papers': nu area fraction, g(2a) pair correlation at contact, E kinetic energy,
M total mass, d = 2a diameter, r restitution, t_c contact duration, tau = t / t_E(0).
"""

from collections.abc import Callable

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
from granugas.analysis.mixtures import mixture_contact_values, mixture_pressure, mixture_rate  # noqa: F401 - likewise
from granugas.geometry import INERTIA, ROTATIONS

Numbers = NDArray[np.float64]

ENERGY_OF_ELASTIC_PARTICLES = 5 / 4
"""e_e / n_e for t_c -> 0 (A Fig. 7), exact in two dimensions: (2D + 1) / (2D), see `energy_of_elastic_particles`."""

VIRIAL_COEFFICIENTS = (1.0, 1.0, 0.782004, 0.532232, 0.333556)
"""B_k / B_2^(k-1) of hard disks for k = 1 ... 5, where B_2 times the number density is 2 nu."""


def energy_of_elastic_particles(dimensions: int) -> float:
    """e_e / n_e = (2D + 1) / (2D) for t_c -> 0: kinetic energy of a particle at its collision, by the mean one."""
    return (2 * dimensions + 1) / (2 * dimensions)


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
    return (2 * np.asarray(heating) / (_dissipation(restitution) * correction * np.asarray(rate))) ** (2 / 3)


def elastic_particle_fraction(contact_time: ArrayLike, rate: ArrayLike) -> Numbers:
    """n_e = 1 - exp(-t_c / t_E) (A Eq. 20)."""
    return -np.expm1(-np.asarray(contact_time) * np.asarray(rate))


def elastic_collision_fraction(contact_time: ArrayLike, rate: ArrayLike) -> Numbers:
    """c_e = 1 - exp(-2 t_c / t_E) (A Eq. 21): mean field, some per cent too high."""
    return elastic_particle_fraction(2 * np.asarray(contact_time), rate)


def kolafa_pressure(volume_fraction: ArrayLike) -> Numbers:
    """P V / (N k T) = [1 + nu + nu^2 - (2/3) nu^3 (1 + nu)] / (1 - nu)^3 of hard spheres (Kolafa; Boublik & Nezbeda 1986)."""
    nu = np.asarray(volume_fraction, dtype=float)
    return (1 + nu + nu**2 - 2 / 3 * nu**3 * (1 + nu)) / (1 - nu) ** 3


def homogeneous_cooling(tau: ArrayLike, restitution: ArrayLike, dimensions: int = 2) -> Numbers:
    """K = [1 + (1 - r^2) tau / 4]^-2 (A Eq. 23, where K is called T; B Eq. 1); in D dimensions (1 - r^2) tau / (2D)."""
    return (1 + _dissipation(restitution) * np.asarray(tau) / (2 * dimensions)) ** -2


def energy_after_collisions(collisions_per_particle: ArrayLike, restitution: ArrayLike, dimensions: int = 2) -> Numbers:
    """K = exp[-(1 - r^2) / 2 * C/N] in homogeneous cooling (B Eq. 3); in D dimensions (1 - r^2) / D."""
    return np.exp(-_dissipation(restitution) / dimensions * np.asarray(collisions_per_particle))


def collisions_until(tau: ArrayLike, restitution: ArrayLike, dimensions: int = 2) -> Numbers:
    """C/N = 4 / (1 - r^2) ln K^(-1/2) in homogeneous cooling (B Eq. 4), 2D / (1 - r^2) in D dimensions; tau itself at r = 1."""
    loss, tau = np.broadcast_arrays(_dissipation(restitution) / (2 * dimensions), np.asarray(tau, dtype=float))
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
    a = _dissipation(restitution) / 4 + tangents * eta * (1 - eta) / 2
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


# One ball that bounces on a plate under gravity g (A section 4.2). v_1 is its speed before the first hit, t_1 = 2 v_1 / g.
# Energies are per mass m.


def bounce_speed(n: ArrayLike, restitution: ArrayLike, first_speed: ArrayLike) -> Numbers:
    """v_n = r^(n-1) v_1 in m/s before hit n (A Eq. 5)."""
    return np.asarray(restitution, dtype=float) ** (np.asarray(n) - 1) * np.asarray(first_speed)


def bounce_period(speed: ArrayLike, gravity: float) -> Numbers:
    """t_n = 2 v_n / g in s: the flight that ends with the speed v_n (A Eq. 6)."""
    return 2 * np.asarray(speed, dtype=float) / gravity


def hits_to_rest(restitution: ArrayLike, contact_ratio: ArrayLike) -> Numbers:
    """n_s = ln(t_c / t_1) / ln r = ln(g t_c / 2 v_1) / ln r, a real number (A Eq. 7); `contact_ratio`: t_c / t_1 <= 1."""
    return np.log(contact_ratio) / np.log(restitution)


def whole_hits_to_rest(restitution: ArrayLike, contact_ratio: ArrayLike) -> Numbers:
    """The integer n_s: hits that dissipate, until a flight is no longer than t_c; Eq. 7 rounded up."""
    return np.ceil(hits_to_rest(restitution, contact_ratio))


def staying_period(restitution: ArrayLike, contact_ratio: ArrayLike) -> Numbers:
    """t_inf / t_1 = r^n_s with the integer n_s: the period that stays, r t_c < t_inf <= t_c."""
    return np.asarray(restitution, dtype=float) ** whole_hits_to_rest(restitution, contact_ratio)


def rest_time_hard(restitution: ArrayLike) -> Numbers:
    """t_s / t_1 = r / (1 - r) of the IHS model, from the first hit on (A Eq. 8)."""
    r = np.asarray(restitution, dtype=float)
    return r / (1 - r)


def rest_time(restitution: ArrayLike, contact_ratio: ArrayLike) -> Numbers:
    """t_s / t_1 = r / (1 - r) (1 - t_c / t_1) of the TC model, with the real n_s (A Eq. 9)."""
    return rest_time_hard(restitution) * (1 - np.asarray(contact_ratio))


def rest_time_difference(restitution: ArrayLike, contact_ratio: ArrayLike) -> Numbers:
    """Delta t_s / t_1 = r / (1 - r) t_c / t_1 with the real n_s (A Eq. 10): the least that an integer one leads to."""
    return rest_time_hard(restitution) * np.asarray(contact_ratio)


def whole_rest_time_difference(restitution: ArrayLike, contact_ratio: ArrayLike) -> Numbers:
    """Delta t_s / t_1 = t_inf / t_1 / (1 - r) with the integer n_s, t_s being the time of the last hit that dissipates."""
    return staying_period(restitution, contact_ratio) / (1 - np.asarray(restitution, dtype=float))


def resting_square_velocity(period: ArrayLike, gravity: float) -> Numbers:
    """<v^2> = (g t_n)^2 / 12 in (m/s)^2 over one period t_n (A section 4.2.1); E = E_e is half of it, E_p is as large."""
    return (gravity * np.asarray(period, dtype=float)) ** 2 / 12


def resting_height(period: ArrayLike, gravity: float) -> Numbers:
    """<h> = g t_n^2 / 12 in m over one period t_n (A section 4.2.1)."""
    return gravity * np.asarray(period, dtype=float) ** 2 / 12


def spring_contact_time(stiffness: ArrayLike) -> Numbers:
    """t_c^el = pi sqrt(m/k) in s of a linear spring, from k/m in 1/s^2 (A Eq. 12, where pi reads sqrt(2))."""
    return np.pi / np.sqrt(np.asarray(stiffness, dtype=float))


def spring_energy_at_rest(contact_time: ArrayLike, gravity: float) -> Numbers:
    """V(h_0) = (g t_c^el)^2 / (2 pi^2) in (m/s)^2 of a particle that rests on a linear spring, h_0 = m g / k (A 4.2.2)."""
    return (gravity * np.asarray(contact_time, dtype=float)) ** 2 / (2 * np.pi**2)


PERIOD_OF_SPRING = np.sqrt(12) / np.pi
"""t_n / t_c^el = 1.103 of the ball whose E_e is the V(h_0) of the spring (A Eq. 13, where it is sqrt(2/12) by mistake)."""


def released_square_velocity(
    period: ArrayLike, gravity: float, restitution: ArrayLike, period_ratio: ArrayLike = 1.0
) -> Numbers:
    """<v^2> = (g t_n)^2 [2 - (1 - r^2) u^3] / 24 in (m/s)^2 after gravity is switched off at a random phase (A 4.2.3).

    A ball that falls then hits the plate once more, within t_c of its last hit only if it falls faster than u of the speed
    that it hits with under gravity: u + 1/u = 4 t_c / t_n - 2, u <= 1. At t_n = t_c, 1 + r^2 stands in place of the
    print's 1 + r.

    Args:
        period: t_n (s).
        gravity: g (m/s^2).
        restitution: r.
        period_ratio: t_n / t_c, from 0 to 1.
    """
    half = 2 / np.asarray(period_ratio, dtype=float) - 1
    u = 1 / (half + np.sqrt(half**2 - 1))
    return (gravity * np.asarray(period, dtype=float)) ** 2 * (2 - _dissipation(restitution) * u**3) / 24


# What a collision leaves behind: elastic fractions beyond the mean field of A section 5.4, for t_c -> 0.
# Two disks in touch hide from any third one the directions within 60 degrees of each other. A disk that has just collided
# is hit again from the other directions only, though more often from there than the mean disk, as it flies away fast.


def rate_after_collision(angle: ArrayLike) -> Numbers:
    """Rate of collisions from a direction, of a disk that has just collided, by the mean disk's: q(theta).

    q(theta) = sqrt(1 - rho^2) + rho (pi/2 + arcsin rho), rho = -cos(theta)/2, is the mean of a product, as rates are of the
    speeds of approach: that of the two partners at their collision and that of the third disk now. Both are normal
    variables taken where they are positive, of correlation rho, as the partner took its part of them away.

    Args:
        angle: theta in rad between the directions to the partner and to the third disk. No shadow is in it.
    """
    rho = -np.cos(angle) / 2
    return np.sqrt(1 - rho**2) + rho * (np.pi / 2 + np.arcsin(rho))


def loss_after_collision(angle: ArrayLike) -> Numbers:
    """As `rate_after_collision`, but with each collision counted by its energy loss, by u_n^2 of its normal speed u_n.

    [3 rho (pi/2 + arcsin rho) + 3 sqrt(1 - rho^2) - (1 - rho^2)^(3/2)] / 2: the third power of the speed of approach now,
    its first power at the collision before.
    """
    rho = -np.cos(angle) / 2
    return (3 * rho * (np.pi / 2 + np.arcsin(rho)) + 3 * np.sqrt(1 - rho**2) - (1 - rho**2) ** 1.5) / 2


def triplet_excess(angle: ArrayLike) -> Numbers:
    """[chi(theta) - 1] / nu for nu -> 0: how much more often a third disk is in touch beside the partner than alone.

    chi = g_3 / g(2a)^2 of three disks, i in touch with j and k. A fourth one finds no place within d of j or of k; where
    these areas overlap and i does not keep it away already, it gains room: (sqrt(3)/2 + pi/3 - sin(theta) - theta/2) d^2
    up to 120 degrees, none beyond.

    Args:
        angle: theta in rad, from pi/3 to pi: between the directions from i to j and to k.
    """
    theta = np.asarray(angle, dtype=float)
    area = np.sqrt(3) / 2 + np.pi / 3 - np.sin(theta) - theta / 2
    return 4 / np.pi * np.where(theta < 2 * np.pi / 3, area, 0.0)


def shielding(area_fraction: ArrayLike = 0.0) -> Numbers:
    """q = lim c_e / (2 t_c / t_E) for t_c -> 0: .9168 + .0595 nu, to first order in nu; 1 in mean field (A Eq. 21).

    The mean of `rate_after_collision` over all directions outside the partner's shadow; exact for nu -> 0, 1 % low at
    nu = .4. Without the shadow q would be 1.0635: disks that collide are the fast ones.
    """
    return _outside_shadow(rate_after_collision, area_fraction)


def loss_shielding(area_fraction: ArrayLike = 0.0) -> Numbers:
    """As `shielding`, of collisions counted by their energy loss: 1.0891 + .0540 nu, to first order in nu.

    Collisions that follow soon upon another are fewer but harder than in mean field, so the TC model, which makes them
    elastic, saves more energy than 1 - c_e tells.
    """
    return _outside_shadow(loss_after_collision, area_fraction)


def elastic_collision_fraction_shielded(contact_time: ArrayLike, rate: ArrayLike, area_fraction: ArrayLike = 0.0) -> Numbers:
    """c_e = 1 - exp(-2 q t_c / t_E): A Eq. 21 with the right slope for t_c -> 0 (`shielding`)."""
    return elastic_collision_fraction(shielding(area_fraction) * np.asarray(contact_time), rate)


def dissipation_factor(contact_time: ArrayLike, rate: ArrayLike, area_fraction: ArrayLike = 0.0) -> Numbers:
    """Factor by which the TC model reduces the energy loss of a homogeneous gas of r near 1: exp(-2 q t_c / t_E).

    With the q of `loss_shielding`, so the slope for t_c -> 0 is right. A section 7 expects 1 - c_e.
    """
    return 1 - elastic_collision_fraction(loss_shielding(area_fraction) * np.asarray(contact_time), rate)


def elastic_in_company(area_fraction: ArrayLike, gap: ArrayLike) -> Numbers:
    """Share of collisions with a third disk nearer to a partner than `gap` (by d, << 1): critical distance (A section 3.v).

    2 n g(2a) d gap by angle outside the shadow, with the number density n: the disks that lie next to either partner.
    """
    return -np.expm1(-_neighbours(area_fraction, gap) * _outside_shadow(np.ones_like, area_fraction))


def elastic_within(area_fraction: ArrayLike, distance: ArrayLike) -> Numbers:
    """c_e of the TC model with t_c(u) = `distance` (by d, << 1) / u, that is alpha = 1 (A section 3, end).

    Of the disks next to a partner (`elastic_in_company`) those that approach, however slowly: (1 + rho)/2 at the angle theta,
    as the partner's velocity was chosen by the speed of approach of the collision before; rho of `rate_after_collision`.
    """
    approach = _outside_shadow(lambda angle: (1 - np.cos(angle) / 2) / 2, area_fraction)
    return -np.expm1(-_neighbours(area_fraction, distance) * approach)


def _neighbours(area_fraction: ArrayLike, gap: ArrayLike) -> Numbers:
    """Disks within a gap (by d, << 1) of either partner if these hid no direction: 2 n g(2a) 2 pi d^2 gap = 16 nu g gap."""
    return 16 * np.asarray(area_fraction) * contact_value(area_fraction) * np.asarray(gap)


def _outside_shadow(function: Callable[[Numbers], Numbers], area_fraction: ArrayLike) -> Numbers:
    """Mean over all directions of a function of theta, times chi: 0 in the shadow, else 1 + nu `triplet_excess`."""
    edge = np.pi / 3
    free = _mean_over_angles(function, edge, np.pi)
    crowded = _mean_over_angles(lambda angle: function(angle) * triplet_excess(angle), edge, 2 * edge)
    return free + crowded * np.asarray(area_fraction, dtype=float)


def _mean_over_angles(function: Callable[[Numbers], Numbers], low: float, high: float) -> float:
    """Integral from low to high by pi: 20 Gauss points, exact to rounding for what is smooth in between."""
    place, weight = np.polynomial.legendre.leggauss(20)
    half = (high - low) / 2
    return float(half * weight @ function(low + half * (1 + place)) / np.pi)


def _dissipation(restitution: ArrayLike) -> Numbers:
    return 1 - np.asarray(restitution, dtype=float) ** 2

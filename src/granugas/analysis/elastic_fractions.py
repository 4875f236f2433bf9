"""What the TC model makes elastic, for t_c -> 0: in mean field (A = tc1998, section 5.4), and with what a collision leaves.

Two disks in touch hide from any third one the directions within 60 degrees of each other. A disk that has just collided
is hit again from the other directions only, though more often from there than the mean disk, as it flies away fast.
Arguments may be arrays.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from granugas.analysis.enskog import Numbers, contact_value

ENERGY_OF_ELASTIC_PARTICLES = 5 / 4
"""e_e / n_e for t_c -> 0 (A Fig. 7), exact in two dimensions: (2D + 1) / (2D), see `energy_of_elastic_particles`."""


def energy_of_elastic_particles(dimensions: int) -> float:
    """e_e / n_e = (2D + 1) / (2D) for t_c -> 0: kinetic energy of a particle at its collision, by the mean one."""
    return (2 * dimensions + 1) / (2 * dimensions)


def elastic_particle_fraction(contact_time: ArrayLike, rate: ArrayLike) -> Numbers:
    """n_e = 1 - exp(-t_c / t_E) (A Eq. 20)."""
    return -np.expm1(-np.asarray(contact_time) * np.asarray(rate))


def elastic_collision_fraction(contact_time: ArrayLike, rate: ArrayLike) -> Numbers:
    """c_e = 1 - exp(-2 t_c / t_E) (A Eq. 21): mean field, some per cent too high."""
    return elastic_particle_fraction(2 * np.asarray(contact_time), rate)


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

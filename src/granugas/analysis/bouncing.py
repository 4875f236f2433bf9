"""A ball that bounces on a plate under gravity g, in the TC model and as a spring (A = tc1998, section 4.2).

v_1 is its speed before the first hit, t_1 = 2 v_1 / g. Energies are per mass m. Arguments may be arrays.
"""

import numpy as np
from numpy.typing import ArrayLike

from granugas.analysis.enskog import Numbers


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
    return (gravity * np.asarray(period, dtype=float)) ** 2 * (2 - dissipation(restitution) * u**3) / 24


def dissipation(restitution: ArrayLike) -> Numbers:
    """1 - r^2: the share of the energy of the normal motion that a collision takes."""
    return 1 - np.asarray(restitution, dtype=float) ** 2

"""Elastic fractions against their printed values and Monte Carlo."""

import numpy as np
import pytest

from granugas.analysis.elastic_fractions import (
    ENERGY_OF_ELASTIC_PARTICLES,
    dissipation_factor,
    elastic_collision_fraction,
    elastic_collision_fraction_shielded,
    elastic_in_company,
    elastic_particle_fraction,
    elastic_within,
    loss_after_collision,
    loss_shielding,
    rate_after_collision,
    shielding,
    triplet_excess,
)
from granugas.analysis.enskog import contact_value, enskog_rate

AREA_FRACTION_A = np.pi / (8 * np.sqrt(3))
ENERGY_PER_MASS = 0.5**2 / 3


def test_printed_elastic_fractions():
    rate = enskog_rate(AREA_FRACTION_A, ENERGY_PER_MASS, 1e-3)
    contact_times = np.array([1e-3, 1e-4, 1e-2, 1e-5])
    np.testing.assert_allclose(elastic_collision_fraction(contact_times, rate), [0.59, 0.085, 0.9999, 8.8e-3], rtol=0.01)
    n_e = elastic_particle_fraction(contact_times, rate)
    np.testing.assert_allclose(n_e**2 + 2 * n_e * (1 - n_e), elastic_collision_fraction(contact_times, rate))


def test_disks_that_have_just_collided_by_monte_carlo():
    """Pairs drawn with the rate at which they collide: their energy, and their next partners, in the shadow and outside."""
    rng = np.random.default_rng(7)
    own, others, tangential, third = rng.normal(size=(4, 2_000_000))
    angle = rng.uniform(0, np.pi, own.size)
    meet = np.maximum(own - others, 0)  # along the direction to the partner, whose speed the disk takes over
    energy = np.average((others**2 + tangential**2) / 2, weights=meet)
    assert energy == pytest.approx(ENERGY_OF_ELASTIC_PARTICLES, rel=3e-3)
    mean_disk = np.maximum(own - third, 0).mean()
    again = np.maximum(others * np.cos(angle) + tangential * np.sin(angle) - third, 0) / mean_disk
    assert np.average(again, weights=meet) == pytest.approx(1.0635, rel=4e-3)
    outside = angle > np.pi / 3
    assert np.average(again * outside, weights=meet) == pytest.approx(shielding(), rel=4e-3)
    places = np.array([0.5, 1.5, 2.5])
    harder = again**3 * mean_disk**3 / (np.maximum(own - third, 0) ** 3).mean()
    assert np.average(harder * outside, weights=meet) == pytest.approx(loss_shielding(), rel=8e-3)
    by_angle = [np.average(again[near], weights=meet[near]) for near in (abs(angle - place) < 0.1 for place in places)]
    np.testing.assert_allclose(rate_after_collision(places), by_angle, rtol=0.02)


def test_third_disks_in_touch_by_monte_carlo():
    """The room that a fourth disk gains where the surroundings of two others overlap, by points in a square."""
    rng = np.random.default_rng(7)
    points = rng.uniform(-1, 2, (1_000_000, 2))
    for angle in (np.pi / 3, 1.4, 1.8, 2.2):
        i, j, k = (np.hypot(*(points - place).T) < 1 for place in ((0, 0), (1, 0), (np.cos(angle), np.sin(angle))))
        room = 9 * np.mean(j & k & ~i)
        assert triplet_excess(angle) == pytest.approx(4 / np.pi * room, abs=6e-3)


def test_shielding():
    """Its integral by small steps; 7 % of the elastic collisions of mean field are missing in the papers' gas."""
    angle = np.linspace(np.pi / 3, np.pi, 100_001)
    crowd = 1 + 0.3 * triplet_excess(angle)
    by_steps = np.trapezoid(rate_after_collision(angle) * crowd, angle) / np.pi
    np.testing.assert_allclose(shielding([0, 0.3]), [0.916753, by_steps], rtol=1e-6)
    assert shielding(AREA_FRACTION_A) == pytest.approx(0.93, abs=0.003)
    by_loss = np.trapezoid(loss_after_collision(angle) * crowd, angle) / np.pi
    np.testing.assert_allclose(loss_shielding([0, 0.3]), [1.089068, by_loss], rtol=1e-6)


def test_shielded_fraction_of_elastic_collisions():
    contact_time, rate = np.array([1e-9, 1.0]), 445.0
    shielded = elastic_collision_fraction_shielded(contact_time, rate, 0.2)
    mean_field = elastic_collision_fraction(contact_time, rate)
    np.testing.assert_allclose(shielded / mean_field, [shielding(0.2), 1], rtol=1e-6)
    left = dissipation_factor(contact_time, rate, 0.2)
    np.testing.assert_allclose((1 - left) / mean_field, [loss_shielding(0.2), 1], rtol=1e-6)


def test_third_disks_that_are_near_by_monte_carlo():
    """Those next to one of the partners of a collision, outside the shadow of the other: all, and those that approach it."""
    rng = np.random.default_rng(7)
    own, others, tangential, third = rng.normal(size=(4, 2_000_000))
    angle = rng.uniform(0, np.pi, own.size)
    meet, outside = np.maximum(own - others, 0), angle > np.pi / 3
    nu, gap = 1e-4, 1e-3
    neighbours = 2 * (4 * nu / np.pi) * contact_value(nu) * 2 * np.pi * gap  # 2 n g 2 pi d gap
    assert elastic_in_company(nu, gap) / neighbours == pytest.approx(np.average(outside, weights=meet), rel=2e-3)
    approach = others * np.cos(angle) + tangential * np.sin(angle) > third
    assert elastic_within(nu, gap) / neighbours == pytest.approx(np.average(approach & outside, weights=meet), rel=3e-3)
    assert elastic_in_company(0.2, 10) == pytest.approx(1)

"""Motion within clusters, and mixing."""

import numpy as np
import pytest

from granugas.analysis.mixing import differences_nearby, internal_energy_share

BOX = np.array([2.0, 1.0])


def test_differences_within_a_cell():
    positions = [[0.1, 0.1], [1.5, 0.9], [0.2, 0.2], [0.3, 0.1], [-0.5, 1.9]]  # the last is where the second is
    mean, largest = differences_nearby([0.0, 0.3, 0.1, 0.9, 0.5], 1.0, positions, BOX, 2)
    np.testing.assert_allclose(mean, [0.1, 0.2, 0.15, 0.15, 0.2])
    np.testing.assert_allclose(largest, [0.1, 0.2, 0.2, 0.2, 0.2])


def test_who_is_alone_has_no_neighbour():
    assert np.isnan(differences_nearby([1.0, 2.0], 5.0, [[0.1, 0.1], [1.9, 0.9]], BOX, 2)).all()


def test_random_values_differ_by_a_quarter_of_the_period():
    rng = np.random.default_rng(2)
    mean, largest = differences_nearby(7 * rng.random(20_000), 7.0, rng.random((20_000, 2)) * BOX, BOX, 10)
    assert np.mean(mean) == pytest.approx(7 / 4, rel=0.01)
    assert largest.min() > 3.3 and largest.max() <= 3.5


def test_a_solid_body_has_no_internal_motion():
    """It moves and turns across the edge of the box."""
    rng = np.random.default_rng(3)
    place = rng.normal(0, 0.05, (500, 2))
    velocity = [3.0, -1.0] + 20 * np.stack([-place[:, 1], place[:, 0]], axis=1)
    across = (place + np.array([0.01, 0.99])) % BOX
    assert internal_energy_share(velocity, across, BOX) == pytest.approx(0, abs=1e-12)
    noise = rng.normal(size=(500, 2))
    noisy = internal_energy_share(velocity + noise, across, BOX)
    assert noisy == pytest.approx(2 / np.square(velocity + noise).sum(axis=1).mean(), rel=0.05)


def test_expansion_and_shear_are_internal():
    place = np.random.default_rng(4).normal(0, 0.05, (5000, 2))
    assert internal_energy_share(place, place, BOX) == pytest.approx(1, abs=1e-3)
    shear = np.stack([place[:, 1], 0 * place[:, 1]], axis=1)  # half of it is rotation
    assert internal_energy_share(shear, place, BOX) == pytest.approx(0.5, abs=0.03)


def test_one_particle_is_solid():
    assert internal_energy_share([[1.0, 2.0]], [[0.5, 0.5]], BOX) == 0

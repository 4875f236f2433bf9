"""Test volumes and their stress, by hand and against sums over everything."""

import numpy as np
import pytest

from granugas.analysis.stress import Volumes, collisional_stress, kinetic_stress, pressure

BOX = (2.0, 3.0)
RNG = np.random.default_rng(5)
POSITION, VELOCITY = RNG.random((200, 2)) * BOX, RNG.normal(size=(200, 2))
ANGLE = RNG.uniform(0, 2 * np.pi, 300)
CONTACT, NORMAL = RNG.random((300, 2)) * BOX, np.stack([np.cos(ANGLE), np.sin(ANGLE)], axis=1)
MOMENTUM = -RNG.random(300)


def test_volumes_are_numbered_row_by_row_and_periodic():
    volumes = Volumes(BOX, 4, 3)
    assert (volumes.count, volumes.area) == (12, 0.5)
    places = [[0.0, 0.0], [1.99, 0.0], [0.6, 1.5], [2.1, 0.5], [-0.1, -0.1], [2.0, 3.0]]
    np.testing.assert_array_equal(volumes.of(places), [0, 3, 5, 0, 11, 0])


def test_kinetic_stress_by_hand():
    """Three particles in the left half, two of them against each other; one alone in the right half."""
    position = [[0.1, 1.0], [0.2, 2.0], [0.3, 0.5], [1.5, 1.0]]
    velocity = [[1.0, 2.0], [-1.0, -2.0], [3.0, 0.0], [5.0, 1.0]]
    kinetic, streaming = kinetic_stress(Volumes(BOX, 2, 1), position, velocity)
    np.testing.assert_allclose(kinetic[0], np.array([[11 - 3, 4], [4, 8]]) / 3.0)
    np.testing.assert_allclose(streaming[0], [[3 / 3.0, 0], [0, 0]], atol=1e-15)
    np.testing.assert_allclose(kinetic[1], 0, atol=1e-15)
    np.testing.assert_allclose(streaming[1], np.array([[25, 5], [5, 1]]) / 3.0)


def test_collisional_stress_by_hand():
    """Each partner gets dp and l of its own: two times dp_x d/2 along x, from both."""
    place, normal = [[1.5, 1.0], [0.5, 1.0]], [[1.0, 0.0], [0.6, -0.8]]
    stress = collisional_stress(Volumes(BOX, 2, 1), place, normal, [-2.0, -1.0], 0.5, 4.0)
    np.testing.assert_allclose(stress[1], [[2 * 0.5 / (3.0 * 4.0), 0], [0, 0]], atol=1e-15)
    np.testing.assert_allclose(stress[0], 0.5 / (3.0 * 4.0) * np.array([[0.36, -0.48], [-0.48, 0.64]]))


@pytest.mark.parametrize("cuts", [(1, 1), (2, 2), (16, 16), (3, 7)])
def test_volumes_add_up_to_the_box(cuts):
    volumes, whole = Volumes(BOX, *cuts), Volumes(BOX, 1, 1)
    kinetic, streaming = kinetic_stress(volumes, POSITION, VELOCITY)
    everything = np.einsum("ia,ib->ab", VELOCITY, VELOCITY) / whole.area
    np.testing.assert_allclose((kinetic + streaming).sum(axis=0) * volumes.area / whole.area, everything, atol=1e-12)
    parts = collisional_stress(volumes, CONTACT, NORMAL, MOMENTUM, 0.1, 2.0)
    of_box = collisional_stress(whole, CONTACT, NORMAL, MOMENTUM, 0.1, 2.0)[0]
    np.testing.assert_allclose(parts.mean(axis=0), of_box, atol=1e-12)
    assert np.trace(of_box) == pytest.approx(-MOMENTUM.sum() * 0.1 / (6.0 * 2.0))


def test_a_common_velocity_is_streaming_alone():
    volumes = Volumes(BOX, 2, 2)
    rest, _ = kinetic_stress(volumes, POSITION, VELOCITY)
    moving, streaming = kinetic_stress(volumes, POSITION, VELOCITY + np.array([30.0, -10.0]))
    np.testing.assert_allclose(moving, rest, rtol=1e-9, atol=1e-9)
    assert (pressure(streaming) > 1000 * 200 / 6.0 / 4).all()


def test_empty_volumes_have_no_stress():
    kinetic, streaming = kinetic_stress(Volumes(BOX, 2, 1), [[0.5, 0.5]], [[1.0, 1.0]])
    assert not kinetic.any()
    assert not streaming[1].any()
    assert not collisional_stress(Volumes(BOX, 2, 2), np.empty((0, 2)), np.empty((0, 2)), np.empty(0), 0.1, 1.0).any()


def test_pressure_is_the_mean_of_the_eigenvalues():
    turned = np.array([[0.6, -0.8], [0.8, 0.6]])
    tensors = np.array([turned @ np.diag(values) @ turned.T for values in ([3.0, 1.0], [5.0, -1.0])])
    np.testing.assert_allclose(pressure(tensors), [2.0, 2.0])

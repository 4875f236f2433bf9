"""How unevenly disks fill a box."""

import numpy as np
import pytest

from granugas.analysis.structure import (
    density_at,
    density_field,
    density_variance,
    mean_wavelength,
    pair_correlation,
    strongest_wavelength,
    structure_factor,
    structure_length,
)

BOX = (2.0, 1.0)


def wave(periods: int, axis: int, n: int = 20_000) -> np.ndarray:
    rng = np.random.default_rng(periods)
    place = rng.random((4 * n, 2))
    kept = rng.random(4 * n) < (1 + np.cos(2 * np.pi * periods * place[:, axis])) / 2
    return place[kept] * BOX


def test_density_is_relative_to_its_mean():
    field = density_field([[0.1, 0.1], [0.2, 0.2], [1.5, 0.9], [1.6, 0.1]], BOX, 2)
    assert np.array_equal(field, [[2, 0], [1, 1]])


def test_positions_outside_of_the_box_are_in_it():
    assert np.array_equal(density_field([[-0.1, 0.1], [2.0, 1.0]], BOX, 2), density_field([[1.9, 0.1], [0.0, 0.0]], BOX, 2))


def test_density_of_each_particle():
    assert np.array_equal(density_at([[0.1, 0.1], [1.5, 0.9], [0.2, 0.2], [1.6, 0.1]], BOX, 2), [2, 1, 2, 1])


def test_variance_of_the_even_the_random_and_the_clustered():
    grid = np.stack(np.meshgrid(np.arange(40) / 20, np.arange(40) / 40), axis=-1).reshape(-1, 2)
    at_random = np.random.default_rng(0).random((20_000, 2)) * BOX
    assert density_variance(grid, BOX, 8) == pytest.approx(0, abs=1e-12)
    assert density_variance(at_random, BOX, 16) == pytest.approx(256 / 20_000, rel=0.3)
    assert density_variance(wave(2, 0), BOX, 16) == pytest.approx(0.5, rel=0.1)


@pytest.mark.parametrize(("periods", "axis", "length"), [(1, 0, 2.0), (3, 0, 2 / 3), (2, 1, 0.5)])
def test_lengths_of_a_wave(periods, axis, length):
    shell = round(np.sqrt(2) / length)
    assert strongest_wavelength(wave(periods, axis), BOX, 32) == pytest.approx(1 / shell)
    assert structure_length(wave(periods, axis, 200_000), BOX, 8) == pytest.approx(length, rel=0.05)


def test_longer_waves_are_longer_structures():
    lengths = [structure_length(wave(periods, 0), BOX, 32) for periods in (6, 4, 2, 1)]
    assert np.all(np.diff(lengths) > 0)


def test_structure_factor_of_points_at_random():
    positions = np.random.default_rng(1).random((50_000, 2)) * BOX
    k, strength = structure_factor(positions, BOX, 256)
    np.testing.assert_allclose(k, 2 * np.pi / np.sqrt(2) * np.arange(1, 65))
    assert np.nanmean(strength[20:]) == pytest.approx(1, abs=0.03)
    assert strength[5:] == pytest.approx(1, abs=0.5)


@pytest.mark.parametrize("mode", [(3, 0), (0, 2), (2, 2)])
def test_structure_factor_of_one_wave(mode):
    """Each disk adds its phase: the sum over k, for a density 1 + cos(kr), is N/4 in two modes of the shell."""
    rng = np.random.default_rng(2)
    place = rng.random((400_000, 2))
    kept = place[rng.random(len(place)) < (1 + np.cos(2 * np.pi * place @ mode)) / 2]
    k, strength = structure_factor(kept * 3.0, (3.0, 3.0), 128)
    shell = round(np.hypot(*mode))
    index = np.arange(-64, 64)
    modes = (np.rint(np.hypot(index[:, None], index)) == shell).sum()
    assert strength.argmax() == shell - 1
    assert k[shell - 1] == pytest.approx(2 * np.pi * shell / 3)
    assert strength[shell - 1] == pytest.approx(2 * len(kept) / 4 / modes, rel=0.03)


def test_structure_factor_equals_the_sum_over_particles():
    rng = np.random.default_rng(3)
    positions = rng.random((500, 2)) * 4.0
    _, strength = structure_factor(positions, (4.0, 4.0), 512)
    wave = 2 * np.pi / 4.0 * np.array([(1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)])
    exact = np.abs(np.exp(1j * positions @ wave.T).sum(axis=0)) ** 2 / 500
    assert strength[0] == pytest.approx(exact.mean(), rel=0.02)


def test_mean_wavelength():
    k = 2 * np.pi / np.array([8.0, 4.0, 2.0, 1.0])
    assert mean_wavelength(k, np.array([0.0, 3.0, 0.0, 0.0]), 1.0) == pytest.approx(4)
    assert mean_wavelength(k, np.array([1.0, 0.0, 1.0, np.nan]), 1.0) == pytest.approx(2 / (1 / 8 + 1 / 2))
    assert mean_wavelength(k, np.array([1.0, 0.0, 1.0, 9.0]), 2.0) == pytest.approx(2 / (1 / 8 + 1 / 2))


def test_the_length_of_the_structure_factor_follows_a_wave():
    lengths = [mean_wavelength(*structure_factor(wave(periods, 0, 200_000), BOX, 128), 0.2) for periods in (6, 4, 2, 1)]
    assert np.all(np.diff(lengths) > 0)
    assert lengths[1] == pytest.approx(0.5, rel=0.1)


def test_pairs_of_points_without_order_and_of_a_lattice():
    rng, box = np.random.default_rng(1), (3.0, 2.0)
    found = np.mean([pair_correlation(rng.random((300, 2)) * box, box, [0.0, 0.2, 0.5, 1.0]) for _ in range(40)], axis=0)
    np.testing.assert_allclose(found, 1, atol=0.02)
    square = np.stack(np.meshgrid(np.arange(8), np.arange(8)), axis=-1).reshape(-1, 2) + 0.5
    near = pair_correlation(square, (8.0, 8.0), [0.0, 0.9, 1.1, 1.3, 1.5])
    expected = 4 * 64 / (63 * np.pi * np.diff(np.square([0.0, 0.9, 1.1, 1.3, 1.5])))
    np.testing.assert_allclose(near, [0, expected[1], 0, expected[3]])

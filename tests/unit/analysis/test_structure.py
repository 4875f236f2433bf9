"""How unevenly disks fill a box."""

import numpy as np
import pytest

from granugas.analysis.structure import density_at, density_field, density_variance, strongest_wavelength, structure_length

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

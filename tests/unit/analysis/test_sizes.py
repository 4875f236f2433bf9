"""Distributions of cluster sizes, some that scale and some that do not."""

import numpy as np
import pytest

from granugas.analysis.clusters import size_bins
from granugas.analysis.sizes import collapse, mass_distribution, middle_sizes, octaves, scaling, size_distribution

N = 10**6
EDGES = size_bins(N)
LOWER, UPPER = EDGES[:-1], EDGES[1:]
SCALES = np.array([20.0, 200.0, 2000.0])


def binned(density):
    """Clusters of N particles in the bins, from n(M)/N of every size M."""
    sizes = np.arange(1, EDGES[-1])
    return np.add.reduceat(N * density(sizes), LOWER - 1)


def growing(scale):
    """n(M) = N/s^2 f(M/s) with f = exp(-x)."""
    return binned(lambda m: np.exp(-m / scale) / scale**2)


def test_middles_of_bins():
    np.testing.assert_allclose(middle_sizes([1, 4, 8], [2, 6, 12]), [1, np.sqrt(20), np.sqrt(88)])


def test_densities_of_a_power_law():
    numbers = binned(lambda m: m**-2.0)
    middles = middle_sizes(LOWER, UPPER)
    np.testing.assert_allclose(size_distribution(numbers, LOWER, UPPER, N) * middles**2, 1, rtol=0.03)
    np.testing.assert_allclose(mass_distribution(numbers, LOWER, UPPER, N), 1, rtol=0.03)


def test_all_particles_are_in_clusters():
    """sum M n(M) = N."""
    numbers = np.zeros((2, len(LOWER)))
    numbers[0, 0], numbers[1, [0, 1]] = N, [N / 2, N / 4]
    density = size_distribution(numbers, LOWER, UPPER, N)
    np.testing.assert_allclose((density * middle_sizes(LOWER, UPPER) * (UPPER - LOWER)).sum(axis=1), 1)


def test_octaves_keep_every_cluster():
    numbers = np.arange(3 * len(LOWER)).reshape(3, -1)
    joined, lower, upper = octaves(numbers, LOWER)
    np.testing.assert_array_equal(lower, 2 ** np.arange(20))
    np.testing.assert_array_equal(upper[:-1], lower[1:])
    np.testing.assert_array_equal(joined.sum(axis=1), numbers.sum(axis=1))
    np.testing.assert_array_equal(joined[0, :4], [0, 1 + 2, 3 + 4, 5 + 6])


def test_what_scales_collapses():
    curves = mass_distribution([growing(s) for s in SCALES], LOWER, UPPER, N)
    shown = np.where(curves > 1e-4, curves, 0)
    assert collapse(middle_sizes(LOWER, UPPER), shown, SCALES) < 0.01
    assert collapse(middle_sizes(LOWER, UPPER), shown, 7 * SCALES) < 0.01  # the unit of s is free
    assert collapse(middle_sizes(LOWER, UPPER), shown, SCALES**2) > 0.5


def test_what_stands_still_does_not_collapse():
    """A distribution that does not change, and one of small clusters that stay beside large ones that grow."""
    sizes = middle_sizes(LOWER, UPPER)
    exponential = mass_distribution(growing(50.0), LOWER, UPPER, N)
    still = np.where(exponential > 1e-4, exponential, 0) * np.array([[1.0], [1.1], [1.2]])
    assert collapse(sizes, still, SCALES) > 10
    tail = binned(lambda m: 0.3 * m**-3.5)
    both = mass_distribution([tail + growing(s) for s in SCALES], LOWER, UPPER, N)
    assert collapse(sizes, np.where(both > 1e-4, both, 0), SCALES) > 0.2
    large = sizes > 30
    assert collapse(sizes[large], np.where(both > 1e-4, both, 0)[:, large], SCALES) < 0.1


def test_by_hand():
    """Two straight lines a distance ln 2 apart, that scaling brings to ln 2 / 2."""
    sizes = np.exp(np.arange(10.0))
    curves = np.array([1 / sizes, 2 / sizes])
    assert collapse(sizes, curves, [1.0, np.sqrt(2)]) == pytest.approx(1 / 4, rel=1e-9)
    assert collapse(sizes, curves, [1.0, 2.0]) == pytest.approx(0, abs=1e-12)


def test_empty_bins_are_no_points():
    sizes = np.exp(np.arange(10.0))
    curves = np.array([1 / sizes, 2 / sizes])
    curves[0, 4:6] = 0
    curves[1, 7] = np.nan
    assert collapse(sizes, curves, [1.0, np.sqrt(2)]) == pytest.approx(1 / 4, rel=1e-9)


@pytest.mark.parametrize("curves", [[[1.0, 2.0, 0, 0], [0, 0, 1.0, 2.0]], [[1.0, 2.0, 3.0, 4.0]] * 2, np.zeros((2, 4))])
def test_without_a_common_range_or_a_difference_there_is_no_quality(curves):
    assert np.isnan(collapse([1, 2, 4, 8], curves, [1.0, 2.0]))


@pytest.fixture
def realizations():
    rng = np.random.default_rng(0)
    numbers = np.array([[rng.poisson(growing(s)) for s in SCALES] for _ in range(5)], dtype=float)
    return numbers, 2 * SCALES * rng.uniform(0.9, 1.1, (5, 3))


def test_scaling_of_realizations(realizations):
    numbers, weighted = realizations
    quality, error = scaling(numbers, weighted, LOWER, UPPER, N, 2)
    assert quality < 0.15
    assert 0 < error < quality
    mean = mass_distribution(numbers.mean(axis=0), LOWER, UPPER, N)[:, 1:]
    assert quality == pytest.approx(collapse(middle_sizes(LOWER, UPPER)[1:], mean, weighted.mean(axis=0)))


def test_one_realization_has_no_error(realizations):
    numbers, weighted = realizations
    quality, error = scaling(numbers[:1], weighted[:1], LOWER, UPPER, N, 1)
    assert np.isfinite(quality) and np.isnan(error)


def test_equal_realizations_have_no_spread(realizations):
    numbers, weighted = realizations
    assert scaling(numbers[[0] * 4], weighted[[0] * 4], LOWER, UPPER, N, 16)[1] == pytest.approx(0, abs=1e-12)

"""Curves compared."""

import numpy as np
import pytest

from granugas.analysis.comparison import interpolated, largest_factor, log_mean, onset, smallest_step


def test_geometric_mean():
    assert np.exp(log_mean([[1.0, 2.0], [4.0, 8.0]])) == pytest.approx([2, 4])


@pytest.mark.parametrize("other", [[0.0, np.log(3)], [0.0, -np.log(3)]])
def test_the_largest_factor_has_no_sign(other):
    assert largest_factor([0.0, 0.0], other) == pytest.approx(3)


@pytest.mark.parametrize(("values", "step"), [([1, 2, 4], 1), ([1, 4, 3], -1), ([2, 2, 3], 0)])
def test_smallest_step(values, step):
    assert smallest_step(values) == step


@pytest.mark.parametrize(("threshold", "place"), [(0.05, 2.0), (0.1, 5.0), (0.3, 9.0), (1.0, 9.0)])
def test_onset_is_the_first_point_above(threshold, place):
    assert onset([1.0, 2.0, 5.0, 7.0, 9.0], [0.0, 0.1, 0.3, 0.05, 0.2], threshold) == place


def test_power_laws_are_interpolated_exactly():
    x = np.array([[1.0, 10.0, 1000.0], [2.0, 5.0, 500.0]])
    y = np.array([[3.0], [7.0]]) * x**-2
    at = np.array([2.0, 4.0, 300.0])
    np.testing.assert_allclose(interpolated(x, y, at), np.array([[3.0], [7.0]]) * at**-2)


def test_no_curve_goes_on_beyond_its_ends():
    x, y = [[1.0, 2.0, 4.0], [1.0, 2.0, np.nan]], [[1.0, 1.0, 1.0], [5.0, 5.0, np.nan]]
    found = interpolated(x, y, [0.5, 1.0, 2.0, 3.0, 4.0, 8.0])
    np.testing.assert_allclose(found, [[np.nan, 1, 1, 1, 1, np.nan], [np.nan, 5, 5, np.nan, np.nan, np.nan]])

"""Windows of time and what is averaged over them."""

import numpy as np
import pytest
import xarray as xr

from granugas.analysis.windows import equal_windows, growing_windows, middles, ratio_of_changes, snapshot_means

TIME = np.linspace(0, 5, 5001)


def series(*runs):
    values = np.array(runs, dtype=float)
    return xr.DataArray(values, dims=("realization", "time"), coords={"time": np.arange(values.shape[1]) * 0.1})


def test_equal_windows_end_at_multiples_of_their_width():
    np.testing.assert_array_equal(equal_windows(TIME, 0.1), np.arange(0, 5001, 100))
    np.testing.assert_array_equal(equal_windows([0, 0.3, 0.9, 1.0, 1.7, 2.4], 1.0), [0, 3, 4])


def test_windows_without_a_sample_are_left_out():
    np.testing.assert_array_equal(equal_windows([0, 0.5, 3.5, 4.0], 1.0), [0, 1, 3])


def test_rounding_moves_no_edge():
    """.1 + .2 is larger than .3, and three times .1, which is not .3 either, ends no window early or late."""
    np.testing.assert_array_equal(equal_windows([0.0, 0.1 + 0.2, 0.6], 0.3), [0, 1, 2])
    np.testing.assert_array_equal(equal_windows(np.arange(11) / 10, 0.1), np.arange(11))


def test_growing_windows():
    edges = growing_windows(TIME, 0.002, 2.0)
    np.testing.assert_array_equal(edges, [0, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096])


def test_ratio_of_changes_counts_each_window_by_itself():
    part, whole = series([0, 1, 1, 5, 5], [0, 0, 2, 2, 2]), series([0, 2, 4, 8, 8], [0, 4, 8, 8, 8])
    found = ratio_of_changes(part, whole, np.array([0, 2, 3, 4]))
    np.testing.assert_allclose(found, [[0.25, 1.0, np.nan], [0.25, np.nan, np.nan]])
    assert found.dims == ("realization", "time")


def test_middles():
    np.testing.assert_allclose(middles(series([0, 1, 4, 9]), np.array([0, 2, 3])), [[2.0, 6.5]])


def test_snapshot_means_take_equidistant_samples_up_to_the_end():
    values = series(np.arange(21.0))
    np.testing.assert_allclose(snapshot_means(values, np.array([0, 10, 20]), 2), [[(5 + 10) / 2, (15 + 20) / 2]])
    np.testing.assert_allclose(snapshot_means(values, np.array([0, 2, 20]), 20), [[1.5, 11.5]])


def test_twenty_snapshots_of_a_tenth_of_a_second_are_every_fifth_sample():
    values = xr.DataArray(np.random.default_rng(1).random((2, 5001)), dims=("realization", "time"))
    expected = values.values[:, 5::5].reshape(2, 50, 20).mean(axis=2)
    np.testing.assert_allclose(snapshot_means(values, equal_windows(TIME, 0.1), 20), expected)


@pytest.mark.parametrize("count", [1, 3, 7])
def test_what_runs_have_not_reached_stays_missing(count):
    values = series([0.0, 1.0, 2.0, np.nan, np.nan])
    edges = np.array([0, 2, 4])
    assert np.isnan(ratio_of_changes(values, values, edges)[0, 1])
    assert np.isnan(snapshot_means(values, edges, count)[0, 1])

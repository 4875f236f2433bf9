"""Limits of a run and its sampling points."""

import numpy as np
import pytest

from granugas.sampling import Limits, sampling_points


def test_logarithmic_points_end_on_the_limit():
    samples = sampling_points(Limits.of(5.0), {"spacing": "log", "count": 7, "first": 1e-3})
    assert samples.axis == "time"
    assert samples.points[0] == 1e-3
    assert samples.points[-1] == 5.0
    np.testing.assert_allclose(np.diff(np.log(samples.points)), np.log(5000) / 6)


def test_linear_points():
    samples = sampling_points(Limits.of({"time": 2.0}), {"spacing": "linear", "count": 4, "first": 0.5})
    np.testing.assert_allclose(samples.points, [0.5, 1.0, 1.5, 2.0])


def test_collisions_are_the_axis_where_no_time_limits():
    samples = sampling_points(Limits.of({"collisions_per_particle": 100}), {"count": 3, "first": 1.0})
    assert samples.axis == "collisions"
    np.testing.assert_allclose(samples.points, [1, 10, 100])


def test_the_axis_can_be_chosen_where_both_limit():
    both = Limits.of({"time": 5.0, "collisions_per_particle": 100})
    assert sampling_points(both, {}).points[-1] == 5.0
    assert sampling_points(both, {"axis": "collisions"}).points[-1] == 100


def test_one_sample_is_the_end():
    np.testing.assert_array_equal(sampling_points(Limits.of(3.0), {"count": 1}).points, [3.0])


def test_the_default_begins_early_in_a_short_run():
    assert sampling_points(Limits.of(1e-3)).points[0] == pytest.approx(1e-5)


@pytest.mark.parametrize("until", [0, -1.0, np.inf, np.nan, True, "5", {}, {"times": 5.0}, {"time": 0}])
def test_impossible_limits(until):
    with pytest.raises(ValueError, match="until"):
        Limits.of(until)


@pytest.mark.parametrize(
    ("samples", "key"),
    [
        ({"spacing": "cubic"}, "spacing"),
        ({"count": 0}, "count"),
        ({"count": 2.5}, "count"),
        ({"first": 6.0}, "first"),
        ({"first": 0.0}, "first"),
        ({"axis": "collisions"}, "axis"),
        ({"frist": 1e-3}, "frist"),
    ],
)
def test_impossible_samples(samples, key):
    with pytest.raises(ValueError, match=rf"samples\.{key}"):
        sampling_points(Limits.of(5.0), samples)

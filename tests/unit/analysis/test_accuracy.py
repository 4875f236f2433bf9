"""Made-up numbers with known answers."""

import numpy as np
import pytest
import xarray as xr

from granugas.analysis.accuracy import at_zero, bias, in_large_systems, mean_error, scatter


def numbers(values, *dims, **coords) -> xr.DataArray:
    return xr.DataArray(np.asarray(values, float), coords, dims)


def test_mean_error_leaves_out_what_is_not_there():
    assert mean_error(numbers([1, 2, 3, 4], "realization")) == pytest.approx(np.sqrt(5 / 3) / 2)
    assert mean_error(numbers([1, 3, np.nan], "realization")) == pytest.approx(1)
    assert np.isnan(mean_error(numbers([1], "realization")))


def test_a_straight_line_is_followed_to_zero_in_each_realization():
    t_c = np.array([1e-5, 1e-8, 1e-6, 1e-12])
    lines = [[2 + 3e4 * t, -1 - 1e3 * t] for t in t_c]
    found = at_zero(numbers(lines, "setting", "realization", setting=t_c), "setting")
    np.testing.assert_allclose(found, [2, -1], rtol=1e-12)


def test_noise_about_a_line_enters_the_limit_with_its_weight():
    """Points at 1, 2, 3: the intercept is 4/3 y_1 + 1/3 y_2 - 2/3 y_3."""
    y = np.array([[0.3, -0.2, 0.5], [0.0, 1.0, 0.0]])
    found = at_zero(numbers(y, "realization", "x", x=[1, 2, 3]), "x")
    np.testing.assert_allclose(found, y @ np.array([4, 1, -2]) / 3, atol=1e-14)


def test_a_limit_needs_three_points_and_all_of_them():
    with pytest.raises(ValueError, match=r"x = \[1\.0, 2\.0\]: at least 3"):
        at_zero(numbers([1, 1], "x", x=[1, 2]), "x")
    assert np.isnan(at_zero(numbers([1, np.nan, 1], "x", x=[1, 2, 3]), "x"))


def test_bias_of_paired_runs_knows_nothing_of_what_they_share():
    """Realizations differ by 10, their differences from the truth are 1 +- 1/sqrt(3)."""
    truths = numbers([10, 20, 30], "realization")
    values = numbers([[10, 22, 31], [10, 20, 30]], "setting", "realization", setting=[1, 0])
    found = bias(values, truths)
    assert found["truth"] == 20 and found["truth_error"] == pytest.approx(10 / np.sqrt(3))
    np.testing.assert_allclose(found["measured"], [21, 20])
    np.testing.assert_allclose(found["measured_error"], [mean_error(values[0]), 10 / np.sqrt(3)])
    np.testing.assert_allclose(found["relative_error"], [1 / 20, 0])
    np.testing.assert_allclose(found["relative_error_error"], [1 / np.sqrt(3) / 20, 0])


def test_errors_count_from_either_side_and_by_the_size_of_the_truth():
    found = bias(numbers([-3, -5], "realization"), numbers([-2, -2], "realization"))
    assert found["relative_error"] == 1 and found["relative_error_error"] == pytest.approx(0.5)


def test_nothing_is_relative_to_zero():
    found = bias(numbers([1, 3], "realization"), numbers(0.0))
    assert (found["measured"], found["truth"], found["truth_error"]) == (2, 0, 0)
    assert np.isnan(found["relative_error"]) and np.isnan(found["relative_error_error"])
    assert np.isnan(scatter(numbers([1, 3], "realization"), numbers(0.0))["relative_error"])


def test_scatter_of_single_runs():
    """Squares 1, 9, 1, 9: root mean square sqrt 5, its error half of theirs by it."""
    found = scatter(numbers([9, 13, 11, 7], "realization"), numbers(10.0))
    assert found["relative_error"] == pytest.approx(np.sqrt(5) / 10)
    assert found["relative_error_error"] == pytest.approx(np.sqrt(64 / 3) / 2 / (2 * np.sqrt(5)) / 10)


@pytest.mark.parametrize("judge", [bias, scatter])
def test_errors_are_as_large_as_they_say(judge):
    """What many groups of realizations find scatters by the error that each of them gives."""
    drawn = numbers(np.random.default_rng(1).normal(1.3, 0.2, (50, 3000)), "realization", "group")
    found = judge(drawn, numbers(1.0))
    assert float(found["relative_error_error"].mean()) == pytest.approx(float(found["relative_error"].std()), rel=0.05)


def test_the_limit_of_large_systems_is_that_of_a_line_in_1_over_n():
    n = xr.DataArray([10.0, 100.0, 1000.0, 10000.0], dims="setting")
    measured = (2 + 30 / n + 5000 / n**3).assign_coords(setting=n)
    error = xr.full_like(measured, 1e-3)
    found = in_large_systems(measured, error, "setting")
    assert float(found["truth"]) == pytest.approx(2, abs=2e-3)
    assert float(in_large_systems(measured[::-1], error[::-1], "setting")["truth"]) == pytest.approx(float(found["truth"]))
    rng = np.random.default_rng(1)
    drawn = measured + xr.DataArray(rng.normal(0, 1e-3, (4000, 4)), dims=("draw", "setting"))
    assert float(in_large_systems(drawn, error, "setting")["truth"].std()) == pytest.approx(
        float(found["truth_error"]), rel=0.05
    )


def test_one_size_has_no_limit():
    one = xr.DataArray([1.0], {"setting": [42.0]}, ("setting",))
    with pytest.raises(ValueError, match="at least 2 sizes"):
        in_large_systems(one, one, "setting")

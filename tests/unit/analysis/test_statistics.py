"""Means, intervals and power laws on data that were made to known answers."""

import numpy as np
import pytest
import scipy.stats

from granugas.analysis import statistics


def test_mean_and_error_over_realizations():
    mean, error = statistics.mean_and_error([[1.0, 4.0, 1.0], [3.0, 4.0, np.nan], [5.0, 4.0, np.nan]])
    np.testing.assert_allclose(mean, [3, 4, 1])
    np.testing.assert_allclose(error, [2 / np.sqrt(3), 0, np.nan])


def test_mean_of_nothing_is_nan():
    mean, error = statistics.mean_and_error([[np.nan], [np.nan]])
    assert np.isnan(mean).all() and np.isnan(error).all()


def test_student_t_table():
    expected = scipy.stats.t.ppf((1 + statistics.CONFIDENCE) / 2, np.arange(1, len(statistics.STUDENT_T) + 1))
    np.testing.assert_allclose(statistics.STUDENT_T, expected, atol=5e-5)


@pytest.mark.parametrize("freedom", [1, 5, 9, 10, 15, 40, 1000])
def test_student_t(freedom):
    assert statistics.student_t(freedom) == pytest.approx(scipy.stats.t.ppf((1 + statistics.CONFIDENCE) / 2, freedom), rel=2e-3)


@pytest.mark.parametrize("n", [2, 4, 6, 10, 12])
def test_the_bootstrap_covers_the_truth_as_often_as_it_says(n, monkeypatch):
    monkeypatch.setattr(statistics, "RESAMPLES", 1000)
    rng = np.random.default_rng(n)
    intervals = np.array([statistics.bootstrap_interval(rng.normal(size=n)) for _ in range(600 if n > 4 else 2000)])
    covered = np.mean((intervals[:, 0] < 0) & (intervals[:, 1] > 0))
    assert covered == pytest.approx(0.95, abs=0.02)


def test_no_interval_from_one_realization():
    assert np.isnan(statistics.bootstrap_interval([1.0])).all()


def test_no_interval_where_some_draws_have_no_value():
    assert np.isnan(statistics.bootstrap_interval([1.0, 2.0, 3.0], lambda v: v.mean() if v.max() > 2 else np.nan)).all()


def test_bootstrap_interval_is_the_normal_one_for_many_realizations():
    values = np.random.default_rng(5).normal(2.0, 3.0, 400)
    half_width = 1.96 * values.std(ddof=1) / np.sqrt(len(values))
    expected = values.mean() - half_width, values.mean() + half_width
    np.testing.assert_allclose(statistics.bootstrap_interval(values), expected, atol=0.1 * half_width)


def test_bootstrap_of_another_statistic():
    values = np.random.default_rng(6).exponential(size=300)
    low, high = statistics.bootstrap_interval(values, np.median)
    assert low < np.median(values) < high
    assert low < np.log(2) < high


def noisy_power_laws(n, rng, correlated=0.0):
    """n realizations of 5 x^-0.7; `correlated` is a wander that all times of one realization share in part."""
    x = np.geomspace(0.1, 1000, 80)
    slopes = -0.7 + correlated * rng.normal(size=(n, 1))
    return x, 5 * x**slopes * np.exp(0.02 * rng.normal(size=(n, 80)))


@pytest.mark.parametrize("n", [1, 2, 4, 16])
def test_power_law_is_recovered(n):
    x, y = noisy_power_laws(n, np.random.default_rng(n))
    fit = statistics.fit_power_law(x, y, (1, 100))
    assert fit.exponent == pytest.approx(-0.7, abs=0.01)
    assert fit.amplitude == pytest.approx(5, rel=0.03)
    assert fit(10.0) == pytest.approx(5 * 10**-0.7, rel=0.02)
    assert fit.exponents.shape == (n,)
    assert np.isnan(fit.half_width) if n == 1 else 0 < fit.half_width < 0.1


@pytest.mark.parametrize("n", [3, 12])
def test_interval_tells_of_the_realizations_and_not_of_the_times(n):
    """Slopes differ from run to run by .1 while the points of one run lie on a line: only the former is the error."""
    rng = np.random.default_rng(7)
    covered, widths = 0, []
    for _ in range(60):
        fit = statistics.fit_power_law(*noisy_power_laws(n, rng, correlated=0.1), (1, 100))
        covered += fit.interval[0] < -0.7 < fit.interval[1]
        widths.append(fit.half_width)
    assert covered >= 50
    assert np.median(widths) > 0.04


def test_points_outside_of_the_window_do_not_count():
    x, y = noisy_power_laws(3, np.random.default_rng(8))
    bent = np.where((x < 1) | (x > 100), 1e6, y)
    assert statistics.fit_power_law(x, bent, (1, 100)).exponent == statistics.fit_power_law(x, y, (1, 100)).exponent


def test_realizations_that_end_in_the_window_are_left_out():
    x, y = noisy_power_laws(3, np.random.default_rng(9))
    y[1, x > 50] = np.nan
    assert len(statistics.fit_power_law(x, y, (1, 100)).exponents) == 2
    assert len(statistics.fit_power_law(x, y, (1, 40)).exponents) == 3


def test_windows_without_an_answer_are_refused():
    x, y = noisy_power_laws(2, np.random.default_rng(10))
    with pytest.raises(ValueError, match=r"window = \(1, 1.1\): 1 points in it, at least 3"):
        statistics.fit_power_law(x, y, (1, 1.1))
    with pytest.raises(ValueError, match="no realization"):
        statistics.fit_power_law(x, -y, (1, 100))


def test_the_jackknife_of_a_mean_is_its_standard_error():
    values = np.random.default_rng(1).normal(size=(12, 3))
    mean, error = statistics.jackknife(lambda v: v.mean(axis=0), values)
    assert np.allclose((mean, error), statistics.mean_and_error(values))


def test_the_jackknife_adds_independent_groups():
    rng = np.random.default_rng(2)
    first, second = 5 + rng.normal(size=20), 2 + 0.1 * rng.normal(size=8)
    ratio, error = statistics.jackknife(lambda a, b: a.mean() / b.mean(), first, second)
    parts = [values.std(ddof=1) / np.sqrt(len(values)) / values.mean() for values in (first, second)]
    assert ratio == pytest.approx(first.mean() / second.mean())
    assert error == pytest.approx(ratio * np.hypot(*parts), rel=0.05)


def test_a_single_realization_has_no_jackknife_error():
    value, error = statistics.jackknife(lambda a, b: a.mean() - b.mean(), [3.0], [1.0, 2.0])
    assert value == pytest.approx(1.5) and np.isnan(error)

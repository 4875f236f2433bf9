"""The growth law on curves whose exponents and kinks are known."""

import numpy as np
import pytest

from granugas.analysis.growth import growth_regime, growth_window, local_exponent, regime_boundaries, window_exponents
from granugas.analysis.statistics import fit_power_law

T = np.geomspace(5e-3, 446.6, 250)


def three_regimes(n=6, begin=1.0, end=40.0, power=0.3, noise=0.0, seed=1, t=T):
    """(n, m) constant, growing as t^power between the kinks, constant; kinks and values scatter by the noise."""
    rng = np.random.default_rng(seed)
    kinks = np.log([begin, end]) + 5 * noise * rng.normal(size=(n, 1, 2))
    grown = np.clip(np.log(t)[:, np.newaxis], kinks[..., :1], kinks[..., 1:])[..., 0] - kinks[..., 0]
    return 1.2 * np.exp(power * grown + noise * rng.normal(size=(n, len(t))))


@pytest.mark.parametrize("power", [-2.0, 0.3])
def test_the_local_exponent_of_a_power_law_is_its_exponent(power):
    found = local_exponent(T, np.stack([T**power, 5 * T**power]))
    t = T
    there = (t >= 2 * t[0]) & (t <= t[-1] / 2)
    np.testing.assert_allclose(found[:, there], power, rtol=1e-9)
    assert np.isnan(found[:, (t < 1.99 * t[0]) | (t > t[-1] / 1.99)]).all()


@pytest.mark.parametrize("width", [0.7, np.log(4), 2.0])
def test_at_a_kink_it_is_the_mean_of_both_powers(width):
    t = np.geomspace(0.01, 100, 401)
    y = np.where(t < 1, t**-0.5, t**0.9)
    assert local_exponent(t, y, width)[200] == pytest.approx(0.2, abs=1e-9)


def test_its_mean_is_that_of_the_geometric_mean():
    y = three_regimes(noise=0.05)
    np.testing.assert_allclose(local_exponent(T, y).mean(axis=0), local_exponent(T, np.exp(np.log(y).mean(axis=0))))


def test_a_run_that_ends_has_exponents_until_then():
    y = np.stack([T**0.3, np.where(T < 10, T**0.3, np.nan)])
    found = local_exponent(T, y)[1]
    assert np.isnan(found[T > 5.1]).all() and found[(T > 1) & (T < 4.9)] == pytest.approx(0.3)


@pytest.mark.parametrize("width", [0.7, np.log(4)])
def test_growth_lies_between_the_kinks(width):
    begin, end = growth_regime(T, local_exponent(T, three_regimes(1)[0], width))
    assert begin == pytest.approx(1, rel=0.02) and end == pytest.approx(40, rel=0.02)


def test_growth_without_an_end_has_none():
    begin, end = growth_regime(T, local_exponent(T, three_regimes(1, end=1e4)[0]))
    assert begin == pytest.approx(1, rel=0.02) and np.isnan(end)


@pytest.mark.parametrize("y", [np.ones(250), T**-0.3, np.full(250, np.nan)])
def test_nothing_grows(y):
    assert np.isnan(growth_regime(T, local_exponent(T, y))).all()


def test_what_decays_more_slowly_does_not_grow():
    assert np.isnan(growth_regime([1.0, 2.0, 4.0, 8.0], [-0.5, -0.1, -0.2, -0.5])).all()


def test_a_bump_elsewhere_is_no_boundary():
    """The boundaries are those next to the maximum."""
    exponent = np.interp(np.log(T), np.log([0.01, 0.02, 0.04, 1, 2, 40, 80]), [0, 0.2, 0, 0, 0.3, 0.3, 0])
    begin, end = growth_regime(T, exponent)
    assert (begin, end) == pytest.approx((np.sqrt(2), 40 * np.sqrt(2)), rel=0.01)


@pytest.mark.parametrize(("end", "reached"), [(40, 40), (1e4, T[-1])])
def test_the_window_of_a_fit_is_the_regime_or_ends_with_the_samples(end, reached):
    assert growth_window(T, three_regimes(end=end)) == pytest.approx((1, reached), rel=0.02)


def test_a_jump_leaves_enough_samples_to_fit():
    """A dip after it makes its regime narrower than the window of a local exponent."""
    t = np.geomspace(5e-3, 446.6, 20)
    y = np.where(t > 1, np.where(t > 3, 1.5, 3), 1.0)[np.newaxis]
    narrow, window = growth_regime(t, local_exponent(t, y)[0]), growth_window(t, y)
    assert np.count_nonzero((t >= narrow[0]) & (t <= narrow[1])) < 3
    assert fit_power_law(t, y, window).exponent > 0


@pytest.mark.parametrize("y", [T**-0.3, np.full(250, np.nan)])
def test_where_nothing_grows_the_window_is_the_run(y):
    assert growth_window(T, y[np.newaxis]) == (T[0], T[-1])


@pytest.mark.parametrize("samples", [60, 250])
def test_boundaries_of_noisy_runs_with_intervals(samples):
    t = np.geomspace(5e-3, 446.6, samples)
    covered = []
    for seed in range(15):
        found = regime_boundaries(t, three_regimes(noise=0.01, seed=seed, t=t))
        assert [found[0].time, found[1].time] == pytest.approx([1, 40], rel=0.15)
        covered += [b.low < truth < b.high for b, truth in zip(found, (1, 40), strict=True)]
        assert all(1 < b.high / b.low < 1.5 for b in found)
    assert np.mean(covered) > 0.8


def test_the_energy_has_boundaries_in_its_excess_over_homogeneous_cooling():
    """-2, then -1, then -1.8: the excess grows with power 1, then .2."""
    y = np.exp(np.interp(np.log(T), np.log([5e-3, 0.5, 50, 446.6]), np.cumsum([0, 0, np.log(100), 0.2 * np.log(446.6 / 50)])))
    begin, end = regime_boundaries(T, y[np.newaxis] * np.array([[1.0], [1.02]]))
    assert begin.time == pytest.approx(0.5, rel=0.03)
    assert 50 < end.time < 80  # half of the maximum is nearer to the lower level than the kink's mean of both


def test_one_run_has_boundaries_without_intervals():
    for boundary in regime_boundaries(T, three_regimes(1)):
        assert boundary.time > 0 and np.isnan([boundary.low, boundary.high]).all()


def test_intervals_end_with_the_samples():
    for boundary in regime_boundaries(T, three_regimes(2, noise=0.3)):
        assert np.isnan(boundary.low) or T[0] <= boundary.low <= boundary.high <= T[-1]


def test_exponents_over_all_windows():
    lows, highs = [0.01, 1.0, 2.0, 30.0], [0.1, 1.5, 40.0, 400.0]
    y = three_regimes(3, noise=0.02)
    found = window_exponents(T, y, lows, highs)
    assert found.shape == (4, 4)
    for i, j in ((0, 0), (0, 3), (1, 2), (2, 2), (3, 3)):
        assert found[i, j] == pytest.approx(fit_power_law(T, y, (lows[i], highs[j])).exponent)
    assert found[1, 2] == pytest.approx(0.3, abs=0.02) and found[0, 0] == pytest.approx(0, abs=0.02)
    assert np.isnan([found[1, 1], found[3, 2], found[2, 0]]).all()  # shorter than an octave, or nothing at all


def test_windows_of_two_samples_tell_nothing():
    assert np.isnan(window_exponents([1.0, 2.0, 4.0], [[1.0, 2.0, 4.0]], [1.0], [2.5])).all()
    assert window_exponents([1.0, 2.0, 4.0], [[1.0, 2.0, 4.0]], [1.0], [4.0]) == pytest.approx(1)

"""The edge of the collapse on made-up runs whose edge is known."""

import numpy as np
import pytest
import xarray as xr

from granugas.analysis.threshold import collapse_threshold, collapsed_within, crossing, falling, rate_on_approach

R = np.array([0.1, 0.2, 0.3, 0.4])


def test_falling_levels_what_rises():
    np.testing.assert_allclose(falling([1, 0.2, 0.6, 0.0]), [1, 0.4, 0.4, 0.0])
    np.testing.assert_allclose(falling([0.3, 0.6, 0.9]), [0.6, 0.6, 0.6])
    np.testing.assert_allclose(falling([1, 0.5, 0.0]), [1, 0.5, 0.0])


def test_crossing_lies_on_a_straight_line():
    assert crossing(R, [1, 0.75, 0.25, 0]) == pytest.approx(0.25)
    assert crossing(R, [1, 0.9, 0.1, 0]) == pytest.approx(0.25)
    assert crossing(R, [1, 0.6, 0.2, 0]) == pytest.approx(0.225)
    assert crossing(R, [1, 1, 0, 0.2]) == pytest.approx(0.2 + 0.1 * 5 / 9)  # after levelling 1, 1, .1, .1
    assert crossing(R, [1, 0.5, 0, 0]) == pytest.approx(0.2)


@pytest.mark.parametrize("fraction", [[0.4, 0.3, 0.2, 0], [1, 0.9, 0.8, 0.6]])
def test_no_crossing(fraction):
    assert np.isnan(crossing(R, fraction))
    assert np.isnan(collapse_threshold(R, [[round(f) for f in fraction]] * 3)).all()


def test_a_sharp_edge_is_known_to_a_step_of_r():
    """All realizations alike: drawing them again tells nothing, and r_c may be anywhere between .2 and .3."""
    assert collapse_threshold(R, [[1, 1, 0, 0]] * 5) == pytest.approx((0.25, 0.2, 0.3))
    assert collapse_threshold(R, [[1, 1, 0, 0]]) == pytest.approx((0.25, 0.2, 0.3))


def test_edge_of_known_place():
    """Runs collapse with a chance that falls from 1 to 0 over .1 in r: r_c is found, and bands hold it."""
    rng, r = np.random.default_rng(5), np.linspace(0.4, 0.8, 9)
    chance = 1 / (1 + np.exp((r - 0.63) / 0.025))
    assert collapse_threshold(r, rng.random((4000, 9)) < chance).value == pytest.approx(0.63, abs=0.005)
    bands = [collapse_threshold(r, rng.random((12, 9)) < chance) for _ in range(8)]
    assert sum(low <= 0.63 <= high for _, low, high in bands) >= 7
    assert all(high - low < 0.2 for _, low, high in bands)


def test_collapsed_within():
    """N = 10: 50 events are 10 collisions per particle."""
    runs = xr.Dataset(
        {
            "events": ("realization", [20, 50, 60, 100, 30]),
            "stop_reason": ("realization", [*["inelastic_collapse"] * 3, "collisions_per_particle", "time"]),
        },
        {"n_particles": 10},
    )
    np.testing.assert_array_equal(collapsed_within(runs, 10), [1, 1, 0, 0, np.nan])
    np.testing.assert_array_equal(collapsed_within(runs, 20), [1, 1, 1, 0, np.nan])
    np.testing.assert_array_equal(collapsed_within(runs, 21), [1, 1, 1, np.nan, np.nan])


def test_rate_on_approach():
    """Ten collisions a decade have a rate that is inverse to the time left; a decade that the record begins in has none."""
    left = 10.0 ** -(np.arange(-5, 40) / 10 + 0.05)
    rate = rate_on_approach([*left, np.nan], 10.0 ** np.arange(-4, 2))
    np.testing.assert_allclose(rate[:4], 10 / (9 * 10.0 ** np.arange(-4, 0)))
    assert np.isnan(rate[4])

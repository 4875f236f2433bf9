"""One ball on a plate against A Eqs. 5 to 13, for all r and t_c / t_1 (A section 4.2)."""

import numpy as np
import pytest
import xarray as xr

from granugas.analysis import theory
from granugas.analysis.at_rest import energies_at_rest
from granugas.dynamics.events.effects.constant import Constant
from granugas.dynamics.events.effects.contact_time import ContactTime
from granugas.dynamics.plate import COLLAPSE, HITS, Ball, bounce
from granugas.experiments import bouncing
from granugas.storage.variables import describe

G, T_1 = bouncing.GRAVITY, bouncing.FIRST_PERIOD
R, RATIO = np.meshgrid(bouncing.RESTITUTIONS, bouncing.CONTACT_RATIOS, indexing="ij")


@pytest.fixture(scope="module")
def ball() -> xr.Dataset:
    return describe(bouncing.measure())


@pytest.fixture(scope="module")
def one_period(ball) -> xr.Dataset:
    """Averages over one period, in units of the formulas for it, wherever it ends."""
    means = ball.sel(window=1)
    period = ball["staying_period"]
    return xr.Dataset(
        {
            "v": means["mean_velocity"] / (G * period),
            "v2": means["mean_square_velocity"] / theory.resting_square_velocity(period, G)[..., None],
            "h": means["mean_height"] / theory.resting_height(period, G)[..., None],
            "force": means["plate_force"],
        }
    )


def in_units_of_t_1(times: xr.DataArray) -> np.ndarray:
    return times.values / T_1


@pytest.mark.parametrize("r", bouncing.RESTITUTIONS)
def test_speeds_and_flights_until_rest(r):
    """A Eqs. 5 and 6."""
    ratio = 1e-4
    run = bounce(ContactTime(Constant(r), ratio * T_1), Ball(0.0, -bouncing.FIRST_SPEED), G, 2000)
    assert run.stop == HITS
    n = np.arange(1, theory.whole_hits_to_rest(r, ratio) + 1)
    speeds = theory.bounce_speed(n, r, bouncing.FIRST_SPEED)
    np.testing.assert_allclose(run.before[: len(n)], speeds, rtol=1e-12)
    np.testing.assert_allclose(run.since[1 : len(n)], theory.bounce_period(speeds[1:], G), rtol=1e-12)
    assert run.elastic[len(n) :].all()
    assert not run.elastic[: len(n)].any()


def test_hits_until_rest_are_equation_7_rounded_up(ball):
    n_s = ball["hits_to_rest"].values
    np.testing.assert_array_equal(n_s, theory.whole_hits_to_rest(R, RATIO))
    more = n_s - theory.hits_to_rest(R, RATIO)
    assert np.all((more >= 0) & (more < 1))


def test_hard_balls_collapse_at_equation_8(ball):
    assert set(ball["stop_reason"].values) == {COLLAPSE}
    expected = theory.rest_time_hard(bouncing.RESTITUTIONS)
    np.testing.assert_allclose(in_units_of_t_1(ball["rest_time_hard"]), expected, rtol=1e-12)
    assert ball["hits_to_collapse"].max() < bouncing.MOST_HITS


def test_time_until_rest(ball):
    """A Eq. 9 has the real n_s and the flight after the last hit in it: t_s is earlier by no more than that flight."""
    measured = in_units_of_t_1(ball["rest_time"])
    np.testing.assert_allclose(measured, theory.rest_time_hard(R) - theory.whole_rest_time_difference(R, RATIO), rtol=1e-12)
    early = theory.rest_time(R, RATIO) - measured
    assert np.all(early > 0)
    assert np.all(early < RATIO * (1 + 1e-9))


def test_difference_of_the_times_until_rest(ball):
    """A Eq. 10 is the least that whole hits lead to, and right within 1/r; rounding is that of t_s."""
    measured = in_units_of_t_1(ball["rest_time_difference"])
    np.testing.assert_allclose(measured, theory.whole_rest_time_difference(R, RATIO), rtol=1e-12, atol=1e-12)
    ratio = measured / theory.rest_time_difference(R, RATIO)
    assert np.all((ratio > 1) & (ratio < 1 / R))


def test_period_that_stays(ball):
    period = in_units_of_t_1(ball["staying_period"])
    np.testing.assert_allclose(period, theory.staying_period(R, RATIO), rtol=1e-12)
    assert np.all((period > R * RATIO) & (period <= RATIO))


@pytest.mark.parametrize(("name", "expected"), [("v", 0.0), ("v2", 1.0), ("h", 1.0), ("force", 1.0)])
def test_averages_over_a_period(one_period, name, expected):
    """<v> = 0, <v^2> = (g t_n)^2 / 12, <h> = g t_n^2 / 12, f = m g, whenever the period ends."""
    np.testing.assert_allclose(one_period[name], expected, atol=1e-12)


def test_all_energy_is_elastic(ball):
    """E_k = 0 in any window, E_p = 2 E over a period."""
    np.testing.assert_array_equal(ball["elastic_square_velocity"], ball["mean_square_velocity"])
    over = ball.sel(window=1)
    np.testing.assert_allclose(G * over["mean_height"], 2 * over["mean_square_velocity"] / 2, rtol=1e-12)


def test_longer_windows_hold_one_hit_more_or_less(ball):
    """The force of w + 1/2 periods is (w or w + 1) / (w + 1/2) of the weight."""
    for window in bouncing.WINDOWS[1:]:
        hits = ball["plate_force"].sel(window=window) * window
        np.testing.assert_allclose(hits, np.round(hits), rtol=1e-9)
        assert set(np.round(hits.values).ravel()) == {window - 0.5, window + 0.5}
        for name in ("mean_square_velocity", "mean_height"):
            longer, period = (ball[name].sel(window=w) for w in (window, 1))
            np.testing.assert_allclose(longer.mean("window_end"), period.mean("window_end"), rtol=0.1 / window)


def test_gravity_switched_off(ball):
    """The formula with u; 1e4 phases leave 1e-4 of rounding at the phase where the last hit becomes elastic."""
    period = ball["staying_period"].values
    expected = theory.released_square_velocity(period, G, R, period / (RATIO * T_1))
    np.testing.assert_allclose(ball["released_square_velocity"], expected, rtol=2e-4)
    by_print = (G * period) ** 2 * (1 + R) / 24  # 1 + r is too low, and for larger r hardly apart
    assert np.all((ball["released_square_velocity"] / by_print)[:3] > 1.05)
    from_elastic = ball["mean_square_velocity"].sel(window=1).mean("window_end")
    assert np.all(ball["released_square_velocity"] < from_elastic * (1 + 1e-4))


def test_soft_particle_at_rest(ball):
    """k h_0 = m g, V(h_0) of the sheet, and the ball with its energy has t_n = 1.103 t_c^el (A Eqs. 12, 13, corrected)."""
    t_c = float(ball["soft_contact_time"])
    elastic = float(ball["soft_elastic_energy"])
    assert float(ball["soft_force"]) == pytest.approx(1, rel=1e-12)
    assert elastic == pytest.approx(theory.spring_energy_at_rest(t_c, G), rel=1e-7)
    assert float(ball["soft_potential_energy"]) == pytest.approx(-2 * elastic, rel=1e-12)
    assert float(ball["soft_kinetic_energy"]) < 1e-20 * elastic
    measured = ball["elastic_square_velocity"].sel(window=1).mean("window_end") / 2 / ball["staying_period"] ** 2
    np.testing.assert_allclose(np.sqrt(elastic / measured) / t_c, theory.PERIOD_OF_SPRING, rtol=1e-7)


def test_heights(ball):
    """The hard ball has no state after its collapse, the TC ball goes on below g t_c^2 / 8, the soft one sinks in."""
    rest = ball.sel(restitution=ball.attrs["restitution"], contact_ratio=ball.attrs["contact_ratio"])
    time = ball["experiment_time"]
    late = time > rest["rest_time_hard"]
    assert np.isnan(ball["height_hard"][late]).all()
    assert np.isfinite(ball["height_hard"][~late]).all()
    before = time < rest["rest_time"]
    np.testing.assert_allclose(ball["height_hard"][before], ball["height_contact_time"][before], rtol=1e-12, atol=1e-15)
    top = ball["height_contact_time"][late].max()
    assert top == pytest.approx(G * float(rest["staying_period"]) ** 2 / 8, rel=1e-3)
    soft = ball["height_soft"]
    assert soft.min() < -10 * top
    assert float(soft[-1]) == pytest.approx(float(rest["soft_potential_energy"]) / G, rel=0.05)


def test_table_1(ball):
    """All but E_p and the force in the quasi-static limit: E_k = 0, E_e > 0 and constant; nothing of it in the IHS model."""
    table = energies_at_rest(ball).set_index("quantity")
    ratio = float(in_units_of_t_1(ball["staying_period"])[3, 0] / 0.1) ** 2
    tc = table["tc"]
    assert tc["(free) kinetic energy"] == 0
    assert tc["elastic, kinetic energy"] == pytest.approx(ratio / 24)
    assert tc["potential energy"] == pytest.approx(ratio / 12)
    assert table["ihs"]["(free) kinetic energy"] < 1e-25
    assert table.loc["elastic, kinetic energy", "tc_100.5_high"] == pytest.approx(ratio / 24, rel=0.01)

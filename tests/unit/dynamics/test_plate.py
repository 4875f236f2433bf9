import math

import numpy as np
import pytest

from granugas.dynamics.events.effects.constant import Constant, Elastic
from granugas.dynamics.events.effects.contact_time import ContactTime
from granugas.dynamics.plate import COLLAPSE, ESCAPE, HITS, Ball, averages, bounce, next_hit, plate, state_at, time_to_hit

G = 9.81
THROWN = Ball(0.0, -1.0)


def test_a_dropped_ball_hits_with_the_energy_of_its_height():
    hit = next_hit(Constant(0.5), Ball(2.0, 0.0), plate(G))
    assert hit.flight == pytest.approx(math.sqrt(4 / G))
    assert hit.before == pytest.approx(math.sqrt(4 * G))
    assert hit.after == hit.before / 2
    assert hit.since == math.inf


@pytest.mark.parametrize("v", [-3.0, 0.0, 3.0])
def test_time_to_hit_is_the_root_of_the_parabola(v):
    t = time_to_hit(Ball(0.7, v), G)
    assert t > 0
    assert 0.7 + v * t - G * t**2 / 2 == pytest.approx(0, abs=1e-14)


def test_time_to_hit_close_to_the_plate_is_not_lost_in_rounding():
    assert time_to_hit(Ball(1e-18, -1.0), G) == pytest.approx(1e-18, rel=1e-14)


def test_without_gravity_only_a_falling_ball_hits():
    assert time_to_hit(Ball(0.5, -2.0), 0.0) == 0.25
    assert bounce(Constant(0.5), Ball(0.5, 0.0), 0.0, 3).stop == ESCAPE
    assert next_hit(Constant(0.5), Ball(0.5, 1.0), plate(0.0)) is None
    once = bounce(Constant(0.5), Ball(0.5, -2.0), 0.0, 3)
    assert (once.stop, once.time.tolist(), once.after.tolist()) == (ESCAPE, [0.25], [1.0])


def test_the_clock_that_the_ball_brings_along_decides():
    """A Eq. 4: elastic up to t_c, the bound included."""
    ball = Ball(0.5, -2.0, 1.0)
    assert next_hit(ContactTime(Constant(0.5), 1.25), ball, plate(0.0)) == (0.25, 2.0, 2.0, 1.25, True)
    assert next_hit(ContactTime(Constant(0.5), 1.2499), ball, plate(0.0)) == (0.25, 2.0, 1.0, 1.25, False)


def test_the_first_hit_is_the_one_of_v_1():
    run = bounce(Constant(0.8), THROWN, G, 4)
    assert run.stop == HITS
    np.testing.assert_allclose(run.before, [1, 0.8, 0.64, 0.512])
    np.testing.assert_allclose(run.after, 0.8 * run.before)
    np.testing.assert_allclose(run.time, np.cumsum([0, 1.6, 1.28, 1.024]) / G)
    np.testing.assert_allclose(run.since[1:], np.diff(run.time))
    assert not run.elastic.any()


@pytest.mark.parametrize("r", [0.5, 0.9, 0.99])
def test_a_collapse_is_noticed(r):
    run = bounce(Constant(r), THROWN, G, 100_000)
    assert run.stop == COLLAPSE
    assert len(run.time) < 20 + 40 / -math.log(r)
    assert run.time[-1] == pytest.approx(2 / G * r / (1 - r), rel=1e-12)
    assert np.all(np.diff(run.time) > 0)


def test_a_ball_that_sticks_ends_the_run():
    assert bounce(Constant(0.0), THROWN, G, 10).stop == COLLAPSE
    assert bounce(ContactTime(Constant(0.0), 1e-3), THROWN, G, 10).stop == COLLAPSE


def test_an_elastic_ball_bounces_on_alike():
    run = bounce(Elastic(), THROWN, G, 1000)
    assert run.stop == HITS
    assert np.all(run.after == 1.0)
    assert run.time[-1] == pytest.approx(999 * 2 / G)


def test_states_lie_on_the_parabolas():
    run = bounce(Constant(0.8), THROWN, G, 3)
    h, v = state_at(run, [run.time[0], 0.8 / G, run.time[1], run.time[1] + 0.32 / G])
    np.testing.assert_allclose(h, [0, 0.32 / G, 0, (0.64 * 0.32 - 0.32**2 / 2) / G], atol=1e-16)
    np.testing.assert_allclose(v, [0.8, 0, 0.64, 0.32], atol=1e-15)


def test_no_state_where_the_run_has_none():
    falling = bounce(Constant(0.8), Ball(1.0, 0.0), G, 3)
    end = falling.time[-1] + 2 * falling.after[-1] / G
    assert np.isnan(state_at(falling, [0.0, np.nextafter(end, 9), 9.0])[0]).all()
    assert np.isfinite(state_at(falling, [falling.time[0], end])[0]).all()
    collapsed = bounce(Constant(0.5), THROWN, G, 1000)
    assert np.isnan(state_at(collapsed, collapsed.time[-1] + 1e-9)[1])


@pytest.mark.parametrize(("begin", "end"), [(0.0, 0.05), (0.01, 0.3), (0.2, 0.21), (0.03, 0.55)])
def test_averages_are_those_of_the_states(begin, end):
    run, t_c = bounce(ContactTime(Constant(0.8), 0.11), THROWN, G, 20), 0.11
    steps = 200_000
    time = begin + (np.arange(steps) + 0.5) / steps * (end - begin)
    h, v = state_at(run, time)
    since = time - run.time[np.searchsorted(run.time, time, side="right") - 1]
    mean = averages(run, end, end - begin, t_c)
    sums = [v.mean(), (v**2).mean(), (v**2 * (since <= t_c)).mean(), h.mean()]
    np.testing.assert_allclose(mean[:4], sums, rtol=1e-5, atol=2e-5)


def test_the_force_is_the_momentum_of_the_hits_in_the_window():
    run = bounce(Constant(0.8), THROWN, G, 5)
    end = run.time[2]
    assert averages(run, end, end - run.time[1] + 1e-9, 0.0).force * (end - run.time[1] + 1e-9) == pytest.approx(
        1.8 * (0.8 + 0.64)
    )
    assert averages(run, end, end - run.time[1], 0.0).force * (end - run.time[1]) == pytest.approx(1.8 * 0.64)


@pytest.mark.parametrize(("end", "length"), [(0.5, 0.6), (9.0, 0.1), (0.3, 0.0), (math.nan, 0.1)])
def test_no_average_beyond_the_run(end, length):
    with pytest.raises(ValueError, match="no state"):
        averages(bounce(Constant(0.8), THROWN, G, 5), end, length, 0.0)

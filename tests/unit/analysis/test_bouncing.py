"""Numbers of paper A's bouncing ball."""

import numpy as np
import pytest

from granugas.analysis.bouncing import (
    PERIOD_OF_SPRING,
    bounce_period,
    bounce_speed,
    hits_to_rest,
    released_square_velocity,
    rest_time,
    rest_time_difference,
    rest_time_hard,
    resting_height,
    resting_square_velocity,
    spring_contact_time,
    spring_energy_at_rest,
    staying_period,
    whole_hits_to_rest,
    whole_rest_time_difference,
)


def test_bouncing_ball_comes_to_rest():
    """v_1 = 3 m/s, g = 10 m/s^2: flights of .6, .3, .15, .075 s; t_c = .1 s."""
    np.testing.assert_allclose(bounce_period(bounce_speed([1, 2, 3], 0.5, 3.0), 10.0), [0.6, 0.3, 0.15])
    ratio = 0.1 / 0.6
    assert 0.5 ** hits_to_rest(0.5, ratio) == pytest.approx(ratio)
    assert whole_hits_to_rest(0.5, ratio) == 3
    assert staying_period(0.5, ratio) * 0.6 == pytest.approx(0.075)
    assert rest_time_hard(0.5) * 0.6 == pytest.approx(0.3 * 2)
    last = 0.3 + 0.15  # of the hits that dissipate
    assert whole_rest_time_difference(0.5, ratio) * 0.6 == pytest.approx(0.6 - last)
    assert rest_time(0.5, ratio) + rest_time_difference(0.5, ratio) == pytest.approx(rest_time_hard(0.5))
    assert rest_time_difference(0.5, ratio) * 0.6 == pytest.approx(0.1)


@pytest.mark.parametrize("r", [0.2, 0.5, 0.9, 0.99])
def test_whole_hits_delay_rest_by_less_than_a_factor_of_r(r):
    ratio = np.geomspace(1e-8, 0.3, 500)
    by_equation_10 = whole_rest_time_difference(r, ratio) / rest_time_difference(r, ratio)
    assert np.all(by_equation_10 > 1 - 1e-12)
    assert np.all(by_equation_10 < 1 / r + 1e-12)
    assert np.ptp(by_equation_10) > 0.9 * (1 / r - 1)  # both bounds are reached


def test_spring_of_the_same_energy_at_rest():
    g, stiffness = 9.81, 4e4
    t_c = spring_contact_time(stiffness)
    assert stiffness * (g / stiffness) ** 2 / 2 == pytest.approx(spring_energy_at_rest(t_c, g))
    period = PERIOD_OF_SPRING * t_c
    assert pytest.approx(1.103, abs=5e-4) == PERIOD_OF_SPRING
    assert resting_square_velocity(period, g) / 2 == pytest.approx(spring_energy_at_rest(t_c, g))
    assert resting_height(period, g) * g == pytest.approx(resting_square_velocity(period, g))


def test_released_ball():
    """1 + r^2 for t_n = t_c, 2 for t_n << t_c, and for r = 1 all of the energy; in between by small steps."""
    unit = 9.81**2 / 24
    assert released_square_velocity(1.0, 9.81, 0.6) == pytest.approx(1.36 * unit)
    assert released_square_velocity(1.0, 9.81, 0.6, 1e-3) == pytest.approx(2 * unit)
    np.testing.assert_allclose(released_square_velocity(1.0, 9.81, 1.0, [0.1, 1.0]), resting_square_velocity(1.0, 9.81))
    w = np.linspace(0, 1, 1_000_001)[1:]  # speed of the ball that falls
    r = np.where((1 + w) ** 2 / (4 * w) <= 1 / 0.9, 1, 0.6)
    by_steps = 12 * unit / 4 * np.mean(w**2 + (r * w) ** 2)
    assert released_square_velocity(1.0, 9.81, 0.6, 0.9) == pytest.approx(by_steps, rel=1e-5)

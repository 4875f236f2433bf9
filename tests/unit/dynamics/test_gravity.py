"""Parabolas, and where they end."""

import math

import numpy as np
import pytest
from numba import njit

from granugas.dynamics.events.effects.gravity import Gravity
from granugas.dynamics.events.flight import leaves_interval

G = 10.0
DOWN = Gravity((0.0, -G))


@njit
def leaves(force, axis, x, v, low, high):
    """From Python."""
    return leaves_interval(force, axis, x, v, low, high)


def first_look_outside(x, v, low, high):
    """By looking often."""
    t = np.linspace(0.0, 10.0, 2_000_001)
    y = x + v * t - G * t * t / 2
    k = int(np.argmax((y < low - 1e-12) | (y > high + 1e-12)))
    return t[k], y[k] > high


def test_a_parabola_ends_where_one_sees_it_end():
    rng = np.random.default_rng(0)
    for _ in range(60):
        low, high = -rng.uniform(0.1, 1.0), rng.uniform(0.1, 1.0)
        x, v = rng.uniform(low, high), rng.normal(0.0, 4.0)
        seen, above = first_look_outside(x, v, low, high)
        delay, upper = leaves(DOWN, 1, x, v, low, high)
        assert upper == above
        assert delay == pytest.approx(seen, abs=6e-6)


@pytest.mark.parametrize(("v", "delay", "upper"), [(2.0, 0.25, True), (-1.0, 1.5, False)])
def test_across_gravity_lines_are_straight(v, delay, upper):
    assert leaves(DOWN, 0, 0.5, v, -1.0, 1.0) == (delay, upper)


@pytest.mark.parametrize("v", [1e-12, 1e-3, 1.0, 1e6])
def test_a_flight_from_the_floor_to_the_floor_is_exact(v):
    assert leaves(DOWN, 1, -0.5, v, -0.5, math.inf) == (pytest.approx(2 * v / G, rel=1e-15, abs=0.0), False)


def test_no_digit_is_lost_where_roots_are_near():
    """The distance to the floor is 1e-13 of the height that the speed is worth."""
    assert leaves(DOWN, 1, 1e-12, -10.0, 0.0, 2.0)[0] == pytest.approx(1e-13, rel=1e-12, abs=0.0)
    assert leaves(DOWN, 1, -1e-12, 10.0, -1.0, 0.0) == (pytest.approx(1e-13, rel=1e-12, abs=0.0), True)


def test_outside_by_rounding_is_at_the_end():
    assert leaves(DOWN, 1, -1e-17, -1.0, 0.0, 1.0) == (0.0, False)
    assert leaves(DOWN, 1, 1 + 1e-17, 1.0, 0.0, 1.0) == (0.0, True)
    assert leaves(DOWN, 1, 0.0, 0.0, 0.0, 1.0) == (0.0, False)


def test_the_top_of_a_parabola_that_just_reaches_the_edge():
    v = math.sqrt(2 * G * 0.5)
    assert leaves(DOWN, 1, 0.0, v * (1 + 1e-12), -1.0, 0.5)[1]
    assert not leaves(DOWN, 1, 0.0, v * (1 - 1e-12), -1.0, 0.5)[1]

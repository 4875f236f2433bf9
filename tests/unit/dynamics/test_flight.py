"""Straight lines, and the time at which they leave a cell."""

import math

import numpy as np
import pytest
from numba import njit

from granugas.dynamics.events.flight import exit_distances, exit_time, leaves_through_x, next_step, position

BOX = (6.0, 9.0)


@njit
def leave(gas, i, time):
    """Place, distances to the edges ahead, the edge that comes first, and when."""
    x, y = position(gas, i, time)
    to_x, to_y = exit_distances(gas, i, x, y)
    return x, y, to_x, to_y, leaves_through_x(gas, i, to_x, to_y), exit_time(gas, i, x, y, time)


@njit
def step_of(gas, i):
    x, y = position(gas, i, 0.0)
    return next_step(gas, i, x, y)


def test_where_a_disk_is(gas_of):
    gas = gas_of([[0.7, 1.2]], [[0.5, -0.25]], BOX)
    gas.disks.rows["t"] = 2.0
    x, y = gas.disks.rows["x"][0], gas.disks.rows["y"][0]
    assert leave(gas, 0, 2.0)[:2] == (x, y)
    assert leave(gas, 0, 2.5)[:2] == (x + 0.25, y - 0.125)


@pytest.mark.parametrize("seed", range(50))
def test_a_disk_leaves_through_the_nearest_edge(seed, gas_of):
    rng = np.random.default_rng(seed)
    gas = gas_of([rng.uniform(0, BOX)], [rng.normal(size=2)], BOX)
    disk, grid = gas.disks.rows[0], gas.grid
    times = [
        (edge - disk[x]) / disk[v]
        for x, v, half in (("x", "vx", grid.half_x), ("y", "vy", grid.half_y))
        for edge in (-half, half)
    ]
    first = min(time for time in times if time > 0)
    *_, through_x, when = leave(gas, 0, 0.0)
    assert when == pytest.approx(first, rel=1e-14)
    assert through_x == (times.index(first) < 2)
    assert step_of(gas, 0) == ((-1, 0), (1, 0), (0, -1), (0, 1))[times.index(first)]


@pytest.mark.parametrize(
    ("velocity", "through_x", "delay"),
    [
        ((2.0, 0.0), True, "half_x"),
        ((-2.0, 0.0), True, "half_x"),
        ((0.0, 2.0), False, "half_y"),
        ((0.0, -2.0), False, "half_y"),
    ],
)
def test_along_an_axis(velocity, through_x, delay, gas_of):
    gas = gas_of([[0.5, 0.5]], [velocity], BOX)
    gas.disks.rows["x"] = gas.disks.rows["y"] = 0.0
    *_, across, when = leave(gas, 0, 0.0)
    assert across == through_x
    assert when == getattr(gas.grid, delay) / 2


def test_a_disk_at_rest_stays(gas_of):
    assert leave(gas_of([[0.5, 0.5]], [[0.0, 0.0]], BOX), 0, 1.0)[-1] == math.inf


def test_beyond_an_edge_by_rounding_it_leaves_now(gas_of):
    gas = gas_of([[0.5, 0.5]], [[1.0, 0.5]], BOX)
    gas.disks.rows["x"] = gas.grid.half_x * (1 + 1e-15)
    _, _, to_x, _, through_x, when = leave(gas, 0, 0.0)
    assert (to_x, through_x, when) == (0.0, True, 0.0)

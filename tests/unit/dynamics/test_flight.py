"""Straight lines, and the time at which they leave a cell."""

import math

import numpy as np
import pytest
from numba import njit

from granugas.dynamics.events.flight import (
    Straight,
    axis_of_exit,
    hastened,
    leaves_after,
    moved,
    next_step,
    position,
    settle,
    way_ahead,
)
from granugas.dynamics.events.vectors import mapped_three

BOXES = [(6.0,), (6.0, 9.0), (6.0, 9.0, 7.0)]
"""In one, two and three dimensions."""


@njit
def leave(gas, i, time):
    """Place, ways to the edges ahead, the axis of the one that comes first, and after which time."""
    x, v = position(gas, i, time), gas.disks.v[i]
    ways = mapped_three(x, v, gas.grid.half, way_ahead)
    return x, ways, axis_of_exit(ways, v), leaves_after(gas.force, x, v, gas.grid.half)


@njit
def step_of(gas, i):
    return next_step(gas.force, position(gas, i, 0.0), gas.disks.v[i], gas.grid.half)


@njit
def settled(gas, i, time):
    settle(gas.force, gas, i, time)


def test_where_a_disk_is(gas_of):
    gas = gas_of([[0.7, 1.2]], [[0.5, -0.25]], BOXES[1])
    gas.disks.rows["t"] = 2.0
    x, y = gas.disks.rows["x"][0]
    assert leave(gas, 0, 2.0)[0] == (x, y)
    assert leave(gas, 0, 2.5)[0] == (x + 0.25, y - 0.125)
    settled(gas, 0, 2.5)
    assert gas.disks.rows["t"][0] == 2.5
    assert gas.disks.rows["x"][0].tolist() == [x + 0.25, y - 0.125]


def test_a_straight_line():
    assert moved(Straight(), (1.0, 2.0, 3.0), (0.5, -1.0, 0.0), 2.0) == (2.0, 0.0, 3.0)
    assert hastened(Straight(), (0.5, -1.0), 2.0) == (0.5, -1.0)


@pytest.mark.parametrize("box", BOXES)
@pytest.mark.parametrize("seed", range(50))
def test_a_disk_leaves_through_the_nearest_edge(seed, box, gas_of):
    rng, dimensions = np.random.default_rng(seed), len(box)
    gas = gas_of([rng.uniform(0, box)], [rng.normal(size=dimensions)], box)
    x, v, half = gas.disks.rows["x"][0], gas.disks.rows["v"][0], np.array(gas.grid.half)
    times = [(edge - x[k]) / v[k] for k in range(dimensions) for edge in (-half[k], half[k])]
    first = min(time for time in times if time > 0)
    *_, axis, when = leave(gas, 0, 0.0)
    through, forward = divmod(times.index(first), 2)
    assert when == pytest.approx(first, rel=1e-14)
    assert axis == through
    assert step_of(gas, 0) == tuple((2 * forward - 1) * (k == through) for k in range(dimensions))


@pytest.mark.parametrize("box", BOXES)
@pytest.mark.parametrize("speed", [2.0, -2.0])
def test_along_an_axis(speed, box, gas_of):
    for axis in range(len(box)):
        velocity = speed * np.eye(len(box))[axis]
        gas = gas_of([np.full(len(box), 0.5)], [velocity], box)
        gas.disks.rows["x"] = 0.0
        *_, across, when = leave(gas, 0, 0.0)
        assert across == axis
        assert when == gas.grid.half[axis] / 2


@pytest.mark.parametrize("box", BOXES)
def test_a_disk_at_rest_stays(box, gas_of):
    assert leave(gas_of([[0.5] * len(box)], [[0.0] * len(box)], box), 0, 1.0)[-1] == math.inf


def test_beyond_an_edge_by_rounding_it_leaves_now(gas_of):
    gas = gas_of([[0.5, 0.5]], [[1.0, 0.5]], BOXES[1])
    gas.disks.rows["x"][0, 0] = gas.grid.half[0] * (1 + 1e-15)
    _, ways, axis, when = leave(gas, 0, 0.0)
    assert (ways[0], axis, when) == (0.0, 0, 0.0)

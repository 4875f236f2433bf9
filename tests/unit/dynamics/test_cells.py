"""Every disk is in the list of its cell, and all images of all neighbours are found, in the smallest boxes too."""

import math

import numpy as np
import pytest
from gases import lattice_gas
from numba import njit

from granugas.dynamics.events import cells
from granugas.dynamics.events.cells import enter_cell, leave_cell, list_ahead, list_around
from granugas.dynamics.events.engine import Engine
from granugas.dynamics.events.state import NOBODY
from granugas.dynamics.events.tables import NARROWEST
from granugas.scene import Scene


def members(arrays):
    """The disks of each cell's list, by (column, row)."""
    heads, following, nx = arrays["cells"]["head"], arrays["disks"]["next"], int(arrays["grid"]["cells"][0, 0])
    found = {}
    for cell, head in enumerate(heads):
        inside, k = [], head
        while k != NOBODY:
            inside.append(int(k))
            assert len(inside) <= len(following), "the list runs in a circle"
            k = following[k]
        found[cell % nx, cell // nx] = inside
    return found


def check_lists(arrays):
    """Each disk is once in the list of the cell that it names, and in no other."""
    disks = arrays["disks"]
    listed = [(i, *cell) for cell, inside in members(arrays).items() for i in inside]
    assert sorted(listed) == [(i, *map(int, c["cell"])) for i, c in enumerate(disks)]


def check_places(arrays):
    """No disk is outside of its cell, but for rounding; flights begin in it."""
    disks, grid, calendar = arrays["disks"], arrays["grid"][0], arrays["calendar"][0]
    flown = (calendar["now"] - disks["t"])[:, np.newaxis]
    assert np.all(np.abs(disks["x"] + disks["v"] * flown) <= grid["half"] + 1e-14)
    assert np.all(np.abs(disks["x"]) <= grid["half"] + 1e-14)


@pytest.mark.parametrize(
    "scene",
    [
        Scene(300, 0.7, 0.9, 1e-4),
        Scene(300, 0.02, 0.9, 1e-4),
        Scene(64, 0.5, 0.9, 1e-4, aspect_ratio=12.0),
        Scene(5, 0.3, 0.9, 1e-4),
        Scene(3, 0.4, 0.9, 1e-4),
        Scene(2, 0.5, 0.9, 1e-4),
        Scene(1, 0.7),
    ],
    ids=lambda scene: f"{scene.n_particles}-{scene.area_fraction}",
)
def test_lists_stay_complete(scene):
    engine = Engine(scene, lattice_gas(scene))
    for _ in range(20):
        check_lists(engine.arrays)
        check_places(engine.arrays)
        engine.advance(math.inf, most_events=151)


@pytest.mark.parametrize("box", [(1.02, 1.02), (1.5, 2.3), (3.2, 1.1), (40.0, 7.0)])
@pytest.mark.parametrize("n", [1, 4, 100])
def test_cells_hold_a_disk_and_fill_the_box(n, box, gas_of):
    grid = gas_of(np.zeros((1, 2)) if n == 1 else np.random.default_rng(0).uniform(0, box, (n, 2)), np.zeros((n, 2)), box).grid
    assert grid.count == grid.cells[0] * grid.cells[1]
    for count, width, half, length in zip(grid.cells, grid.width, grid.half, grid.box, strict=True):
        assert count * width == pytest.approx(length, rel=1e-15)
        assert half == width / 2
        assert width >= min(NARROWEST, length)


@njit
def listed(gas, n):
    """The disks in the n lists in `near`, each with the place of its cell."""
    found = []
    for k in range(n):
        j = gas.near.disk[k]
        while j != NOBODY:
            found.append((j, gas.near.at[k][0], gas.near.at[k][1]))
            j = gas.disks.next[j]
    return found


@njit
def around(gas, i):
    return listed(gas, list_around(gas.disks.cell[i], gas))


@njit
def ahead(gas, i, step_x, step_y):
    return listed(gas, list_ahead((step_x, step_y), gas, gas.disks.cell[i]))


def images(position, gas, i):
    """All disks whose cell, in any image of the box, is one of the nine around disk i: number, columns and rows away."""
    count, width = np.array(gas.grid.cells), np.array(gas.grid.width)
    cells = np.floor(position / width)
    shifts = [count * (a, b) for a in range(-2, 3) for b in range(-2, 3)]
    away = [(j, *(cells[j] + shift - cells[i])) for j in range(len(position)) for shift in shifts]
    return sorted((j, x, y) for j, x, y in away if max(abs(x), abs(y)) <= 1)


BOXES = [(1.1, 1.2), (2.2, 1.1), (2.5, 2.5), (3.7, 2.3), (9.0, 3.5)]
"""Of one, two, three and more cells along a side."""


@pytest.mark.parametrize("box", BOXES)
def test_all_near_images_are_listed(box, gas_of):
    position = np.random.default_rng(1).uniform(0, box, (8, 2))
    gas = gas_of(position, np.zeros((8, 2)), box)
    for i in range(8):
        found = sorted((j, x / gas.grid.width[0], y / gas.grid.width[1]) for j, x, y in around(gas, i))
        assert found == images(position, gas, i)


@pytest.mark.parametrize("step", [(1, 0), (-1, 0), (0, 1), (0, -1)])
@pytest.mark.parametrize("box", BOXES)
def test_what_is_ahead_is_listed(step, box, gas_of):
    position = np.random.default_rng(2).uniform(0, box, (8, 2))
    gas = gas_of(position, np.zeros((8, 2)), box)
    for i in range(8):
        found = sorted((j, x / gas.grid.width[0], y / gas.grid.width[1]) for j, x, y in ahead(gas, i, *step))
        assert found == [(j, x, y) for j, x, y in images(position, gas, i) if x * step[0] + y * step[1] == 1]


@njit
def leave(gas, i):
    leave_cell(gas, i)


@njit
def enter(gas, i, cx, cy):
    gas.disks.cell[i] = cx, cy
    enter_cell(gas, i)


def test_disks_enter_and_leave(gas_of):
    """First, last and only ones of their lists."""
    rng, n = np.random.default_rng(3), 12
    gas = gas_of(rng.uniform(0, 3.5, (n, 2)), np.zeros((n, 2)), (3.5, 3.5))
    arrays = {name: getattr(gas, name).rows for name in ("disks", "cells", "grid")}
    for i in rng.integers(0, n, 300):
        leave(gas, i)
        assert i not in [j for inside in members(arrays).values() for j in inside]
        enter(gas, i, *rng.integers(0, gas.grid.cells))
        check_lists(arrays)


@njit
def wrapped(k, n):
    return cells.wrapped(k, n)


@njit
def steps_between(k, m, n):
    return cells.steps_between(k, m, n)


@njit
def nearest_image(separation, length):
    return cells.nearest_image(separation, length)


def test_steps_across_the_edge():
    assert [wrapped(k, 4) for k in (-1, 0, 3, 4)] == [3, 0, 3, 0]
    assert [wrapped(k, 1) for k in (-1, 0, 1)] == [0, 0, 0]
    assert [steps_between(*pair, 5) for pair in ((0, 1), (1, 0), (4, 0), (0, 4), (2, 2))] == [1, -1, 1, -1, 0]


def test_the_nearest_image():
    box = 2.5
    for separation in np.linspace(-2.4, 2.4, 96):
        candidates = separation + box * np.arange(-1, 2)
        assert nearest_image(separation, box) == pytest.approx(candidates[np.argmin(np.abs(candidates))], abs=1e-15)
    assert nearest_image(0.3, box) == 0.3  # no bit of a near one is touched

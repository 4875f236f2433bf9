"""The tables of a state in which nothing is predicted yet: cells, calendar, and every disk in its cell."""

import math
from collections.abc import Sequence

import numpy as np

from granugas.dynamics.events import state as layout
from granugas.dynamics.events.calendar import EVENTS_PER_BIN, HEADROOM
from granugas.dynamics.events.memory import allocate
from granugas.dynamics.state import State

CELL_WIDTH = {1: 1.0, 2: 0.62, 3: 0.62}
"""Wanted width of a cell in units of the mean distance of particles, by the dimensions of space (measured)."""

NARROWEST, WIDEST = 1.002, 3.0
"""Bounds of the wanted width, by the largest diameter: disks in cells that are not neighbours never touch."""

MOST_CELLS = {1: 2**30, 2: 32_000, 3: 32_000}
"""In one direction, by the dimensions of space: columns, rows and layers are counted in two bytes, on a line in four."""

LARGE = 30_000
"""Above this number of disks the tables outgrow the cache, and looking ahead pays (measured)."""

LOOK_AHEAD = 1
"""Bins between two of its steps (measured)."""

REBASE_AFTER = 100.0
"""The origin of times moves on when a disk has flown so many diameters: its place is still known to 1e-14 d."""


def tables_of(
    state: State, diameter: float, walled: Sequence[bool] = (), largest: float = 1.0, gained: float = 0.0
) -> dict[str, np.ndarray]:
    """All tables of a gas, laid out as state.layouts says.

    Args:
        state: where the disks are.
        diameter: d in m, the unit of length of the tables.
        walled: for each axis, whether the box ends there in walls; none by default.
        largest: diameter of a particle (d).
        gained: what a force or a wall in motion may add to the square of a velocity (m^2/s^2).
    """
    n, dimensions = state.position.shape
    rows = layout.layouts(dimensions)
    grid = _grid(n, tuple(length / diameter for length in state.box), walled or (False,) * dimensions, largest)
    disks, clocks = allocate(n, rows["disks"]), allocate(n, rows["clocks"])
    width, inside = grid["width"][0], grid["cells"][0] - np.asarray(walled or 0, int)
    place = state.position / diameter
    disks["cell"] = np.clip((place / width).astype(np.int64), 0, inside - 1)
    disks["x"] = place - (disks["cell"] + 0.5) * width
    disks["v"] = state.velocity / diameter
    disks["collisions"] = state.collisions
    clocks["last"] = state.last_collision_time - state.time
    clocks["interval"] = state.last_collision_interval
    speed = math.sqrt(np.mean(np.sum(state.velocity**2, axis=1)) + gained) / diameter
    calendar = _calendar(n, state.time, speed)
    tables = {
        "disks": disks,
        "clocks": clocks,
        "cells": allocate(int(grid["count"][0]), rows["cells"]),
        "near": allocate(3**dimensions + 1, rows["near"]),
        "grid": grid,
        "schedule": allocate(n, rows["schedule"]),
        "bins": allocate(int(calendar["n_bins"][0]) * layout.SLOTS, rows["bins"]),
        "heap": allocate(int(calendar["heap_limit"][0]), rows["heap"]),
        "calendar": calendar,
        "tally": allocate(1, rows["tally"]),
    }
    tables["cells"]["head"] = layout.NOBODY
    tables["schedule"]["time"] = math.inf
    return tables


def _grid(n: int, box: tuple[float, ...], walled: Sequence[bool], largest: float) -> np.ndarray:
    """Cells wide enough for one disk, and wider in a dilute gas, where leaving a cell costs more than a neighbour.

    Between two walls there is one more cell, in which nobody ever is: who looks across a wall, from either side, looks
    there. No image lies behind a wall, so that the box has no end along such an axis.
    """
    narrowest, dimensions = NARROWEST * largest, len(box)
    wanted = min(max(CELL_WIDTH[dimensions] * (math.prod(box) / n) ** (1 / dimensions), narrowest), WIDEST * largest)
    grid = allocate(1, layout.layouts(dimensions)["grid"])
    count = np.array([min(max(1, int(length / wanted)), MOST_CELLS[dimensions]) for length in box])
    grid["width"] = np.array(box) / count
    grid["half"] = grid["width"] / 2
    grid["cells"] = count + np.asarray(walled, int)
    grid["box"] = np.where(walled, math.inf, box)
    grid["count"] = int(np.prod(grid["cells"][0]))
    return grid


def _calendar(n: int, time: float, speed: float) -> np.ndarray:
    """A calendar whose window has just ended, so that the first event opens one; `speed` in d/s."""
    calendar = allocate(1, layout.CALENDAR)
    n_bins = max(64, n // 2)
    width = EVENTS_PER_BIN / (3 * n * speed) if speed > 0 else 1.0  # some three events per diameter flown
    calendar["base"] = time
    calendar["start"] = -(n_bins + 1) * width
    calendar["width"], calendar["rate"] = width, 1 / width
    calendar["bin"] = n_bins - 1
    calendar["n_disks"], calendar["n_bins"] = n, n_bins
    calendar["heap_limit"] = n + n // 4 + 4 * HEADROOM
    calendar["look_ahead"] = LOOK_AHEAD if n > LARGE else 0
    calendar["rebase_after"] = REBASE_AFTER / speed if speed > 0 else math.inf
    return calendar

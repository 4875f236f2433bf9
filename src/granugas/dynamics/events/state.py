"""What the kernels work on: the layouts of all tables, and the bundle that is handed from function to function.

Units inside the engine: length d (diameter), time s, mass m (of a particle, the mean one where they differ). Positions are
relative to the centre of the particle's cell, so that their precision does not depend on the size of the box and no minimum
image is ever taken. Times are relative to `calendar.base`, which follows the simulation, so that their precision does not
depend on how long it has run.
"""

from functools import cache
from typing import Any, NamedTuple

import numpy as np

from granugas.dynamics.events.memory import Record, Table

NOBODY = -1
"""In place of a particle: no partner, end of a cell's list."""

SLOTS = 8
"""Entries of a bin of the calendar: a count and seven disks, half a cache line."""

CLOCKS = np.dtype([("last", "f8"), ("interval", "f8")])
"""Time of a disk's last collision, and the time between the last two (s)."""

CELLS = np.dtype([("head", "i4")])
"""First disk of each cell's list."""

SCHEDULE = np.dtype([("time", "f8")])
"""Next event of each disk; infinite where the partner answers for it."""

BINS = np.dtype([("entry", "i4")])
"""Bins of the calendar, SLOTS entries each: a count, then the numbers of disks."""

HEAP = np.dtype([("time", "f8"), ("disk", "i8")])
"""Events of the current bin, earliest on top."""

CALENDAR = np.dtype(
    [
        ("now", "f8"),  # time of the last event
        ("base", "f8"),  # origin of all times, as an unevaluated sum of two
        ("base_low", "f8"),
        ("until", "f8"),  # no event after this time is wanted now
        ("reached", "f8"),  # up to here everything has happened; read by Python alone
        ("start", "f8"),  # of the window that the bins cover
        ("width", "f8"),  # of a bin
        ("rate", "f8"),  # bins per second, 1 / width
        ("bin", "i8"),  # current
        ("n_disks", "i8"),
        ("n_bins", "i8"),
        ("heap_size", "i8"),
        ("heap_limit", "i8"),
        ("events", "i8"),  # since the window began
        ("look_ahead", "i8"),  # bins between the steps of look_ahead.py; 0: none
        ("rebase_after", "f8"),  # s
        ("backwards", "i8"),  # events that came out of order: 0, or the calendar is broken
    ]
)

RECORDS = ("grid", "calendar", "tally")
"""Tables of one row."""


@cache
def layouts(dimensions: int) -> dict[str, np.dtype]:
    """The layout of each table; vectors have as many components as space has dimensions."""
    vector, cell = ("f8", (dimensions,)), ("i4" if dimensions == 1 else "i2", (dimensions,))
    disks = [
        ("x", *vector),  # at time t, from the centre of the cell (d)
        ("v", *vector),  # d/s
        ("t", "f8"),  # start of the present flight (s)
        ("t_coll", "f8"),  # with `partner`; without one: no collision is known before that time
        ("partner", "i4"),
        ("next", "i4"),  # in the list of the cell
        ("cell", *cell),
        ("collisions", "i4"),
    ]
    near = [("at", *vector), ("disk", "i8")]  # scratch: first disks of a block of cells, and where the cells' centres are (d)
    grid = [  # cells of the box; lengths in d
        ("cells", "i8", (dimensions,)),  # along each axis
        ("width", *vector),
        ("half", *vector),
        ("box", *vector),
        ("count", "i8"),  # of all cells
    ]
    tally = [  # sums over the collisions since the tally was last taken
        ("taken", "i8"),  # collisions of all tallies before
        ("collisions", "i8"),
        ("elastic", "i8"),  # by a rule
        ("crossings", "i8"),
        ("loss", "f8"),  # energy dissipated (m d^2/s^2)
        ("loss_time", "f8"),  # sum of loss times the time when it happened, from calendar.base
        ("stored", "f8"),  # translational energy that went over into another kind (m d^2/s^2)
        ("stored_time", "f8"),  # likewise
        ("stress", "f8", (dimensions, dimensions)),  # dp_a l_b over both partners of every collision (A Eq. 15)
    ]
    return {
        "disks": _in_cache_lines(disks),
        "clocks": CLOCKS,
        "cells": CELLS,
        "near": np.dtype(near),
        "grid": np.dtype(grid),
        "schedule": SCHEDULE,
        "bins": BINS,
        "heap": HEAP,
        "calendar": CALENDAR,
        "tally": np.dtype(tally),
    }


def _in_cache_lines(fields: list[tuple]) -> np.dtype:
    """Rows of a whole number of cache lines: all that a prediction reads of a disk lies in one, in 3D in two."""
    packed = np.dtype(fields)
    names, size = packed.names, -(-packed.itemsize // 64) * 64
    offsets = [packed.fields[name][1] for name in names]
    return np.dtype({"names": names, "formats": [packed[name] for name in names], "offsets": offsets, "itemsize": size})


class Gas(NamedTuple):
    """All that a kernel touches: tables, and from `rule` on the effects of the scene (composition.py, effects/)."""

    disks: Table
    clocks: Table
    cells: Table
    near: Table
    grid: Record
    schedule: Table
    bins: Table
    heap: Table
    calendar: Record
    tally: Record
    rule: Any
    watch: Any
    force: Any
    walls: Any
    floor: Any
    sizes: Any
    surface: Any
    after: Any


EFFECTS = Gas._fields[Gas._fields.index("rule") :]
"""Names of the places that effects take."""


def bundle(arrays: dict[str, np.ndarray], effects: dict[str, Any]) -> Gas:
    """The arrays (named and laid out as `layouts` says) as tables and records, with the effect of each of EFFECTS."""
    names = Gas._fields[: -len(EFFECTS)]
    seen = {name: (Record if name in RECORDS else Table)(arrays[name]) for name in names}
    return Gas(**seen, **{place: effects[place] for place in EFFECTS})

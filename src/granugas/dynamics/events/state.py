"""What the kernels work on: the layouts of all tables, and the bundle that is handed from function to function.

Units inside the engine: length d (diameter), time s, mass m. Positions are relative to the centre of the particle's cell, so
that their precision does not depend on the size of the box and no minimum image is ever taken. Times are relative to
`calendar.base`, which follows the simulation, so that their precision does not depend on how long it has run.
"""

from typing import Any, NamedTuple

import numpy as np

from granugas.dynamics.events.memory import Record, Table

NOBODY = -1
"""In place of a particle: no partner, end of a cell's list."""

SLOTS = 8
"""Entries of a bin of the calendar: a count and seven disks, half a cache line."""

DISKS = np.dtype(
    [
        ("x", "f8"),  # at time t, from the centre of the cell (d)
        ("y", "f8"),
        ("vx", "f8"),  # d/s
        ("vy", "f8"),
        ("t", "f8"),  # start of the present flight (s)
        ("t_coll", "f8"),  # with `partner`; without one: no collision is known before that time
        ("partner", "i4"),
        ("next", "i4"),  # in the list of the cell
        ("cx", "i2"),  # cell
        ("cy", "i2"),
        ("collisions", "i4"),
    ]
)
"""One cache line a disk: all that a prediction reads."""

CLOCKS = np.dtype([("last", "f8"), ("interval", "f8")])
"""Time of a disk's last collision, and the time between the last two (s)."""

CELLS = np.dtype([("head", "i4")])
"""First disk of each cell's list."""

NEAR = np.dtype([("x", "f8"), ("disk", "i8"), ("y", "f8")])
"""Scratch: the disks of a block of cells, and where the centres of their cells are (d)."""

GRID = np.dtype(
    [
        ("nx", "i8"),
        ("ny", "i8"),
        ("width_x", "f8"),
        ("width_y", "f8"),
        ("half_x", "f8"),
        ("half_y", "f8"),
        ("box_x", "f8"),
        ("box_y", "f8"),
    ]
)
"""Cells of the box; lengths in d."""

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

TALLY = np.dtype(
    [
        ("taken", "i8"),  # collisions of all tallies before
        ("collisions", "i8"),
        ("elastic", "i8"),  # by the TC rule
        ("crossings", "i8"),
        ("loss", "f8"),  # energy dissipated (m d^2/s^2)
        ("loss_time", "f8"),  # sum of loss times the time when it happened, from calendar.base
        ("xx", "f8"),  # sum of dp_a l_b over both partners of every collision (A Eq. 15)
        ("xy", "f8"),
        ("yx", "f8"),
        ("yy", "f8"),
    ]
)
"""Sums over the collisions since the tally was last taken."""


class Gas(NamedTuple):
    """All that a kernel touches; `rule` and `watch` are effects (composition.py)."""

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


LAYOUTS = {
    "disks": DISKS,
    "clocks": CLOCKS,
    "cells": CELLS,
    "near": NEAR,
    "grid": GRID,
    "schedule": SCHEDULE,
    "bins": BINS,
    "heap": HEAP,
    "calendar": CALENDAR,
    "tally": TALLY,
}
RECORDS = ("grid", "calendar", "tally")


def bundle(arrays: dict[str, np.ndarray], rule: Any, watch: Any) -> Gas:
    """The arrays (named and laid out as LAYOUTS says) as tables and records, with the scene's effects."""
    seen = {name: (Record if name in RECORDS else Table)(rows) for name, rows in arrays.items()}
    return Gas(**seen, rule=rule, watch=watch)

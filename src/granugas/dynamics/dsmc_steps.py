"""Steps of direct simulation Monte Carlo: particles collide in their cells, then they fly and are sorted anew (see dsmc.py).

Random numbers belong to cells (dsmc_collisions.py), and sums are made of parts of fixed size in a fixed order: no bit depends
on the number of threads.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numba import njit, prange

from granugas.dynamics.dsmc_collisions import meet
from granugas.dynamics.events.composition import generic, implements, inline, outline
from granugas.dynamics.events.loop import COLLISIONS, EVENTS, TIME
from granugas.dynamics.events.memory import Record, Table
from granugas.dynamics.events.vectors import along, dot, mapped_three

PARTS = 8
"""Of all particles, each flown by one thread."""

TOGETHER = 32
"""Cells that one thread takes at a time, with sums of their own."""

REORDER = 16
"""Steps after which the rows of particles are put in the order of cells: those of a cell then lie near each other."""

COST = 8
"""Particles whose flight costs what an event does in a slice of a run."""


class Gas(NamedTuple):
    """All tables, laid out as `layouts` says."""

    disks: Table
    clocks: Table
    spare_disks: Table
    spare_clocks: Table
    place: Table
    order: Table
    begin: Table
    counted: Table
    energy: Table
    rates: Table
    times: Table
    sums: Table
    lasting: Table
    space: Record
    model: Record
    clock: Record


def layouts(dimensions: int) -> dict[str, np.dtype]:
    """The layout of each table. Unit of length is the diameter d, of mass that of a particle."""
    vector, counts = ("f8", (dimensions,)), ("i8", (dimensions,))
    columns = {
        "disks": [("x", *vector), ("v", *vector)],
        "clocks": [("last", "f8"), ("interval", "f8"), ("collisions", "i4"), ("who", "i4")],  # who: number of the particle
        "place": [("cell", "i4")],  # of each row
        "order": [("row", "i4")],  # rows in the order of cells
        "begin": [("at", "i4")],  # of each cell, in this order
        "counted": [("rows", "i4")],  # for each part and cell
        "energy": [("twice", "f8")],  # sum of v^2 of each part
        "rates": [("value", "f8")],  # of a pair by its relative speed (1/d), for each number of particles in a cell
        "times": [("t_c", "f8")],  # all of the scene (s)
        "sums": [
            ("collisions", "i8"),
            ("loss", "f8"),  # of energy
            ("loss_time", "f8"),  # the same, times when
            ("squares", *vector),  # of dp_a l_b (A Eq. 15): xx, yy ...
            ("mixed", "f8", (1 if dimensions == 2 else 3,)),  # xy; yz, zx, xy
        ],
        "lasting": [("elastic", "i8"), ("held", "f8")],  # collisions within t_c, time that particles were elastic before (s)
        "space": [("box", *vector), ("by_box", *vector), ("by_width", *vector), ("cells", *counts)],
        "model": [(name, "i8") for name in ("n", "n_cells", "several", "most")] + [("restitution", "f8"), ("flight", "f8")],
        "clock": [("time", "f8"), ("step", "f8"), ("steps", "i8"), ("collisions", "i8"), ("taken", "i8"), ("key", "u8")],
    }
    columns |= {f"spare_{name}": columns[name] for name in ("disks", "clocks")}
    return {name: np.dtype(fields) for name, fields in columns.items()}


@generic
def number_of(slot, cells):
    """Number of a cell from its places along the axes."""


@implements(number_of, 2)
def _number_in_a_plane(slot, cells):
    return slot[0] + cells[0] * slot[1]


@implements(number_of, 3)
def _number_in_space(slot, cells):
    return slot[0] + cells[0] * (slot[1] + cells[1] * slot[2])


@inline
def _back(x, side, by_side):
    """Into the periodic box."""
    if 0.0 <= x < side:
        return x  # not a bit of it changes
    x -= side * math.floor(x * by_side)
    return x if 0.0 <= x < side else 0.0


@inline
def _slot(x, by_width, cells):
    return min(int(x * by_width), cells - 1)


@outline
def _fly(gas, part, time):
    """Let a part of the particles fly (s), and count where they are."""
    disks, space, n, n_cells = gas.disks, gas.space, gas.model.n, gas.model.n_cells
    box, by_box, by_width, cells, counted, at = (
        space.box,
        space.by_box,
        space.by_width,
        space.cells,
        gas.counted,
        part * n_cells,
    )
    for c in range(n_cells):
        counted.rows[at + c] = 0
    energy = 0.0
    for i in range(part * n // PARTS, (part + 1) * n // PARTS):
        v = disks.v[i]
        x = mapped_three(along(disks.x[i], time, v), box, by_box, _back)
        disks.x[i] = x
        c = number_of(mapped_three(x, by_width, cells, _slot), cells)
        gas.place.cell[i] = c
        counted.rows[at + c] += 1
        energy += dot(v, v)
    gas.energy.twice[part] = energy


@outline
def _order_cells(gas):
    """Where each cell begins in the order of cells, and in it each part of the particles."""
    n_cells, total = gas.model.n_cells, 0
    for c in range(n_cells):
        gas.begin.at[c] = total
        for part in range(PARTS):
            here = gas.counted.rows[part * n_cells + c]
            gas.counted.rows[part * n_cells + c] = total
            total += here
    gas.begin.at[n_cells] = total


@outline
def _put(gas, part):
    """Put the rows of a part of the particles where they belong in the order of cells."""
    n, at = gas.model.n, part * gas.model.n_cells
    for i in range(part * n // PARTS, (part + 1) * n // PARTS):
        c = at + gas.place.cell[i]
        gas.order.row[gas.counted.rows[c]] = i
        gas.counted.rows[c] += 1


@outline
def _set_aside(gas, part):
    """Copy the rows of a part of the order of cells."""
    n, disks, clocks, to, at = gas.model.n, gas.disks, gas.clocks, gas.spare_disks, gas.spare_clocks
    for k in range(part * n // PARTS, (part + 1) * n // PARTS):
        i = gas.order.row[k]
        to.x[k], to.v[k] = disks.x[i], disks.v[i]
        at.last[k], at.interval[k] = clocks.last[i], clocks.interval[i]
        at.collisions[k], at.who[k] = clocks.collisions[i], clocks.who[i]


@outline
def _take_back(gas, part):
    """Copy them back, now in the order of cells."""
    n, disks, clocks, to, at = gas.model.n, gas.disks, gas.clocks, gas.spare_disks, gas.spare_clocks
    for k in range(part * n // PARTS, (part + 1) * n // PARTS):
        disks.x[k], disks.v[k] = to.x[k], to.v[k]
        clocks.last[k], clocks.interval[k] = at.last[k], at.interval[k]
        clocks.collisions[k], clocks.who[k] = at.collisions[k], at.who[k]
        gas.order.row[k] = k


@outline
def _meet_in(gas, group, cut):
    """The collisions of cells that are taken together."""
    for cell in range(group * TOGETHER, min((group + 1) * TOGETHER, gas.model.n_cells)):
        meet(gas, cell, group, cut)


@outline
def _end_of_step(gas, groups):
    """Count the collisions of a step, and go on to the next one."""
    clock, met = gas.clock, 0
    for group in range(groups):
        met += gas.sums.collisions[group]
    cost = clock.taken + met - clock.collisions + gas.model.n // COST + 1
    clock.collisions = clock.taken + met
    clock.time += clock.step
    clock.steps += 1
    return cost


@outline
def _choose_step(gas):
    """A part of the mean free time of a gas with the present energy; endless where nobody moves."""
    twice = 0.0
    for part in range(PARTS):
        twice += gas.energy.twice[part]
    gas.clock.step = gas.model.flight / math.sqrt(twice) if twice > 0.0 else math.inf


def _kernels(loop, **options):
    """Two kernels; `loop` over parts is a range, or a prange for several threads: in either, each bit is the same.

    Both are told apart in the cache by it alone. What the parts do to the same tables the compiler does not see, so it must
    not put loops together.
    """

    def go(gas, until, most_collisions, most_events):
        clock, groups = gas.clock, (gas.model.n_cells + TOGETHER - 1) // TOGETHER
        time, stop = 0.0, clock.collisions + most_collisions
        while True:
            for part in loop(PARTS):
                _fly(gas, part, time)
            _order_cells(gas)
            for part in loop(PARTS):
                _put(gas, part)
            if clock.steps % REORDER == 0:
                for part in loop(PARTS):
                    _set_aside(gas, part)
                for part in loop(PARTS):
                    _take_back(gas, part)
            _choose_step(gas)
            if not clock.time + clock.step <= until or clock.step == math.inf:
                return TIME
            if most_events <= 0:
                return EVENTS
            if clock.collisions >= stop:
                return COLLISIONS
            for group in loop(groups):
                _meet_in(gas, group, math.inf)
            time = clock.step
            most_events -= _end_of_step(gas, groups)

    def look(gas, cut):
        for group in loop((gas.model.n_cells + TOGETHER - 1) // TOGETHER):
            _meet_in(gas, group, cut)

    compiled = njit(error_model="numpy", cache=True, **options)
    return Kernels(compiled(go), compiled(look))


class Kernels(NamedTuple):
    """What Python calls.

    Attributes:
        go: steps that end up to a time (s), as long as there are fewer collisions and events; returns why no more. At the end
            particles are in the order of their cells, so that one may look into the next step.
        look: the collisions of the next step, up to so long (s) after its begin.
    """

    go: Callable[..., int]
    look: Callable[..., None]


ALONE, SEVERAL = _kernels(range), _kernels(prange, parallel={"fusion": False})
"""By one thread, and by several."""

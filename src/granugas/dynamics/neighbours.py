"""Verlet's list of the pairs that may touch soon, each once, made from linked cells.

A pair is in the list if its distance is less than d and a skin; until the particles have come nearer by the skin, nobody else
can touch. A cell is at least that wide, so that partners are in one cell or in neighbouring ones, and a cell knows those of its
neighbours with which its own particles are to be paired: which of them are the same in a narrow box is settled there.
"""

import math
from itertools import product
from typing import NamedTuple

import numpy as np

from granugas.dynamics.events.composition import inline, kernel
from granugas.dynamics.events.memory import Table
from granugas.dynamics.events.vectors import dot, mapped, minus

NOBODY = -1

CELLS = np.dtype([("head", "i4"), ("first", "i4")])
"""First particle of a cell, and the first of its neighbours in the table of them; one row more ends the last cell's."""

LINKS = np.dtype([("next", "i4")])
"""The next particle in a cell."""

BESIDE = np.dtype([("cell", "i4")])
"""Neighbours of the cells, one cell's after the other's."""

PAIRS = np.dtype([("i", "i4"), ("j", "i4"), ("touching", "i4")])
"""Two particles, and whether they touched when forces were last computed."""


class Grid(NamedTuple):
    """The box and its cells.

    Attributes:
        side: of the box (m), for each axis.
        image: the same, infinite where the box ends in walls.
        count: of cells.
        reach: distance of the pairs in the list (m).
        n_cells, n: of cells in all, and of particles.
        cells, beside, links: tables CELLS, BESIDE and LINKS.
    """

    side: tuple[float, ...]
    image: tuple[float, ...]
    count: tuple[int, ...]
    reach: float
    n_cells: int
    n: int
    cells: Table
    beside: Table
    links: Table


def grid_of(side: tuple[float, ...], walled: tuple[bool, ...], reach: float, n_particles: int) -> Grid:
    """Cells for pairs up to a distance (m), about one for each particle where they are that few."""
    width = max(reach, (math.prod(side) / n_particles) ** (1 / len(side)))
    count = tuple(max(1, int(length / width)) for length in side)
    beside, first = _beside(count, walled)
    cells = np.zeros(len(first), CELLS)
    cells["first"] = first
    image = tuple(math.inf if wall else length for length, wall in zip(side, walled, strict=True))
    links = np.zeros(n_particles, LINKS)
    return Grid(side, image, count, reach, math.prod(count), n_particles, Table(cells), Table(beside), Table(links))


def _beside(count: tuple[int, ...], walled: tuple[bool, ...]) -> tuple[np.ndarray, np.ndarray]:
    """The neighbours with larger numbers of each cell, each once, as BESIDE; where those of a cell begin, and where all end."""
    cell = np.stack(np.unravel_index(np.arange(math.prod(count)), count), axis=1)
    around = np.full((len(cell), 3 ** len(count)), NOBODY, np.int32)
    for k, step in enumerate(product((-1, 0, 1), repeat=len(count))):
        there = cell + step
        outside = np.any(walled & ((there < 0) | (there >= count)), axis=1)
        around[:, k] = np.where(outside, NOBODY, np.ravel_multi_index(tuple(np.mod(there, count).T), count))
    around.sort(axis=1)
    wanted = around > np.arange(len(cell))[:, np.newaxis]
    wanted[:, 1:] &= around[:, 1:] != around[:, :-1]
    beside = np.zeros(max(1, np.count_nonzero(wanted)), BESIDE)
    beside["cell"][: np.count_nonzero(wanted)] = around[wanted]
    return beside, np.concatenate([[0], np.cumsum(wanted.sum(axis=1))])


@inline
def nearest(separation, box):
    """A component of a separation across the nearest periodic image, of places that are at most one and a half boxes apart."""
    if separation > 0.5 * box:
        return separation - box
    if separation < -0.5 * box:
        return separation + box
    return separation


@kernel
def list_pairs(grid, motion, pairs, room):
    """Take all particles back into the box and list the pairs: how many there are, of which `room` are written."""
    cells, beside, links = grid.cells, grid.beside, grid.links
    for cell in range(grid.n_cells):
        cells.head[cell] = NOBODY
    for i in range(grid.n):
        motion.x[i] = mapped(motion.x[i], grid.image, _back)
        cell = _cell_of(grid, motion.x[i])
        links.next[i], cells.head[cell] = cells.head[cell], i
    found = 0
    for cell in range(grid.n_cells):
        i = cells.head[cell]
        while i != NOBODY:
            found = _pair_with(grid, motion, pairs, room, i, links.next[i], found)
            for k in range(cells.first[cell], cells.first[cell + 1]):
                found = _pair_with(grid, motion, pairs, room, i, cells.head[beside.cell[k]], found)
            i = links.next[i]
    return found


@inline
def _back(x, box):
    """A place in the periodic box; without one (infinite) as it is."""
    return x - box * math.floor(x / box) if box < math.inf else x


@inline
def _cell_of(grid, x):
    """Number of the cell of a place; what is outside of the box by rounding, or in a wall, is in the outermost."""
    number = 0
    for axis in range(len(x)):
        count = grid.count[axis]
        number = number * count + min(max(int(x[axis] / grid.side[axis] * count), 0), count - 1)
    return number


@inline
def _pair_with(grid, motion, pairs, room, i, j, found):
    """List i with j and all that follow in the cell of j; how many pairs there are then."""
    while j != NOBODY:
        r = mapped(minus(motion.x[j], motion.x[i]), grid.image, nearest)
        if dot(r, r) < grid.reach * grid.reach:
            if found < room:
                pairs.i[found], pairs.j[found], pairs.touching[found] = i, j, 0
            found += 1
        j = grid.links.next[j]
    return found

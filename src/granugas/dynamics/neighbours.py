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
    """Cells for pairs up to a distance (m), no more than some per particle."""
    most = max(1.0, (2.0 * n_particles) ** (1 / len(side)))
    mean = math.prod(side) ** (1 / len(side))
    count = tuple(max(1, int(min(length / reach, most * max(1.0, length / mean)))) for length in side)
    around = [_paired(np.array(cell), count, walled) for cell in product(*(range(k) for k in count))]
    cells = np.zeros(len(around) + 1, CELLS)
    cells["first"][1:] = np.cumsum([len(others) for others in around])
    beside = np.zeros(max(1, cells["first"][-1]), BESIDE)
    beside["cell"][: cells["first"][-1]] = [other for others in around for other in others]
    image = tuple(math.inf if wall else length for length, wall in zip(side, walled, strict=True))
    links = np.zeros(n_particles, LINKS)
    return Grid(side, image, count, reach, len(around), n_particles, Table(cells), Table(beside), Table(links))


def _paired(cell: np.ndarray, count: tuple[int, ...], walled: tuple[bool, ...]) -> list[int]:
    """Numbers of the neighbours of a cell that are larger than its own, each once."""
    shape, wall, found = np.array(count), np.array(walled), set()
    for step in product((-1, 0, 1), repeat=len(count)):
        other = cell + step
        if np.any(wall & ((other < 0) | (other >= shape))):
            continue
        found.add(int(np.ravel_multi_index(tuple(other % shape), count)))
    own = int(np.ravel_multi_index(tuple(cell), count))
    return sorted(k for k in found if k > own)


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

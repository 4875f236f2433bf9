"""The linked cells: which disks are near, and across which edge of the box."""

import math

from granugas.dynamics.events.composition import generic, implements, inline
from granugas.dynamics.events.state import NOBODY
from granugas.dynamics.events.vectors import mapped, mapped_three, minus, plus, times


@inline
def wrapped(index, count):
    """A cell's index along an axis, at most one step outside of 0 ... count - 1, brought back through the periodic edge."""
    if index < 0:
        return index + count
    if index >= count:
        return index - count
    return index


@generic
def index_of(cell, gas):
    """Number of a cell (column, row, layer) in the table of cells."""


@generic
def list_around(cell, gas):
    """Write the first disk of each cell of the block around a cell into `near`, with the offsets; how many there are."""


@generic
def list_ahead(step, gas, cell):
    """The same for the cells that are new to a disk that takes a step, +-1 along one axis, into a cell."""


@inline
def next_cell(gas, cell, step):
    """The cell one step further, through the periodic edge."""
    return mapped(plus(cell, step), gas.grid.cells, wrapped)


@inline
def enter_cell(gas, i):
    """Put disk i at the head of the list of its cell."""
    cell = index_of(gas.disks.cell[i], gas)
    gas.disks.next[i] = gas.cells.head[cell]
    gas.cells.head[cell] = i


@inline
def leave_cell(gas, i):
    """Take disk i out of the list of its cell."""
    cell = index_of(gas.disks.cell[i], gas)
    k = gas.cells.head[cell]
    if k == i:
        gas.cells.head[cell] = gas.disks.next[i]
        return
    while gas.disks.next[k] != i:
        k = gas.disks.next[k]
    gas.disks.next[k] = gas.disks.next[i]


@inline
def steps_between(a, b, count):
    """Steps along an axis from cell a to its neighbour b, across the periodic edge where that is nearer."""
    steps = b - a
    if steps > 1:
        return steps - count
    if steps < -1:
        return steps + count
    return steps


@inline
def nearest_image(separation, box):
    """The component of a separation across the nearest periodic image (in a box of one or two cells steps are ambiguous)."""
    if abs(separation) <= 0.5 * box:
        return separation
    return separation - box * math.floor(separation / box + 0.5)


@inline
def separation(gas, i, j):
    """From disk i to disk j, to its nearest image, in the same or in neighbouring cells and both placed at one time (d)."""
    disks, grid = gas.disks, gas.grid
    steps = mapped_three(disks.cell[i], disks.cell[j], grid.cells, steps_between)
    return mapped(plus(minus(disks.x[j], disks.x[i]), times(grid.width, steps)), grid.box, nearest_image)


@inline
def _list(gas, n, cell, at):
    """Write one cell's first disk as entry n of `near`; how many entries there are then."""
    first = gas.cells.head[cell]
    gas.near.disk[n], gas.near.at[n] = first, at
    return n + (first != NOBODY)  # an empty cell's entry is overwritten: cheaper than a branch


# --- beads on a line ------------------------------------------------------------------------------------------------------


@implements(index_of, 1)
def _index_on_a_line(cell, gas):
    return cell[0]


@implements(list_around, 1)
def _around_on_a_line(cell, gas):
    n = 0
    for dx in range(-1, 2):
        n = _list(gas, n, wrapped(cell[0] + dx, gas.grid.cells[0]), (dx * gas.grid.width[0],))
    return n


@implements(list_ahead, 1)
def _ahead_on_a_line(step, gas, cell):
    return _list(gas, 0, wrapped(cell[0] + step[0], gas.grid.cells[0]), (step[0] * gas.grid.width[0],))


# --- disks in a plane -----------------------------------------------------------------------------------------------------


@implements(index_of, 2)
def _index_in_a_plane(cell, gas):
    return cell[1] * gas.grid.cells[0] + cell[0]


@implements(list_around, 2)
def _around_in_a_plane(cell, gas):
    (nx, ny), (width_x, width_y) = gas.grid.cells, gas.grid.width
    n = 0
    for dy in range(-1, 2):
        row = wrapped(cell[1] + dy, ny) * nx
        for dx in range(-1, 2):
            n = _list(gas, n, row + wrapped(cell[0] + dx, nx), (dx * width_x, dy * width_y))
    return n


@implements(list_ahead, 2)
def _ahead_in_a_plane(step, gas, cell):
    (nx, ny), (width_x, width_y) = gas.grid.cells, gas.grid.width
    n = 0
    for k in range(-1, 2):
        dx, dy = step[0] + k * step[1] * step[1], step[1] + k * step[0] * step[0]
        n = _list(gas, n, wrapped(cell[1] + dy, ny) * nx + wrapped(cell[0] + dx, nx), (dx * width_x, dy * width_y))
    return n


# --- spheres in space -----------------------------------------------------------------------------------------------------


@implements(index_of, 3)
def _index_in_space(cell, gas):
    return (cell[2] * gas.grid.cells[1] + cell[1]) * gas.grid.cells[0] + cell[0]


@implements(list_around, 3)
def _around_in_space(cell, gas):
    (nx, ny, nz), (width_x, width_y, width_z) = gas.grid.cells, gas.grid.width
    n = 0
    for dz in range(-1, 2):
        layer = wrapped(cell[2] + dz, nz) * ny
        for dy in range(-1, 2):
            row = (layer + wrapped(cell[1] + dy, ny)) * nx
            for dx in range(-1, 2):
                n = _list(gas, n, row + wrapped(cell[0] + dx, nx), (dx * width_x, dy * width_y, dz * width_z))
    return n


@implements(list_ahead, 3)
def _ahead_in_space(step, gas, cell):
    (nx, ny, nz), (width_x, width_y, width_z) = gas.grid.cells, gas.grid.width
    along_x, along_y = step[0] != 0, step[1] != 0
    n = 0
    for k in range(-1, 2):
        for m in range(-1, 2):
            dx = step[0] if along_x else k
            dy = step[1] if along_y else (k if along_x else m)
            dz = m if along_x or along_y else step[2]
            row = wrapped(cell[2] + dz, nz) * ny + wrapped(cell[1] + dy, ny)
            n = _list(gas, n, row * nx + wrapped(cell[0] + dx, nx), (dx * width_x, dy * width_y, dz * width_z))
    return n

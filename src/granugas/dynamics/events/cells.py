"""The linked cells: which disks are near, and across which edge of the box."""

import math

from granugas.dynamics.events.composition import inline
from granugas.dynamics.events.state import NOBODY


@inline
def wrapped(index, count):
    """A cell's column or row, at most one step outside of 0 ... count - 1, brought back through the periodic edge."""
    if index < 0:
        return index + count
    if index >= count:
        return index - count
    return index


@inline
def enter_cell(gas, i):
    """Put disk i at the head of the list of its cell (cx, cy)."""
    cell = gas.disks.cy[i] * gas.grid.nx + gas.disks.cx[i]
    gas.disks.next[i] = gas.cells.head[cell]
    gas.cells.head[cell] = i


@inline
def leave_cell(gas, i):
    """Take disk i out of the list of its cell."""
    cell = gas.disks.cy[i] * gas.grid.nx + gas.disks.cx[i]
    k = gas.cells.head[cell]
    if k == i:
        gas.cells.head[cell] = gas.disks.next[i]
        return
    while gas.disks.next[k] != i:
        k = gas.disks.next[k]
    gas.disks.next[k] = gas.disks.next[i]


@inline
def list_around(gas, cx, cy):
    """Write the first disk of each of the nine cells around (cx, cy) into `near`, with the offsets; how many there are."""
    near, head = gas.near, gas.cells.head
    nx, ny, width_x, width_y = gas.grid.nx, gas.grid.ny, gas.grid.width_x, gas.grid.width_y
    n = 0
    for dy in range(-1, 2):
        row = wrapped(cy + dy, ny) * nx
        for dx in range(-1, 2):
            first = head[row + wrapped(cx + dx, nx)]
            near.disk[n], near.x[n], near.y[n] = first, dx * width_x, dy * width_y
            n += first != NOBODY  # an empty cell's entry is overwritten: cheaper than a branch
    return n


@inline
def list_ahead(gas, cx, cy, step_x, step_y):
    """The same for the three cells ahead of a disk that takes a step, (+-1, 0) or (0, +-1), into the cell (cx, cy)."""
    near, head = gas.near, gas.cells.head
    nx, ny, width_x, width_y = gas.grid.nx, gas.grid.ny, gas.grid.width_x, gas.grid.width_y
    n = 0
    for k in range(-1, 2):
        dx, dy = step_x + k * step_y * step_y, step_y + k * step_x * step_x
        first = head[wrapped(cy + dy, ny) * nx + wrapped(cx + dx, nx)]
        near.disk[n], near.x[n], near.y[n] = first, dx * width_x, dy * width_y
        n += first != NOBODY
    return n


@inline
def steps_between(a, b, count):
    """Columns or rows from cell a to its neighbour b, across the periodic edge where that is nearer."""
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
    x = disks.x[j] - disks.x[i] + grid.width_x * steps_between(disks.cx[i], disks.cx[j], grid.nx)
    y = disks.y[j] - disks.y[i] + grid.width_y * steps_between(disks.cy[i], disks.cy[j], grid.ny)
    return nearest_image(x, grid.box_x), nearest_image(y, grid.box_y)

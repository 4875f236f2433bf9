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
def list_heads(gas, i, columns, rows):
    """Write the first disk of each cell of a block around disk i into `near`, with the cell's offset; how many there are.

    columns, rows: first and last offset of the block, in -1 ... 1.
    """
    disks, near, grid = gas.disks, gas.near, gas.grid
    n = 0
    for dy in range(rows[0], rows[1] + 1):
        row = wrapped(disks.cy[i] + dy, grid.ny) * grid.nx
        for dx in range(columns[0], columns[1] + 1):
            head = gas.cells.head[row + wrapped(disks.cx[i] + dx, grid.nx)]
            near.disk[n], near.x[n], near.y[n] = head, dx * grid.width_x, dy * grid.width_y
            n += head != NOBODY
    return n


@inline
def list_next(gas, k, n):
    """Append the disk that follows entry k of `near` in its cell, if there is one; how many entries there are then."""
    near = gas.near
    follower = gas.disks.next[near.disk[k]]
    near.disk[n], near.x[n], near.y[n] = follower, near.x[k], near.y[k]
    return n + (follower != NOBODY)


@inline
def nearest_image(separation, box):
    """The component of a separation across the nearest periodic image."""
    return separation - box * math.floor(separation / box + 0.5)

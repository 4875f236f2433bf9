"""Looking ahead: in a large system every event would wait for the main memory some ten times.

What a bin of the calendar will need is asked for while earlier bins are worked on, in three steps, each of which needs what
the one before has brought: the disks of the bin; their partners and the lists of the cells around them; the disks in those
cells. Nothing is computed here, and nothing depends on it. It pays where the tables outgrow the cache (engine.py decides).
"""

from granugas.dynamics.events.cells import list_ahead, list_around, wrapped
from granugas.dynamics.events.composition import inline
from granugas.dynamics.events.flight import next_step
from granugas.dynamics.events.memory import prefetch
from granugas.dynamics.events.state import NOBODY, SLOTS


@inline
def look_ahead(gas, current):
    """Ask for what the bins after the current one will need; `calendar.look_ahead` is the distance between two steps."""
    step = gas.calendar.look_ahead
    _fetch_disks(gas, current + 3 * step)
    _fetch_cells(gas, current + 2 * step)
    _fetch_neighbours(gas, current + step)


@inline
def _fetch_disks(gas, b):
    if b < gas.calendar.n_bins:
        for slot in range(b * SLOTS + 1, b * SLOTS + 1 + gas.bins.entry[b * SLOTS]):
            i = gas.bins.entry[slot]
            prefetch(gas.disks.x, i)
            prefetch(gas.schedule.time, i)
            prefetch(gas.clocks.last, i)


@inline
def _fetch_cells(gas, b):
    if b < gas.calendar.n_bins:
        disks = gas.disks
        for slot in range(b * SLOTS + 1, b * SLOTS + 1 + gas.bins.entry[b * SLOTS]):
            i = gas.bins.entry[slot]
            j = disks.partner[i]
            if gas.schedule.time[i] < disks.t_coll[i]:
                step_x, step_y = next_step(gas, i, disks.x[i], disks.y[i])
                _fetch_heads(gas, disks.cx[i] + step_x, disks.cy[i] + step_y)
                _fetch_heads(gas, disks.cx[i] + 2 * step_x, disks.cy[i] + 2 * step_y)
            elif j != NOBODY:
                prefetch(disks.x, j)
                prefetch(gas.clocks.last, j)
                _fetch_heads(gas, disks.cx[i], disks.cy[i])


@inline
def _fetch_heads(gas, cx, cy):
    """The lists of the cell and of those above and below; the ones beside them mostly come along."""
    head, nx, last = gas.cells.head, gas.grid.nx, gas.grid.nx * gas.grid.ny - 1
    cell = cy * nx + cx
    prefetch(head, min(max(cell, 0), last))
    prefetch(head, min(max(cell - nx, 0), last))
    prefetch(head, min(max(cell + nx, 0), last))


@inline
def _fetch_neighbours(gas, b):
    if b < gas.calendar.n_bins:
        disks, grid = gas.disks, gas.grid
        for slot in range(b * SLOTS + 1, b * SLOTS + 1 + gas.bins.entry[b * SLOTS]):
            i = gas.bins.entry[slot]
            cx, cy = disks.cx[i], disks.cy[i]
            j = disks.partner[i]
            if gas.schedule.time[i] < disks.t_coll[i]:
                step_x, step_y = next_step(gas, i, disks.x[i], disks.y[i])
                _fetch_near(gas, list_ahead(gas, wrapped(cx + step_x, grid.nx), wrapped(cy + step_y, grid.ny), step_x, step_y))
            else:
                _fetch_near(gas, list_around(gas, cx, cy))
                if j != NOBODY:
                    _fetch_near(gas, list_around(gas, disks.cx[j], disks.cy[j]))


@inline
def _fetch_near(gas, n):
    for k in range(n):
        prefetch(gas.disks.x, gas.near.disk[k])

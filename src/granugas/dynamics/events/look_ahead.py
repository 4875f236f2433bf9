"""Looking ahead: in a large system every event would wait for the main memory some ten times.

What a bin of the calendar will need is asked for while earlier bins are worked on, in three steps, each of which needs what
the one before has brought: the disks of the bin; their partners and the lists of the cells around them; the disks in those
cells. Nothing is computed here, and nothing depends on it. It pays where the tables outgrow the cache (engine.py decides).
"""

from granugas.dynamics.events.cells import list_around
from granugas.dynamics.events.composition import inline
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
        nx, last = gas.grid.nx, gas.grid.nx * gas.grid.ny - 1
        for slot in range(b * SLOTS + 1, b * SLOTS + 1 + gas.bins.entry[b * SLOTS]):
            i = gas.bins.entry[slot]
            cell = gas.disks.cy[i] * nx + gas.disks.cx[i]
            prefetch(gas.cells.head, cell)
            prefetch(gas.cells.head, max(cell - nx, 0))
            prefetch(gas.cells.head, min(cell + nx, last))
            j = gas.disks.partner[i]
            if j != NOBODY:
                prefetch(gas.disks.x, j)
                prefetch(gas.clocks.last, j)


@inline
def _fetch_neighbours(gas, b):
    if b < gas.calendar.n_bins:
        for slot in range(b * SLOTS + 1, b * SLOTS + 1 + gas.bins.entry[b * SLOTS]):
            n = list_around(gas, gas.bins.entry[slot])
            for k in range(n):
                prefetch(gas.disks.x, gas.near.disk[k])

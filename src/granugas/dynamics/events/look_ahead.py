"""Looking ahead: in a large system every event would wait for the main memory some ten times.

What a bin of the calendar will need is asked for while earlier bins are worked on, in three steps, each of which needs what
the one before has brought: the disks of the bin; their partners and the lists of the cells around them; the disks in those
cells. Nothing is computed here, and nothing depends on it. It pays where the tables outgrow the cache (engine.py decides).
"""

from granugas.dynamics.events.boundary import step_ahead
from granugas.dynamics.events.cells import index_of, list_ahead, list_around, next_cell
from granugas.dynamics.events.composition import inline
from granugas.dynamics.events.memory import prefetch
from granugas.dynamics.events.state import NOBODY, SLOTS
from granugas.dynamics.events.vectors import plus


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
                step = step_ahead(gas.walls, gas, i, disks.x[i], disks.v[i])
                ahead = plus(disks.cell[i], step)
                _fetch_heads(gas, ahead)
                _fetch_heads(gas, plus(ahead, step))
            elif j != NOBODY:
                prefetch(disks.x, j)
                prefetch(gas.clocks.last, j)
                _fetch_heads(gas, disks.cell[i])


@inline
def _fetch_heads(gas, cell):
    """The lists of the cell and of those a row above and below; the ones beside them mostly come along."""
    head, row, last = gas.cells.head, gas.grid.cells[0], gas.grid.count - 1
    here = index_of(cell, gas)
    prefetch(head, min(max(here, 0), last))
    prefetch(head, min(max(here - row, 0), last))
    prefetch(head, min(max(here + row, 0), last))


@inline
def _fetch_neighbours(gas, b):
    if b < gas.calendar.n_bins:
        disks = gas.disks
        for slot in range(b * SLOTS + 1, b * SLOTS + 1 + gas.bins.entry[b * SLOTS]):
            i = gas.bins.entry[slot]
            j = disks.partner[i]
            if gas.schedule.time[i] < disks.t_coll[i]:
                step = step_ahead(gas.walls, gas, i, disks.x[i], disks.v[i])
                _fetch_near(gas, list_ahead(step, gas, next_cell(gas, disks.cell[i], step)))
            else:
                _fetch_near(gas, list_around(disks.cell[i], gas))
                if j != NOBODY:
                    _fetch_near(gas, list_around(disks.cell[j], gas))


@inline
def _fetch_near(gas, n):
    for k in range(n):
        prefetch(gas.disks.x, gas.near.disk[k])

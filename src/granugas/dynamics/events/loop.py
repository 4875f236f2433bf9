"""The event loop."""

import math

from granugas.dynamics.events.calendar import next_event, refresh_if_full
from granugas.dynamics.events.cells import enter_cell, leave_cell, list_ahead, list_around, wrapped
from granugas.dynamics.events.collisions import collide
from granugas.dynamics.events.composition import generic, inline, kernel
from granugas.dynamics.events.flight import next_step, position
from granugas.dynamics.events.predict import look_around, plan
from granugas.dynamics.events.state import NOBODY

TIME, COLLISIONS, EVENTS, WATCH = 0, 1, 2, 3
"""Why the loop ended: no event is left up to `calendar.until`, a number was reached, or the watch called."""


@generic
def witness(watch, gas, i, j, now, since, u_n):
    """Look at a collision that has just happened; True ends the loop after it.

    since: time since the last collision of the partner that collided last (s); u_n: normal relative velocity before (d/s).
    """


@kernel
def run(gas, most_collisions, most_events):
    """Process events in order of time up to `calendar.until` or either number of them; returns why it ended."""
    disks, tally = gas.disks, gas.tally
    last_collision = tally.collisions + most_collisions
    for _ in range(most_events):
        if tally.collisions >= last_collision:
            return COLLISIONS
        refresh_if_full(gas)
        now, i = next_event(gas)
        if i == NOBODY:
            return TIME
        if now < disks.t_coll[i]:
            _cross(gas, i, now)
            continue
        j = disks.partner[i]
        called = False
        if j != NOBODY:
            since, u_n = collide(gas, i, j, now)
            called = witness(gas.watch, gas, i, j, now, since, u_n)
            _forget(gas, j)
        _forget(gas, i)
        while i != NOBODY:
            x, y = position(gas, i, now)
            look_around(gas, i, x, y, now, list_around(gas, disks.cx[i], disks.cy[i]))
            plan(gas, i, x, y, now)
            i, j = j, NOBODY
        if called:
            return WATCH
    return EVENTS


@inline
def _forget(gas, i):
    """Disk i knows of no collision."""
    gas.disks.partner[i] = NOBODY
    gas.disks.t_coll[i] = math.inf
    gas.schedule.time[i] = math.inf


@inline
def _cross(gas, i, now):
    """Disk i enters the next cell, where only the three cells ahead are new to it."""
    disks, grid = gas.disks, gas.grid
    x, y = position(gas, i, now)
    step_x, step_y = next_step(gas, i, x, y)
    leave_cell(gas, i)
    disks.cx[i] = wrapped(disks.cx[i] + step_x, grid.nx)
    disks.cy[i] = wrapped(disks.cy[i] + step_y, grid.ny)
    shift_x, shift_y = step_x * grid.width_x, step_y * grid.width_y
    disks.x[i] -= shift_x
    disks.y[i] -= shift_y
    enter_cell(gas, i)
    gas.tally.crossings += 1
    look_around(gas, i, x - shift_x, y - shift_y, now, list_ahead(gas, disks.cx[i], disks.cy[i], step_x, step_y))
    plan(gas, i, x - shift_x, y - shift_y, now)


@kernel
def start(gas):
    """Predict everything from positions, velocities and cells alone."""
    disks, n = gas.disks, gas.calendar.n_disks
    now = gas.calendar.now
    for i in range(n):
        _forget(gas, i)
        enter_cell(gas, i)
    for i in range(n):
        x, y = position(gas, i, now)
        look_around(gas, i, x, y, now, list_around(gas, disks.cx[i], disks.cy[i]))
        plan(gas, i, x, y, now)

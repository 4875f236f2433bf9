"""The event loop."""

import math

from granugas.dynamics.events.boundary import NO_WALL, WALL_AND_CALL, bounce, step_ahead
from granugas.dynamics.events.calendar import clear, next_event, refresh_if_full
from granugas.dynamics.events.cells import enter_cell, leave_cell, list_ahead, list_around, next_cell
from granugas.dynamics.events.collisions import collide, lose
from granugas.dynamics.events.composition import ANY, generic, implements, inline, kernel
from granugas.dynamics.events.flight import position, settle, velocity
from granugas.dynamics.events.predict import look_around, plan
from granugas.dynamics.events.sizes import mass
from granugas.dynamics.events.state import NOBODY
from granugas.dynamics.events.vectors import dot, minus, plus, times

TIME, COLLISIONS, EVENTS, WATCH = 0, 1, 2, 3
"""Why the loop ended: no event is left up to `calendar.until`, a number was reached, or the watch called."""


@generic
def witness(watch, gas, i, j, now, since, u_n):
    """Look at a collision that has just happened; True ends the loop after it.

    since: time since the last collision of the partner that collided last (s); u_n: normal relative velocity before (d/s).
    """


@generic
def witness_at_wall(watch, gas, i, now, since, u_n):
    """The same for disk i and a wall."""


@implements(witness_at_wall, ANY)
def _not_at_walls(watch, gas, i, now, since, u_n):
    return False


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
        called = False
        if now < disks.t_coll[i]:
            met = bounce(gas.walls, gas, i, now)
            if met == NO_WALL:
                _cross(gas, i, now)
                continue
            called = met == WALL_AND_CALL
            j = NOBODY
        else:
            j = disks.partner[i]
            if j != NOBODY:
                since, u_n = collide(gas, i, j, now)
                called = witness(gas.watch, gas, i, j, now, since, u_n)
                _forget(gas, j)
        _forget(gas, i)
        while i != NOBODY:
            _look_everywhere(gas, i, now)
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
def _look_everywhere(gas, i, now):
    """Predict the next event of a disk that knows of none."""
    x, v = position(gas, i, now), velocity(gas, i, now)
    look_around(gas, i, x, v, now, list_around(gas.disks.cell[i], gas))
    plan(gas, i, x, v, now)


@inline
def _cross(gas, i, now):
    """Disk i enters the next cell, where only the cells ahead are new to it.

    Its flight begins there: a start thousands of cells behind would be rounded in the same direction at each of them.
    """
    disks = gas.disks
    settle(gas.force, gas, i, now)
    v = disks.v[i]
    step = step_ahead(gas.walls, gas, i, disks.x[i], v)
    leave_cell(gas, i)
    disks.cell[i] = next_cell(gas, disks.cell[i], step)
    x = minus(disks.x[i], times(gas.grid.width, step))
    disks.x[i] = x
    enter_cell(gas, i)
    gas.tally.crossings += 1
    look_around(gas, i, x, v, now, list_ahead(step, gas, disks.cell[i]))
    plan(gas, i, x, v, now)


@kernel
def start(gas):
    """Predict everything from positions, velocities and cells alone."""
    n, now = gas.calendar.n_disks, gas.calendar.now
    for i in range(n):
        _forget(gas, i)
        enter_cell(gas, i)
    for i in range(n):
        _look_everywhere(gas, i, now)


@kernel
def kick(gas, kicks):
    """Add `kicks.dv` to the velocities at the time that is reached, and predict everything anew; the energy put in."""
    calendar, disks = gas.calendar, gas.disks
    calendar.now = calendar.reached
    gain = 0.0
    for i in range(calendar.n_disks):
        settle(gas.force, gas, i, calendar.now)
        v, dv = disks.v[i], kicks.dv[i]
        disks.v[i] = plus(v, dv)
        gain += mass(gas.sizes, i) * (dot(v, dv) + 0.5 * dot(dv, dv))
    lose(gas.tally, -gain, calendar.now)
    predict_anew(gas)
    return gain


@inline
def predict_anew(gas):
    """Predict everything again from what the particles are at `calendar.now`."""
    clear(gas)
    for i in range(gas.calendar.n_disks):
        _forget(gas, i)
    for i in range(gas.calendar.n_disks):
        refresh_if_full(gas)  # which may move the origin of times
        _look_everywhere(gas, i, gas.calendar.now)

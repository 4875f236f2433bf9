"""Prediction: who meets whom, and when.

A collision is written into both partners (`partner`, `t_coll`), and the one with the smaller number keeps the appointment in
the calendar. A disk that loses its partner to an earlier collision keeps the old `t_coll` as a promise that nothing known
happens before, and looks around again at that time, if nobody has found it by then.
"""

import math

from granugas.dynamics.events.boundary import goes_on_after
from granugas.dynamics.events.calendar import cancel, schedule
from granugas.dynamics.events.composition import inline
from granugas.dynamics.events.flight import position, velocity
from granugas.dynamics.events.sizes import reach
from granugas.dynamics.events.state import NOBODY
from granugas.dynamics.events.vectors import dot, minus, plus

NOISE = 1.0e-28
"""(1e-14)^2: disks in touch that approach more slowly than 1e-14 of their speeds do so by rounding only."""

LONGEST = 1.0e300
"""In place of an infinite delay, which would make a NaN of 0 times infinity."""


@inline
def contact_delay(r, u, reach_2, speed_2, longest):
    """How long until two disks touch, |r + u t|^2 = reach_2; infinite if never or not within `longest`.

    r, u: separation and relative velocity; reach_2: square of the distance in contact; speed_2: the sum of the squares of
    both velocities. The solution is the one without cancellation, c / (-b + sqrt(b^2 - u^2 c)), and it is bounded from below
    by -c / 2b before any root is taken.
    """
    b = dot(r, u)
    c = dot(r, r) - reach_2
    root = b * b - dot(u, u) * c
    if max(b, -root, c + 2.0 * b * longest) > 0.0:  # one branch for three: none is foreseeable by itself
        return math.inf
    if c <= 0.0:
        return 0.0 if b * b > NOISE * speed_2 * reach_2 else math.inf
    return c / (math.sqrt(root) - b)


@inline
def look_around(gas, i, x, v, now, n):
    """Find the next collision of disk i, at x with velocity v now, in the n cells listed in `near`.

    It is written into both partners. A collision counts only if it comes before the next known one of either partner.
    """
    disks, near = gas.disks, gas.near
    speed_2 = dot(v, v)
    earliest = disks.t_coll[i]
    found = NOBODY
    for k in range(n):
        j = near.disk[k]
        at = minus(near.at[k], x)
        while j != NOBODY:
            w = velocity(gas, j, now)
            r = plus(position(gas, j, now), at)
            contact = reach(gas.sizes, i, j)
            longest = min(earliest - now, LONGEST)
            time = now + contact_delay(r, minus(w, v), contact * contact, speed_2 + dot(w, w), longest)
            if time < min(earliest, disks.t_coll[j]):
                earliest, found = time, j
            j = disks.next[j]
    if found != NOBODY:
        _pair(gas, i, found, earliest)


@inline
def plan(gas, i, x, v, now):
    """Enter the next event of disk i, at x with velocity v now, into the calendar: the end of its cell, or its collision."""
    t_coll = gas.disks.t_coll[i]
    goes_on = now + goes_on_after(gas.walls, gas, i, x, v, now)
    if goes_on < t_coll:
        schedule(gas, i, goes_on)
    else:
        _schedule_collision(gas, i, t_coll)


@inline
def _schedule_collision(gas, i, t_coll):
    """One of two partners keeps the appointment."""
    if gas.disks.partner[i] > i or gas.disks.partner[i] == NOBODY:
        schedule(gas, i, t_coll)
    else:
        cancel(gas, i)


@inline
def _pair(gas, i, j, time):
    """i and j meet at `time`; whoever they were to meet before is left alone."""
    disks = gas.disks
    leave_partner(gas, i)
    leave_partner(gas, j)
    disks.partner[i], disks.partner[j] = j, i
    disks.t_coll[i], disks.t_coll[j] = time, time
    if gas.schedule.time[j] > time:
        _schedule_collision(gas, j, time)


@inline
def leave_partner(gas, i):
    """Whom disk i was to meet has lost its partner, and looks around again when they would have met."""
    m = gas.disks.partner[i]
    if m != NOBODY:
        gas.disks.partner[m] = NOBODY
        if gas.schedule.time[m] > gas.disks.t_coll[m]:
            schedule(gas, m, gas.disks.t_coll[m])

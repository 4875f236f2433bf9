"""A watch that writes down where and how hard disks collide: what the stress of a test volume is made of (A Eq. 15)."""

from typing import NamedTuple

import numpy as np

from granugas.dynamics.events.cells import separation
from granugas.dynamics.events.composition import implements
from granugas.dynamics.events.loop import witness
from granugas.dynamics.events.memory import Record, Table
from granugas.dynamics.events.vectors import dot, minus

SEEN = np.dtype([("time", "f8"), ("x", "f8"), ("y", "f8"), ("nx", "f8"), ("ny", "f8"), ("dp", "f8")])
"""Time (s); the point of contact (d), up to half a diameter outside of the box; the unit vector from the one disk to the other;
the momentum (m d/s) that the one gains along it, and the other loses: negative, as disks repel each other."""

COUNT = np.dtype([("n", "i8")])


class Contacts(NamedTuple):
    """A table of SEEN collisions with room for `size` of them."""

    seen: Table
    count: Record
    size: int


def contacts(size: int) -> Contacts:
    """A watch that ends the loop whenever it is full; while nobody empties it by `take`, collisions are not kept."""
    return Contacts(Table(np.zeros(size, SEEN)), Record(np.zeros(1, COUNT)), size)


def take(watch: Contacts) -> np.ndarray:
    """The collisions (n,) of SEEN since they were last taken, in order of time."""
    n = watch.count.n
    watch.count.n = 0
    return watch.seen.rows[:n].copy()


@implements(witness, Contacts)
def _contacts(watch, gas, i, j, now, since, u_n):
    disks, grid, seen, k = gas.disks, gas.grid, watch.seen, watch.count.n
    if k == watch.size:
        return True
    n = separation(gas, i, j)  # of length 1: they touch
    seen.time[k] = gas.calendar.base + (gas.calendar.base_low + now)
    (x, y), (cx, cy), (width_x, width_y) = disks.x[i], disks.cell[i], grid.width
    seen.x[k] = x + (cx + 0.5) * width_x + 0.5 * n[0]
    seen.y[k] = y + (cy + 0.5) * width_y + 0.5 * n[1]
    seen.nx[k], seen.ny[k] = n
    parting = dot(minus(disks.v[j], disks.v[i]), n)
    seen.dp[k] = 0.5 * (u_n - parting)  # A Eq. 2, whatever the rule
    watch.count.n = k + 1
    return k + 1 == watch.size

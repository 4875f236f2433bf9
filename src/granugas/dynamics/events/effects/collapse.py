"""A watch that notices the inelastic collapse (A section 2.1): infinitely many collisions in finite time.

On the way into a collapse both the time between collisions and the approach speed fall geometrically, so the distance that
is left between two partners falls out of what double precision resolves after some tens of collisions. From there on the
rounding, not the model, decides. A collision whose partners moved less than RESOLUTION towards each other since one of them
collided last is such a collision. Disks that stick, r = 0, have some of them whenever three meet, a gas or a dense cluster
as good as none, in a collapse there is no end of them: so many, or a single one at which the partners are at REST, end it.
"""

from typing import NamedTuple

import numpy as np

from granugas.dynamics.events.composition import implements, inline
from granugas.dynamics.events.loop import witness, witness_at_wall
from granugas.dynamics.events.memory import Record, Table
from granugas.dynamics.events.vectors import dot
from granugas.dynamics.state import State
from granugas.scene import Scene

RESOLUTION = 1.0e-13
"""Unresolved distance (d)."""

UNRESOLVED = 100
"""Unresolved collisions that are called a collapse."""

REST = 1.0e-12
"""An approach more slowly than this part of their speeds: finitely many collisions never make disks of r > 0 so slow."""

INVOLVED = np.dtype([("i", "i4"), ("j", "i4")])
COUNT = np.dtype([("n", "i8")])


class CollapseWatch(NamedTuple):
    """The partners of the unresolved collisions so far."""

    involved: Table
    count: Record

    def members(self) -> np.ndarray:
        """Numbers of the particles, ascending."""
        rows = self.involved.rows[: self.count.n]
        return np.unique(np.concatenate([rows["i"], rows["j"]])).astype(np.int64)


def effect_of(scene: Scene, state: State) -> CollapseWatch:
    """A watch that has seen nothing yet."""
    return CollapseWatch(Table(np.zeros(UNRESOLVED, INVOLVED)), Record(np.zeros(1, COUNT)))


@implements(witness_at_wall, CollapseWatch)
def _collapse_at_a_wall(watch, gas, i, now, since, u_n):
    return _unresolved(watch, gas, i, i, since, u_n)


@implements(witness, CollapseWatch)
def _collapse_watch(watch, gas, i, j, now, since, u_n):
    return _unresolved(watch, gas, i, j, since, u_n)


@inline
def _unresolved(watch, gas, i, j, since, u_n):
    if -u_n * since >= RESOLUTION:
        return False
    k = watch.count.n
    if k == UNRESOLVED:
        return True
    watch.involved.i[k], watch.involved.j[k] = i, j
    watch.count.n = k + 1
    v, w = gas.disks.v[i], gas.disks.v[j]
    return k + 1 == UNRESOLVED or u_n * u_n < REST * REST * (dot(v, v) + dot(w, w))

"""A watch that writes down every collision, those with walls too."""

from typing import NamedTuple

import numpy as np

from granugas.dynamics.events.composition import implements, inline
from granugas.dynamics.events.loop import witness, witness_at_wall
from granugas.dynamics.events.memory import Record, Table
from granugas.dynamics.events.state import NOBODY

SEEN = np.dtype([("time", "f8"), ("i", "i4"), ("j", "i4")])
COUNT = np.dtype([("n", "i8")])


class Recorder(NamedTuple):
    """A table of SEEN collisions, i < j (i = NOBODY: j hits a wall), with room for `size` of them; times from calendar.base."""

    seen: Table
    count: Record
    size: int


def recorder(size: int) -> Recorder:
    """A recorder that ends the loop after `size` collisions; later ones are not kept."""
    return Recorder(Table(np.zeros(size, SEEN)), Record(np.zeros(1, COUNT)), size)


@implements(witness, Recorder)
def _recorder(watch, gas, i, j, now, since, u_n):
    return _write(watch, i, j, now)


@implements(witness_at_wall, Recorder)
def _recorder_at_walls(watch, gas, i, now, since, u_n):
    return _write(watch, i, NOBODY, now)


@inline
def _write(watch, i, j, now):
    k = watch.count.n
    if k == watch.size:
        return True
    watch.seen.time[k], watch.seen.i[k], watch.seen.j[k] = now, min(i, j), max(i, j)
    watch.count.n = k + 1
    return k + 1 == watch.size

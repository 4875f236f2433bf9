"""A watch that adds up, for a whole list of t_c, how long the particles are elastic: collided no longer than t_c ago.

A particle that collides again after a time s was elastic for min(s, t_c) of it (A section 5.4), so the time average of n_e
is exact, where snapshots only sample it.
"""

from typing import NamedTuple

import numpy as np

from granugas.dynamics.events.composition import implements
from granugas.dynamics.events.loop import witness, witness_at_wall
from granugas.dynamics.events.memory import Table
from granugas.dynamics.state import State
from granugas.scene import Scene

TIMES = np.dtype([("t_c", "f8"), ("held", "f8")])
"""t_c (s), and the time that particles were elastic between two collisions (s)."""


class ElasticTime(NamedTuple):
    """A table of TIMES with `size` rows."""

    times: Table
    size: int

    def take(self, scene: Scene) -> dict[str, np.ndarray]:
        """The times between collisions the second of which came since they were last taken (s)."""
        held = self.times.rows["held"].copy()
        self.times.rows["held"] = 0
        return {"elastic_time": held}


def effect_of(scene: Scene, state: State) -> ElasticTime:
    """The watch of elastic disks with contact times."""
    times = np.zeros(len(scene.contact_times), TIMES)
    times["t_c"] = sorted(scene.contact_times)
    return ElasticTime(Table(times), len(times))


@implements(witness, ElasticTime)
def _elastic_time(watch, gas, i, j, now, since, u_n):
    between_i, between_j = gas.clocks.interval[i], gas.clocks.interval[j]
    for k in range(watch.size):
        t_c = watch.times.t_c[k]
        watch.times.held[k] += min(between_i, t_c) + min(between_j, t_c)
    return False


@implements(witness_at_wall, ElasticTime)
def _elastic_time_at_a_wall(watch, gas, i, now, since, u_n):
    for k in range(watch.size):
        watch.times.held[k] += min(since, watch.times.t_c[k])
    return False

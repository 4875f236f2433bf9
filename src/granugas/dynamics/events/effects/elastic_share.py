"""Elastic disks that count, for a whole list of t_c, which collisions the TC rule would call elastic.

At r = 1 the rule changes no velocity, so one trajectory serves every t_c (A section 5.4).
"""

from typing import Any, NamedTuple

import numpy as np

from granugas.dynamics.events.collisions import restitution
from granugas.dynamics.events.composition import implements
from granugas.dynamics.events.memory import Table
from granugas.dynamics.state import State
from granugas.scene import Scene

SHARES = np.dtype([("t_c", "f8"), ("elastic", "i8")])
"""t_c (s) in ascending order, and the collisions that came within it."""


class ElasticShare(NamedTuple):
    """A table of SHARES with `size` rows."""

    shares: Table
    size: int

    def take(self, scene: Scene) -> dict[str, np.ndarray]:
        """The counts since they were last taken."""
        counted = self.shares.rows["elastic"].copy()
        self.shares.rows["elastic"] = 0
        return {"elastic": counted}


def effect_of(scene: Scene, state: State, material: Any) -> ElasticShare:
    """The rule of a scene with r = 1."""
    shares = np.zeros(len(scene.contact_times), SHARES)
    shares["t_c"] = sorted(scene.contact_times)
    return ElasticShare(Table(shares), len(shares))


@implements(restitution, ElasticShare)
def _elastic_share(rule, gas, i, j, u_n, since):
    k = rule.size - 1
    while k >= 0 and since <= rule.shares.t_c[k]:
        rule.shares.elastic[k] += 1
        k -= 1
    return 1.0

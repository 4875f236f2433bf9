"""Elastic disks that count, for a whole list of t_c, which collisions the TC rule would call elastic.

At r = 1 the rule changes no velocity, so one trajectory serves every t_c (A section 5.4).
"""

from typing import NamedTuple

import numpy as np

from granugas.dynamics.events.collisions import restitution
from granugas.dynamics.events.composition import implements
from granugas.dynamics.events.memory import Table

SHARES = np.dtype([("t_c", "f8"), ("elastic", "i8")])
"""t_c (s) in ascending order, and the collisions that came within it."""


class ElasticShare(NamedTuple):
    """A table of SHARES with `size` rows."""

    shares: Table
    size: int


@implements(restitution, ElasticShare)
def _elastic_share(rule, gas, since):
    k = rule.size - 1
    while k >= 0 and since <= rule.shares.t_c[k]:
        rule.shares.elastic[k] += 1
        k -= 1
    return 1.0

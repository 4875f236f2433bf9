"""A constant coefficient of restitution: the inelastic hard-sphere model (IHS), elastic disks at r = 1."""

from typing import NamedTuple

from granugas.dynamics.events.collisions import restitution
from granugas.dynamics.events.composition import implements


class Constant(NamedTuple):
    """r in [0, 1]."""

    r: float


class Elastic(NamedTuple):
    """r = 1, known when the kernel is compiled."""


@implements(restitution, Constant)
def _constant(rule, gas, since):
    return rule.r


@implements(restitution, Elastic)
def _elastic(rule, gas, since):
    return 1.0

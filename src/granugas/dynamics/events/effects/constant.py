"""A constant coefficient of restitution; elastic disks at r = 1."""

from typing import NamedTuple

from granugas.dynamics.events.collisions import restitution
from granugas.dynamics.events.composition import implements
from granugas.dynamics.state import State
from granugas.scene import Scene


class Constant(NamedTuple):
    """r in [0, 1]."""

    r: float


class Elastic(NamedTuple):
    """r = 1, known when the kernel is compiled."""


def effect_of(scene: Scene, state: State) -> Constant | Elastic:
    """The material of a scene."""
    return Elastic() if scene.restitution == 1 else Constant(float(scene.restitution))


@implements(restitution, Constant)
def _constant(material, gas, i, j, u_n, since):
    return material.r


@implements(restitution, Elastic)
def _elastic(material, gas, i, j, u_n, since):
    return 1.0

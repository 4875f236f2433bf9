"""Plastic contacts (A section 3.iv): above the yield velocity r falls as u^(-1/4), below it is the material's own."""

import math
from typing import NamedTuple

from granugas.dynamics.events.collisions import restitution
from granugas.dynamics.events.composition import implements
from granugas.dynamics.state import State
from granugas.scene import Scene


class Plastic(NamedTuple):
    """r below the yield velocity, and that velocity (d/s)."""

    r: float
    v_y: float


def effect_of(scene: Scene, state: State) -> Plastic:
    """The material of a scene; the yield velocity is given in m/s."""
    return Plastic(float(scene.restitution), float(scene.yield_velocity / scene.diameter))


@implements(restitution, Plastic)
def _plastic(material, gas, i, j, u_n, since):
    u = abs(u_n)
    return material.r if u <= material.v_y else material.r * math.sqrt(math.sqrt(material.v_y / u))

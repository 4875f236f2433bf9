"""Viscoelastic spheres (A section 3.iv): the slower a collision, the less it dissipates; r -> 1 as u -> 0."""

from typing import NamedTuple

from granugas.dynamics.events.collisions import restitution
from granugas.dynamics.events.composition import implements
from granugas.dynamics.state import State
from granugas.scene import Scene

C1 = 1.15344
"""Of the Hertz contact with a viscous force: r = 1 - C1 x + C2 x^2 with x = A u^(1/5), u the normal relative velocity."""

C2 = 0.6 * C1 * C1

LARGEST = 0.5 * C1 / C2
"""x where r is least, 7/12, and stays: beyond, the series would rise again. A scene begins below it."""


class Viscoelastic(NamedTuple):
    """A in (s/d)^(1/5)."""

    a: float


def effect_of(scene: Scene, state: State) -> Viscoelastic:
    """The material of a scene; A is given in (s/m)^(1/5)."""
    return Viscoelastic(float(scene.viscosity * scene.diameter**0.2))


@implements(restitution, Viscoelastic)
def _viscoelastic(material, gas, i, j, u_n, since):
    x = min(material.a * abs(u_n) ** 0.2, LARGEST)
    return 1.0 - C1 * x + C2 * x * x

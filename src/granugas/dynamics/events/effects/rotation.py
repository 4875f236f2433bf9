"""The relative velocity after a collision is turned by a small random angle (A section 3.ii).

Energy and momentum of the pair stay; its angular momentum does not. The rotation has a random vector w, as long as the
tangent of half its angle at most (in a plane a number, in space any within a ball): u' = u + 2 w x (u + w x u) / (1 + w^2)
needs no sine and keeps the length of u. A rotation after which the pair would approach is drawn again.
"""

import math
from typing import NamedTuple

from granugas.dynamics.events.collisions import follow_up, pass_on, push
from granugas.dynamics.events.composition import generic, implements, inline
from granugas.dynamics.events.memory import Record
from granugas.dynamics.events.randomness import stream, symmetric
from granugas.dynamics.events.sizes import reach, reduced_mass
from granugas.dynamics.events.vectors import along, dot, minus, plus, scaled
from granugas.dynamics.state import State
from granugas.scene import Scene

DRAWS = 50
"""Half of all rotations of a pair that parts at least let it part; one that does not part for all of these stays as it is."""


class Rotation(NamedTuple):
    """The tangent of half the largest angle, and the random numbers."""

    tangent: float
    stream: Record


def effect_of(scene: Scene, state: State) -> Rotation:
    """The rotation of a scene; its largest angle is given in degrees."""
    return Rotation(math.tan(math.radians(scene.rotation_angle) / 2), stream(state, "rotation"))


@generic
def turned(u, rotation):
    """The vector u, turned at random."""


@implements(follow_up, Rotation)
def _rotation(rotation, gas, i, j, n, u_n, now):
    u = minus(gas.disks.v[j], gas.disks.v[i])
    for _ in range(DRAWS):
        change = minus(turned(u, rotation), u)
        if dot(u, n) + dot(change, n) >= 0.0:
            push(gas, i, j, -1.0, change)
            pass_on(n, gas.tally, scaled(change, -reduced_mass(gas.sizes, i, j)), reach(gas.sizes, i, j))
            return


@implements(turned, 2)
def _turned_in_a_plane(u, rotation):
    w = rotation.tangent * symmetric(rotation.stream)
    c, s = (1.0 - w * w) / (1.0 + w * w), 2.0 * w / (1.0 + w * w)
    return c * u[0] - s * u[1], s * u[0] + c * u[1]


@implements(turned, 3)
def _turned_in_space(u, rotation):
    w_2 = 2.0
    while w_2 > 1.0:
        w = symmetric(rotation.stream), symmetric(rotation.stream), symmetric(rotation.stream)
        w_2 = dot(w, w)
    w = scaled(w, rotation.tangent)
    return along(u, 2.0 / (1.0 + dot(w, w)), _cross(w, plus(u, _cross(w, u))))


@inline
def _cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]

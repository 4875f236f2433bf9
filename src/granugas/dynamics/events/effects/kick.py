"""Random energy for partners that part too slowly (A section 3.ii).

Where the normal relative velocity after a collision is below a critical value, an energy between 0 and a largest one, all
equally likely, is added to the motion of the two along the line of their centres: their momentum stays.
"""

import math
from typing import NamedTuple

from granugas.dynamics.events.collisions import follow_up, lose, pass_on, push
from granugas.dynamics.events.composition import implements
from granugas.dynamics.events.memory import Record
from granugas.dynamics.events.randomness import stream, uniform
from granugas.dynamics.events.sizes import reach, reduced_mass
from granugas.dynamics.events.vectors import dot, minus, scaled
from granugas.dynamics.state import State
from granugas.scene import Scene


class Kick(NamedTuple):
    """The critical velocity (d/s), the largest energy (m d^2/s^2), and the random numbers."""

    slowest: float
    energy: float
    stream: Record


def effect_of(scene: Scene, state: State) -> Kick:
    """The kick of a scene; its velocity is given in m/s, its energy in m^2/s^2 per mass of a particle."""
    d = scene.diameter
    return Kick(float(scene.kick_velocity / d), float(scene.kick_energy / d**2), stream(state, "kick"))


@implements(follow_up, Kick)
def _kick(kick, gas, i, j, n, u_n, now):
    parting = dot(minus(gas.disks.v[j], gas.disks.v[i]), n)
    if parting < kick.slowest:
        m = reduced_mass(gas.sizes, i, j)
        added = kick.energy * uniform(kick.stream)
        faster = math.sqrt(parting * parting + 2.0 * added / m) - parting
        push(gas, i, j, -faster, n)
        pass_on(n, gas.tally, scaled(n, -m * faster), reach(gas.sizes, i, j))
        lose(gas.tally, -added, now)

"""The TC model (A Eq. 4): no dissipation within the contact duration t_c after a collision."""

from typing import Any, NamedTuple

from granugas.dynamics.events.collisions import lossless, restitution
from granugas.dynamics.events.composition import implements
from granugas.dynamics.state import State
from granugas.scene import Scene


class ContactTime(NamedTuple):
    """The material that dissipates otherwise, and t_c in s."""

    material: Any
    t_c: float


def effect_of(scene: Scene, state: State, material: Any) -> ContactTime:
    """The rule of a scene."""
    return ContactTime(material, float(max(scene.contact_times)))


@implements(lossless, ContactTime)
def _within(rule, gas, i, j, u_n, since):
    return since <= rule.t_c


@implements(restitution, ContactTime)
def _contact_time(rule, gas, i, j, u_n, since):
    if since <= rule.t_c:
        gas.tally.elastic += 1
        return 1.0
    return restitution(rule.material, gas, i, j, u_n, since)

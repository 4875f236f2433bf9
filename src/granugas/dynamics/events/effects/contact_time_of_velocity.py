"""The TC model with a contact duration that depends on the normal relative velocity (end of A section 3): t_c(u) ~ u^(-alpha).

At alpha = 1 the cut-off time is a cut-off distance: a collision is elastic if u times the time since the last one, the way that
the partners came towards each other since then, is at most eps_c = t_c v_0. Like the critical distance it then knows no time of
its own: a gas that is twice as fast does the same in half the time.
"""

from typing import Any, NamedTuple

from granugas.dynamics.events.collisions import lossless, restitution
from granugas.dynamics.events.composition import implements
from granugas.dynamics.state import State
from granugas.scene import Scene


class ContactTimeOfVelocity(NamedTuple):
    """What decides otherwise; alpha; and the largest u^alpha times the time since the last collision ((d/s)^alpha s)."""

    otherwise: Any
    alpha: float
    largest: float


def effect_of(scene: Scene, state: State, otherwise: Any) -> ContactTimeOfVelocity:
    """The rule of a scene: t_c (s) is that of `contact_velocity` (m/s)."""
    alpha, v_0 = float(scene.contact_time_exponent), scene.contact_velocity / scene.diameter
    return ContactTimeOfVelocity(otherwise, alpha, float(scene.contact_time * v_0**alpha))


@implements(lossless, ContactTimeOfVelocity)
def _within(rule, gas, i, j, u_n, since):
    return since * abs(u_n) ** rule.alpha <= rule.largest or lossless(rule.otherwise, gas, i, j, u_n, since)


@implements(restitution, ContactTimeOfVelocity)
def _contact_time_of_velocity(rule, gas, i, j, u_n, since):
    if since * abs(u_n) ** rule.alpha <= rule.largest:
        gas.tally.elastic += 1
        return 1.0
    return restitution(rule.otherwise, gas, i, j, u_n, since)

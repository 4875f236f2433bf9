"""The TC model (A Eq. 4): no dissipation within the contact duration t_c after a collision."""

from typing import NamedTuple

from granugas.dynamics.events.collisions import restitution
from granugas.dynamics.events.composition import implements


class ContactTime(NamedTuple):
    """r in [0, 1] and t_c in s."""

    r: float
    t_c: float


@implements(restitution, ContactTime)
def _contact_time(rule, gas, since):
    if since <= rule.t_c:
        gas.tally.elastic += 1
        return 1.0
    return rule.r

"""No dissipation in company (A section 3.v): elastic if a third particle is nearer to one of the partners than eps_c.

"Nearer" is the gap between the surfaces at the moment of the collision. Images of the partners themselves do not count.
"""

from typing import Any, NamedTuple

from granugas.dynamics.events.cells import list_around
from granugas.dynamics.events.collisions import lossless, restitution
from granugas.dynamics.events.composition import implements, inline
from granugas.dynamics.events.flight import position
from granugas.dynamics.events.sizes import reach
from granugas.dynamics.events.state import NOBODY
from granugas.dynamics.events.vectors import dot, minus, plus
from granugas.dynamics.state import State
from granugas.scene import Scene


class CriticalDistance(NamedTuple):
    """What decides where nobody is near, and eps_c (d), beyond a contact, up to which the rule sees."""

    otherwise: Any
    sight: float


def effect_of(scene: Scene, state: State, otherwise: Any) -> CriticalDistance:
    """The rule of a scene; eps_c is given in m."""
    return CriticalDistance(otherwise, float(scene.critical_distance / scene.diameter))


@implements(lossless, CriticalDistance)
def _suspends(rule, gas, i, j, u_n, since):
    return _near(rule, gas, i, j) or lossless(rule.otherwise, gas, i, j, u_n, since)


@implements(restitution, CriticalDistance)
def _critical_distance(rule, gas, i, j, u_n, since):
    if _near(rule, gas, i, j):
        gas.tally.elastic += 1
        return 1.0
    return restitution(rule.otherwise, gas, i, j, u_n, since)


@inline
def _near(rule, gas, i, j):
    """Whether a third particle is nearer to i or j than eps_c; both have just been placed."""
    now = gas.disks.t[i]
    return _in_company(gas, i, j, rule.sight, now) or _in_company(gas, j, i, rule.sight, now)


@inline
def _in_company(gas, i, partner, gap, now):
    """Whether another particle than its partner is nearer to i than `gap`."""
    disks, near = gas.disks, gas.near
    for k in range(list_around(disks.cell[i], gas)):
        at, other = minus(near.at[k], disks.x[i]), near.disk[k]
        while other != NOBODY:
            if other != i and other != partner:
                r, far = plus(position(gas, other, now), at), reach(gas.sizes, i, other) + gap
                if dot(r, r) < far * far:
                    return True
            other = disks.next[other]
    return False

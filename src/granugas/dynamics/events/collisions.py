"""The collision: A Eqs. 2, 3, 14 and 15, with the coefficient that the rule gives (A Eq. 4)."""

import math
from typing import Any, NamedTuple

from granugas.dynamics.events.cells import separation
from granugas.dynamics.events.composition import ANY, generic, implements, inline
from granugas.dynamics.events.flight import settle
from granugas.dynamics.events.sizes import reach, reduced_mass, shares
from granugas.dynamics.events.vectors import along, divided, dot, minus, scaled


class Smooth(NamedTuple):
    """Surfaces that pass on no tangential momentum."""


class Nothing(NamedTuple):
    """Nothing happens after a collision."""


class Then(NamedTuple):
    """One thing happens after a collision, and then another; each may be a Then again."""

    first: Any
    second: Any


@generic
def restitution(rule, gas, i, j, u_n, since):
    """r of a collision of i and j (A Eq. 3).

    u_n: normal relative velocity before (d/s); since: time since the last collision of the partner that collided last (s).
    """


@generic
def lossless(rule, gas, i, j, u_n, since):
    """Whether the rule suspends all dissipation in a collision of i and j, arguments as of `restitution`."""


@generic
def rub(surface, gas, i, j, n, u, dv_n, since, now):
    """What the surfaces of i and j do to each other.

    n: unit vector from i to j; u: relative velocity before; dv_n: change of its normal component.
    """


@generic
def follow_up(after, gas, i, j, n, u_n, now):
    """What else a collision does to its partners, after its momentum is passed on."""


@inline
def collide(gas, i, j, now):
    """Disks i and j touch: their velocities change by A Eq. 2, and the tally by what was lost and passed on.

    Returns the time since the last collision of the partner that collided last, and the normal relative velocity before.
    """
    disks, clocks, tally, sizes = gas.disks, gas.clocks, gas.tally, gas.sizes
    settle(gas.force, gas, i, now)
    settle(gas.force, gas, j, now)
    n = separation(gas, i, j)
    n = divided(n, math.sqrt(dot(n, n)))
    u = minus(disks.v[j], disks.v[i])
    u_n = dot(u, n)
    since_i, since_j = now - clocks.last[i], now - clocks.last[j]
    since = min(since_i, since_j)
    r = restitution(gas.rule, gas, i, j, u_n, since)
    push(gas, i, j, (1.0 + r) * u_n, n)  # A Eq. 2
    # A Eq. 3 once more: what rounding left of it is not zero on average, and grows with the collisions.
    push(gas, i, j, dot(minus(disks.v[j], disks.v[i]), n) + r * u_n, n)
    clocks.last[i] = clocks.last[j] = now
    clocks.interval[i], clocks.interval[j] = since_i, since_j
    disks.collisions[i] += 1
    disks.collisions[j] += 1
    tally.collisions += 1
    lose(tally, 0.5 * reduced_mass(sizes, i, j) * (1.0 - r * r) * u_n * u_n, now)
    pass_on(n, tally, scaled(n, reduced_mass(sizes, i, j) * (1.0 + r) * u_n), reach(sizes, i, j))
    rub(gas.surface, gas, i, j, n, u, (1.0 + r) * u_n, since, now)
    follow_up(gas.after, gas, i, j, n, u_n, now)
    return since, u_n


@inline
def push(gas, i, j, change, n):
    """Change the velocity of i relative to j by `change` along n, each partner by its share; their momentum stays."""
    disks = gas.disks
    share_i, share_j = shares(gas.sizes, i, j)
    disks.v[i] = along(disks.v[i], share_i * change, n)
    disks.v[j] = along(disks.v[j], -(share_j * change), n)


@inline
def lose(tally, loss, now):
    """Count energy that is dissipated (m d^2/s^2)."""
    tally.loss += loss
    tally.loss_time += loss * now


@inline
def store(tally, energy, now):
    """Count translational energy that goes over into another kind, which an effect keeps (m d^2/s^2)."""
    tally.stored += energy
    tally.stored_time += energy * now


@generic
def pass_on(n, tally, dp, contact):
    """Count dp_a l_b of both partners (A Eq. 15): dp is passed on to i, which is nearer to j by `contact` along n."""


@implements(pass_on, 1)
def _pass_on_along_a_line(n, tally, dp, contact):
    tally.stress[0] = along(tally.stress[0], dp[0] * contact, n)


@implements(pass_on, 2)
def _pass_on_in_a_plane(n, tally, dp, contact):
    tally.stress[0] = along(tally.stress[0], dp[0] * contact, n)
    tally.stress[1] = along(tally.stress[1], dp[1] * contact, n)


@implements(pass_on, 3)
def _pass_on_in_space(n, tally, dp, contact):
    tally.stress[0] = along(tally.stress[0], dp[0] * contact, n)
    tally.stress[1] = along(tally.stress[1], dp[1] * contact, n)
    tally.stress[2] = along(tally.stress[2], dp[2] * contact, n)


@implements(lossless, ANY)
def _as_ever(rule, gas, i, j, u_n, since):
    return False


@implements(rub, Smooth)
def _smooth(surface, gas, i, j, n, u, dv_n, since, now):
    return


@implements(follow_up, Nothing)
def _nothing(after, gas, i, j, n, u_n, now):
    return


@implements(follow_up, Then)
def _then(after, gas, i, j, n, u_n, now):
    follow_up(after.first, gas, i, j, n, u_n, now)
    follow_up(after.second, gas, i, j, n, u_n, now)

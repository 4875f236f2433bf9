"""The collision: A Eqs. 2, 3, 14 and 15, with the coefficient that the rule gives (A Eq. 4)."""

import math

from granugas.dynamics.events.cells import separation
from granugas.dynamics.events.composition import generic, inline
from granugas.dynamics.events.flight import position


@generic
def restitution(rule, gas, since):
    """r of a collision (A Eq. 3); `since`: time since the last collision of the partner that collided last (s)."""


@inline
def collide(gas, i, j, now):
    """Disks i and j touch: their velocities change by A Eq. 2, and the tally by what was lost and passed on.

    Returns the time since the last collision of the partner that collided last, and the normal relative velocity before.
    """
    disks, clocks, tally = gas.disks, gas.clocks, gas.tally
    disks.x[i], disks.y[i] = position(gas, i, now)
    disks.x[j], disks.y[j] = position(gas, j, now)
    disks.t[i] = disks.t[j] = now
    nx, ny = separation(gas, i, j)
    norm = math.sqrt(nx * nx + ny * ny)
    nx, ny = nx / norm, ny / norm
    u_n = (disks.vx[j] - disks.vx[i]) * nx + (disks.vy[j] - disks.vy[i]) * ny
    since_i, since_j = now - clocks.last[i], now - clocks.last[j]
    since = min(since_i, since_j)
    r = restitution(gas.rule, gas, since)
    dp = 0.5 * (1.0 + r) * u_n  # A Eq. 2: v_i' = v_i + dp n, v_j' = v_j - dp n
    _push_apart(disks, i, j, dp * nx, dp * ny)
    # A Eq. 3 once more: what rounding left of it is not zero on average, and grows with the collisions.
    left = (disks.vx[j] - disks.vx[i]) * nx + (disks.vy[j] - disks.vy[i]) * ny + r * u_n
    _push_apart(disks, i, j, 0.5 * left * nx, 0.5 * left * ny)
    clocks.last[i] = clocks.last[j] = now
    clocks.interval[i], clocks.interval[j] = since_i, since_j
    disks.collisions[i] += 1
    disks.collisions[j] += 1
    loss = 0.25 * (1.0 - r * r) * u_n * u_n
    tally.collisions += 1
    tally.loss += loss
    tally.loss_time += loss * now
    tally.xx += dp * nx * nx  # A Eq. 15: dp_a l_b of both partners, l = +-(d/2) n, d = 1
    tally.xy += dp * nx * ny
    tally.yx += dp * ny * nx
    tally.yy += dp * ny * ny
    return since, u_n


@inline
def _push_apart(disks, i, j, dp_x, dp_y):
    """Momentum by mass (d/s) from disk j to disk i."""
    disks.vx[i] += dp_x
    disks.vy[i] += dp_y
    disks.vx[j] -= dp_x
    disks.vy[j] -= dp_y

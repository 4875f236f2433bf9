"""A column of beads that hits a wall, without gravity (A section 2.1): below which r it collapses, and what TC does there.

Double precision resolves only some 15 collisions of two beads on the way into their collapse. The edge is therefore found in
decimals of DIGITS places, by the plain rule for the next event; the columns of the TC model are the engine's.
"""

from decimal import Context, Decimal, localcontext
from typing import NamedTuple

import numpy as np
import xarray as xr

from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import at_rest
from granugas.scene import Scene

DIGITS = 80
SHORTEST, SIMULTANEOUS = Decimal("1e-40"), Decimal("1e-60")
"""A column collapses when two collisions follow each other within this part of the time from bead to bead at the start;
within the second number they happen at once, but for rounding."""

WALLS = ("as beads", "elastic")
"""Coefficient of restitution of the wall: that of the beads, or 1."""

SPEED = 1.0
"""Of all beads towards the wall (m/s), at gaps of one diameter d = 1e-3 m: 1e-3 s from bead to bead."""

CONTACT_TIMES = (1e-4, 1e-5, 1e-6)
"""t_c in s, of the TC model."""

DEPTHS = (1.02, 1.1, 1.25, 1.5, 2.0, 3.0)
"""(1 - r) / (1 - r_c) at which it is asked: below r_c."""

TC_SIZE = 10
"""Beads of its columns."""


class Plan(NamedTuple):
    """Numbers of beads, and to which error r_c is found."""

    sizes: tuple[int, ...]
    error: float


FULL = Plan(tuple(range(2, 21)), 1e-3)
SMALL = Plan((2, 3, 5), 1e-2)


def measure(plan: Plan = FULL) -> xr.Dataset:
    """The coefficient of restitution below which a column of N beads collapses, and columns of the TC model below it.

    Returns:
        Dataset over wall (one of WALLS) and n_particles: critical_restitution. Over contact_time and depth =
        (1 - r) / (1 - r_c), for a wall as the beads: column_collisions of TC_SIZE beads with each other until they part, and
        energy_left, their kinetic energy then by the one before.
    """
    found = [[critical_restitution(n, wall, plan.error) for n in plan.sizes] for wall in WALLS]
    edge = critical_restitution(TC_SIZE, WALLS[0], plan.error)
    soft = [[parted(TC_SIZE, 1 - depth * (1 - edge), t_c) for depth in DEPTHS] for t_c in CONTACT_TIMES]
    collisions, energy = np.moveaxis(soft, -1, 0)
    over = ("contact_time", "depth")
    return xr.Dataset(
        {
            "critical_restitution": (("wall", "n_particles"), found),
            "column_collisions": (over, collisions.astype(np.int64)),
            "energy_left": (over, energy),
        },
        {"wall": list(WALLS), "n_particles": list(plan.sizes), "contact_time": list(CONTACT_TIMES), "depth": list(DEPTHS)},
        {"column_beads": TC_SIZE, "column_edge": edge},
    )


def critical_restitution(n: int, wall: str, error: float) -> float:
    """r_c of n beads by bisection: below it the column collapses."""
    low, high = 0.0, 1.0
    while high - low > error:
        middle = (low + high) / 2
        low, high = (middle, high) if collapses(n, middle, wall) else (low, middle)
    return (low + high) / 2


def collapses(n: int, restitution: float, wall: str) -> bool:
    """Whether beads at equal distances and of one speed come to infinitely many collisions on the wall.

    Gaps stand for places and closing speeds for velocities: of the first bead and the wall, of the second and the first ...
    """
    with localcontext(Context(prec=DIGITS)):
        r = Decimal(restitution)
        gap, closing = [Decimal(1)] * n, [Decimal(1)] + [Decimal(0)] * (n - 1)
        while any(speed > 0 for speed in closing):
            delay, k = min((g / c, k) for k, (g, c) in enumerate(zip(gap, closing, strict=True)) if c > 0)
            if SIMULTANEOUS < delay < SHORTEST:
                return True
            gap = [g - c * delay for g, c in zip(gap, closing, strict=True)]
            gap[k] = Decimal(0)
            _collide(closing, k, r if k or wall == WALLS[0] else Decimal(1))
        return False


def _collide(closing: list[Decimal], k: int, r: Decimal) -> None:
    """A Eq. 2 in closing speeds: between two beads each takes half of the change, at the wall the bead takes all of it."""
    change = (1 + r) * closing[k] / (2 if k else 1)
    closing[k] -= (1 + r) * closing[k]
    if k:
        closing[k - 1] += change
    if k + 1 < len(closing):
        closing[k + 1] += change


def parted(n: int, restitution: float, contact_time: float) -> tuple[int, float]:
    """Collisions of n beads of the TC model with each other until they have parted, and the share of energy that is left."""
    d, length = 1e-3, 2000.0  # the other wall is so far away that nobody comes there
    wall = {"boundary": "wall", "wall_restitution": restitution, "wall_contact_time": contact_time, "dimensions": 1}
    scene = Scene(n_particles=n, diameter=d, restitution=restitution, contact_time=contact_time, **wall)
    position = d * (1.5 + 2 * np.arange(n))[:, np.newaxis]
    engine = Engine(scene, at_rest(position, np.full((n, 1), -SPEED), (length,)))
    engine.advance(0.4 * length / SPEED)
    return engine.collisions, float(np.mean(engine.state().velocity ** 2)) / SPEED**2

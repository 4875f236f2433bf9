"""A column of soft beads on a wall, against the two models of hard ones: does TC mimic contacts of many (A section 3)?

Beads at equal gaps s and with one speed v hit a wall of their own kind, one after the other at intervals of s/v. As long as
these are long against t_c all contacts are of two; where they are short the soft beads of the column are in contact together,
and dissipate less than in as many collisions of two.
"""

from typing import NamedTuple

import numpy as np
import xarray as xr

from granugas.dynamics import engine_of
from granugas.dynamics.events import loop
from granugas.equilibrate import at_rest
from granugas.scene import Scene

MODELS: dict[str, dict[str, str | float]] = {
    "soft": {"dynamics": "soft_spheres", "steps_per_contact": 200},
    "TC": {},
    "IHS": {"contact_time": 0.0, "wall_contact_time": 0.0},
}
"""What each names beside the column."""

SPEED, CONTACT_TIME, DIAMETER, LENGTH = 1.0, 1e-5, 1e-3, 100.0
"""v (m/s), t_c (s), d (m), and how far the other wall is away (m): nobody comes there."""

FIRST_LOOK, LAST_LOOK = 10.0, 1e5
"""When it is first asked whether the beads have parted, by the time until the last one comes; and for the last time (t_c)."""

SLOW = 1e-2
"""Velocity, by the root mean square, below which beads that approach each other count as parted: 1e-4 of the energy."""


class Plan(NamedTuple):
    """Numbers of beads, intervals s/(v t_c) between their impacts, and coefficients of restitution."""

    sizes: tuple[int, ...]
    intervals: tuple[float, ...]
    restitutions: tuple[float, ...]


FULL = Plan(tuple(range(1, 21)), (0.01, 0.03, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 30.0), (0.95, 0.8, 0.6))
SMALL = Plan((1, 2, 3, 8), (0.03, 1.0, 30.0), (0.8, 0.6))


def measure(plan: Plan = FULL) -> xr.Dataset:
    """What the models leave of the energy of a column.

    Returns:
        Dataset over model (MODELS), restitution, n_particles and impact_interval = s/(v t_c): energy_left by the energy before,
        and column_collisions of the beads with each other until they have parted; NaN and -1 where the column collapses.
    """
    over = ("model", "restitution", "n_particles", "impact_interval")
    shape = (len(MODELS), len(plan.restitutions), len(plan.sizes), len(plan.intervals))
    energy, collisions = np.empty(shape), np.empty(shape, np.int64)
    for place in np.ndindex(shape):
        model, r, n, interval = (values[k] for values, k in zip((tuple(MODELS), *_axes(plan)), place, strict=True))
        energy[place], collisions[place] = after_impact(model, r, n, interval)
    labels = dict(zip(over, (list(MODELS), *map(list, _axes(plan))), strict=True))
    return xr.Dataset({"energy_left": (over, energy), "column_collisions": (over, collisions)}, labels)


def _axes(plan: Plan) -> tuple[tuple[float, ...], ...]:
    return plan.restitutions, plan.sizes, plan.intervals


def after_impact(model: str, restitution: float, n: int, interval: float) -> tuple[float, int]:
    """Energy that is left to n beads when they have parted, and collisions; NaN and -1 where they never do."""
    values = {"contact_time": CONTACT_TIME, "wall_contact_time": CONTACT_TIME, "diameter": DIAMETER} | MODELS[model]
    line = {"dimensions": 1, "boundary": "wall", "restitution": restitution, "wall_restitution": restitution}
    scene = Scene(n_particles=n, **line | values)
    gap = interval * SPEED * CONTACT_TIME
    position = DIAMETER / 2 + gap + (DIAMETER + gap) * np.arange(n)
    engine = engine_of(scene, at_rest(position[:, np.newaxis], np.full((n, 1), -SPEED), (LENGTH,)))
    time = FIRST_LOOK * (n * interval + 1) * CONTACT_TIME
    while time < LAST_LOOK * CONTACT_TIME:
        if engine.advance(time) == loop.WATCH:
            break
        position, velocity = engine.state().position[:, 0], engine.state().velocity[:, 0]
        if has_parted(position, velocity):
            return float(np.mean(velocity**2)) / SPEED**2, engine.collisions
        time *= 1.5
    return np.nan, -1


def has_parted(position: np.ndarray, velocity: np.ndarray) -> bool:
    """Whether beads, the first one next to the wall, touch nobody and will not but for SLOW ones."""
    apart = np.diff(position, prepend=-DIAMETER / 2) > DIAMETER
    slow = SLOW * np.sqrt(np.mean(velocity**2))
    return bool(np.all(apart) and np.all(np.diff(velocity, prepend=0.0) > -slow))

"""What each effect adds to the time of a collision when a scene names it: all of them timed in turn, side by side."""

import math
import time
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import xarray as xr

from granugas.dynamics.events.engine import Engine
from granugas.experiments.effects import FEW, ROWS
from granugas.experiments.effects_checks import PLAIN, start_of

ALONE = ("the time of a collision",)

NAMED = {row.name: row.scene for row in ROWS if row.scene.lrv_velocity == 0}
"""Scenes of the event-driven engine by the names of their effects."""

PLAIN_NAME = next(name for name, scene in NAMED.items() if scene == PLAIN)
"""The gas without effects, which all others are compared with."""


class Size(NamedTuple):
    """One size of the gases: number of particles, collisions of a particle in a repetition, and repetitions."""

    n_particles: int
    collisions: float
    repetitions: int


class Plan(NamedTuple):
    """How much is measured: sizes of the gases, and which of NAMED."""

    sizes: tuple[Size, ...]
    names: tuple[str, ...] = tuple(NAMED)


FULL = Plan((Size(5740, 10.0, 31), Size(79524, 5.0, 9)))
SMALL = Plan((Size(500, 10.0, 3), Size(2000, 10.0, 3)), FEW)


def measure(plan: Plan = FULL) -> xr.Dataset:
    """Processor time of a collision, of gases that all begin their repetitions anew with the same engines.

    Returns:
        Dataset over effect, n_particles and repetition (NaN where a size has fewer): cpu_per_collision in ns; and cpu_added,
        what it is more than that of the plain gas in the same repetition. Compilation is not in it.
    """
    most = max(size.repetitions for size in plan.sizes)
    costs = [
        np.pad(timed(size, plan.names), ((0, 0), (0, most - size.repetitions)), constant_values=np.nan) for size in plan.sizes
    ]
    cost = xr.DataArray(
        np.stack(costs, axis=1),
        {"effect": list(plan.names), "n_particles": [size.n_particles for size in plan.sizes], "repetition": np.arange(most)},
        ("effect", "n_particles", "repetition"),
    )
    added = cost - cost.sel(effect=PLAIN_NAME, drop=True)
    return xr.Dataset({"cpu_per_collision": cost, "cpu_added": added}, attrs={"plain": PLAIN_NAME})


def timed(size: Size, names: Sequence[str]) -> np.ndarray:
    """(effects, repetitions) ns per collision."""
    scenes = [replace(NAMED[name], n_particles=size.n_particles) for name in names]
    engines = [Engine(scene, start_of(scene)) for scene in scenes]
    begun = [{name: rows.copy() for name, rows in engine.arrays.items()} for engine in engines]
    collisions = math.ceil(size.collisions * size.n_particles / 2)
    for engine in engines:
        engine.advance(math.inf, 1)  # loads its kernel
    cost = np.empty((len(engines), size.repetitions))
    for k in range(size.repetitions):
        for j, engine in enumerate(engines):
            engine.restore(begun[j])
            before = time.process_time()
            engine.advance(math.inf, collisions)
            cost[j, k] = (time.process_time() - before) / engine.collisions * 1e9
    return cost

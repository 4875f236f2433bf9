"""What a job of the workflow does for a run: all its realizations, one after the other, as one dataset."""

import math
from collections.abc import Iterable, Mapping
from types import MappingProxyType

import xarray as xr

from granugas.equilibrate import equilibrate
from granugas.interruption import Keeper
from granugas.runs import Run
from granugas.simulate import ENDLESS, simulate
from granugas.storage.pooling import pool, realization_of

NONE: Mapping[int, Keeper] = MappingProxyType({})


def start_states(run: Run) -> xr.Dataset:
    """The start states of a run."""
    return _together(
        equilibrate(run.scene, seed=run.seed, realization=k, collisions_per_particle=run.equilibration).assign(realization=k)
        for k in run.realizations
    )


def collisions_before(states: xr.Dataset) -> int:
    """Collisions of pairs that it took to make start states, of one realization or of several."""
    name = "equilibration_collisions_per_particle"
    per_particle = states[name].values.sum() if name in states else states.attrs[name]
    return round(float(per_particle) * states.sizes["particle"] / 2)


def perform(
    run: Run, states: xr.Dataset, checkpoints: Mapping[int, Keeper] = NONE, max_seconds: float = math.inf
) -> xr.Dataset:
    """The dataset of a run from its start states, with `trajectory` (and its motion) where that is kept.

    Args:
        run: what is simulated.
        states: of `start_states`.
        checkpoints: of its realizations; those without one begin at t = 0.
        max_seconds: of wall time, for each realization.

    Raises:
        Interrupted: by a signal, with a checkpoint written.
    """
    return _together(
        simulate(
            run.scene,
            run.until,
            seed=run.seed,
            realization=k,
            samples=run.samples,
            snapshots=run.snapshots,
            state=realization_of(states, k),
            keep_positions=run.keep_positions,
            keep_motion=run.keep_motion,
            max_seconds=max_seconds,
            max_collisions=run.max_collisions or ENDLESS,
            checkpoint=checkpoints.get(k),
        )
        for k in run.realizations
    )


def _together(parts: Iterable[xr.Dataset]) -> xr.Dataset:
    first, *others = parts
    return pool([first, *others], keys=[]) if others else first

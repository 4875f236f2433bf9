"""What a job of the workflow does for a run: all its realizations, one after the other, as one dataset."""

from collections.abc import Iterable

import xarray as xr

from granugas.equilibrate import equilibrate
from granugas.runs import Run
from granugas.simulate import simulate
from granugas.storage.pooling import pool, realization_of


def start_states(run: Run) -> xr.Dataset:
    """The start states of a run."""
    return _together(
        equilibrate(run.scene, seed=run.seed, realization=k, collisions_per_particle=run.equilibration).assign(realization=k)
        for k in run.realizations
    )


def perform(run: Run, states: xr.Dataset) -> xr.Dataset:
    """The dataset of a run from its start states, with `trajectory` (and its motion) where that is kept."""
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
        )
        for k in run.realizations
    )


def _together(parts: Iterable[xr.Dataset]) -> xr.Dataset:
    first, *others = parts
    return pool([first, *others], keys=[]) if others else first

"""A job with several realizations gives what single jobs give."""

from dataclasses import replace

import pytest
import xarray as xr

from granugas.execute import perform, start_states
from granugas.runs import Run
from granugas.scene import Scene
from granugas.storage.dataset import content_sha256, read, write
from granugas.storage.pooling import pool, realization_of

RUN = Run(
    scene=Scene(n_particles=42, area_fraction=0.2, restitution=1.0, contact_time=(1e-5, 1e-3)),
    seed=5,
    realizations=(3, 4),
    until={"collisions_per_particle": 20.0},
    samples={"spacing": "linear", "count": 4, "first": 5.0, "axis": "collisions"},
    snapshots=(1e-4,),
    equilibration=30.0,
    keep_positions=False,
)


@pytest.fixture(scope="module")
def single() -> list[tuple[xr.Dataset, xr.Dataset]]:
    runs = [replace(RUN, realizations=(k,)) for k in RUN.realizations]
    states = [start_states(run) for run in runs]
    return [(state, perform(run, state)) for run, state in zip(runs, states, strict=True)]


@pytest.fixture(scope="module")
def chunk(tmp_path_factory) -> tuple[xr.Dataset, xr.Dataset]:
    path = tmp_path_factory.mktemp("states") / "chunk.nc"
    write(start_states(RUN), path)
    states = read(path)
    return states, perform(RUN, states)


def test_start_states_are_those_of_single_runs(single, chunk):
    for k, (state, _) in zip(RUN.realizations, single, strict=True):
        part = realization_of(chunk[0], k)
        assert part["position"].equals(state["position"])
        assert part["velocity"].equals(state["velocity"])
        assert (part.attrs["box_x"], part.attrs["branch"]) == (state.attrs["box_x"], state.attrs["branch"])


def test_a_study_pooled_from_chunks_is_the_one_pooled_from_single_runs(single, chunk):
    keys = ["area_fraction", "contact_time"]
    assert content_sha256(pool([chunk[1]], keys)) == content_sha256(pool([data for _, data in single], keys))


def test_the_only_realization_is_the_dataset_itself(single):
    assert realization_of(single[0][0], 3) is single[0][0]

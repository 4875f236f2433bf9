"""What a run needs of the machine, against what it takes."""

import gc
import resource
import tracemalloc
from dataclasses import replace

import numpy as np
import pytest

import granugas as gg
from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import state_of
from granugas.execute import perform, start_states
from granugas.resources import ENGINE, START, memory_at_hand, memory_of
from granugas.runs import Run


def run_of(n=2000, count=10, realizations=(0,), snapshots=(), keep_positions=False, keep_motion=False, **effects) -> Run:
    samples = {"spacing": "linear", "count": count, "first": 1e-4, "axis": "time"}
    scene = gg.Scene(n_particles=n, **effects)
    return Run(scene, 1, realizations, {"time": 1e-3}, samples, snapshots, 1.0, keep_positions, keep_motion)


@pytest.mark.parametrize(
    "run",
    [
        run_of(n=50_000),
        run_of(n=5000, count=100, keep_positions=True),
        run_of(n=5000, count=100, keep_positions=True, keep_motion=True),
        run_of(n=20_000, snapshots=tuple(np.linspace(1e-5, 1e-3, 12))),
        run_of(n=20_000, realizations=(0, 1, 2, 3), snapshots=(1e-4, 1e-3)),
        run_of(n=16, count=2000),
        run_of(n=50_000, dimensions=3),
        run_of(n=5000, count=100, keep_positions=True, dimensions=3),
        run_of(n=50_000, dimensions=1),
        run_of(n=20_000, sizes="bidisperse"),
        run_of(n=5000, heating=1e-9),
        run_of(n=5000, dynamics="soft_spheres", contact_time=1e-4),
        run_of(n=5000, dynamics="soft_spheres", contact_time=1e-4, dimensions=3),
        run_of(n=50_000, dynamics="dsmc"),
        run_of(n=50_000, dynamics="dsmc", dimensions=3),
    ],
    ids=[
        *("disks", "positions", "motion", "snapshots", "realizations", "samples"),
        *("spheres", "positions of spheres", "beads", "sizes", "heated"),
        *("soft disks", "soft spheres", "dsmc", "dsmc of spheres"),
    ],
)
def test_the_estimate_is_near_what_is_taken(run):
    small = replace(run, scene=replace(run.scene, n_particles=100))
    perform(small, start_states(small))  # what compilation takes is apart
    states = start_states(run)
    gc.collect()
    tracemalloc.start()
    try:
        perform(run, states)
        taken = tracemalloc.get_traced_memory()[1] + states.nbytes
    finally:
        tracemalloc.stop()
    assert 0.5 < memory_of(run) / taken < 2


@pytest.mark.parametrize("dimensions", [1, 2, 3])
def test_a_particle_of_the_engine(dimensions):
    scene = gg.Scene(n_particles=10_000, dimensions=dimensions)
    engine = Engine(scene, state_of(gg.equilibrate(scene, collisions_per_particle=1)))
    state = engine.state()
    arrays = (state.position, state.velocity, state.last_collision_time, state.last_collision_interval, state.collisions)
    assert (
        engine.bytes_per_particle
        < ENGINE[dimensions] - 2 * sum(array.nbytes for array in arrays) / 10_000
        < 1.5 * engine.bytes_per_particle
    )
    assert sum(array.nbytes for array in arrays[:4]) / 10_000 == START * (1 + dimensions)


def test_memory_at_hand_is_what_the_shell_allows(monkeypatch):
    physical = memory_at_hand()
    assert physical > 1e8
    monkeypatch.setattr(resource, "getrlimit", lambda kind: (10**8, 10**9))
    assert memory_at_hand() == 10**8

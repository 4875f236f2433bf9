"""Runs as the simulation hands them over, with random numbers in place of physics."""

import numpy as np
import pytest
import xarray as xr

from granugas.scene import Scene

SNAPSHOTS = [0.1, 0.2]


def make_run(realization=0, *, samples=4, until_collisions=False, **scene):
    """A run of few particles; other sizes and the contact times follow from the scene."""
    scene = Scene(**{"n_particles": 5, **scene})
    rng = np.random.default_rng([realization, scene.n_particles])
    n, s = scene.n_particles, samples
    elastic = ("time", "contact_time") if isinstance(scene.contact_time, tuple) else ("time",)
    shape = (s, len(scene.contact_times)) if isinstance(scene.contact_time, tuple) else (s,)
    variables = {
        "kinetic_energy": ("time", rng.random(s)),
        "elastic_collision_fraction": (elastic, rng.random(shape)),
        "position": (("snapshot", "particle", "axis"), rng.random((2, n, 2))),
        "initial_y": ("particle", rng.random(n)),
        "trajectory": (("time", "particle", "axis"), rng.random((s, n, 2))),
        "enskog_rate": rng.random(),
        "seed": 1998,
        "realization": realization,
        "events": 40 + realization,
        "wall_time": rng.random(),
        "cpu_time": rng.random(),
        "stop_reason": "time",
        "stop_time": 1.0,
    }
    times = np.linspace(0, 1, s)
    coords = {"time": times, "snapshot": SNAPSHOTS, "axis": ["x", "y"]}
    if until_collisions:
        variables["sampling_time"] = ("time", times)
        coords["time"] = np.arange(s)
    if isinstance(scene.contact_time, tuple):
        coords["contact_time"] = list(scene.contact_time)
    attributes = scene.as_dict() | {"box_x": 1.0 * n, "box_y": 1.5 * n}
    return xr.Dataset(variables, coords, attributes)


@pytest.fixture(name="make_run")
def make_run_fixture():
    """The function that makes a run."""
    return make_run

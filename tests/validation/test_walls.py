"""Walls, gravity, a floor in motion: the engine and brute force see the same collisions, in one, two and three dimensions."""

import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from gases import lattice_gas
from reference_walls import follow_between_walls

from granugas.analysis.enskog import contact_value
from granugas.dynamics.events.effects.recorder import recorder
from granugas.dynamics.events.engine import Engine
from granugas.dynamics.events.memory import COMPILED
from granugas.dynamics.state import State
from granugas.equilibrate import at_rest
from granugas.scene import Scene

STRETCH, PIECES = 25, 6
"""Collisions from one state on, which double precision holds (test_brute_force.py), and how many such stretches follow."""

FALLING = {"gravity": 50.0}
SHAKEN = {"gravity": 50.0, "floor": "harmonic", "floor_amplitude": 0.2, "floor_frequency": 4.0}
DISSIPATIVE = {"restitution": 0.8, "contact_time": 1e-3, "wall_restitution": 0.7, "wall_contact_time": 2e-3}
SCENES = {
    "walls": {"boundary": "wall"},
    "a channel": {"boundary": "periodic wall"},
    "dissipative": {"boundary": "wall", **DISSIPATIVE},
    "gravity": {"boundary": "wall", **FALLING},
    "gravity in a channel": {"boundary": "periodic wall", **FALLING, **DISSIPATIVE},
    "harmonic": {"boundary": "wall", **SHAKEN, **DISSIPATIVE},
    "gentle": {"boundary": "wall", **SHAKEN, **DISSIPATIVE, "floor_amplitude": 0.05},
    "sawtooth": {"boundary": "periodic wall", **SHAKEN, **DISSIPATIVE, "floor": "sawtooth"},
    "weightless": {"boundary": "wall", **SHAKEN, **DISSIPATIVE, "gravity": 0.0},
}


def gas_between_walls(scene: Scene, seed: int = 0) -> State:
    """Particles on a grid that keeps away from the walls, in a box as long as the volume asks for."""
    n, dimensions = scene.n_particles, scene.dimensions
    side = scene.volume ** (1 / dimensions)
    rows = math.ceil(n ** (1 / dimensions) - 1e-9)
    grid = np.stack(np.meshgrid(*[np.arange(rows)] * dimensions, indexing="ij"), axis=-1).reshape(-1, dimensions)[:n]
    velocity = np.random.default_rng(seed).normal(0.0, 5.0 * scene.diameter, (n, dimensions))
    return at_rest((grid + 0.5) * side / rows, velocity, (side,) * dimensions)


def words(boundary: str, dimensions: int) -> str:
    """The same boundary in another space: walls along the last axis, and along the others as along the first."""
    first, *rest = boundary.split()
    return " ".join([first] * (dimensions - 1) + [rest[-1] if rest else first])


COMPILED_TOO = {("dissipative", 3), ("sawtooth", 2)}
"""Each kernel takes seconds to compile; the others are compared as plain Python, which does the same (test_plain_python.py)."""


def test_all_of_them_in_plain_python():
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-q",
        "-p",
        "no:cacheprovider",
        f"{__file__}::{test_the_same_collisions.__name__}",
    ]
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1"}
    done = subprocess.run(command, capture_output=True, text=True, env=environment, cwd=Path(__file__).parents[2])
    assert done.returncode == 0, done.stdout
    assert f"{3 * len(SCENES)} passed" in done.stdout


@pytest.mark.parametrize("dimensions", [1, 2, 3])
@pytest.mark.parametrize("name", SCENES)
def test_the_same_collisions(name, dimensions):
    if COMPILED and (name, dimensions) not in COMPILED_TOO:
        pytest.skip("compared as plain Python")
    keys = {"restitution": 1.0, "contact_time": 0.0} | SCENES[name]
    keys["boundary"] = words(keys["boundary"], dimensions)
    n, fraction = {1: (6, 0.3), 2: (16, 0.2), 3: (27, 0.1)}[dimensions]
    scene = Scene(n, fraction, diameter=1.0, dimensions=dimensions, lattice="auto", **keys)
    state = gas_between_walls(scene)
    hits = 0
    for _ in range(PIECES):
        engine = Engine(scene, state, watch=recorder(STRETCH))
        engine.advance(math.inf)
        seen = engine.watch.seen.rows
        expected = follow_between_walls(state, scene, STRETCH)
        np.testing.assert_array_equal(np.stack([seen["i"], seen["j"]], axis=1), expected.who)
        np.testing.assert_allclose(seen["time"] + (engine.arrays["calendar"]["base"][0] - state.time), expected.time, atol=1e-9)
        state = engine.state()
        np.testing.assert_allclose(state.velocity, expected.velocity, atol=1e-6)
        assert engine.backwards == 0
        hits += np.count_nonzero(seen["i"] < 0)
    assert hits > STRETCH


def test_the_pressure_on_walls_is_that_of_the_bulk_between_them():
    """A Eqs. 16 and 17 at the density away from the walls, which is larger than that of the box: centres keep off the walls."""
    scene = Scene(200, 0.3, restitution=1.0, contact_time=0.0, boundary="periodic wall", aspect_ratio=0.5)
    engine = Engine(scene, lattice_gas(scene))
    engine.advance(0.2)
    engine.take_tally()
    begun, height, inside = engine.time, engine.state().box[1], []
    for _ in range(1500):
        engine.advance(engine.time + 0.002)
        y = engine.state().position[:, 1]
        inside.append(np.mean((y > 0.25 * height) & (y < 0.75 * height)) * 2)
    state, tally = engine.state(), engine.take_tally()
    interval, energy = engine.time - begun, np.sum(state.velocity**2) / 2
    pressure = engine.observe(state, tally, interval)["wall_pressure"]
    density = np.mean(inside)
    assert pressure / density == pytest.approx(1 + 2 * 0.3 * density * contact_value(0.3 * density), rel=0.01)
    assert density > 1.01
    virial = 1 - np.trace(tally.stress) / (2 * energy * interval)  # with the contacts at the walls (A Eq. 15)
    assert virial == pytest.approx(pressure, rel=3 / np.sqrt(tally.more["wall_hits"]))
    assert energy == pytest.approx(200 * 0.25 / 3, rel=1e-10)

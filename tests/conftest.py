"""Gases to start from."""

import math
import signal
from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from granugas.dynamics.events.engine import Engine
from granugas.dynamics.state import State
from granugas.equilibrate import at_rest, on_lattice
from granugas.initial import random_stream, start_lattice, start_velocities
from granugas.scene import Scene

TILTED = {2: 1, 3: 1, 5: 2}
"""Few disks start at (k, m k)/N of the box (spheres: and m^2 k), where they have more room than in rows: m for each N."""


def pytest_sessionstart() -> None:
    """Shells let what they start in the background ignore Ctrl-C, which some tests send."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session")
def start_of() -> Callable[..., State]:
    """The function that gives a scene's disks after 40 elastic collisions each; the same for all r and t_c."""

    def start(scene: Scene, realization: int = 0) -> State:
        return _after_elastic_collisions(replace(scene, restitution=1.0, contact_time=0.0), realization)

    return start


@cache
def _after_elastic_collisions(scene: Scene, realization: int) -> State:
    rng, n = random_stream(scene, 0, realization), scene.n_particles
    if n in TILTED:
        box = (scene.volume ** (1 / scene.dimensions),) * scene.dimensions
        position = np.outer(np.arange(n), TILTED[n] ** np.arange(scene.dimensions)) % n * box[0] / n
        start = at_rest(position, start_velocities(scene, rng), box)
    else:
        start = on_lattice(scene, start_lattice(scene), rng)
    engine = Engine(scene, start)
    engine.advance(math.inf, 20 * n)
    return engine.state()

"""A few disks to hand to single functions of the engine."""

from collections.abc import Callable

import numpy as np
import pytest

from granugas.dynamics.events.engine import Engine
from granugas.dynamics.events.state import Gas, bundle
from granugas.equilibrate import at_rest
from granugas.scene import Scene


@pytest.fixture
def gas_of() -> Callable[..., Gas]:
    """The function that puts disks into a box, in d and d/s, every one in its cell and with its next event planned."""
    kept = []

    def make(position, velocity, box, **effects) -> Gas:
        position, velocity = np.array(position, float), np.array(velocity, float)
        n, dimensions = position.shape
        scene = Scene(n_particles=n, diameter=1.0, restitution=1.0, contact_time=0.0, dimensions=dimensions)
        engine = Engine(scene, at_rest(position, velocity, box), **effects)
        kept.append(engine)  # its arrays are the memory of the gas
        return bundle(engine.arrays, engine.effects)

    return make

"""Start states for tests of the engine."""

from granugas.dynamics.state import State
from granugas.equilibrate import on_lattice
from granugas.initial import random_stream, start_lattice
from granugas.scene import Scene


def lattice_gas(scene: Scene, seed: int = 0) -> State:
    """Disks on their lattice with uniform velocities, before any collision."""
    return on_lattice(scene, start_lattice(scene), random_stream(scene, seed, 0))

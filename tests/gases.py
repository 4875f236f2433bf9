"""Start states for tests of the engine."""

from granugas.dynamics.state import State
from granugas.equilibrate import at_rest
from granugas.initial import random_stream, sites, start_lattice, start_velocities
from granugas.scene import Scene


def lattice_gas(scene: Scene, seed: int = 0) -> State:
    """Disks on their lattice with uniform velocities, before any collision."""
    rng = random_stream(scene, seed, 0)
    lattice = start_lattice(scene)
    return at_rest(sites(lattice, scene.n_particles, rng), start_velocities(scene, rng), lattice.box)

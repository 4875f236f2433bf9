"""Compile ahead of time what the runs of a configuration will need."""

from collections.abc import Iterable
from dataclasses import replace

from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import at_rest
from granugas.initial import random_stream, sites, start_lattice, start_velocities
from granugas.scene import Scene


def warm_up(scenes: Iterable[Scene] = (Scene(),)) -> None:
    """Fill the cache with the kernels of these scenes and of their equilibration, on a few disks each.

    Processes that start at the same time on a cold cache would all compile the same.
    """
    for scene in scenes:
        small = replace(scene, n_particles=16, area_fraction=0.2, lattice="auto", aspect_ratio=1.0)
        for needed in (small, small.at_start()):
            rng = random_stream(needed, 0, 0)
            lattice = start_lattice(needed)
            Engine(needed, at_rest(sites(lattice, 16, rng), start_velocities(needed, rng), lattice.box)).advance(1.0, 32)

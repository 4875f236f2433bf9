"""Compile ahead of time what the runs of a configuration will need."""

from collections.abc import Iterable
from dataclasses import replace

from granugas.dynamics import engine_of
from granugas.equilibrate import engine_at_start, on_lattice
from granugas.initial import random_stream, start_lattice
from granugas.scene import Scene


def warm_up(scenes: Iterable[Scene] = (Scene(),)) -> None:
    """Fill the cache with the kernels of these scenes and of their equilibration, on a few disks each.

    Processes that start at the same time on a cold cache would all compile the same.
    """
    for scene in scenes:
        small = replace(scene, n_particles=16, area_fraction=0.01, lattice="auto", aspect_ratio=1.0)
        lattice = start_lattice(small)
        start = on_lattice(small, lattice, random_stream(small, 0, 0))
        for engine in (engine_of(small, start), engine_at_start(small, start, lattice)):
            engine.advance(1.0, 32, 2000)

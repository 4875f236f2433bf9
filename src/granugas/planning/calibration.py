"""How fast this machine is: a few seconds of measurement, kept beside the compiled kernels that it is true for."""

import json
import math
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time
from dataclasses import asdict, dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from granugas.digest import kernel_cache_directory
from granugas.scene import Scene
from granugas.storage.files import replacing

if TYPE_CHECKING:
    from granugas.dynamics import Dynamics

SIZES = (500, 5740, 79524)
"""Numbers of particles whose collisions are timed."""

MELTING, TIMED, ROUNDS = 10, 150_000, 3
"""Collisions per particle before anything is timed; collisions in each of so many rounds."""

REFERENCE = 365.0
"""ns per collision at N = 5740 of the machine on which all other costs of plan.py were measured."""

JOB = """
import sys
from granugas.jobs import logged
with logged(sys.argv[2]):
    from granugas import Scene, simulate
    from granugas.storage.dataset import write
    scene = Scene(n_particles=16, restitution=1.0, contact_time=0.0)
    write(simulate(scene, {"collisions_per_particle": 1.0}, progress=False), sys.argv[1])
"""
"""What every job does beside its work: programs and kernels are loaded, a dataset is written."""


@dataclass(frozen=True)
class Calibration:
    """Processor times of a machine.

    Attributes:
        sizes, ns_per_collision: of elastic disks, area fraction .25.
        start_seconds: of a job beside its work.
        sample_seconds: of a sample without particles, and ...
        sample_seconds_per_particle: ... for each particle.
    """

    sizes: tuple[int, ...]
    ns_per_collision: tuple[float, ...]
    start_seconds: float
    sample_seconds: float
    sample_seconds_per_particle: float

    def collision(self, n: float) -> float:
        """ns per collision of N elastic disks: between the sizes linear in ln N, beyond the largest as before it."""
        x, y = np.log(self.sizes), np.array(self.ns_per_collision)
        beyond = max(math.log(n) - x[-1], 0.0) * (y[-1] - y[-2]) / (x[-1] - x[-2])
        return float(np.interp(math.log(n), x, y) + beyond)

    @cached_property
    def slowness(self) -> float:
        """Times of this machine by those of the one that plan.py's other costs were measured on."""
        return self.collision(SIZES[1]) / REFERENCE


REFERENCE_MACHINE = Calibration(SIZES, (340.0, REFERENCE, 540.0), 0.7, 4e-5, 2e-7)
"""The one of REFERENCE, for those who plan for machines on which nothing can be measured."""


def calibration() -> Calibration:
    """The one of this machine and these sources, from before or measured now."""
    path = kernel_cache_directory() / f"calibration-{platform.node()}-{os.cpu_count()}.json"
    if (kept := _kept(path)) is None:
        kept = measure()
        with replacing(path) as temporary:
            temporary.write_text(json.dumps(asdict(kept)))
    return kept


def measure(sizes: tuple[int, ...] = SIZES, timed: int = TIMED) -> Calibration:
    """Time elastic disks of these sizes, samples of the first and the last, and a job beside its work (the best of three)."""
    gases = [_melted(Scene(n_particles=n, area_fraction=0.25, restitution=1.0, contact_time=0.0)) for n in sizes]
    costs = [statistics.median(_collisions(engine, timed) for _ in range(ROUNDS)) for engine, _ in gases]
    few, many = (_sample(*gas) for gas in (gases[0], gases[-1]))
    each = max((many - few) / (sizes[-1] - sizes[0]), 0.0)
    return Calibration(tuple(sizes), tuple(costs), min(_start() for _ in range(3)), max(few - each * sizes[0], 0.0), each)


def _melted(scene: Scene) -> tuple["Dynamics", Scene]:
    """An engine whose disks have collided some times, and its scene."""
    from granugas.dynamics import engine_of
    from granugas.equilibrate import on_lattice
    from granugas.initial import random_stream, start_lattice

    engine = engine_of(scene, on_lattice(scene, start_lattice(scene), random_stream(scene, 0, 0)))
    engine.advance(math.inf, MELTING * scene.n_particles // 2)
    return engine, scene


def _collisions(engine: "Dynamics", number: int) -> float:
    """ns for each of so many."""
    done, begun = engine.collisions, time.process_time()
    engine.advance(math.inf, number)
    return (time.process_time() - begun) / (engine.collisions - done) * 1e9


def _sample(engine: "Dynamics", scene: Scene, number: int = 5) -> float:
    """Seconds of a sample: what a run asks its dynamics for, and writes down."""
    from granugas.record import Record
    from granugas.sampling import Limits, sampling_points

    points = sampling_points(Limits.of({"collisions_per_particle": 1.0}), {"count": number, "first": 0.1})
    record = Record(scene, engine.state(), points, (), keep_positions=False)
    begun = time.process_time()
    for _ in range(number):
        state, tally = engine.state(), engine.take_tally()
        record.sample(state, tally, engine.observe(state, tally, 1.0))
    return (time.process_time() - begun) / number


def _start() -> float:
    """Seconds of a job with next to no work."""
    before = sum(os.times()[2:4])
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-c", JOB, f"{folder}/run.nc", f"{folder}/log"], check=True, capture_output=True)
    return sum(os.times()[2:4]) - before


def _kept(path: Path) -> Calibration | None:
    try:
        values = json.loads(path.read_text())
        read: dict[str, Any] = {key: tuple(value) if isinstance(value, list) else value for key, value in values.items()}
        return Calibration(**read)
    except (OSError, ValueError, TypeError, AttributeError):
        return None

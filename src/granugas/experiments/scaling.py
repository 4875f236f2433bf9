"""What the cost of a collision depends on: number of disks, area fraction, clusters, contact duration."""

import math
import time
from typing import NamedTuple

import numpy as np
import xarray as xr

from granugas.analysis.clusters import find_clusters
from granugas.benchmark import time_collisions
from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import equilibrate, state_of
from granugas.scene import Scene

ALONE = ("the time of a collision",)

ELASTIC = {"restitution": 1.0, "contact_time": 0.0}
AREA_FRACTION = 0.25
"""Of gases of different sizes."""

SIZE = 5740
"""Of gases of different area fractions and contact durations."""

PAPER_B = {"area_fraction": 0.2498, "restitution": 0.8, "contact_time": 1e-5, "diameter": 2e-3, "lattice": "square"}
DISTANCE_FACTOR = 1.1


class Plan(NamedTuple):
    """What is timed.

    Attributes:
        sizes: numbers of disks, elastic.
        area_fractions: of elastic disks.
        contact_times: of gases with r = .4, to `until` (s).
        until: see there.
        clustering: number of disks of paper B's large system, and the times (s) up to which it is followed.
        collisions: that are timed in each elastic gas.
    """

    sizes: tuple[int, ...]
    area_fractions: tuple[float, ...]
    contact_times: tuple[float, ...]
    until: float
    clustering: tuple[int, tuple[float, ...]]
    collisions: int


FULL = Plan(
    sizes=(42, 100, 378, 1435, 5740, 22960, 79524, 300_000, 1_000_000),
    area_fractions=(0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8),
    contact_times=(1e-12, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2),
    until=5.0,
    clustering=(79524, tuple(float(t) for t in np.geomspace(0.01, 100.0, 25))),
    collisions=1_000_000,
)
SMALL = Plan((42, 378), (0.1, 0.3), (1e-5, 1e-3), 0.5, (784, (0.1, 1.0, 3.0)), 20_000)


def measure(plan: Plan = FULL) -> xr.Dataset:
    """Processor time of a collision of pairs, with all other events, compilation apart.

    Returns:
        Dataset of times in ns: cpu_by_size and cpu_by_area_fraction over statistic too (of five rounds); cpu_by_contact_time,
        and run_collisions, C/N at the end of those runs; cpu_while_clustering over time (s), from the time before to this one,
        with mean_cluster_size and collisions_per_particle then.
    """
    n, times = plan.clustering
    by_contact_time = [whole_run(Scene(SIZE, contact_time=t_c), plan.until) for t_c in plan.contact_times]
    clustering = follow(Scene(n, **PAPER_B), times)
    return xr.Dataset(
        {
            "cpu_by_size": (
                ("n_particles", "statistic"),
                [timed(Scene(n, AREA_FRACTION, **ELASTIC), plan.collisions) for n in plan.sizes],
            ),
            "cpu_by_area_fraction": (
                ("area_fraction", "statistic"),
                [timed(Scene(SIZE, nu, **ELASTIC), plan.collisions) for nu in plan.area_fractions],
            ),
            **_columns(("cpu_by_contact_time", "run_collisions"), "contact_time", by_contact_time),
            **_columns(("cpu_while_clustering", "mean_cluster_size", "collisions_per_particle"), "time", clustering),
        },
        {
            "n_particles": list(plan.sizes),
            "area_fraction": list(plan.area_fractions),
            "contact_time": list(plan.contact_times),
            "time": list(times),
            "statistic": ["median", "fastest", "slowest"],
        },
        {"clustering_n": n, "distance_factor": DISTANCE_FACTOR},
    )


def _columns(names: tuple[str, ...], along: str, rows: list[tuple[float, ...]]) -> dict[str, tuple[str, list[float]]]:
    return {name: (along, list(column)) for name, column in zip(names, zip(*rows, strict=True), strict=True)}


def timed(scene: Scene, collisions: int) -> tuple[float, float, float]:
    """Median, fastest and slowest round (ns)."""
    timing = time_collisions(scene, max(collisions, scene.n_particles), equilibration=10.0)
    return timing.ns_per_collision, timing.fastest, timing.slowest


def begun(scene: Scene) -> Engine:
    """An engine in equilibrium whose kernel is there."""
    state = state_of(equilibrate(scene, seed=1, collisions_per_particle=30.0))
    Engine(scene, state).advance(math.inf, 1)
    return Engine(scene, state)


def whole_run(scene: Scene, until: float) -> tuple[float, float]:
    """ns per collision from t = 0 to `until` (s), and C/N then."""
    engine = begun(scene)
    clock = time.process_time()
    engine.advance(until)
    spent = time.process_time() - clock
    return spent / engine.collisions * 1e9, 2 * engine.collisions / scene.n_particles


def follow(scene: Scene, times: tuple[float, ...]) -> list[tuple[float, float, float]]:
    """For each time (s): ns per collision since the one before, <M> and C/N then."""
    engine, rows = begun(scene), []
    for until in times:
        done, clock = engine.collisions, time.process_time()
        engine.advance(until)
        spent = time.process_time() - clock
        state = engine.state()
        clusters = find_clusters(state.position, state.box, scene.diameter, [DISTANCE_FACTOR])
        cost = spent / (engine.collisions - done) * 1e9
        rows.append((cost, float(clusters.mean_sizes[0]), 2 * engine.collisions / scene.n_particles))
    return rows

"""`make bench`: what a collision costs, and what else a user waits for. Prints a table; writes bench.csv and bench.png.

Run it on an idle machine: medians of five rounds in one process, processor time, compilation apart.
"""

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
import pandas as pd
from matplotlib import style
from matplotlib.figure import Figure
from numba import njit

from granugas.analysis.clusters import find_clusters
from granugas.benchmark import Timing, always_contact_time, time_collisions, time_span
from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import equilibrate, state_of
from granugas.plotting.style import COLUMN, STYLE, save
from granugas.scene import Scene
from granugas.storage.files import replacing

ELASTIC = {"restitution": 1.0, "contact_time": 0.0}
PAPER_B = {"n_particles": 79524, "area_fraction": 0.2498, "restitution": 0.8, "contact_time": 1e-5, "diameter": 2e-3}
SIZES = (42, 100, 378, 1435, 5740, 22960, 79524, 300_000, 1_000_000)
FACTORS = (1.05, 1.1, 1.2, 1.3, 1.4)
ROUNDS = 5


def main(output: str = "results") -> None:
    """Measure everything, say each result at once."""
    rows = []
    for row in measurements():
        rows.append(row)
        print(f"{row['what']:58s} {row['value']:10.4g} {row['unit']:6s} (bar {row['bar']:g})", flush=True)
    table = pd.DataFrame(rows)
    folder = Path(output)
    folder.mkdir(parents=True, exist_ok=True)
    with replacing(folder / "bench.csv") as path:
        table.to_csv(path, index=False)
    draw(table, folder)


def measurements() -> Iterator[dict[str, Any]]:
    """One row a figure: what, value, unit, bar (nan: none), and the fastest and slowest round."""
    yield {"what": "this machine: a random read of 10 MB", "value": random_read(10e6), "unit": "ns", "bar": float("nan")}
    for n, nu, bar in ((5740, 0.25, 470), (79524, 0.25, 680), (1_000_000, 0.25, 1400), (5740, 0.70, 390)):
        scene = Scene(n_particles=n, area_fraction=nu, **ELASTIC)
        timing = time_collisions(scene, max(2_000_000, n))
        yield cost(f"N = {n}, area fraction {nu:.2f}, elastic", timing, bar)
    yield {"what": "memory at N = 1e6", "value": memory(1_000_000), "unit": "B", "bar": 160}
    yield cost("N = 79524, r = .8, t_c = 1e-5 s, t = 0 to 10 s", time_span(Scene(**PAPER_B), 10.0), 700)
    clustered = Scene(n_particles=5740, area_fraction=0.226725, restitution=0.4, contact_time=1e-12, lattice="triangular")
    yield cost("N = 5740, r = .4, t_c = 1e-12 s, t = 0 to 5 s", time_span(clustered, 5.0), 350)
    yield rule_cost()
    big = time_span(Scene(**PAPER_B), 446.6)
    seconds_in_all = big.ns_per_collision * big.collisions / 1e9
    yield {"what": "N = 79524, r = .8 to 446.6 s", "value": seconds_in_all, "unit": "s", "bar": 240}
    yield {"what": "five S_c, N = 79524", "value": sweep_time() * 1e3, "unit": "ms", "bar": 30}
    yield from start_up()
    for n in SIZES:
        timing = time_collisions(Scene(n_particles=n, area_fraction=0.25, **ELASTIC), max(500_000, n // 2))
        yield cost(f"size N = {n}", timing, float("nan"))


def cost(what: str, timing: Timing, bar: float) -> dict[str, Any]:
    """A row in ns per collision."""
    spread = {"fastest": timing.fastest, "slowest": timing.slowest, "collisions": timing.collisions}
    return {"what": what, "value": timing.ns_per_collision, "unit": "ns", "bar": bar, **spread}


def random_read(size: float) -> float:
    """Nanoseconds of one read that waits for the one before: what a large system's cost depends on beside the code."""
    lines = int(size / 64)
    order = np.random.default_rng(1).permutation(lines)
    table = np.zeros((lines, 8), np.int64)
    table[order, 0] = np.roll(order, -1)
    _follow(table, 10)
    return median(seconds(partial(_follow, table, 10 * lines)) for _ in range(ROUNDS)) / (10 * lines) * 1e9


@njit
def _follow(table: np.ndarray, steps: int) -> int:
    row = 0
    for _ in range(steps):
        row = table[row, 0]
    return row


def memory(n: int) -> float:
    """Bytes a particle of the engine's arrays."""
    return time_collisions(Scene(n_particles=n, area_fraction=0.25, **ELASTIC), 5, equilibration=1.0).bytes_per_particle


def rule_cost() -> dict[str, Any]:
    """The TC rule where it changes nothing (r = 1, t_c = 0) against the kernel without it, in alternating rounds."""
    scene = Scene(area_fraction=0.25, **ELASTIC)
    start = state_of(equilibrate(scene))
    engines = [Engine(scene, start), Engine(scene, start, rule=always_contact_time(scene))]
    times: list[list[float]] = [[], []]
    for _ in range(4 * ROUNDS):
        for engine, spent in zip(engines, times, strict=True):
            begin = time.process_time()
            engine.advance(float("inf"), 100_000)
            spent.append(time.process_time() - begin)
    ratios = [with_rule / without for without, with_rule in zip(*times, strict=True)]
    return {"what": "cost of the TC rule", "value": 100 * (median(ratios) - 1), "unit": "%", "bar": 3}


def sweep_time() -> float:
    """Seconds for the clusters of one configuration at five S_c."""
    scene = Scene(n_particles=79524, area_fraction=0.2498, **ELASTIC)
    state = state_of(equilibrate(scene, collisions_per_particle=5))
    search = partial(find_clusters, state.position, state.box, scene.diameter, FACTORS)
    search()
    return median(seconds(search) for _ in range(ROUNDS))


def start_up() -> Iterator[dict[str, Any]]:
    """Compilation after installation, and what a later process waits for."""
    call = [sys.executable, "-c", "import granugas; granugas.warm_up()"]
    with tempfile.TemporaryDirectory() as cold:
        run = partial(subprocess.run, call, check=True, env=os.environ | {"NUMBA_CACHE_DIR": cold, "XDG_CACHE_HOME": cold})
        yield {"what": "first start, all compiled", "value": seconds(run), "unit": "s", "bar": 15}
        later = median(seconds(run) for _ in range(ROUNDS))
        yield {"what": "later starts, from the cache", "value": later, "unit": "s", "bar": 1.5}


def seconds(work: Callable[[], Any]) -> float:
    """Wall time of one call."""
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def draw(table: pd.DataFrame, folder: Path) -> None:
    """The cost per collision against N."""
    sizes = table[table["what"].str.startswith("size N = ")]
    n = sizes["what"].str.removeprefix("size N = ").astype(int)
    spread = np.abs(sizes[["fastest", "slowest"]].to_numpy().T - sizes["value"].to_numpy())
    with style.context(STYLE):
        figure = Figure(figsize=(COLUMN, 0.75 * COLUMN))
        axes = figure.subplots()
        axes.errorbar(n, sizes["value"], yerr=spread, marker="o", capsize=2)
        axes.set(xscale="log", xlabel="number of disks $N$", ylabel="time per collision (ns)", ylim=(0, None))
        save(figure, folder / "bench.png", folder / "bench.pdf")


if __name__ == "__main__":
    main(*sys.argv[1:])

"""What a study would take on a cluster, on paper: what goes alone and what together, on so many cores (docs/howto/cluster.md).

    python benchmarks/on_paper.py phase_diagram --configfile phase.yaml --cores 500

Times are those that jobs ask a batch system for, without their margin (granugas.planning.batch).
"""

import argparse
import heapq
from collections import defaultdict
from pathlib import Path

import yaml

from granugas import studies
from granugas.configuration import merged
from granugas.planning import batch
from granugas.planning.expected import end_of
from granugas.resources import memory_of
from granugas.runs import Run

ROOT = Path(__file__).parents[1]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("study")
    parser.add_argument("--configfile", nargs="+", default=[])
    parser.add_argument("--cores", type=int, default=500)
    options = parser.parse_args()
    schema = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text())
    study = studies.load(merged([ROOT / "config/config.yaml", *options.configfile]), schema).studies[options.study]
    states = [batch.of_states(run) for run in {run.state_address: run for run in study.runs}.values()]
    runs = [batch.of_run(run) for run in study.runs]
    largest = max(map(memory_of, study.runs))
    alone, bundles = bundled("runs", runs)
    print(f"collisions: {sum(map(collisions, study.runs)):.2g}; processor time: {hours(runs)}")
    print(f"runs alone: {len(alone)}, {hours(alone)}; the longest: {max(runs) / 3600:.2f} h")
    print(f"shorter ones: {len(runs) - len(alone)} in {len(bundles)} bundles, {hours(bundles)}")
    print(f"start states: {len(states)} in {sum(map(len, bundled('states', states)))} jobs, {hours(states)}")
    time = makespan([*alone, *bundles], options.cores)
    print(f"{options.cores} cores: {time / 3600:.2f} h; evenly {sum(runs) / options.cores / 3600:.2f} h")
    print(f"largest job: {largest / 1e6:.0f} MB, asked for {batch.megabytes(largest) / 1e3:.1f} GB")
    print(f"pooling: {batch.of_pool(study.runs) / 60:.1f} min, {batch.pooled_size(study.runs) / 1e9:.1f} GB")


def bundled(kind: str, seconds: list[float]) -> tuple[list[float], list[float]]:
    """Times of the jobs that go alone, and of bundles as large as profiles/slurm says."""
    profile = yaml.safe_load((ROOT / "profiles/slurm/config.yaml").read_text())
    sizes = dict(item.split("=") for item in profile["group-components"])
    alone, short = [], defaultdict(list)
    for time in seconds:
        name = batch.kind(time)
        (alone if name is None else short[name]).append(time)
    chunks = ((times, int(sizes[f"{kind}_{name}"])) for name, times in short.items())
    return alone, [sum(times[k : k + size]) for times, size in chunks for k in range(0, len(times), size)]


def makespan(seconds: list[float], cores: int) -> float:
    """Until the last of the jobs has ended, the longest begun first."""
    free = [0.0] * cores
    for time in sorted(seconds, reverse=True):
        heapq.heappush(free, heapq.heappop(free) + time)
    return max(free)


def collisions(run: Run) -> float:
    """Expected of a job."""
    return end_of(run.scene, run.until).collisions * run.scene.n_particles / 2 * len(run.realizations)


def hours(seconds: list[float]) -> str:
    return f"{sum(seconds) / 3600:.1f} h"


if __name__ == "__main__":
    main()

"""What jobs ask of a batch system: memory, time, and which of them are too short to go alone.

Expected times are those of plan.py on its own machine: a login node says nothing of the nodes, and nothing is measured here.
"""

import math
from collections.abc import Sequence
from functools import cache
from typing import TYPE_CHECKING

from granugas.runs import Run
from granugas.scene import Scene

if TYPE_CHECKING:
    from granugas.planning.calibration import Calibration
    from granugas.planning.expected import End

SAFETY = 3.0
"""Time asked for by time expected: nodes are slower and full, and runs collide up to 1.5 times as often as expected."""

BEFORE = 60.0
"""s asked for besides: Snakemake starts three times, and a node of another kind compiles its kernels first."""

MEMORY_SAFETY = 1.5
"""Memory asked for by memory of a run (resources.py)."""

PROGRAMS = 1.5e9
"""Bytes asked for besides: Snakemake three times, with 10^4 runs in its configuration, and what a job loads."""

POOLED = 3
"""How many times a pooled dataset is in memory: as parts, as a whole, with its errors."""

SHORT = {"under_5_s": 5.0, "under_15_s": 15.0, "under_60_s": 60.0}
"""Kinds of short jobs, by the expected s that they stay under; the profile says how many of a kind go together."""


def minutes(seconds: float, attempt: int = 1) -> int:
    """Time to ask for, where a job is expected to take so many s; as much again with each further attempt."""
    return attempt * math.ceil((BEFORE + SAFETY * seconds) / 60)


def megabytes(size: float, attempt: int = 1) -> int:
    """Memory to ask for, where data take so many bytes; as much again with each further attempt."""
    return attempt * math.ceil((PROGRAMS + MEMORY_SAFETY * size) / 1e6)


def kind(seconds: float) -> str | None:
    """Of a short job that is expected to take so many s; None: it is long enough to go alone."""
    return next((name for name, limit in SHORT.items() if seconds < limit), None)


# Expected s of each job. What is imported inside loads more than the start of every job should wait for.


def of_states(run: Run) -> float:
    """Of the start states of a run."""
    from granugas.planning.plan import equilibration_seconds

    return equilibration_seconds(run, _machine())


def of_run(run: Run) -> float:
    """Of a run."""
    from granugas.planning.plan import run_seconds

    return run_seconds(run, _end(run.scene, tuple(run.until.items())), _machine())


def of_clusters(run: Run, distance_factors: Sequence[float]) -> float:
    """Of the cluster analysis of a run."""
    from granugas.planning.plan import analysis_seconds

    return analysis_seconds(run, len(distance_factors), _machine())


def of_pool(runs: Sequence[Run]) -> float:
    """Of pooling a study."""
    from granugas.planning.plan import pooling_seconds

    return pooling_seconds(len(runs), _machine())


def pooled_size(runs: Sequence[Run]) -> float:
    """Bytes in memory while a study is pooled."""
    from granugas.planning.plan import dataset_bytes

    return POOLED * sum(map(dataset_bytes, runs))


def _machine() -> "Calibration":
    from granugas.planning.calibration import REFERENCE_MACHINE

    return REFERENCE_MACHINE


@cache
def _end(scene: Scene, until: tuple[tuple[str, float], ...]) -> "End":
    """The end of runs of a scene: their realizations share it."""
    from granugas.planning.expected import end_of

    return end_of(scene, dict(until))

"""Studies: grids of runs as a configuration describes them.

Pure data and light: nothing here simulates, reads results or knows of the workflow.
"""

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import PurePath
from typing import Any

from granugas.configuration import MISSING, ConfigError, Written, check_structure, unknown, with_defaults
from granugas.grid import ascending, distinct, number_of_runs, rounded, scenes
from granugas.resources import memory_at_hand, memory_of
from granugas.runs import Run, digest_of

MOST_RUNS = 10_000
"""Runs of a configuration that does not say `allow_large: true`; realizations of one job are so many runs."""


@dataclass(frozen=True)
class Keeping:
    """What no result depends on, as long as a run comes to its end.

    Attributes:
        checkpoint_seconds: wall time between two checkpoints of a run.
        max_seconds: wall time after which a run stops with what it has; its checkpoint stays.
    """

    checkpoint_seconds: float
    max_seconds: float


@dataclass(frozen=True)
class Study:
    """A grid of runs.

    Attributes:
        name: of the study and its dataset.
        grid_keys: the keys that the study's grid names, the dimensions of its dataset.
        runs: each once, the realizations of a point one after the other.
        distance_factors: S_c of its cluster analysis, ascending; empty for none.
        keeping: how its runs are carried out.
    """

    name: str
    grid_keys: tuple[str, ...]
    runs: tuple[Run, ...]
    distance_factors: tuple[float, ...]
    keeping: Keeping

    def clusters(self) -> dict[str, Run]:
        """The runs by the addresses of their cluster analyses, which name the S_c too."""
        if not self.distance_factors:
            return {}
        suffix = f"sc{len(self.distance_factors)}_{digest_of(self.distance_factors)}"
        return {f"{run.address}_{suffix}": run for run in self.runs}


@dataclass(frozen=True)
class Animation:
    """A film of the first realization of a study.

    Attributes:
        run: which keeps positions and motion at its sampling times, the frames.
        colour: what the colours of the disks mean.
    """

    run: Run
    colour: str


@dataclass(frozen=True)
class Studies:
    """Everything that a configuration asks for.

    Attributes:
        output: folder of the results.
        studies: by name.
        figures: the figures that can be built and the studies that each needs, overviews included.
        wanted: names of those that the configuration asks for.
        left_out: figures that `all` cannot build, with the studies that are missing.
        all_wanted: whether the configuration asks for all there is.
        animations: by name.
        small_experiments: whether experiments take their small plan, where they have one.
    """

    output: str
    studies: Mapping[str, Study]
    figures: Mapping[str, tuple[str, ...]]
    wanted: tuple[str, ...]
    left_out: Mapping[str, tuple[str, ...]]
    all_wanted: bool
    animations: Mapping[str, Animation]
    small_experiments: bool = False

    def possible(self, products: Mapping[str, tuple[str, ...]]) -> dict[str, tuple[str, ...]]:
        """Those products (tables, claims) whose studies are all configured."""
        return {name: needs for name, needs in products.items() if not self.missing(needs)}

    def missing(self, needs: tuple[str, ...]) -> tuple[str, ...]:
        """Those of the named studies that are not configured."""
        return _missing(needs, self.studies)

    def runs(self) -> dict[str, Run]:
        """Every run by its address; runs that studies share stand here once."""
        return {run.address: run for study in self.studies.values() for run in study.runs}

    def states(self) -> dict[str, Run]:
        """For every start state one of the runs that begin with it."""
        return {run.state_address: run for run in self.runs().values()}

    def first_to_ask(self) -> dict[tuple[str, str], str]:
        """The study that is the first to ask for a job's work, by the names of its rule (see cost.py) and of its product."""
        asked: dict[tuple[str, str], str] = {}
        for name, study in self.studies.items():
            asked.setdefault(("pool", name), name)
            for run in study.runs:
                asked.setdefault(("simulate", run.address), name)
                asked.setdefault(("equilibrate", run.state_address), name)
            for address in study.clusters():
                asked.setdefault(("clusters", address), name)
        return asked

    def names(self) -> dict[str, set[str]]:
        """For each folder of the results the names of the runs' files in it, without suffix."""
        runs = self.runs()
        return {
            "runs": {*runs},
            "states": {*self.states()},
            "positions": {address for address, run in runs.items() if run.keep_positions},
            "clusters": {*self.clusters()},
            "checkpoints": {f"{address}_{k}" for address, run in runs.items() for k in run.realizations},
        }

    def keeping(self) -> dict[str, Keeping]:
        """How each run is carried out, by its address; of studies that share one, the last says so."""
        return {run.address: study.keeping for study in self.studies.values() for run in study.runs}

    def clusters(self) -> dict[str, tuple[Run, tuple[float, ...]]]:
        """Every cluster analysis by its address: the run and its S_c."""
        return {
            address: (run, study.distance_factors)
            for study in self.studies.values()
            for address, run in study.clusters().items()
        }


def load(config: Mapping[str, Any], schema: Mapping[str, Any], figures: Mapping[str, tuple[str, ...]] | None = None) -> Studies:
    """Check a configuration and expand it.

    Args:
        config: as the YAML files give it.
        schema: of its structure.
        figures: the figures that there are and the studies that each needs, see `declared.studies_in`.

    Raises:
        ConfigError: the first mistake, one line that names key, value and what is allowed.
    """
    check_structure(config, schema)
    whole = with_defaults(config, schema)
    piece = schema["$defs"]["study"]
    scripts = {name: with_defaults(block, schema["$defs"]["animation"]) for name, block in whole["animations"].items()}
    filmed = {block["study"] for block in scripts.values()}
    if not whole["allow_large"]:
        _refuse_too_many(whole["studies"], piece)
    studies = {
        name: _study(name, with_defaults(block, piece), whole["seed"], name in filmed)
        for name, block in whole["studies"].items()
    }
    animations = {name: _animation(f"animations.{name}", block, studies) for name, block in scripts.items()}
    figures = figures or {}
    overviews = {f"study_{name}": (name,) for name in studies}
    left_out = {name: missing for name, needs in figures.items() if (missing := _missing(needs, studies))}
    possible = {name: needs for name, needs in figures.items() if name not in left_out}
    everything = whole["figures"] == "all"
    if everything:
        used = set(itertools.chain(*possible.values()))
        wanted = (*possible, *(name for name, (study,) in overviews.items() if study not in used))
    else:
        wanted = _asked_for(whole["figures"], possible | overviews, left_out)
        left_out = {}
    output = str(PurePath(whole["output"]))
    small = whole["small_experiments"]
    return Studies(output, studies, possible | overviews, wanted, left_out, everything, animations, small)


def _missing(needs: Sequence[str], studies: Mapping[str, Study]) -> tuple[str, ...]:
    return tuple(name for name in needs if name not in studies)


def _animation(where: str, block: Mapping[str, Any], studies: Mapping[str, Study]) -> Animation:
    study = block["study"]
    if study not in studies:
        raise unknown(f"{where}.study", study, study, studies, kind="study")
    first, *others = studies[study].runs
    if len(first.realizations) > 1 or any(run.scene != first.scene for run in others):
        allowed = "allowed is a study with one point in its grid and one realization a job"
        raise ConfigError(f"{where}.study", study, allowed)
    if first.scene.dimensions != 2:
        raise ConfigError(f"{where}.study", study, "allowed is a study in two dimensions: a film shows disks in a plane")
    return Animation(first, block["colour"])


def _study(name: str, block: Mapping[str, Any], seed: int, filmed: bool) -> Study:
    """A study; where it is filmed, the first realization keeps what the animation shows."""
    where = f"studies.{name}"
    for key in block["scene"]:
        if key in block["grid"]:
            raise ConfigError(f"{where}.scene.{key}", block["scene"][key], f"allowed once, {where}.grid names it too")
    until = {key: rounded(value) for key, value in block["until"].items()}
    snapshots = ascending(f"{where}.snapshots", block.get("snapshots", ()))
    if "time" in until and snapshots and snapshots[-1] > until["time"]:
        allowed = f"allowed are times from 0 to {until['time']:g} s (until.time)"
        raise ConfigError(f"{where}.snapshots", snapshots[-1], allowed)
    factors = ascending(f"{where}.distance_factors", block.get("distance_factors", ()))
    if factors and block["realizations_per_job"] > 1:
        allowed = f"allowed is 1 where clusters are analysed ({where}.distance_factors)"
        raise ConfigError(f"{where}.realizations_per_job", block["realizations_per_job"], allowed)
    common: dict[str, Any] = {
        "seed": seed,
        "until": until,
        "samples": _samples(f"{where}.samples", block["samples"], until),
        "snapshots": snapshots,
        "equilibration": rounded(block["equilibration"]["collisions_per_particle"]),
        "keep_positions": bool(factors) or filmed,
        "max_collisions": block.get("max_collisions"),
    }
    runs = [
        Run(scene=scene, realizations=chunk, keep_motion=filmed and 0 in chunk, **common)
        for scene in scenes(where, block["grid"], block["scene"])
        for chunk in _chunks(block["realizations"], block["realizations_per_job"])
    ]
    has = memory_at_hand()
    for run in runs:
        _refuse_too_large(where, run, has)
    keeping = Keeping(block["checkpoint_seconds"], block.get("max_seconds", math.inf))
    return Study(name, tuple(block["grid"]), tuple(runs), factors, keeping)


def _refuse_too_large(where: str, run: Run, has: int) -> None:
    """Runs that do not fit into so many bytes of memory, and a disk that never meets another."""
    n, needs = run.scene.n_particles, memory_of(run)
    if needs > has:
        kept = f" and positions at {run.samples['count']} samples" if run.keep_positions else ""
        allowed = f"allowed is what fits into the memory at hand, {has:.3g} bytes: {n} disks{kept} need {needs:.3g} bytes"
        raise ConfigError(f"{where}.grid.n_particles", n, allowed)
    if n == 1 and "time" not in run.until:
        raise ConfigError(f"{where}.until.time", MISSING, "allowed is a number > 0: a single disk never collides")


def _refuse_too_many(studies: Mapping[str, Mapping[str, Any]], schema: Mapping[str, Any]) -> None:
    """Count the runs before any is made; at r = 1 one run of hard particles serves all contact times."""
    numbers = {name: number_of_runs(with_defaults(block, schema)) for name, block in studies.items()}
    total, largest = sum(numbers.values()), max(numbers, key=numbers.__getitem__)
    if total > MOST_RUNS:
        allowed = f"allowed are {MOST_RUNS} runs; with allow_large: true at the top level, any number"
        raise ConfigError(f"studies.{largest}", Written(f"{numbers[largest]} runs of {total} in all"), allowed)


def _chunks(realizations: int, size: int) -> Iterator[tuple[int, ...]]:
    """The realizations of each job; chunks do not move when realizations are added."""
    return (tuple(range(first, min(first + size, realizations))) for first in range(0, realizations, size))


def _samples(where: str, block: Mapping[str, Any], until: Mapping[str, float]) -> dict[str, Any]:
    axis = block.get("axis", "time" if "time" in until else "collisions")
    key = {"time": "time", "collisions": "collisions_per_particle"}[axis]
    if key not in until:
        raise ConfigError(f"{where}.axis", axis, f"allowed only where until.{key} is given")
    limit, count = until[key], block["count"]
    first = rounded(block.get("first", limit / count if block["spacing"] == "linear" else limit * 1e-4))
    if first >= limit:
        raise ConfigError(f"{where}.first", first, f"allowed is a number > 0 and < {limit:g} (until.{key})")
    return {"spacing": block["spacing"], "count": count, "first": first, "axis": axis}


def _asked_for(names: Sequence[str], possible: Mapping[str, Any], left_out: Mapping[str, Sequence[str]]) -> tuple[str, ...]:
    for name in names:
        if name in left_out:
            missing = ", ".join(left_out[name])
            raise ConfigError("figures", name, f"allowed where its studies are configured; {missing} is not")
        if name not in possible:
            raise unknown("figures", name, name, possible, kind="figure")
    return distinct("figures", names)

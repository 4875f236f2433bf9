"""What a configuration will cost and how good it will be, before anything runs.

Seconds are processor time. Those of collisions, of samples and of a job beside its work are measured on this machine
(calibration.py); the rest was measured once, on the machine of `REFERENCE`, and is scaled by the speed of collisions here.
"""

import json
import math
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field, fields, replace
from pathlib import Path

import netCDF4

from granugas.dynamics.soft_contact import step_of
from granugas.planning.calibration import Calibration
from granugas.planning.expected import End, bias, end_of, rate_of, scatter
from granugas.resources import memory_of
from granugas.runs import Run
from granugas.scene import Scene
from granugas.studies import Studies, Study

QUANTITIES = ("kinetic_energy", "pressure", "mean_cluster_size")

COOLING = {1: 1.0, 2: 1.1, 3: 1.4}
"""Time of a collision in a cooling gas by that in the elastic one: particles cross more cells between collisions."""

EFFECTS = (
    (lambda scene: scene.dimensions == 1, (0.72, 0.65)),
    (lambda scene: scene.dimensions == 3, (1.35, 2.07)),
    (lambda scene: scene.sizes == "bidisperse", (1.12, 1.28)),
    (lambda scene: scene.sizes in ("uniform", "log_normal"), (1.28, 1.67)),
    (lambda scene: scene.internal_modes > 0, (1.14, 1.33)),
    (lambda scene: scene.critical_distance > 0, (1.13, 1.10)),
    (lambda scene: scene.material == "viscoelastic", (1.06, 1.07)),
    (lambda scene: scene.rough, (1.00, 1.09)),
    (lambda scene: any(scene.walled), (1.12, 1.06)),
    (lambda scene: scene.gravity > 0, (1.07, 1.05)),
    (lambda scene: scene.floor != "still", (1.08, 1.04)),
)
"""Time of a collision with an effect by that without, N = 5740 and 79524 (table effects.csv, medians of three builds).

Those within 5 % are left out. At the larger N what does not fit into caches differs by a tenth or two from build to build.
"""

KICKS, KICK, KICK_EACH = 10.0, 3.6e-4, 1.1e-7
"""Random kicks in each mean free time of a heated gas; s of one, and for each particle."""

OTHER_DYNAMICS = {"soft_spheres": 5.0, "dsmc": 60.0}
"""ns of a particle-step (3 to 15, the more the longer t_c is), and of a collision."""

EQUILIBRATION_ROUNDS = 1.05
"""Rounds of `equilibration` that a start state takes, on average."""

NUMBER, ANALYSED, WITH_FACTOR = 8.3e-8, 1.6e-7, 7e-9
"""s for each coordinate of a position that is kept; for each position of a cluster analysis, and with each S_c of it."""

POOLING, POOLED = 0.7, 0.03
"""s of pooling a study, and for each of its jobs."""

DATASET, OF_SAMPLE, OF_STATE, ANALYSIS = 95e3, 150, (9, 14), 60e3
"""Bytes of a run's file, for each sample, of a start state for each particle (and axis), of a cluster analysis."""


@dataclass(frozen=True)
class Forecast:
    """What a study (or all of them) asks for.

    Attributes:
        runs: jobs that simulate.
        there: of these, done; shared: of the others, those that an earlier study of the configuration does.
        of_other_sources: of those there, made by other sources of the engine: those whose physics changed run again.
        collisions: of pairs, of what is to be done.
        seconds: of processor time for it, on this machine; equilibration, clusters and pooling included.
        memory: bytes of the largest job, whether done or not.
        disk: bytes of what is to be made.
        errors: expected relative errors of means over the realizations at the end of the runs, for QUANTITIES; the largest of
            the grid.
        biases: relative, of the kinetic energy: of n_particles and of contact_time (expected.bias).
    """

    runs: int = 0
    there: int = 0
    shared: int = 0
    of_other_sources: int = 0
    collisions: float = 0.0
    seconds: float = 0.0
    memory: int = 0
    disk: float = 0.0
    errors: Mapping[str, float] = field(default_factory=dict)
    biases: Mapping[str, float] = field(default_factory=dict)

    def __add__(self, other: "Forecast") -> "Forecast":
        sums = {one.name: getattr(self, one.name) + getattr(other, one.name) for one in fields(self)[:-2]}
        return Forecast(**sums | {"memory": max(self.memory, other.memory)})


def forecast(asked: Studies, machine: Calibration, engine: str = "") -> dict[str, Forecast]:
    """The forecast of each study, in the order of the configuration; what studies share counts for the first.

    Args:
        asked: of a configuration; what is there is looked for in its folder of results, by address.
        machine: how fast it is.
        engine: digest of the engine's sources as a dataset's provenance has it; "" asks nobody for theirs.
    """
    seen: set[Path] = set()
    return {name: _of_study(study, Path(asked.output), machine, engine, seen) for name, study in asked.studies.items()}


def run_seconds(run: Run, end: End, machine: Calibration) -> float:
    """Of the job of a run: all its realizations, and the writing of what it keeps."""
    scene, samples = run.scene, run.samples["count"] + 1
    n, numbers = scene.n_particles, scene.n_particles * scene.dimensions
    each = machine.sample_seconds + machine.sample_seconds_per_particle * n
    kept = numbers * (samples * run.keep_positions + 7 * len(run.snapshots)) * NUMBER * machine.slowness
    work = motion_seconds(scene, end, machine) + samples * each + kept
    return machine.start_seconds + len(run.realizations) * work


def equilibration_seconds(run: Run, machine: Calibration) -> float:
    """Of the job that makes the start states of a run."""
    return machine.start_seconds + _collisions_before(run) * collision_seconds(run.scene.at_start(), machine)


def analysis_seconds(run: Run, factors: int, machine: Calibration) -> float:
    """Of the cluster analysis of a run with so many S_c."""
    positions = run.scene.n_particles * (run.samples["count"] + 1)
    return machine.start_seconds + positions * (ANALYSED + WITH_FACTOR * factors) * machine.slowness


def pooling_seconds(jobs: int, machine: Calibration) -> float:
    """Of pooling a study of so many jobs."""
    return (POOLING + POOLED * jobs) * machine.slowness


def dataset_bytes(run: Run) -> float:
    """Of the file of a run."""
    n, axes, samples = run.scene.n_particles, run.scene.dimensions, run.samples["count"] + 1
    of_snapshots = len(run.snapshots) * n * (16 * axes + 24)
    return DATASET + len(run.realizations) * (OF_SAMPLE * samples + of_snapshots + 8 * n)


def motion_seconds(scene: Scene, end: End, machine: Calibration) -> float:
    """Of the motion of all particles from t = 0 to the end, by what moves them.

    From event to event: collisions. Soft spheres: particle-steps, `steps_per_contact` of them in t_c. DSMC: collisions,
    as many as of hard particles, though it knows less of their clusters.
    """
    collisions = end.collisions * scene.n_particles / 2
    if scene.dynamics == "soft_spheres":
        steps = scene.n_particles * end.tau / rate_of(scene) / step_of(scene)
        return steps * OTHER_DYNAMICS["soft_spheres"] * 1e-9 * machine.slowness
    if scene.dynamics == "dsmc":
        return collisions * OTHER_DYNAMICS["dsmc"] * 1e-9 * machine.slowness
    kicks = KICKS * end.collisions if scene.heating > 0 else 0.0
    of_kicks = kicks * (KICK + KICK_EACH * scene.n_particles) * machine.slowness
    return collisions * collision_seconds(scene, machine) * (COOLING[scene.dimensions] if scene.dissipates else 1.0) + of_kicks


def collision_seconds(scene: Scene, machine: Calibration) -> float:
    """Of a collision of an event-driven scene in equilibrium."""
    between = math.log(scene.n_particles / 5740) / math.log(79524 / 5740)
    cost = machine.collision(scene.n_particles) * 1e-9
    for applies, (small, large) in EFFECTS:
        if applies(scene):
            cost *= small + (large - small) * min(max(between, 0.0), 1.5)
    return cost


def _of_study(study: Study, output: Path, machine: Calibration, engine: str, seen: set[Path]) -> Forecast:
    ends = {run.scene: end_of(run.scene, run.until) for run in study.runs}
    errors, biases = _errors(study, ends), _largest(bias(scene, end) for scene, end in ends.items())
    whole = Forecast()
    clusters = {run.address: address for address, run in study.clusters().items()}
    for run in study.runs:
        whole += _of_run(run, ends[run.scene], output, machine, engine, seen)
        if run.address in clusters and _to_do(output / f"clusters/{clusters[run.address]}.nc", seen):
            whole += Forecast(seconds=analysis_seconds(run, len(study.distance_factors), machine), disk=ANALYSIS)
    if _to_do(output / f"studies/{study.name}.nc", seen):
        disk = sum(dataset_bytes(run) for run in study.runs)
        whole += Forecast(seconds=pooling_seconds(len(study.runs), machine), disk=disk)
    return replace(whole, errors=errors, biases=biases)


def _of_run(run: Run, end: End, output: Path, machine: Calibration, engine: str, seen: set[Path]) -> Forecast:
    """A run, and its start state where that is not there."""
    path, memory = output / f"runs/{run.address}.nc", memory_of(run)
    if path in seen:
        return Forecast(runs=1, shared=1, memory=memory)
    if not _to_do(path, seen):
        return Forecast(runs=1, there=1, of_other_sources=int(bool(engine) and _engine_of(path) != engine), memory=memory)
    n, realizations = run.scene.n_particles, len(run.realizations)
    found = Forecast(
        runs=1,
        collisions=end.collisions * n / 2 * realizations,
        seconds=run_seconds(run, end, machine),
        memory=memory,
        disk=dataset_bytes(run) + 4 * n * run.scene.dimensions * (run.samples["count"] + 1) * run.keep_positions,
    )
    if not _to_do(output / f"states/{run.state_address}.nc", seen):
        return found
    return found + Forecast(
        collisions=_collisions_before(run),
        seconds=equilibration_seconds(run, machine),
        disk=n * realizations * (OF_STATE[0] + OF_STATE[1] * run.scene.dimensions),
    )


def _collisions_before(run: Run) -> float:
    """Of pairs, in the start states of a run."""
    return run.equilibration * EQUILIBRATION_ROUNDS * run.scene.n_particles / 2 * len(run.realizations)


def _errors(study: Study, ends: Mapping[Scene, End]) -> dict[str, float]:
    """Of means over the realizations, the largest of the grid; of <M> where clusters are analysed."""
    numbers: dict[Scene, int] = {}
    for run in study.runs:
        numbers[run.scene] = numbers.get(run.scene, 0) + len(run.realizations)
    found = _largest(
        {name: value / math.sqrt(numbers[scene]) for name, value in scatter(scene, end).items()} for scene, end in ends.items()
    )
    return {name: value for name, value in found.items() if study.distance_factors or name != "mean_cluster_size"}


def _largest(several: Iterable[Mapping[str, float]]) -> dict[str, float]:
    several = list(several)
    return {name: max(one[name] for one in several) for name in several[0]}


def _to_do(path: Path, seen: set[Path]) -> bool:
    """Whether nobody makes it before and it is not there."""
    if path in seen or path.exists():
        return False
    seen.add(path)
    return True


def _engine_of(path: Path) -> str:
    """The digest of the engine's sources that a dataset was made by."""
    with netCDF4.Dataset(path) as file:
        return json.loads(file.provenance)["engine"]


def table(found: Mapping[str, Forecast], machine: Calibration) -> str:
    """For people: a line for each study and one for all, and what the columns mean."""
    titles = ("study", "runs", "there", "collisions", "CPU time", "memory", "disk", "K", "P", "<M>", "bias N", "bias t_c")
    rows = [titles, *(_row(name, one) for name, one in found.items()), _row("all", sum(found.values(), Forecast()))]
    widths = [max(len(row[k]) for row in rows) for k in range(len(titles))]
    lines = ["  ".join([row[0].ljust(widths[0]), *map(str.rjust, row[1:], widths[1:])]).rstrip() for row in rows]
    old = sum(one.of_other_sources for one in found.values())
    notes = [
        "Collisions, CPU time, disk: of what is not there yet (by the addresses of runs). Memory: of the largest job.",
        "Kernels that this machine does not have yet are compiled besides, 5 to 15 s for each kind.",
        "K, P, <M>: expected standard errors of the means at the end of the runs, the largest of the grid;",
        "bias: of K, for finite N and t_c; t_c counts as it is, where a study varies it to see what it does.",
        f"This machine: {machine.collision(5740):.0f} ns per collision at N = 5740, {machine.start_seconds:.1f} s to start.",
    ]
    notes += [f"{old} runs that are there are of other sources: those whose own physics changed run again."] if old else []
    return "\n".join([*lines, *notes])


def as_numbers(found: Mapping[str, Forecast], machine: Calibration) -> dict[str, object]:
    """For programs: everything, in s and bytes."""
    whole = asdict(sum(found.values(), Forecast()))
    of_all = {key: value for key, value in whole.items() if key not in ("errors", "biases")}
    studies = {name: asdict(one) for name, one in found.items()}
    return {"studies": studies, "all": of_all, "machine": asdict(machine)}


def _row(name: str, one: Forecast) -> tuple[str, ...]:
    there = f"{one.there}" + (f" + {one.shared} shared" if one.shared else "")
    errors = (_percent(one.errors.get(quantity)) for quantity in QUANTITIES)
    biases = (_percent(one.biases.get(key)) for key in ("n_particles", "contact_time"))
    numbers = (f"{one.collisions:.2g}", duration(one.seconds), _bytes(one.memory), _bytes(one.disk))
    return (name, f"{one.runs}", there, *numbers, *errors, *biases)


def duration(seconds: float) -> str:
    """A time in the unit that suits it."""
    for size, unit in ((3600.0, "h"), (60.0, "min")):
        if seconds >= 2 * size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds:.2g} s"


def _bytes(size: float) -> str:
    return f"{size / 1e9:.2g} GB" if size >= 1e9 else f"{size / 1e6:.2g} MB"


def _percent(share: float | None) -> str:
    return "" if share is None else f"{100 * share:.2g} %"

"""Asked the other way round: the cheapest N, t_c and number of realizations that reach an error, as a study of their own."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from granugas.planning.calibration import Calibration
from granugas.planning.expected import bias, end_of, scatter
from granugas.planning.plan import QUANTITIES, collision_seconds, duration, run_seconds
from granugas.runs import Run
from granugas.studies import Study

SIZES = (42, 100, 196, 400, 784, 1600, 3136, 6400, 12544, 25600, 51076, 102400, 204800, 409600)
"""Numbers of particles to choose from, most of them squares."""

CONTACT_TIMES = (*(float(f"{m}e{e}") for e in range(-8, -4) for m in (1, 2, 5)), 1e-4)
"""s, to choose from where the study has any; up to there gases of the papers' units cool alike to the eye (A section 6.2)."""

LEAST_REALIZATIONS, MOST_REALIZATIONS = 4, 4096
"""Fewer do not say how large the error is; more are no study."""

SHARE_OF_BIAS = 0.5
"""Of the error that is asked for, at most, may be bias; the scatter gets what is left in squares."""

JOB_SECONDS = 60.0
"""Realizations are put together in jobs of about this length."""


@dataclass(frozen=True)
class Choice:
    """What reaches an error.

    Attributes:
        n_particles, contact_time, realizations, realizations_per_job: of the study; t_c in s, None: as the study has it.
        error, bias: relative, expected: standard error of the mean, and what N and t_c do to it.
        seconds: of processor time on this machine.
    """

    n_particles: int
    contact_time: float | None
    realizations: int
    realizations_per_job: int
    error: float
    bias: float
    seconds: float

    def __str__(self) -> str:
        t_c = "" if self.contact_time is None else f" t_c = {self.contact_time:g} s,"
        return (
            f"N = {self.n_particles},{t_c} {self.realizations} realizations: standard error "
            f"{100 * self.error:.2g} %, bias {100 * self.bias:.2g} %, {duration(self.seconds)} of processor time"
        )


def cheapest(study: Study, error: float, of: str, machine: Calibration) -> Choice:
    """The choice that costs least among those whose scatter and bias together, in squares, are no more than an error.

    The errors are those of the end of the runs, at the worst point of the grid; formulas and their limits: `expected.scatter`
    and `expected.bias`. Of the bias, that of N is known for K and taken for all three; it is an upper bound for <M> (measured a
    third of it at r = .4) and P. That of t_c is known for K only, and where clusters rule no more than that K does not
    change visibly up to 1e-5 s: choose t_c yourself where numbers of collisions or elastic shares are what you want.

    Args:
        error: relative, standard error and bias together.
        of: one of QUANTITIES.

    Raises:
        ValueError: nothing to be chosen, or nothing that reaches it.
    """
    if of not in QUANTITIES:
        raise ValueError(f"--of {of}: allowed are {', '.join(QUANTITIES)}")
    if not 0 < error < 1:
        raise ValueError(f"--error {error:g}: allowed is a number > 0 and < 1, or a percentage, as in 1%")
    if of == "mean_cluster_size" and not study.distance_factors:
        raise ValueError(f"studies.{study.name}: has no distance_factors, so no clusters; another study, or add them")
    if of == "kinetic_energy" and not any(run.scene.dissipates for run in study.runs):
        raise ValueError(f"studies.{study.name}: nothing dissipates, the kinetic energy is exact")
    found = list(_choices(study, error, of, machine))
    if not found:
        most = f"N = {SIZES[-1]} and {MOST_REALIZATIONS} realizations"
        raise ValueError(f"--error {100 * error:g}%: not reached for {of} of study {study.name} by {most}; allow more")
    return min(found, key=lambda choice: choice.seconds)


def overlay(block: Mapping[str, Any], choice: Choice, name: str) -> dict[str, Any]:
    """A configuration to lay on top: the study's own block under another name, with what was chosen in it."""
    chosen = {"n_particles": choice.n_particles, "lattice": "auto"}
    chosen |= {} if choice.contact_time is None else {"contact_time": choice.contact_time}
    numbers = {"realizations": choice.realizations, "realizations_per_job": choice.realizations_per_job}
    return {"studies": {name: {**block, "grid": {**block["grid"], **chosen}, **numbers}}}


def _choices(study: Study, error: float, of: str, machine: Calibration) -> Iterator[Choice]:
    points = {_varied(run, SIZES[-1], CONTACT_TIMES[0]).scene: run for run in study.runs}.values()
    any_time = any(run.scene.dissipates and max(run.scene.contact_times) > 0 for run in points)
    for n in SIZES:
        for contact_time in CONTACT_TIMES if any_time else (None,):
            yield from _choice(study, [_varied(run, n, contact_time) for run in points], contact_time, error, of, machine)


def _varied(run: Run, n: int, contact_time: float | None) -> Run:
    """A point of the grid with another N and t_c; one without contact duration, or of elastic disks, keeps what it has."""
    varied = contact_time is not None and max(run.scene.contact_times) > 0 and run.scene.dissipates
    times = contact_time if varied and contact_time is not None else run.scene.contact_time
    return replace(run, scene=replace(run.scene, n_particles=n, contact_time=times, lattice="auto"), realizations=(0,))


def _choice(
    study: Study, runs: Sequence[Run], contact_time: float | None, error: float, of: str, machine: Calibration
) -> Iterator[Choice]:
    """One, or none where that does not do."""
    ends = [end_of(run.scene, run.until) for run in runs]
    worst = max(math.hypot(*bias(run.scene, end).values()) for run, end in zip(runs, ends, strict=True))
    spread = max(scatter(run.scene, end)[of] for run, end in zip(runs, ends, strict=True))
    if worst > SHARE_OF_BIAS * error:
        return
    number = max(math.ceil(spread**2 / (error**2 - worst**2)), LEAST_REALIZATIONS)
    if number > MOST_REALIZATIONS:
        return
    scene = runs[0].scene
    each = [run_seconds(run, end, machine) - machine.start_seconds for run, end in zip(runs, ends, strict=True)]
    starting = runs[0].equilibration * scene.n_particles / 2 * collision_seconds(scene.at_start(), machine)
    per_job = 1 if study.distance_factors else max(1, min(number, int(JOB_SECONDS / max(each))))
    jobs = math.ceil(number / per_job) * (len(runs) + 1)
    seconds = jobs * machine.start_seconds + number * (sum(each) + starting)
    yield Choice(scene.n_particles, contact_time, number, per_job, spread / math.sqrt(number), worst, seconds)

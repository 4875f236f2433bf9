"""What jobs ask of a batch system."""

from dataclasses import replace
from pathlib import Path

import pytest
import yaml

import granugas as gg
from granugas.planning import batch, plan
from granugas.planning.calibration import REFERENCE_MACHINE
from granugas.planning.expected import end_of
from granugas.resources import memory_of
from granugas.runs import Run

PROFILES = Path(__file__).resolve().parents[3] / "profiles"
OF_SNAKEMAKE = 2.0
"""s that Snakemake takes for each job that goes with others, at least (measured: 2.4 with 10^4 runs)."""

SAMPLES = {"spacing": "log", "count": 50, "first": 1e-3, "axis": "time"}


def run_of(n: int, time: float = 5.0, realizations: tuple[int, ...] = (0,)) -> Run:
    return Run(gg.Scene(n_particles=n), 1, realizations, {"time": time}, SAMPLES, (), 100.0, False)


def profile(name: str) -> dict:
    return yaml.safe_load((PROFILES / name / "config.yaml").read_text())


def together() -> dict[str, int]:
    return {kind: int(number) for kind, number in (pair.split("=") for pair in profile("slurm")["group-components"])}


def test_time_is_that_of_the_plan_with_a_margin():
    run = run_of(97776, time=446.6)
    expected = plan.run_seconds(run, end_of(run.scene, run.until), REFERENCE_MACHINE)
    assert batch.of_run(run) == pytest.approx(expected) and expected > 1000
    assert batch.minutes(expected) * 60 == pytest.approx(batch.SAFETY * expected + batch.BEFORE, abs=60)
    assert batch.of_run(replace(run, realizations=(0, 1))) > 1.9 * expected
    assert batch.of_states(run) < expected and batch.of_clusters(run, (1.1,)) < batch.of_clusters(run, (1.1,) * 50)


def test_nobody_asks_for_less_than_what_programs_take():
    assert batch.minutes(0.0) * 60 >= 60
    assert batch.megabytes(0.0) >= 1000
    assert batch.megabytes(memory_of(run_of(10**6))) > batch.megabytes(memory_of(run_of(10)))


def test_each_attempt_asks_for_more():
    assert [batch.minutes(100.0, attempt) for attempt in (1, 2, 3)] == [6, 12, 18]
    assert batch.megabytes(1e9, 2) == 2 * batch.megabytes(1e9)


def test_pooling_has_room_for_all_runs():
    runs = [run_of(1000)] * 50
    assert batch.pooled_size(runs) == pytest.approx(batch.POOLED * 50 * plan.dataset_bytes(runs[0]))
    assert batch.of_pool(runs) == plan.pooling_seconds(50, REFERENCE_MACHINE)


def test_short_jobs_of_a_kind_take_a_minute_together():
    least = dict(zip(batch.SHORT, (REFERENCE_MACHINE.start_seconds, *batch.SHORT.values()), strict=False))
    for what in ("states", "runs", "clusters"):
        for kind, seconds in least.items():
            assert together()[f"{what}_{kind}"] * (seconds + OF_SNAKEMAKE) >= 60, (what, kind)
    assert [batch.kind(seconds) for seconds in (1.0, 5.0, 59.0, 60.0)] == ["under_5_s", "under_15_s", "under_60_s", None]


def test_the_profile_names_every_kind_and_no_other():
    assert together().keys() == {f"{what}_{kind}" for what in ("states", "runs", "clusters") for kind in batch.SHORT} | {
        "figures"
    }


def test_the_profile_repeats_what_it_replaces():
    assert profile("default").items() <= profile("slurm").items()

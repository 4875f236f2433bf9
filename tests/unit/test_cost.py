"""What jobs take is written down, added up, and told."""

import json
import os
import re
import runpy
import subprocess
import sys
from pathlib import Path

import pandas as pd
import pytest
import yaml
from workflow.project import ROOT

from granugas.cost import COLUMNS, MADE, Cost, Entry, entries, record, renew_table, summary, write_table
from granugas.storage.dataset import read_by_name
from granugas.studies import load


def job(code: str, log: Path) -> subprocess.CompletedProcess[str]:
    text = f"from granugas.jobs import logged\nwith logged({str(log)!r}) as spent:\n    {code}\n"
    return subprocess.run([sys.executable, "-c", text], capture_output=True, text=True)


def recorded(log: Path) -> Cost:
    return Cost(**json.loads(log.with_suffix(".json").read_text()))


def test_a_job_writes_down_what_it_takes(tmp_path: Path) -> None:
    """Its own processor time, that of a program it starts, and its collisions; waiting is no processor time."""
    burn = "import time; t = time.process_time()\nwhile time.process_time() < t + .3: pass"
    code = (
        f"import subprocess, sys, time; time.sleep(.5); spent.collisions = 7; subprocess.run([sys.executable, '-c', {burn!r}])"
    )
    assert job(code, tmp_path / "n42_r0.4.log").returncode == 0
    cost = recorded(tmp_path / "n42_r0.4.log")
    assert cost.done and cost.collisions == 7 and cost.compile_seconds == cost.io_seconds == 0
    assert 0.3 < cost.cpu_seconds < 5 and cost.wall_seconds > 0.8
    assert [path.name for path in sorted(tmp_path.iterdir())] == ["n42_r0.4.json", "n42_r0.4.log"]


def test_compilation_is_told_from_the_rest_and_counted_once(tmp_path: Path) -> None:
    """A function that calls another is compiled with it, within the time that the whole took."""
    code = (
        "import time, numba; inner = numba.njit(lambda x: x + 1); outer = numba.njit(lambda x: inner(x) * 2); "
        "t = time.process_time(); outer(1); print(time.process_time() - t); outer(2)"
    )
    job(code, tmp_path / "job.log")
    took = float((tmp_path / "job.log").read_text().split()[0])
    assert 0.5 * took < recorded(tmp_path / "job.log").compile_seconds <= took


def test_reading_and_writing_are_told_from_the_rest(tmp_path: Path) -> None:
    code = (
        "import numpy as np, xarray as xr, time; from granugas.storage.dataset import read, write; "
        f"data = xr.Dataset({{'tau': ('time', np.random.rand(500000))}}); path = {str(tmp_path / 'data.nc')!r}; "
        "t = time.process_time(); write(data, path); read(path); print(time.process_time() - t)"
    )
    job(code, tmp_path / "job.log")
    took = float((tmp_path / "job.log").read_text().split()[0])
    assert 0.9 * took < recorded(tmp_path / "job.log").io_seconds <= took


def test_what_failed_attempts_took_is_part_of_it(tmp_path: Path) -> None:
    log = tmp_path / "job.log"
    for code in ("raise ValueError('no')", "raise SystemExit(1)", "pass"):
        job(f"spent.collisions = 5; {code}", log)
    cost = recorded(log)
    assert cost.done and cost.collisions == 15
    record(log, Cost(cpu_seconds=1.0, collisions=3, done=True))  # the same job, later, for another physics
    assert recorded(log) == Cost(cpu_seconds=1.0, collisions=3, done=True)
    log.with_suffix(".json").write_text("{")
    record(log, Cost(cpu_seconds=2.0))
    assert recorded(log).cpu_seconds == 2.0


@pytest.fixture
def results(tmp_path: Path) -> Path:
    """Two runs, one without its file, a state, a table, kernels compiled ahead."""
    costs = {
        "simulate/n42_r0.4": Cost(3.0, 4.0, 1.0, 0.5, 1000, True),
        "simulate/gone": Cost(99.0, 99.0),
        "equilibrate/n42": Cost(2.0, 2.0, 0.0, 0.5, 500, True),
        "pool/scan": Cost(0.5, 0.5, done=True),
        "claims": Cost(0.25, 0.5, done=True),
        "cost": Cost(0.25, 0.5, done=True),  # of the table itself: not in it
        "warm_up": Cost(8.0, 4.0, 8.0),
    }
    for name, cost in costs.items():
        log = tmp_path / "logs" / f"{name}.log"
        log.parent.mkdir(parents=True, exist_ok=True)
        record(log, cost)
    for name in ("runs/n42_r0.4.nc", "states/n42.nc", "studies/scan.nc", "claims.csv"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    return tmp_path


STUDY_OF = {("simulate", "n42_r0.4"): "scan", ("equilibrate", "n42"): "scan", ("pool", "scan"): "scan"}


def test_the_table_has_a_row_for_everything_that_is_there(results: Path) -> None:
    write_table(results / "cost.csv", entries(results), STUDY_OF)
    table = pd.read_csv(results / "cost.csv", keep_default_na=False)
    assert tuple(table) == COLUMNS
    assert list(zip(table["study"], table["rule"], table["cpu_seconds"], strict=True)) == [
        ("", "claims", 0.25),
        ("", "warm_up", 8.0),
        ("scan", "equilibrate", 2.0),
        ("scan", "pool", 0.5),
        ("scan", "simulate", 3.0),
    ]
    run = table.set_index("rule").loc["simulate"]
    assert (run["name"], run["collisions"], run["ns_per_collision"]) == ("n42_r0.4", "1000", "1500000.0")
    assert list(table["ns_per_collision"][:2]) == ["", ""]


def test_renewing_the_table_makes_nothing_out_of_date(results: Path) -> None:
    path = renew_table(results, STUDY_OF)
    assert path.stat().st_mtime == 0.0  # a build that wants it makes it
    os.utime(path, (1000.0, 1000.0))
    (results / "states/n42.nc").unlink()
    renew_table(results, STUDY_OF)
    assert path.stat().st_mtime == 1000.0
    assert "equilibrate" not in path.read_text() and "simulate" in path.read_text()


def test_the_last_line_of_a_build(results: Path) -> None:
    costs = [Cost(600.0, 0, 90.0, 6.0, 10**9, True), Cost(30.0, 0, 0, 0, 0, True), Cost(1200.0, 0, 5.0, 5.0, 10**9, True)]
    jobs = [("simulate", "a", 9.0), ("pool", "b", 8.0), ("simulate", "c", 5.0)]
    found = [Entry(*of, cost) for of, cost in zip(jobs, costs, strict=True)]
    assert summary(found, 6.0, "cost.csv") == (
        "This build took 10.5 CPU min for 1 runs (1e+09 collisions, 504 ns each; compile 90 s, I/O 6 s); "
        "all that is there cost 30.5 CPU min: cost.csv"
    )
    assert summary([], 0.0, "cost.csv").startswith("This build took 0 CPU s for 0 runs (0 collisions; compile 0 s")


def test_every_folder_of_logs_is_known() -> None:
    texts = [path.read_text() for path in (ROOT / "workflow/rules").glob("*.smk")]
    assert {name for text in texts for name in re.findall(r"logs/(\w+)", text)} == {*MADE, "cost"}
    figure = runpy.run_path(str(ROOT / "workflow/figures/cost.py"))
    assert {*figure["OF_STUDIES"], *figure["OTHERS"]} == {*MADE}


def test_shared_work_counts_for_the_first_study_that_asks() -> None:
    schema = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text())
    grid = {"n_particles": 42, "restitution": 0.8}
    common = {"until": {"time": 0.1}, "distance_factors": [1.1]}
    config = {"a": {"grid": grid, **common}, "b": {"grid": grid | {"restitution": [0.8, 0.7]}, **common}}
    asked = load({"studies": config}, schema).first_to_ask()
    assert sorted(study for (rule, _), study in asked.items() if rule == "simulate") == ["a", "b"]
    assert [study for (rule, _), study in asked.items() if rule == "equilibrate"] == ["a"]
    assert sorted(study for (rule, _), study in asked.items() if rule == "clusters") == ["a", "b"]
    assert (asked["pool", "a"], asked["pool", "b"]) == ("a", "b")


def test_the_figure_has_a_bar_for_every_study_and_experiment_and_what_belongs_to_none(results: Path) -> None:
    for name in ("logs/experiments", "experiments"):
        (results / name).mkdir()
    record(results / "logs/experiments/tried.log", Cost(6.0, 6.0, done=True))
    (results / "experiments/tried.nc").touch()
    write_table(results / "cost.csv", entries(results), STUDY_OF)
    data = read_by_name([results / "cost.csv"])
    figure = runpy.run_path(str(ROOT / "workflow/figures/cost.py"))
    minutes = figure["minutes_of"](data["cost"])
    assert [*minutes.index] == [
        "figures, films, tables, claims",
        "scan",
        "tried",
        "kernels, compiled ahead",
    ]  # from short to long
    assert minutes.loc["scan"].sum() * 60 == pytest.approx(5.5) and minutes.loc["scan", "runs"] * 60 == pytest.approx(3)
    (axes,) = figure["draw"](data).axes
    assert sum(bar.get_width() for bar in axes.patches) * 60 == pytest.approx(19.75)
    assert [text.get_text() for text in axes.get_yticklabels()] == [*minutes.index]

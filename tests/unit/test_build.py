"""Locks, kernels ahead of the jobs, progress and the report of what failed."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from types import SimpleNamespace

import pytest
import xarray as xr
from workflow.project import run_logged

from granugas import digest
from granugas.build import Job, claim, damaged, date_now, failures, progress, wake, warm_up
from granugas.scene import Scene
from granugas.storage.dataset import write

OLD, NOW = 1000.0, 2000.0


def written(path: Path, text: str, when: float) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    os.utime(path, (when, when))
    return path


def test_who_waits_for_jobs_is_woken_from_time_to_time() -> None:
    waiting = threading.Semaphore(0)
    wake(waiting, every=0.01)
    assert all(waiting.acquire(timeout=30) for _ in range(3))


def test_a_folder_is_claimed_by_one_process(tmp_path: Path) -> None:
    claim(tmp_path / "results")
    code = f"from granugas.build import claim; claim({str(tmp_path / 'results')!r})"
    second = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert second.returncode == 1 and "BlockingIOError" in second.stderr


def test_claiming_removes_what_killed_jobs_left(tmp_path: Path) -> None:
    left = written(tmp_path / "runs/.n42_r0.4.nc.123", "half", OLD)
    kept = [written(tmp_path / name, "whole", OLD) for name in ("runs/n42_r0.4.nc", "runs/.hidden.nc")]
    claim(tmp_path)
    assert not left.exists()
    assert all(path.exists() for path in kept)


def test_progress_counts_the_expected_work(tmp_path: Path) -> None:
    long = Job("simulate", (tmp_path / "long.nc",), written(tmp_path / "long.log", "start\n12:00 t = 1 s, 40 % done\n", NOW))
    done = Job("simulate", (written(tmp_path / "done.nc", "", NOW),), None)
    waits = Job("simulate", (written(tmp_path / "old.nc", "", OLD),), written(tmp_path / "old.log", "99 %\n", OLD))
    line = progress({long: 50.0, done: 20.0, waits: 30.0}, since=1500.0, now=1560.0)
    assert line == "1 of 3 runs, 40% of the expected work, 1.0 min so far, about 1.5 min to go"


def test_before_anything_is_done_no_end_is_foretold(tmp_path: Path) -> None:
    line = progress({Job("simulate", (tmp_path / "a.nc",), None): 1.0}, since=NOW, now=NOW + 5)
    assert line == "0 of 1 runs, 0% of the expected work, 5 s so far"


def test_the_report_names_what_is_missing_and_why(tmp_path: Path) -> None:
    reason = "Traceback ...\nValueError: too dense\n\n"
    failed = Job("simulate", (tmp_path / "runs/bad.nc",), written(tmp_path / "bad.log", reason, NOW))
    good = Job("simulate", (written(tmp_path / "runs/good.nc", "", NOW),), written(tmp_path / "good.log", "done", NOW))
    old = Job("pool", (written(tmp_path / "studies/old.nc", "", OLD),), written(tmp_path / "pool.log", "done", OLD))
    figure = Job("figure_x", (tmp_path / "x.png", tmp_path / "x.pdf"), tmp_path / "x.log")
    said = failures([failed, good, old, figure, Job("all", (), None)], since=1500.0, finals=["figure", "pool"])
    assert said.splitlines() == [
        "Missing or out of date:",
        f"  {tmp_path}/studies/old.nc",
        f"  {tmp_path}/x.png",
        "Because of:",
        f"  simulate bad: ValueError: too dense (log: {tmp_path}/bad.log)",
    ]


def test_a_job_that_was_killed_is_told_as_such(tmp_path: Path) -> None:
    words = {"": "none", "12:00:00 run: t = 1 s (40%)\n": "12:00:00 run: t = 1 s (40%)"}
    for text, said in words.items():
        killed = Job("simulate", (tmp_path / "run.nc",), written(tmp_path / "run.log", text, NOW))
        assert killed.reason() == f"killed, perhaps for lack of memory; its last words: {said}"
    failed = Job("simulate", (tmp_path / "run.nc",), written(tmp_path / "run.log", "12:00:00 run: ...\nValueError: no\n", NOW))
    assert failed.reason() == "ValueError: no"


def test_a_damaged_file_that_a_job_meets_is_looked_at_by_the_next_build(tmp_path: Path) -> None:
    kept = tmp_path / "runs/kept.nc"
    kept.parent.mkdir()
    write(xr.Dataset({"tau": 1.0}), kept)
    broken = written(tmp_path / "runs/broken.nc", "", NOW)
    for path in (kept, broken):
        done = run_logged(
            f"from granugas.storage.damage import DamagedFile as D; raise D({str(path)!r}, 'HDF error')", tmp_path / "log"
        )
        assert done.returncode == 1
        assert (
            (tmp_path / "log")
            .read_text()
            .splitlines()[-1]
            .endswith(f"{path} is damaged (HDF error); the same command makes it again")
        )
    broken.write_bytes(kept.read_bytes()[:-300] + bytes(300))
    assert damaged([kept, broken, tmp_path / "runs/none.nc"]) == [broken]
    assert [path.name for path in sorted(kept.parent.iterdir())] == [".broken.nc.suspect", "broken.nc", "kept.nc"]


def test_files_of_the_future_are_dated_so_that_nothing_old_is_believed(tmp_path: Path) -> None:
    ahead = time.time() + 9999
    run, figure = (written(tmp_path / name, "", ahead) for name in ("runs/a.nc", "figures/a.png"))
    table, old = written(tmp_path / "table.csv", "", ahead), written(tmp_path / "runs/b.nc", "", OLD)
    assert date_now(tmp_path) == 3 and date_now(tmp_path) == 0
    assert abs(run.stat().st_mtime - time.time()) < 60
    assert (figure.stat().st_mtime, table.stat().st_mtime, old.stat().st_mtime) == (0.0, 0.0, OLD)


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        (0, ["run"]),
        (1, ["run", "forget", "run"]),
        (-signal.SIGSEGV, ["run", "forget", "run"]),
        *((-number, ["run"]) for number in (signal.SIGTERM, signal.SIGINT, signal.SIGKILL)),
    ],
)
def test_kernels_that_cannot_be_used_are_compiled_again(tmp_path: Path, monkeypatch, code: int, expected: list[str]) -> None:
    calls = []
    monkeypatch.setattr("granugas.build.forget_kernels", lambda: calls.append("forget"))
    process = SimpleNamespace(wait=lambda: code)
    monkeypatch.setattr(subprocess, "Popen", lambda *_, **__: calls.append("run") or process)
    warm_up(tmp_path / "log", [Scene()])
    assert calls == expected


def test_kinds_of_scenes_with_one_equilibration_go_to_one_process(tmp_path: Path, monkeypatch) -> None:
    compiled = []
    process = SimpleNamespace(wait=lambda: 0)
    monkeypatch.setattr(subprocess, "Popen", lambda command, **_: compiled.append(command[2]) or process)
    kinds = [Scene(dimensions=3), Scene(dimensions=2), Scene(dimensions=1), Scene(contact_time=0.0), Scene(dynamics="dsmc")]
    warm_up(tmp_path / "log", [*kinds, Scene(n_particles=7)], processes=2)
    told = [[text.count(f"'dimensions': {k}") for k in (1, 2, 3)] for text in compiled]
    assert told == [[0, 3, 0], [1, 0, 1]]
    warm_up(tmp_path / "log", kinds[:1], processes=2)
    assert len(compiled) == 3  # no process without work


def test_the_process_that_compiles_ahead_reads_the_scenes_as_they_are(tmp_path: Path, monkeypatch) -> None:
    """Endless values, several contact times, and a scene without kernels of its own; nothing is said, nothing forgotten."""
    monkeypatch.setattr("granugas.build.forget_kernels", lambda: pytest.fail("forgotten"))
    scenes = [
        Scene(restitution=1.0, contact_time=(1e-5, 1e-3)),
        Scene(dimensions=1, contact_time=0.0, lrv_velocity=0.1),
        Scene(dynamics="soft_spheres"),
        Scene(dynamics="dsmc"),
    ]
    warm_up(tmp_path / "log", scenes)
    assert (tmp_path / "log").read_text() == ""


def test_only_kernels_of_its_own_are_forgotten(tmp_path: Path, monkeypatch) -> None:
    for name, gone in (("granugas/kernels-1", True), ("elsewhere", False)):
        folder = tmp_path / name
        folder.mkdir(parents=True)
        monkeypatch.setenv("NUMBA_CACHE_DIR", str(folder))
        digest.forget_kernels()
        assert folder.exists() is not gone

"""Runs that fail, builds that are killed, and two builds at once: reasons are kept, files are whole."""

import os
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

from workflow.project import Project

from granugas.storage.dataset import read

CONFIG = {
    "figures": ["study_doomed", "study_sound"],
    "studies": {
        name: {
            "grid": {"n_particles": 42, "area_fraction": 0.2, "restitution": restitution},
            "until": {"time": 0.01},
            "samples": {"count": 5},
        }
        for name, restitution in (("doomed", 0.4), ("sound", 0.8))
    },
}
DOOM = """

def fail_for_one(scene, *arguments, **options):
    if scene.restitution == 0.4:
        raise ArithmeticError("no such gas")
    return cool(scene, *arguments, **options)


cool, simulate = simulate, fail_for_one
"""
SLOW_WRITE = "import time; time.sleep(60); os.replace(temporary, path)"


def append(project: Project, file: str, text: str) -> None:
    with open(project.sources / file, "a") as source:
        source.write(text)


def start(project: Project) -> subprocess.Popen[bytes]:
    with open(project.folder / "said.txt", "w") as log:
        return subprocess.Popen(project.command(), env=project.environment, cwd=project.folder, stdout=log, stderr=log)


def wait_for(condition: Callable[[], object], seconds: float = 60.0) -> None:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.1)


def is_alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def jobs_of(pid: int) -> list[int]:
    threads = Path(f"/proc/{pid}/task").iterdir()
    return [int(child) for thread in threads for child in (thread / "children").read_text().split()]


def test_a_failing_run_leaves_its_reason_and_the_others_go_on(editable_copy: Project) -> None:
    append(editable_copy, "src/granugas/simulate.py", DOOM)
    editable_copy.configure(**CONFIG)
    done = editable_copy.snakemake()
    results = editable_copy.folder / "results"
    assert done.returncode == 1
    assert (results / "figures/study_sound.png").exists()
    assert not (results / "studies/doomed.nc").exists()
    (log,) = results.glob("logs/simulate*/*_r0.4_*.log")
    assert log.read_text().splitlines()[-1] == "ArithmeticError: no such gas"
    end = done.stdout.partition("Missing or out of date:")[2]
    missing, _, reasons = end.partition("Because of:")
    assert "results/figures/study_doomed.png" in missing and "sound" not in missing
    assert "ArithmeticError: no such gas" in reasons and str(log.relative_to(editable_copy.folder)) in reasons


def test_a_killed_build_leaves_no_half_file_and_goes_on_later(editable_copy: Project) -> None:
    editable_copy.configure(**CONFIG)
    states = editable_copy.folder / "results/states"
    with editable_copy.edited("src/granugas/storage/files.py", "os.replace(temporary, path)", SLOW_WRITE):
        build = start(editable_copy)
        wait_for(lambda: len(list(states.glob(".*.nc.*"))) == 1)
        jobs = jobs_of(build.pid)
        refused = editable_copy.snakemake()
        build.send_signal(signal.SIGKILL)
        build.wait()
    assert jobs
    wait_for(lambda: not any(map(is_alive, jobs)), 5.0)
    assert list(states.glob("*.nc")) == []
    assert refused.returncode == 1
    assert "Another build is writing to results" in refused.stdout and "Traceback" not in refused.stdout
    editable_copy.build("--", "results/studies/sound.nc")
    assert list(states.glob(".*.nc.*")) == []
    assert read(editable_copy.folder / "results/studies/sound.nc").sizes["time"] == 6

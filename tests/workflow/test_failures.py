"""Runs that fail, builds that are killed, and two builds at once: reasons are kept, files are whole."""

import signal
from pathlib import Path
from subprocess import PIPE, STDOUT, Popen

import pytest
from workflow.project import Project, is_running, jobs_of, wait_for

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
AFTER_SIMULATE = "\n\nclass Clock:"
HESITATING_WRITE = "import time; time.sleep(2); os.replace(temporary, path)"
SLOW_WRITE = "import time; time.sleep(600 if str(path).endswith('.nc') else 0); os.replace(temporary, path)"


@pytest.fixture
def project(editable_project: Project, tmp_path: Path) -> Project:
    """The copy of the sources that the tests of this file share, whose kernels are compiled once, and a folder of its own."""
    return Project(editable_project.sources, tmp_path)


def test_a_failing_run_leaves_its_reason_and_the_others_go_on(project: Project) -> None:
    project.configure(**CONFIG)
    with project.edited("src/granugas/simulate.py", AFTER_SIMULATE, DOOM + AFTER_SIMULATE):
        done = project.snakemake()
    results = project.folder / "results"
    assert done.returncode == 1
    assert (results / "figures/study_sound.png").exists()
    assert not (results / "studies/doomed.nc").exists()
    (log,) = results.glob("logs/simulate*/*_r0.4_*.log")
    assert log.read_text().splitlines()[-1] == "ArithmeticError: no such gas"
    end = done.stdout.partition("Missing or out of date:")[2]
    missing, _, reasons = end.partition("Because of:")
    assert "results/figures/study_doomed.png" in missing and "sound" not in missing
    assert "ArithmeticError: no such gas" in reasons and str(log.relative_to(project.folder)) in reasons


def test_a_killed_build_leaves_no_half_file_and_goes_on_later(project: Project) -> None:
    project.configure(**CONFIG)
    states = project.folder / "results/states"
    with project.edited("src/granugas/storage/files.py", "os.replace(temporary, path)", SLOW_WRITE):
        build = project.start()
        wait_for(lambda: list(states.glob(".*.nc.*")))
        jobs = jobs_of(build.pid)
        refused = project.snakemake()
        build.send_signal(signal.SIGKILL)
        build.wait()
    assert jobs
    wait_for(lambda: not any(map(is_running, jobs)), 60.0)
    assert list(states.glob("*.nc")) == []
    assert refused.returncode == 1
    assert "Another build is writing to results" in refused.stdout and "Traceback" not in refused.stdout
    project.build("--", "results/studies/sound.nc")
    assert list(states.glob(".*.nc.*")) == []
    assert read(project.folder / "results/studies/sound.nc").sizes["time"] == 6


def test_of_two_builds_that_start_at_once_one_goes_on_and_the_other_says_why_not(project: Project) -> None:
    project.configure(**CONFIG | {"figures": ["study_sound"]})
    command, at = project.command(), {"env": project.environment, "cwd": project.folder}
    with project.edited("src/granugas/storage/files.py", "os.replace(temporary, path)", HESITATING_WRITE):
        builds = [Popen(command, **at, stdout=PIPE, stderr=STDOUT, text=True) for _ in range(2)]
        said = [build.communicate()[0] for build in builds]
    assert sorted(build.returncode for build in builds) == [0, 1]
    (refused,) = (words for words, build in zip(said, builds, strict=True) if build.returncode)
    assert "Another build is writing to results: wait for its end" in refused
    assert "Traceback" not in "".join(said)
    assert read(project.folder / "results/studies/sound.nc").sizes["time"] == 6

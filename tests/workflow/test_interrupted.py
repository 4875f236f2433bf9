"""Builds that are killed, asked to end, cut off or damaged: the same command again gives what an undisturbed build gives."""

import os
import random
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import pytest
from workflow.project import Project, copy_of_sources, jobs_announced, jobs_of, wait_for

from granugas.storage.dataset import content_sha256, read

KINDS = ("job killed", "all killed", "main process killed", "SIGTERM to a job", "SIGTERM", "Ctrl-C")
FOLDERS = ("states", "runs", "positions", "clusters", "studies")
TARGET = ("--", "results/studies/small.nc")
STUDY = {
    "grid": {"n_particles": 100, "area_fraction": 0.3, "restitution": 1.0, "contact_time": 1.0e-5},
    "until": {"collisions_per_particle": 150_000},  # some seconds
    "samples": {"count": 10},
    "distance_factors": [1.05, 1.1],
    "checkpoint_seconds": 0.2,
}
MANY = int(os.environ.get("INTERRUPTIONS", 102))
"""Interruptions of the long test, as many of each kind."""

SEED = int(os.environ.get("INTERRUPTION_SEED", random.SystemRandom().randrange(10**6)))


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """A study that was built undisturbed, from a copy of the sources."""
    folder = tmp_path_factory.mktemp("whole")
    for name in ("sources", "work"):
        (folder / name).mkdir()
    project = Project(copy_of_sources(folder / "sources"), folder / "work")
    project.configure(studies={"small": STUDY}, figures=["study_small"])
    project.build(*TARGET)
    return project


@pytest.fixture
def fresh(whole: Project, tmp_path: Path) -> Project:
    """The same sources and configuration, nothing built."""
    shutil.copytree(whole.folder / "config", tmp_path / "config")
    return Project(whole.sources, tmp_path)


@pytest.fixture
def copied(whole: Project, tmp_path: Path) -> Project:
    """The same, built."""
    shutil.copytree(whole.folder, tmp_path, dirs_exist_ok=True)
    return Project(whole.sources, tmp_path)


def contents(project: Project) -> dict[str, str]:
    """What all datasets say; half-written ones cannot be read."""
    paths = [path for folder in FOLDERS for path in project.folder.glob(f"results/{folder}/*.nc")]
    return {path.parent.name + "/" + path.name: content_sha256(read(path)) for path in paths}


def the_file(project: Project, folder: str) -> Path:
    (path,) = project.folder.glob(f"results/{folder}/*.nc")
    return path


def log_of_run(project: Project) -> str:
    return "".join(path.read_text() for path in project.folder.glob("results/logs/simulate/*.log"))


def checkpoints(project: Project) -> dict[Path, float]:
    """When each of them was written."""
    return {path: path.stat().st_mtime for path in project.folder.glob("results/checkpoints/*.npz")}


def interrupt(build: subprocess.Popen[bytes], kind: str, rng: random.Random) -> bool:
    """Do it, and wait for the end of the build; whether it came in time: a build that was at its end has to be a good one."""
    if kind.endswith("a job") or kind.startswith("job"):
        wait_for(lambda: jobs_of(build.pid) or build.poll() is not None)
    in_time = build.poll() is None
    with suppress(ProcessLookupError):  # it was at its end
        if kind.endswith("a job") or kind.startswith("job"):
            for job in rng.sample(jobs := jobs_of(build.pid), min(1, len(jobs))):
                os.kill(job, signal.SIGKILL if kind == "job killed" else signal.SIGTERM)
        elif kind == "all killed":
            os.killpg(build.pid, signal.SIGKILL)
        elif kind == "Ctrl-C":
            os.killpg(build.pid, signal.SIGINT)
        else:
            build.send_signal(signal.SIGKILL if kind == "main process killed" else signal.SIGTERM)
    build.wait(300)
    assert in_time or build.returncode == 0
    return in_time


def interrupt_with_a_checkpoint(project: Project, kind: str, rng: random.Random) -> bool:
    """Build, and interrupt up to .3 s after a checkpoint was written; whether it came in time. What is there is taken up."""
    before = checkpoints(project)
    build = project.start(*TARGET)
    wait_for(lambda: checkpoints(project).items() - before.items() or build.poll() is not None)
    time.sleep(rng.uniform(0, 0.3))
    in_time = interrupt(build, kind, rng)
    assert not before or "goes on from a checkpoint" in log_of_run(project)
    assert "Traceback" not in (project.folder / "said.txt").read_text()
    return in_time


@pytest.mark.timeout(1800)
def test_interrupted_in_every_way_it_ends_with_the_same_files(whole: Project, fresh: Project) -> None:
    rng = random.Random(SEED)
    print(f"INTERRUPTION_SEED={SEED}")
    for kind in rng.sample(KINDS, len(KINDS)):
        while not interrupt_with_a_checkpoint(fresh, kind, rng):
            shutil.rmtree(fresh.folder / "results")  # it came to its end before
        assert contents(fresh).items() <= contents(whole).items(), kind
    fresh.build(*TARGET)
    assert contents(fresh) == contents(whole)
    left = [path.name for path in fresh.folder.glob("results/*/.*") if path.name != ".lock"]
    assert left == [] and checkpoints(fresh) == {}


@pytest.mark.full
@pytest.mark.timeout(7200)
def test_interrupted_at_any_moment_the_same_command_ends_with_the_same_files(whole: Project, fresh: Project) -> None:
    rng = random.Random(SEED)
    print(f"INTERRUPTION_SEED={SEED}")
    begun = time.monotonic()
    fresh.build(*TARGET)
    duration = time.monotonic() - begun
    cut, resumed = dict.fromkeys(KINDS, 0), 0
    while sum(cut.values()) < MANY:
        kind = min(cut, key=cut.__getitem__)
        shutil.rmtree(fresh.folder / "results")
        begun, build = time.monotonic(), fresh.start(*TARGET)
        with suppress(subprocess.TimeoutExpired):
            build.wait(rng.uniform(0, duration))
        cut[kind] += (in_time := interrupt(build, kind, rng))
        duration = 1.1 * duration if in_time else time.monotonic() - begun  # builds take longer or shorter by what else runs
        assert "Traceback" not in fresh.build(*TARGET)
        resumed += "goes on from a checkpoint" in log_of_run(fresh)
        assert contents(fresh) == contents(whole), kind
        print(sum(cut.values()), kind, "in time" if in_time else "too late", flush=True)
    print(cut, "of them went on from a checkpoint:", resumed)


FAULTY_WRITE = "fault(path, temporary, 'before'); os.replace(temporary, path); fault(path, temporary, 'after')"
FAULT = """
def fault(path, temporary, moment):
    folder, how, when = os.environ.get("FAULT", "no where ever").split()
    if path.parent.name == folder and moment == when:
        if how == "half":
            os.truncate(temporary, temporary.stat().st_size // 2)
        os.kill(os.getpid(), 9)


def _free"""


@pytest.mark.full
@pytest.mark.timeout(1800)
@pytest.mark.parametrize("how", ["half before", "whole before", "whole after"])
def test_a_job_killed_at_the_boundary_of_a_write(
    whole: Project, fresh: Project, how: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """When its file is half written, when it is whole and has not its name yet, when it has: for every kind of file."""
    files, target = "src/granugas/storage/files.py", ("--", "results/figures/study_small.png", *TARGET[1:])
    with (
        whole.edited(files, "os.replace(temporary, path)", FAULTY_WRITE),
        whole.edited(files, "\ndef _free", FAULT),
    ):
        for folder in (*FOLDERS, "checkpoints", "figures"):
            shutil.rmtree(fresh.folder / "results", ignore_errors=True)
            monkeypatch.setenv("FAULT", f"{folder} {how}")
            done = fresh.snakemake(*target)
            assert done.returncode == 1 and "killed, perhaps for lack of memory" in done.stdout, folder
            assert contents(fresh).items() <= contents(whole).items(), folder
            monkeypatch.delenv("FAULT")
            fresh.build(*target)
            assert contents(fresh) == contents(whole), folder
            assert [path for path in fresh.folder.glob("results/*/.*") if path.name != ".lock"] == [], folder


def test_cut_off_files_and_dates_of_the_future_are_repaired_by_the_same_call(whole: Project, copied: Project) -> None:
    for folder in ("states", "runs", "studies"):
        path = the_file(copied, folder)
        os.truncate(path, path.stat().st_size // 2)
    tomorrow = time.time() + 86400
    os.utime(the_file(copied, "clusters"), (tomorrow, tomorrow))
    said = copied.build(*TARGET)
    for folder in ("runs", "studies"):
        assert f"{the_file(copied, folder).relative_to(copied.folder)} was damaged: removed, to be made again." in said
    assert "is damaged: a run that needs it makes it again." in said and "it is damaged and made again" in said
    assert "1 files in results are dated in the future" in said
    assert "Traceback" not in said
    assert contents(copied) == contents(whole)
    assert copied.jobs(*TARGET) == {}


@pytest.mark.parametrize(
    ("folder", "jobs"),
    [
        ("states", {}),
        ("runs", {"simulate": 1, "clusters": 1, "pool": 1}),
        ("clusters", {"clusters": 1, "pool": 1}),
        ("studies", {"pool": 1}),
    ],
)
def test_of_what_is_whole_nothing_is_made_again(whole: Project, copied: Project, folder: str, jobs: dict[str, int]) -> None:
    path = the_file(copied, folder)
    os.truncate(path, path.stat().st_size // 2)
    assert jobs_announced(copied.build()) == jobs | {"figure_study_small": 1}  # which was not built before
    assert folder == "states" or contents(copied) == contents(whole)


def flip(path: Path) -> None:
    """Another byte in the middle of the file, which is as long as before."""
    content = bytearray(path.read_bytes())
    for place in range(len(content) // 3, len(content) // 3 + 4000):
        content[place] ^= 0xFF
    path.write_bytes(content)


@pytest.mark.full
@pytest.mark.parametrize("folder", FOLDERS)
def test_a_garbled_file_is_told_and_repaired(whole: Project, copied: Project, folder: str) -> None:
    reader = {"states": "simulate", "runs": "pool", "positions": "clusters", "clusters": "pool", "studies": "figures"}[folder]
    made = {"simulate": "runs", "clusters": "clusters", "pool": "studies"}.get(reader)
    flip(the_file(copied, folder))
    for name in {made, "studies"} - {folder, None}:
        the_file(copied, name).unlink()
    done = copied.snakemake("--", "results/figures/study_small.png", "results/studies/small.nc")
    assert "Traceback" not in done.stdout
    if folder != "states":  # a run makes its start state again itself
        assert done.returncode == 1
        reasons = done.stdout.partition("Because of:")[2]
        assert f"{the_file(copied, folder).relative_to(copied.folder)} is damaged" in reasons
        assert "the same command makes it again" in reasons
    copied.build("--", "results/figures/study_small.png", "results/studies/small.nc")
    assert contents(copied) == contents(whole)


@pytest.mark.full
@pytest.mark.parametrize("damage", ["garbled", "another version"])
def test_a_checkpoint_that_cannot_be_used_is_told_and_not_taken(whole: Project, fresh: Project, damage: str) -> None:
    build = fresh.start(*TARGET)
    wait_for(lambda: list(fresh.folder.glob("results/checkpoints/*.npz")))
    interrupt(build, "SIGTERM", random.Random(0))
    (path,) = fresh.folder.glob("results/checkpoints/*.npz")
    if damage == "garbled":
        flip(path)
        fresh.build(*TARGET)
        assert "it is damaged" in log_of_run(fresh)
    else:
        (fresh.folder / "sources").mkdir()
        other = Project(copy_of_sources(fresh.folder / "sources"), fresh.folder)
        with other.edited("src/granugas/dynamics/events/collisions.py", "\nimport", "\nELSE = 1\nimport"):
            other.build(*TARGET)
        assert "it belongs to another version of the program" in log_of_run(fresh)
    assert "goes on from a checkpoint" not in log_of_run(fresh)
    assert contents(fresh) == contents(whole)


@pytest.mark.full
def test_a_limit_of_time_keeps_what_there_is_and_a_higher_one_goes_on(whole: Project, fresh: Project) -> None:
    limited = {"studies": {"small": STUDY | {"max_seconds": 0.5}}, "figures": ["study_small"]}
    fresh.configure(**limited)
    said = fresh.build(*TARGET)
    assert "max_seconds reached at t = " in said
    data = read(fresh.folder / "results/studies/small.nc")
    assert set(data["stop_reason"].values.ravel()) == {"max_seconds"}
    assert bool(data["kinetic_energy"].isel(time=-1).isnull().all()) and not bool(data["kinetic_energy"].isel(time=0).isnull())
    for folder in ("runs", "studies"):
        the_file(fresh, folder).unlink()
    shutil.copytree(whole.folder / "config", fresh.folder / "config", dirs_exist_ok=True)
    fresh.build(*TARGET)
    assert "goes on from a checkpoint" in log_of_run(fresh)
    assert contents(fresh) == contents(whole)


@pytest.mark.full
def test_a_number_of_collisions_ends_a_run_with_what_it_has(fresh: Project) -> None:
    fresh.configure(studies={"small": STUDY | {"max_collisions": 1234}}, figures=["study_small"])
    assert "max_collisions reached at t = " in fresh.build(*TARGET)
    data = read(fresh.folder / "results/studies/small.nc")
    assert data["events"].item() == 1234 and set(data["stop_reason"].values.ravel()) == {"max_collisions"}
    assert bool(data["kinetic_energy"].isel(time=-1).isnull().all())


GREEDY = """
import resource

def with_little_memory(scene, *arguments, **options):
    if scene.n_particles == 100_000:
        resource.setrlimit(resource.RLIMIT_AS, (2**30, 2**30))
        np.ones(2**28)
    return cool(scene, *arguments, **options)


cool, simulate = simulate, with_little_memory
"""


@pytest.mark.full
@pytest.mark.parametrize("end", ["no memory", "killed"])
def test_a_job_without_memory_says_so_and_the_others_go_on(editable_copy: Project, end: str) -> None:
    doom = GREEDY if end == "no memory" else GREEDY.replace("np.ones(2**28)", "import os; os.kill(os.getpid(), 9)")
    with open(editable_copy.sources / "src/granugas/simulate.py", "a") as source:
        source.write(doom)
    grid, short = STUDY["grid"], {"until": {"collisions_per_particle": 2}, "equilibration": {"collisions_per_particle": 1}}
    studies = {"sound": STUDY | {"grid": grid} | short, "greedy": STUDY | {"grid": grid | {"n_particles": 100_000}} | short}
    editable_copy.configure(studies=studies, figures=["study_sound", "study_greedy"])
    done = editable_copy.snakemake("--", "results/studies/sound.nc", "results/studies/greedy.nc")
    assert done.returncode == 1 and "Traceback" not in done.stdout
    assert (editable_copy.folder / "results/studies/sound.nc").exists()
    reasons = done.stdout.partition("Because of:")[2]
    assert ("Unable to allocate 2.00 GiB" if end == "no memory" else "killed, perhaps for lack of memory") in reasons


def in_a_namespace(script: str, **options: object) -> subprocess.CompletedProcess[str]:
    """Run a shell script that may mount file systems, which nobody else sees and which end with it."""
    if subprocess.run(["unshare", "-rm", "mount", "-t", "tmpfs", "x", "/mnt"], capture_output=True).returncode:
        pytest.skip("no file systems can be mounted here (unshare -rm)")
    return subprocess.run(["unshare", "-rm", "sh", "-c", script], capture_output=True, text=True, **options)


def build_in_a_namespace(project: Project, script: str) -> subprocess.CompletedProcess[str]:
    """Run it there in the folder of the project; BUILD in it is the command."""
    command = " ".join(map(str, project.command(*TARGET)))
    return in_a_namespace(script.replace("BUILD", f"{command} 2>&1"), cwd=project.folder, env=project.environment)


@pytest.mark.full
def test_a_full_disk_is_told_and_more_room_repairs_it(whole: Project, fresh: Project) -> None:
    (fresh.folder / "results").mkdir()
    mounted = "mount -t tmpfs -o size=60k x results; "
    done = build_in_a_namespace(
        fresh, mounted + "BUILD; df results; mount -o remount,size=50m results; BUILD; cp -r results copy"
    )
    first, _, second = done.stdout.partition("tmpfs" if "tmpfs" in done.stdout else "x ")
    assert "not written" in first and "0 MB are free" in first and "Traceback" not in done.stdout
    assert "Finished jobid" in second
    os.rename(fresh.folder / "copy", fresh.folder / "kept")
    (fresh.folder / "results").rmdir()
    (fresh.folder / "kept").rename(fresh.folder / "results")
    assert contents(fresh) == contents(whole)


@pytest.mark.full
def test_a_folder_that_is_read_only_is_told_in_a_line(fresh: Project) -> None:
    (fresh.folder / "results").mkdir()
    done = build_in_a_namespace(fresh, "mount -t tmpfs x results; mount -o remount,ro results; BUILD")
    assert done.returncode == 1 and "Traceback" not in done.stdout
    assert "output = 'results': nothing can be written there (Read-only file system)" in done.stdout


COMPILE = "import granugas as gg; gg.warm_up([gg.Scene(16, 0.2, restitution=0.9, contact_time=1e-5)])"
COMPILE_LITTLE = "from granugas.analysis.burning import _neighbour; _neighbour(1, 2, 1.0, True)"


@pytest.fixture
def cold(whole: Project, tmp_path: Path) -> Iterator[dict[str, str]]:
    """The environment of a user who has compiled nothing yet."""
    yield {k: v for k, v in whole.environment.items() if k != "NUMBA_CACHE_DIR"} | {"XDG_CACHE_HOME": str(tmp_path / "cache")}


@pytest.mark.parametrize(
    ("rounds", "program"),
    [(2, COMPILE_LITTLE), pytest.param(20, COMPILE, marks=[pytest.mark.full, pytest.mark.timeout(7200)])],
    ids=["a little", "everything"],
)
def test_many_processes_fill_a_cold_cache_at_once(cold: dict[str, str], tmp_path: Path, rounds: int, program: str) -> None:
    for _ in range(rounds):
        shutil.rmtree(tmp_path / "cache", ignore_errors=True)
        jobs = [subprocess.Popen([sys.executable, "-c", program], env=cold, stderr=-1) for _ in range(4)]
        for job in jobs:
            assert job.communicate()[1] == b"" and job.returncode == 0
        assert list((tmp_path / "cache/granugas").rglob("*.nbc"))


@pytest.mark.parametrize("options", ["ro", "size=1m"], ids=["read-only or missing", "full"])
@pytest.mark.parametrize("home", ["home", "home/of/nobody"])
def test_a_home_that_keeps_no_kernels_is_passed_over(whole: Project, tmp_path: Path, home: str, options: str) -> None:
    for name in ("home", "temporary"):
        (tmp_path / name).mkdir()
    places = {"HOME": str(tmp_path / home), "TMPDIR": str(tmp_path / "temporary")}
    environment = {k: v for k, v in whole.environment.items() if k not in ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME")} | places
    script = f"mount -t tmpfs -o {options} x {tmp_path}/home && exec {sys.executable} -c '{COMPILE_LITTLE}'"
    done = in_a_namespace(script, cwd=tmp_path, env=environment)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert list((tmp_path / "temporary").rglob("*.nbc"))


@pytest.mark.full
@pytest.mark.parametrize("what", ["nbi", "nbc"])
def test_damaged_kernels_are_compiled_again(whole: Project, fresh: Project, what: str) -> None:
    cache = fresh.folder / "cache"
    environment = {k: v for k, v in whole.environment.items() if k != "NUMBA_CACHE_DIR"} | {"XDG_CACHE_HOME": str(cache)}
    subprocess.run([sys.executable, "-c", COMPILE], env=environment, check=True)
    for path in cache.rglob(f"*.{what}"):
        os.truncate(path, path.stat().st_size // 2)
    done = subprocess.run(fresh.command(*TARGET), env=environment, cwd=fresh.folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    assert contents(fresh) == contents(whole)

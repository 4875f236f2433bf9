"""The workflow through a real SLURM: a part of the reduced grid with every kind of rule, and one job that is killed."""

import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
import yaml
from slurm.small_cluster import SmallCluster, small_cluster
from workflow.project import ROOT, Project, wait_for

from granugas.storage.dataset import content_sha256, read

pytestmark = [pytest.mark.slurm, pytest.mark.timeout(900)]

PROFILE = ROOT / "profiles/slurm"
QUICKLY = ("--slurm-init-seconds-before-status-checks", 2, "--max-status-checks-per-second", 1, "--latency-wait", 10)
"""What suits jobs of seconds; the rest is the profile's."""

OF_TEST = ("--jobs", 4, "--slurm-status-command", "squeue", "--slurm-keep-successful-logs", *QUICKLY)

LONG = {
    "grid": {"n_particles": 100, "area_fraction": 0.3, "restitution": 1.0, "contact_time": 1.0e-5},
    "until": {"collisions_per_particle": 600_000},  # some 10 s: time to be killed in
    "samples": {"count": 10},
    "checkpoint_seconds": 0.5,
}
FILMED = {
    "grid": {"n_particles": 64, "area_fraction": 0.3, "restitution": [0.8, 1.0], "contact_time": 1.0e-5},
    "until": {"collisions_per_particle": 30},
    "samples": {"count": 10},
    "distance_factors": [1.05, 1.1],
}
TARGETS = [
    *(f"results/{name}" for name in ("explorer.html", "claims.csv", "tc1998_table1.csv", "checks.txt", "cost.csv")),
    *("results/figures/film.mp4", "results/report/configuration.html"),
]
EVERY_KIND = {
    *("equilibrate", "simulate", "simulate_without_positions", "clusters", "pool", "check", "experiment", "animate"),
    *("explorer", "claims", "cost", "configuration", "figure", "table"),
}
FOLDERS = ("states", "runs", "positions", "clusters", "studies", "experiments")


def configuration() -> dict[str, object]:
    """One study of the reduced grid as it stands there, and what it has no small one of."""
    whole, reduced = (yaml.safe_load((ROOT / f"config/{name}.yaml").read_text()) for name in ("config", "reduced"))
    name = "tc1998_n42"
    filmed = FILMED | {"grid": FILMED["grid"] | {"restitution": 0.7}}
    studies = {name: whole["studies"][name] | reduced["studies"][name], "long": LONG, "clustered": FILMED, "filmed": filmed}
    return {
        "studies": studies,
        "animations": {"film": {"study": "filmed", "colour": "energy"}},
        "figures": ["study_clustered", "tc1998_fig02"],
        "small_experiments": True,
    }


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SmallCluster]:
    with small_cluster(tmp_path_factory.mktemp("slurm")) as cluster:
        yield cluster


@pytest.fixture(scope="module")
def local(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """The same, built by the default profile."""
    project = Project(ROOT, tmp_path_factory.mktemp("local"))
    project.configure(**configuration())
    project.build("--", *TARGETS)
    return project


@pytest.fixture(scope="module")
def built(cluster: SmallCluster, tmp_path_factory: pytest.TempPathFactory) -> tuple[Project, str, str]:
    """What SLURM's jobs built, the number of the one that was killed, and what the build said."""
    project = Project(ROOT, tmp_path_factory.mktemp("on_the_cluster"))
    project.configure(**configuration())
    words = project.command("--workflow-profile", PROFILE, *OF_TEST, "--", *TARGETS)
    words = [word for k, word in enumerate(words) if "--cores" not in words[max(k - 1, 0) : k + 1]]  # the profile's
    said = project.folder / "said.txt"
    with open(said, "w") as file:
        environment = cluster.environment | {"PYTHONPATH": str(ROOT / "src")}
        build = subprocess.Popen(words, env=environment, cwd=project.folder, stdout=file, stderr=file)
    try:
        wait_for(lambda: checkpoints(project) or build.poll() is not None)
        time.sleep(1.0)
        killed = running(cluster, "runs_under_15_s")
        cluster.call("scancel", killed)
        assert build.wait(600) == 0, said.read_text()
    finally:
        build.kill()
    return project, killed, said.read_text()


def checkpoints(project: Project) -> list[Path]:
    return [*project.folder.glob("results/checkpoints/*.npz")]


def running(cluster: SmallCluster, kind: str) -> str:
    """The number of the job that carries out a kind of short jobs."""
    (number,) = [number for number, job in cluster.jobs("RUNNING").items() if kind in job["Comment"]]
    return number


def contents(project: Project) -> dict[str, str]:
    """What all datasets say."""
    paths = [path for folder in FOLDERS for path in project.folder.glob(f"results/{folder}/*.nc")]
    return {f"{path.parent.name}/{path.name}": content_sha256(read(path)) for path in paths}


def test_it_gives_what_a_local_build_gives(built, local):
    project, _, _ = built
    assert contents(project) == contents(local)
    assert {path.parent.name for path in project.folder.glob("results/*/*.nc")} == set(FOLDERS)
    assert all((project.folder / target).is_file() for target in TARGETS)


def test_every_kind_of_rule_was_a_job_of_slurm(built, cluster):
    told = " ".join(job["Comment"] for job in cluster.jobs().values())
    assert [kind for kind in EVERY_KIND if kind not in told] == []


def test_the_killed_job_went_on_from_its_checkpoint(built, cluster):
    project, killed, said = built
    assert cluster.jobs()[killed]["JobState"] == "CANCELLED"
    assert "Trying to restart job" in said and checkpoints(project) == []
    assert any("goes on from a checkpoint" in path.read_text() for path in project.folder.glob("results/logs/simulate/*.log"))


def test_every_job_asked_for_memory_and_time(built, cluster):
    for number, job in cluster.jobs().items():
        assert job["Partition"] == "main" and job["TimeLimit"] not in ("UNLIMITED", "365-00:00:00"), number
        assert "mem=" in job["TRES"] and "cpu=1," in job["TRES"], job["TRES"]


def test_short_jobs_went_together(built, cluster):
    finished = cluster.jobs("COMPLETED").values()
    assert sum("equilibrate" in job["Comment"] for job in finished) == 1  # of all start states, each a second


def test_logs_are_found(built):
    project, _, said = built
    assert list(project.folder.glob("results/logs/simulate/*.log")) and list(
        project.folder.glob(".snakemake/slurm_logs/*/*.log")
    )
    assert "(log: " in said

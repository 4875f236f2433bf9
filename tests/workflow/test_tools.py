"""What Snakemake offers beside building: the graphs of a build, its state, and an archive to pass on."""

import csv
import subprocess
import tarfile

import pytest
from workflow.project import SOURCES, Project, copy_of_sources

CONFIG = {
    "studies": {"mine": {"grid": {"n_particles": 36, "restitution": [0.9, 0.8]}, "until": {"collisions_per_particle": 2}}},
    "figures": ["study_mine"],
}


@pytest.mark.parametrize(("option", "rules"), [("--dag", 6), ("--rulegraph", 5)])
def test_graphs_can_be_drawn(project: Project, option: str, rules: int) -> None:
    """Of the start state, two runs, their study, its figure and `all`."""
    project.configure(**CONFIG)
    graph = said_alone(project, option)
    assert graph.startswith("digraph") and graph.rstrip().endswith("}")
    assert graph.count("label = ") == rules and "figure_study_mine" in graph


def test_a_summary_says_what_is_missing(project: Project) -> None:
    project.configure(**CONFIG)
    rows = list(csv.DictReader(said_alone(project, "--summary").splitlines(), delimiter="\t"))
    assert {row["rule"] for row in rows} == {"equilibrate", "simulate_without_positions", "pool", "figure_study_mine"}
    assert {row["status"] for row in rows} == {"missing"}


@pytest.mark.full
def test_an_archive_is_all_that_another_place_needs(project: Project) -> None:
    """All files under version control, and nothing of what was built."""
    sources = copy_of_sources(project.folder)
    git = ["git", "-c", "user.name=a", "-c", "user.email=a@b", "-C", str(sources)]
    for words in (["init", "--quiet"], ["add", *SOURCES], ["commit", "--quiet", "-m", "sources"]):
        subprocess.run([*git, *words], check=True)
    tracked = subprocess.run([*git, "ls-files"], check=True, capture_output=True, text=True).stdout.split()
    here = Project(sources, sources)
    here.build("--archive", "workflow.tar.gz", "--", "results/studies/scene_bed.nc")
    with tarfile.open(sources / "workflow.tar.gz") as archive:
        assert {member.name for member in archive.getmembers() if member.isfile()} == {*tracked}
        archive.extractall(sources / "elsewhere", filter="data")
    there = Project(sources / "elsewhere", sources / "elsewhere")
    assert there.jobs("results/studies/scene_bed.nc") == {"equilibrate": 1, "simulate_without_positions": 1, "pool": 1}


def said_alone(project: Project, option: str) -> str:
    """Standard output of a call, which must end well."""
    command = project.command(option)
    done = subprocess.run(command, env=project.environment, cwd=project.folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout

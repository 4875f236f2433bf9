"""What runs again after a change, and what does not: a study is built once, dry runs tell the rest."""

import csv
from collections import Counter

import pytest
import yaml
from workflow.project import Project

from granugas.storage.dataset import read

GRID = {"n_particles": [42], "area_fraction": [0.2], "restitution": [0.8, 0.4], "contact_time": [1.0e-5]}
STUDY = {
    "grid": GRID,
    "until": {"time": 0.05},
    "samples": {"spacing": "log", "count": 10, "first": 1.0e-3},
    "snapshots": [0.05],
    "distance_factors": [1.05, 1.1],
}


@pytest.fixture(scope="module")
def built(editable_project: Project) -> Project:
    """A project whose configuration is built, figure and all."""
    editable_project.configure(studies={"small": STUDY}, figures=["study_small"])
    said = editable_project.build("--", "all", "check")
    assert "the figures in results/figures" in said
    return editable_project


def jobs_with(built: Project, change: dict) -> dict[str, int]:
    """The jobs that an overlay on the study calls for."""
    overlay = built.folder / "mine.yaml"
    overlay.write_text(yaml.safe_dump({"studies": {"small": change}}))
    return built.jobs("--configfile", overlay, "--", "all")


def test_a_study_gives_a_dataset_and_an_overview(built: Project) -> None:
    results = built.folder / "results"
    data = read(results / "studies/small.nc")
    sizes = {"restitution": 2, "realization": 1, "time": 11, "distance_factor": 2, "snapshot": 1, "particle": 42}
    assert {name: data.sizes[name] for name in sizes} == sizes
    assert data.time.values[[1, -1]] == pytest.approx([1.0e-3, 0.05])
    assert (results / "figures/study_small.png").stat().st_size > 5000
    assert (results / "figures/study_small.pdf").stat().st_size > 5000
    assert "no finding" in (results / "checks.txt").read_text()


def test_start_states_are_shared_by_all_restitutions(built: Project) -> None:
    assert len(list(built.folder.glob("results/states/*.nc"))) == 1
    assert len(list(built.folder.glob("results/runs/*.nc"))) == 2
    assert len(list(built.folder.glob("results/positions/*.nc"))) == 2


def test_what_everything_cost_is_told_and_written_down(built: Project) -> None:
    """After a build of a part, too; without what is gone; and nothing is out of date for it."""
    table = built.folder / "results/cost.csv"
    jobs = {"warm_up": 1, "equilibrate": 1, "simulate": 2, "clusters": 2, "pool": 1, "figures": 1, "check": 1}
    assert Counter(row["rule"] for row in csv.DictReader(table.open())) == jobs
    for row in csv.DictReader(table.open()):
        assert float(row["cpu_seconds"]) > 0
        assert row["study"] == ("small" if row["rule"] in ("equilibrate", "simulate", "clusters", "pool") else "")
        if row["rule"] == "simulate":
            data = read(built.folder / f"results/runs/{row['name']}.nc")
            assert int(row["collisions"]) == data["events"]
            assert float(row["cpu_seconds"]) > data["cpu_time"]
    figure = built.folder / "results/figures/study_small.png"
    figure.unlink()
    said = built.build("--force", "--", "results/checks.txt")
    assert "This build took " in said and "all that is there cost" in said
    assert Counter(row["rule"] for row in csv.DictReader(table.open())) == Counter(jobs) - Counter(figures=1)
    built.build("--", "all")
    assert Counter(row["rule"] for row in csv.DictReader(table.open())) == jobs


def test_nothing_is_left_to_do(built: Project) -> None:
    assert built.jobs() == {}


def test_another_restitution_runs_the_new_runs_only(built: Project) -> None:
    jobs = jobs_with(built, {"grid": {"restitution": [0.8, 0.4, 0.6]}})
    assert jobs == {"simulate": 1, "clusters": 1, "pool": 1, "figure_study_small": 1}


def test_another_realization_runs_the_new_runs_only(built: Project) -> None:
    jobs = jobs_with(built, {"realizations": 2})
    assert jobs == {"equilibrate": 1, "simulate": 2, "clusters": 2, "pool": 1, "figure_study_small": 1}


def test_another_distance_factor_analyses_again_and_simulates_nothing(built: Project) -> None:
    jobs = jobs_with(built, {"distance_factors": [1.05, 1.1, 1.3]})
    assert jobs == {"clusters": 2, "pool": 1, "figure_study_small": 1}


@pytest.mark.parametrize(
    "file",
    ["scene.py", "simulate.py", "analysis/clusters.py", "storage/dataset.py", "dynamics/events/collisions.py"],
)
def test_a_comment_in_a_module_runs_nothing(built: Project, file: str) -> None:
    with built.edited(f"src/granugas/{file}", "\nimport", "\n# A remark.\nimport"):
        assert built.jobs() == {}


def test_a_comment_in_a_script_runs_nothing(built: Project) -> None:
    with built.edited("workflow/scripts/simulate.py", "\nwith", "\n# A remark.\nwith"):
        assert built.jobs() == {}


def test_changed_physics_runs_everything_again(built: Project) -> None:
    with built.edited("src/granugas/dynamics/events/collisions.py", "\nimport", "\nELSE = 1\nimport"):
        jobs = built.jobs()
    expected = {"equilibrate": 1, "simulate": 2, "clusters": 2, "pool": 1, "figure_study_small": 1}
    assert jobs == expected


def test_a_changed_effect_runs_what_calls_for_it(built: Project) -> None:
    """The TC rule is in the runs and not in their elastic start; no run names the shares of elastic gases."""
    with built.edited("src/granugas/dynamics/events/effects/contact_time.py", "\nfrom typing", "\nELSE = 1\nfrom typing"):
        assert built.jobs() == {"simulate": 2, "clusters": 2, "pool": 1, "figure_study_small": 1}
    with built.edited("src/granugas/dynamics/events/effects/elastic_share.py", "\nfrom typing", "\nELSE = 1\nfrom typing"):
        assert built.jobs() == {}


def test_a_new_effect_runs_nothing(built: Project) -> None:
    file = built.sources / "src/granugas/dynamics/events/effects/new.py"
    file.write_text("ELSE = 1\n")
    with built.edited("src/granugas/scene.py", "\nimport", "\nELSE = 1\nimport"):
        assert built.jobs() == {}
    file.unlink()


def test_a_changed_cluster_analysis_simulates_nothing(built: Project) -> None:
    with built.edited("src/granugas/analysis/clusters.py", "\nimport", "\nELSE = 1\nimport"):
        jobs = built.jobs()
    assert jobs == {"clusters": 2, "pool": 1, "figure_study_small": 1}


def test_a_changed_figure_draws_again(built: Project) -> None:
    with built.edited("workflow/figures/overview.py", "\nimport", "\n# A remark.\nimport"):
        assert built.jobs() == {"figure_study_small": 1}


def test_a_study_of_another_name_shares_the_runs(built: Project) -> None:
    overlay = built.folder / "mine.yaml"
    overlay.write_text(yaml.safe_dump({"studies": {"other": STUDY}}))
    jobs = built.jobs("--configfile", overlay, "--", "results/studies/other.nc")
    assert jobs == {"pool": 1}

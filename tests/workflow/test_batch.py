"""What jobs ask of a batch system is nothing to a build on this machine."""

import json
from pathlib import Path

from workflow.project import Project

STUDY = {
    "grid": {"n_particles": 100, "area_fraction": [0.3, 0.32], "restitution": 1.0, "contact_time": 1.0e-5},
    "until": {"collisions_per_particle": 50_000},  # some seconds, of disks that do not cool
    "samples": {"count": 10},
}


def span(record: Path) -> tuple[float, float]:
    """When a job began and ended, s since the epoch, by what it wrote down of itself."""
    end = record.stat().st_mtime
    return end - json.loads(record.read_text())["wall_seconds"], end


def test_runs_go_side_by_side_whatever_memory_they_ask_for(editable_copy: Project):
    """More than any machine has."""
    editable_copy.configure(studies={"small": STUDY}, figures=["study_small"])
    with editable_copy.edited("src/granugas/planning/batch.py", "PROGRAMS = 1.5e9", "PROGRAMS = 1.5e18"):
        said = editable_copy.build("--", "results/studies/small.nc")
    assert "Group job" not in said
    spans = [span(path) for path in editable_copy.folder.glob("results/logs/simulate/*.json")]
    assert len(spans) == 2 and max(begin for begin, _ in spans) < min(end for _, end in spans)


def test_a_dry_run_shows_no_groups(project: Project):
    project.configure(studies={"small": STUDY}, figures=["study_small"])
    said = project.build("--dry-run", "--quiet", "host", "--", "results/figures/study_small.png")
    assert "mem_mb=" in said and "runtime=" in said and "Group job" not in said


def test_short_jobs_go_together_where_a_profile_says_so(project: Project):
    project.configure(studies={"small": STUDY}, figures=["study_small"])
    groups = ("--group-components", "states_under_5_s=2", "runs_under_5_s=2", "figures=20")
    said = project.build("--dry-run", "--quiet", "host", *groups, "--", "results/figures/study_small.png")
    assert [f"Group job {name}" in said for name in ("states_under_5_s", "runs_under_5_s", "figures")] == [True] * 3

"""The reduced grid goes through the whole chain, and its datasets keep to physics."""

import pandas as pd
import pytest
import yaml
from workflow.project import ROOT, Project

from granugas.claims import FAILS, HOLDS, NOT_MEASURED, SLIP
from granugas.declared import studies_in

FULL, REDUCED = (ROOT / f"config/{name}.yaml" for name in ("config", "reduced"))


@pytest.mark.timeout(1800)
def test_the_preview_builds_every_figure_and_keeps_to_physics(project: Project) -> None:
    said = project.build("--configfile", FULL, REDUCED, "--", "all", "check")
    preview = project.folder / "results/preview"
    figures = studies_in(ROOT / "workflow/figures")
    expected = {f"{name}.{kind}" for name in figures for kind in ("png", "pdf")}
    assert {path.name for path in preview.glob("figures/*")} >= expected
    assert {path.stem for path in preview.glob("*.csv")} == {*studies_in(ROOT / "workflow/tables"), "claims", "cost"}
    assert 1e6 < (preview / "explorer.html").stat().st_size < 5e6
    claims = pd.read_csv(preview / "claims.csv")
    assert len(claims) >= 45 and set(claims["verdict"].str.split(" within").str[0]) <= {HOLDS, FAILS, SLIP, NOT_MEASURED}
    assert (claims["verdict"] != NOT_MEASURED).sum() >= 30
    page = (preview / "claims.md").read_text()
    assert all(name in page for name in claims["id"])
    studies = yaml.safe_load(FULL.read_text())["studies"]
    assert {path.stem for path in preview.glob("studies/*.nc")} == set(studies)
    assert (preview / "checks.txt").read_text() == f"{len(studies)} studies, no finding\n"
    assert "the figures in results/preview/figures" in said
    costs = pd.read_csv(preview / "cost.csv")
    assert {"warm_up", "equilibrate", "simulate", "clusters", "pool", "experiments", "figures", "tables", "claims"} <= {
        *costs["rule"]
    }
    assert "cost" not in {*project.jobs("--configfile", FULL, REDUCED, "--", "all", "check")}


def test_the_preview_has_every_study_and_none_at_full_size() -> None:
    full, reduced = (yaml.safe_load(path.read_text()) for path in (FULL, REDUCED))
    assert set(reduced["studies"]) == set(full["studies"])
    assert reduced["output"] != full["output"]

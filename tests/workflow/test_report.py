"""The report of a small build: everything in its section, with captions, and nothing to load from elsewhere."""

import base64
import json
import re

import pytest
from workflow.project import ROOT, Project

from granugas.declared import studies_in

STUDY = {
    "grid": {"n_particles": 64, "restitution": [0.9, 0.6], "diameter": 2.0e-3},
    "realizations": 2,
    "realizations_per_job": 2,
    "until": {"collisions_per_particle": 20},
    "samples": {"count": 20},
}
FIGURES = {
    "tc1998_fig01": ("Papers", "A: Luding and McNamara 1998", "Fig. 1: two soft and two hard particles"),
    "tc1998_table1": ("Papers", "A: Luding and McNamara 1998", "Table 1 as a picture"),
    "cluster1999_fig1": ("Papers", "B: Luding and Herrmann 1999", "Fig. 1: cooling of small systems"),
    "study_cluster1999_restitutions": ("Studies", "Other", "Any study at a glance"),
}


@pytest.mark.timeout(1200)
def test_the_report_holds_what_was_built(project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    project.configure(figures=[*FIGURES], small_experiments=True, studies={"cluster1999_restitutions": STUDY})
    targets = ["--", "pages", "results/report/tc1998_table1.html"]
    project.build(*targets)
    monkeypatch.setenv("DOCUTILSCONFIG", str(ROOT / "workflow/report/docutils.conf"))
    said = project.build("--report", "report.html", *targets)
    assert "Unknown command" not in said  # no formula that is not understood
    page = (project.folder / "report.html").read_text()
    results, categories = variable(page, "results"), variable(page, "categories")

    for name, (section, part, about) in FIGURES.items():
        path = f"results/figures/{name}.png"
        assert path in categories[section][part]
        shown = results[path]
        assert shown["labels"]["shows"].startswith(f"{name}: {about}")
        assert content_of(shown) == (project.folder / path).read_bytes()
        assert len(shown["caption"]) > 300
    assert "<math" in results["results/figures/cluster1999_fig1.png"]["caption"]
    assert "(3)" in results["results/figures/cluster1999_fig1.png"]["caption"]

    table = results["results/report/tc1998_table1.html"]
    assert "results/report/tc1998_table1.html" in categories["Papers"]["A: Luding and McNamara 1998"]
    assert table["labels"]["shows"].startswith("tc1998_table1.csv: Table 1") and "results/tc1998_table1.csv" in table["caption"]
    rows = (project.folder / "results/tc1998_table1.csv").read_text().splitlines()
    assert content_of(table).decode().count("<tr") == len(rows)
    configuration = content_of(results["results/report/configuration.html"]).decode()
    assert "cluster1999_restitutions:" in configuration and "snakemake" in configuration
    assert categories["Configuration"] == {"Other": ["results/report/configuration.html"]}
    assert len(results) == len(FIGURES) + 2
    assert all(len(result["labels"]) == 1 for result in results.values())  # two would break a section of two entries
    assert not re.search(r"""<(script|link|img|iframe)[^>]+(src|href)=["']?(https?:)?//""", page)


def test_with_all_figures_all_tables_claims_and_costs_are_pages(project: Project) -> None:
    project.configure(studies={"mine": STUDY})
    jobs = project.jobs("--", "pages")
    tables = [name for name, needed in studies_in(ROOT / "workflow/tables").items() if not needed]
    assert jobs["page"] == len(tables) + 2 and jobs["claims"] == jobs["cost"] == 1 and jobs["configuration"] == 1


def variable(page: str, name: str) -> dict:
    """A value that the report's scripts begin with."""
    start = re.search(rf"^ *var {name} = (?={{)", page, re.M)
    assert start, name
    return json.JSONDecoder().raw_decode(page, start.end())[0]


def content_of(result: dict) -> bytes:
    """The file that a result of the report is."""
    return base64.b64decode(result["data_uri"].partition("base64,")[2])

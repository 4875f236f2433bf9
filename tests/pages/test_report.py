"""The report in a browser: its menu has the sections, a figure and its caption are shown, the claims can be sorted."""

from pathlib import Path

import pandas as pd
import pytest
from workflow.project import ROOT, Project

from granugas.report import table_page

CONFIG = {
    "figures": ["tc1998_fig01", "study_mine"],
    "small_experiments": True,
    "studies": {"mine": {"grid": {"n_particles": 36, "restitution": 0.9}, "until": {"collisions_per_particle": 2}}},
}
KNOWN = ("cdn.tailwindcss.com should not be used in production",)
"""What a part of Snakemake's report always says, though it is embedded and loads nothing."""


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("report")
    project = Project(ROOT, folder)
    project.configure(**CONFIG)
    targets = ["--", "pages", "results/report/tc1998_table1.html"]
    project.build(*targets)
    project.build("--report", "report.html", *targets)
    return folder / "report.html"


@pytest.fixture
def page(browser):
    """A page that says nothing unexpected and asks no other address for anything."""
    page = browser.new_page(viewport={"width": 1440, "height": 900})
    said, asked = [], []
    page.on("console", lambda message: said.append(message.text))
    page.on("pageerror", lambda error: said.append(str(error)))
    page.on("request", lambda request: asked.append(request.url))
    yield page
    page.close()
    assert [text for text in said if not text.startswith(KNOWN)] == []
    assert {url.partition(":")[0] for url in asked} <= {"file", "data"}


def test_a_figure_is_found_in_its_section_and_shown_with_its_caption(report, page):
    page.goto(report.as_uri())
    for section in ("Papers", "Studies", "Configuration"):
        page.get_by_text(section, exact=True).first.wait_for()
    page.get_by_text("Papers", exact=True).first.click()
    row = page.locator("nav tbody tr").filter(has_text="tc1998_fig01")
    assert "Fig. 1: two soft and two hard particles" in row.inner_text()
    row.locator("a").nth(0).click()
    image = page.locator("img[src^='data:image/png']").last
    image.wait_for()
    assert image.bounding_box()["width"] > 200 and image.evaluate("image => image.naturalWidth") > 500
    row.locator("a").nth(1).click()
    page.get_by_text("Description", exact=True).wait_for()
    assert "Luding and McNamara, Granular Matter 1 (1998) 113" in " ".join(page.inner_text("nav").split())


def test_a_table_is_sorted_by_its_heads_inside_the_report(report, page):
    page.goto(report.as_uri())
    page.get_by_text("Papers", exact=True).first.click()
    page.locator("nav tbody tr").filter(has_text="tc1998_table1.csv").locator("a").nth(0).click()
    page.locator("iframe").wait_for()
    table = page.frame_locator("iframe")
    head = table.locator("thead th").first
    for order in ("ascending", "descending"):
        head.click()
        assert head.get_attribute("aria-sort") == order
        words = table.locator("tbody td:first-child").all_inner_texts()
        assert words == sorted(words, key=str.lower, reverse=order == "descending")


def test_claims_are_sorted_as_numbers_and_searched(page, tmp_path):
    claims = pd.read_csv(ROOT / "results/gallery/claims.csv")
    claims["row"] = range(len(claims), 0, -1)
    (tmp_path / "claims.html").write_text(table_page(claims, "Claims"), encoding="utf-8")
    page.goto((tmp_path / "claims.html").as_uri())
    page.locator("th", has_text="row").click()
    assert [int(text) for text in page.locator("tbody td:last-child").all_inner_texts()] == sorted(claims["row"])
    page.locator("th", has_text="verdict").focus()
    page.keyboard.press("Enter")
    column = list(claims).index("verdict") + 1
    verdicts = page.locator(f"tbody td:nth-child({column})").all_inner_texts()
    assert verdicts == sorted(claims["verdict"]) and len({*verdicts}) > 1
    page.fill("input", "cluster1999_fig7 holds")
    shown = page.locator("tbody tr:visible").all_inner_texts()
    assert 0 < len(shown) < len(claims) and all("cluster1999_fig7" in text for text in shown)

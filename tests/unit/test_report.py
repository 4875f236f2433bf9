"""Every figure and table has its place in the report, and tables are pages of their own."""

from html.parser import HTMLParser
from pathlib import Path

import pandas as pd
import pytest

from granugas.configuration import ConfigError
from granugas.report import PAPERS, SECTIONS, WIDTH, configuration_page, entry_of, table_page

WORKFLOW = Path(__file__).parents[2] / "workflow"
DRAWN = [path for kind in ("figures", "tables") for path in sorted((WORKFLOW / kind).glob("[!_]*.py"))]


class Cells(HTMLParser):
    """Rows of the tables of a page, and every address in it."""

    def __init__(self, page):
        super().__init__()
        self.rows, self.addresses, self.inside = [], [], False
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        self.addresses += [value for key, value in attrs if key in ("src", "href")]
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")
            self.inside = True

    def handle_endtag(self, tag):
        self.inside = self.inside and tag not in ("td", "th")

    def handle_data(self, data):
        if self.inside:
            self.rows[-1][-1] += data


@pytest.mark.parametrize("path", DRAWN, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_every_figure_and_table_has_a_section_and_a_title(path):
    section, part, about = entry_of(path)
    assert section in SECTIONS and (part is not None) == (section == "Papers")
    assert 10 < len(about) <= WIDTH and about != path.stem and not about.startswith(tuple(PAPERS))


@pytest.mark.parametrize("path", [path for path in DRAWN if path.parent.name == "figures"], ids=lambda path: path.stem)
def test_every_figure_has_a_caption(path):
    assert len((WORKFLOW / f"report/{path.stem}.rst").read_text()) > 80


def test_the_section_of_a_paper_follows_from_the_name(tmp_path):
    path = tmp_path / "tc1998_fig99.py"
    path.write_text('"""tc1998 Fig. 99: a figure that the paper does not have."""\n')
    assert entry_of(path) == ("Papers", PAPERS["tc1998"], "Fig. 99: a figure that the paper does not have")


@pytest.mark.parametrize(
    ("text", "said"),
    [('"""A figure."""\n', "missing"), ('SECTION = "Nowhere"\n', "Nowhere"), ('SECTION: str\nOTHER = "Papers"\n', "missing")],
)
def test_a_file_without_a_section_is_refused_by_name(tmp_path, text, said):
    path = tmp_path / "mine.py"
    path.write_text(text)
    with pytest.raises(ConfigError, match=f"mine.py: SECTION = .*{said}.*allowed are Papers, Accuracy"):
        entry_of(path)


def test_a_table_becomes_a_page_that_needs_nothing_else():
    table = pd.DataFrame({"what": ["a < b", "<script>alert(1)</script>"], "value": [1.23456789, None], "n": [3, 4]})
    page = table_page(table, "Numbers & words")
    cells = Cells(page)
    assert cells.rows == [["what", "value", "n"], ["a < b", "1.23457", "3"], ["<script>alert(1)</script>", "", "4"]]
    assert not cells.addresses and "<script>alert" not in page
    assert "<h1>Numbers &amp; words</h1>" in page and 'type="search"' in page


def test_the_configuration_stands_beside_all_versions():
    origins = [{"package": f"granugas 0.{k}", "parameters": {"seed": k}, "libraries": {"numpy": "2"}} for k in (1, 2)]
    page = configuration_page({"studies": {"mine": {"until": {"time": 5.0}}}}, origins, {"matplotlib": "3.9"})
    rows = Cells(page).rows
    assert ["package", '["granugas 0.1", "granugas 0.2"]'] in rows and ["matplotlib", "3.9"] in rows
    assert "  mine:\n    until:\n      time: 5.0\n" in page
    assert "seed" not in page

"""The report: where a figure or table stands in it, tables that can be sorted, and what everything was made with."""

import ast
import json
from collections.abc import Iterable, Mapping
from html import escape
from pathlib import Path
from textwrap import shorten
from typing import TYPE_CHECKING, Any, NamedTuple

from granugas.configuration import MISSING, ConfigError

if TYPE_CHECKING:
    import pandas as pd

SECTIONS = ("Papers", "Accuracy", "Hard cases", "Effects", "Cost", "Studies", "Claims", "Configuration")

PAPERS = {"tc1998": "A: Luding and McNamara 1998", "cluster1999": "B: Luding and Herrmann 1999"}
"""By the first word of the names of the figures and tables that belong to a paper."""

WIDTH = 56
"""Letters of what is said about an entry: the menu leaves the rest of the window to the figure."""

PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{title}</title>
<style>
body {{ font: 14px/1.35 sans-serif; margin: 1.5em; }}
table {{ border-collapse: collapse; }}
th, td {{ border-bottom: 1px solid #ccc; padding: .3em .6em; text-align: left; vertical-align: top; }}
tbody td:first-child {{ white-space: nowrap; }}
thead th {{ position: sticky; top: 0; background: #eee; cursor: pointer; }}
th[aria-sort=ascending]::after {{ content: " \\25B2"; }}
th[aria-sort=descending]::after {{ content: " \\25BC"; }}
</style></head><body>
<h1>{title}</h1>
{body}
</body></html>
"""

SORTING = """<script>
const body = document.querySelector("tbody"), rows = [...body.rows], heads = [...document.querySelectorAll("thead th")];
const number = text => text.trim() === "" ? NaN : Number(text);
function compare(one, other) {
  const [x, y] = [number(one), number(other)];
  if (!isNaN(x) && !isNaN(y)) return x - y;
  return isNaN(x) - isNaN(y) || one.localeCompare(other);  // numbers before words
}
function sort(head) {
  const rising = head.ariaSort !== "ascending", column = head.cellIndex;
  heads.forEach(other => other.removeAttribute("aria-sort"));
  head.ariaSort = rising ? "ascending" : "descending";
  rows.sort((a, b) => (rising ? 1 : -1) * compare(a.cells[column].textContent, b.cells[column].textContent));
  body.append(...rows);
}
function search(words) {
  rows.forEach(row => row.hidden = !words.every(word => row.textContent.toLowerCase().includes(word)));
}
for (const head of heads) {
  head.tabIndex = 0;
  head.onclick = () => sort(head);
  head.onkeydown = event => { if (event.key === "Enter") sort(head); };
}
document.querySelector("input").oninput = event => search(event.target.value.toLowerCase().split(/\\s+/));
</script>"""


class Entry(NamedTuple):
    """A figure or a table in the report.

    Attributes:
        section: one of `SECTIONS`.
        part: of the section, or None.
        about: what it shows, a few words.
    """

    section: str
    part: str | None
    about: str


def entry_of(path: str | Path) -> Entry:
    """Where the figure or table of a file stands, and what it shows: read from the file, which is not run.

    A name that begins with a paper's stands under `Papers`; any other file has a line `SECTION = "..."`. What it shows is
    the beginning of the file's first line.

    Raises:
        ConfigError: no section, or one that there is not.
    """
    path = Path(path)
    tree = ast.parse(path.read_text(encoding="utf-8"), str(path))
    begin, _, _ = path.stem.partition("_")
    paper = PAPERS.get(begin)
    section = "Papers" if paper else _written(tree, "SECTION")
    if section not in SECTIONS:
        raise ConfigError(f"{path.name}: SECTION", section, f"allowed are {', '.join(SECTIONS)}")
    about = (ast.get_docstring(tree) or path.stem).splitlines()[0].removeprefix(begin).strip(" ,:.")
    return Entry(section, paper, shorten(about, WIDTH, placeholder=" ..."))


def table_page(table: "pd.DataFrame", title: str) -> str:
    """A table as a page of its own, nothing to load from elsewhere: a click on a head sorts by it, a field searches."""
    shown = table.to_html(index=False, border=0, na_rep="", float_format=lambda value: f"{value:.6g}")
    search = '<p><label>Search: <input type="search"></label></p>'
    return PAGE.format(title=escape(title), body="\n".join((search, shown, SORTING)))


def configuration_page(config: Mapping[str, Any], origins: Iterable[Mapping[str, Any]], packages: Mapping[str, str]) -> str:
    """The configuration, the versions that made the datasets, and those that draw and report, as a page.

    Args:
        config: as it was read.
        origins: the `provenance` of each dataset.
        packages: version of each package that is installed now.
    """
    import yaml

    from granugas.storage.provenance import merge

    made = merge({key: value for key, value in origin.items() if key != "parameters"} for origin in origins)
    rows = {key: value if isinstance(value, str) else json.dumps(value) for key, value in made.items()}
    parts = [
        ("The datasets were made with", _rows(rows)),
        ("Figures and tables were made with", _rows(packages)),
        ("Configuration", f"<pre>{escape(yaml.safe_dump(config, sort_keys=False, width=120))}</pre>"),
    ]
    return PAGE.format(title="Configuration and versions", body="\n".join(f"<h2>{head}</h2>\n{text}" for head, text in parts))


def _rows(values: Mapping[str, str]) -> str:
    lines = (f"<tr><td>{escape(key)}</td><td>{escape(value)}</td></tr>" for key, value in values.items())
    return "<table>\n" + "\n".join(lines) + "\n</table>"


def _written(tree: ast.Module, name: str) -> Any:
    for statement in tree.body:
        if isinstance(statement, ast.Assign) and getattr(statement.targets[0], "id", "") == name:
            return ast.literal_eval(statement.value)
    return MISSING

"""The site as `make docs` builds it: no warning, nothing loaded from elsewhere, no dead link, the notebook's pictures in it."""

import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag

import pytest
from docs.blocks import TEXTS
from workflow.project import ROOT

pytestmark = pytest.mark.full

LOADED = {"script": "src", "img": "src", "iframe": "src", "video": "src", "source": "src", "link": "href"}
OUTSIDE = re.compile(r"^(?:[a-z]+:)?//|^[a-z]+:(?!//)(?!image/)", re.I)


class Addresses(HTMLParser):
    """What a page loads, where its links lead, and the names of places in it."""

    def __init__(self, page: Path) -> None:
        super().__init__()
        self.loaded: list[str] = []
        self.links: list[str] = []
        self.places: set[str] = set()
        self.feed(page.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        if tag in LOADED and (address := given.get(LOADED[tag])):
            self.loaded.append(address)
        if tag == "a" and (address := given.get("href")):
            self.links.append(address)
        if place := given.get("id"):
            self.places.add(place)


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The built site."""
    folder = tmp_path_factory.mktemp("site")
    places = ["-d", folder / "doctrees", ROOT / "docs", folder / "html"]
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", *places]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert done.returncode == 0 and done.stdout == "", done.stdout
    return folder / "html"


@pytest.fixture(scope="module")
def pages(site: Path) -> dict[Path, Addresses]:
    """Its pages."""
    return {page: Addresses(page) for page in site.rglob("*.html")}


def test_every_text_is_a_page(site, pages):
    for text in TEXTS:
        assert site / text.relative_to("docs").with_suffix(".html") in pages


def test_nothing_is_loaded_from_elsewhere(site, pages):
    found = {address for page in pages.values() for address in page.loaded if OUTSIDE.match(address)}
    assert {address for address in found if not address.startswith("data:")} == set()
    for sheet in site.rglob("*.css"):
        addresses = re.findall(r"url\(\s*[\"']?([^\"')]+)|@import\s+[\"']([^\"']+)", sheet.read_text(encoding="utf-8"))
        assert [one for pair in addresses for one in pair if re.match(r"(?:https?:)?//", one)] == [], sheet


def test_what_is_loaded_or_linked_is_there(pages):
    for page, addresses in pages.items():
        for address in addresses.loaded + addresses.links:
            if OUTSIDE.match(address):
                continue
            path, place = urldefrag(address)
            target = (page.parent / unquote(path.partition("?")[0])).resolve() if path else page
            target = target / "index.html" if target.is_dir() else target
            assert target.exists(), f"{page.name}: {address}"
            if place and target in pages:
                assert unquote(place) in pages[target].places, f"{page.name}: {address}"


def test_formulas_are_mathml(site):
    text = (site / "physics.html").read_text(encoding="utf-8")
    assert text.count('display="block"') == len(re.findall(r"^\$\$ \(", (ROOT / "docs/physics.md").read_text(), re.M)) >= 10
    assert (
        "<mfrac>" in text
        and "<msqrt>" in text
        and not any("mathjax" in address for address in Addresses(site / "physics.html").loaded)
    )
    assert not re.search(r"\$\$|\\frac", re.sub(r"<pre>.*?</pre>", "", text, flags=re.S))


def test_the_notebook_was_run(site):
    text = (site / "first_result.html").read_text(encoding="utf-8")
    assert text.count("cell_output") >= 7 and text.count("<img") >= 3
    assert re.search(r"\d+ collisions", text) and "Traceback" not in text


def test_the_reference_is_filled(site):
    python = (site / "reference/python.html").read_text(encoding="utf-8")
    for name in ("Scene", "simulate", "find_clusters", "load_study", "equilibrate", "warm_up", "SceneError"):
        assert f'id="granugas.{name}"' in python
    assert 'id="granugas.analysis.theory.homogeneous_cooling"' in (site / "reference/theory.html").read_text()
    assert "restitution" in (site / "reference/configuration.html").read_text()

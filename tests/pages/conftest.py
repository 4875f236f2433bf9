"""Pages in the distribution's Chromium: `make test-pages`."""

import shutil
from dataclasses import dataclass, field

import pytest

FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking"]
FLAGS += ["--disable-component-update", "--disable-sync"]


def pytest_collection_modifyitems(items):
    for item in items:
        if "pages" in item.path.parts:
            item.add_marker("pages")


@dataclass
class Heard:
    """What a page said and asked for."""

    errors: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)


@pytest.fixture(scope="session")
def browser():
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=FLAGS)
        yield chromium
        chromium.close()


@pytest.fixture
def opened(browser):
    """The function that opens a file, and fails where the page complains or asks the network for anything."""
    pages = []

    def open_file(path, **options):
        page, heard = browser.new_page(viewport={"width": 1440, "height": 900}, **options), Heard()
        page.on("console", lambda said: heard.errors.append(said.text))
        page.on("pageerror", lambda error: heard.errors.append(str(error)))
        page.on("request", lambda request: heard.requests.append(request.url))
        pages.append((page, heard, path.as_uri()))
        page.goto(path.as_uri())
        page.locator("#time", has_text="s").wait_for()
        return page

    yield open_file
    for page, heard, address in pages:
        page.close()
        assert heard.errors == []
        assert {url for url in heard.requests if not url.startswith("blob:")} == {address}

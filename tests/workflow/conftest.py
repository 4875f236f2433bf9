"""Projects to run the workflow in."""

from pathlib import Path

import pytest
from workflow.project import ROOT, Project, copy_of_sources


@pytest.fixture
def project(tmp_path: Path) -> Project:
    """The sources as they are, and an empty folder."""
    (tmp_path / "work").mkdir()
    return Project(ROOT, tmp_path / "work")


@pytest.fixture
def editable_copy(tmp_path: Path) -> Project:
    """A copy of the sources, and an empty folder."""
    return _copied(tmp_path)


@pytest.fixture(scope="module")
def editable_project(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """A copy of the sources, and an empty folder, for all tests of a file."""
    return _copied(tmp_path_factory.mktemp("project"))


def _copied(folder: Path) -> Project:
    for name in ("sources", "work"):
        (folder / name).mkdir()
    return Project(copy_of_sources(folder / "sources"), folder / "work")

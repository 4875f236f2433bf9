import json
import subprocess
import sys

import pytest

from granugas.storage import gallery
from granugas.storage.dataset import pool, read, write


@pytest.fixture
def results(tmp_path, make_run):
    for name in (
        "figures/fig8.png",
        "figures/fig8.pdf",
        "powers.csv",
        "claims.md",
        "figures/notes.txt",
        "preview/figures/fig8.png",
    ):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(name)
    write(pool([make_run(0)], ["restitution"]), tmp_path / "studies/scan.nc")
    write(make_run(1), tmp_path / "experiments/one.nc")
    return tmp_path


def test_figures_and_tables_are_copied_under_their_names_with_their_origin(results):
    copies = gallery.collect(results)
    assert {path.name for path in copies} == {"fig8.png", "fig8.pdf", "powers.csv", "claims.md"}
    assert (results / "gallery/fig8.png").read_text() == "figures/fig8.png"
    assert {path.name for path in (results / "gallery").iterdir()} == {path.name for path in copies} | {"PROVENANCE.json"}
    origin = json.loads((results / "gallery/PROVENANCE.json").read_text())
    study = read(results / "studies/scan.nc")
    assert origin["studies"]["scan"]["content_sha256"] == study.attrs["content_sha256"]
    assert origin["experiments"]["one"]["content_sha256"] == read(results / "experiments/one.nc").attrs["content_sha256"]
    assert {"commit", "package", "python", "libraries", "engine"} <= set(origin) and "parameters" not in origin


def test_too_much_or_nothing_is_refused(results, monkeypatch):
    monkeypatch.setattr(gallery, "LIMIT", 10)
    with pytest.raises(ValueError, match=r"allowed are 1e-05 MB; the largest is .*fig8"):
        gallery.collect(results)
    for path in (results / "figures").glob("fig8*"):
        path.unlink()
    command = [sys.executable, "-m", "granugas.storage.gallery", results]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 1 and "no figures here" in done.stderr and "Traceback" not in done.stderr
    assert not (results / "gallery").exists()

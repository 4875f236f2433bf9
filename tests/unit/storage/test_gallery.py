import json
import shutil
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


def renewed(folder, figure, make_run):
    """Another folder of results with the same gallery: one new figure, one study and one experiment made again."""
    for name in (f"{figure}.png", f"{figure}.pdf"):
        (folder / "figures").mkdir(parents=True, exist_ok=True)
        (folder / "figures" / name).write_text("new " + name)
    write(pool([make_run(2)], ["restitution"]), folder / "studies/other.nc")
    write(make_run(3), folder / "experiments/one.nc")
    return folder


def test_a_build_of_some_figures_renews_those_and_keeps_the_rest(results, make_run, tmp_path_factory, monkeypatch):
    monkeypatch.setattr(gallery, "provenance", lambda _: {"commit": "old", "parameters": {}})
    gallery.collect(results)
    before = json.loads((results / "gallery/PROVENANCE.json").read_text())
    partial = renewed(tmp_path_factory.mktemp("partial"), "fig9", make_run)
    shutil.copytree(results / "gallery", partial / "gallery")
    monkeypatch.setattr(gallery, "provenance", lambda _: {"commit": "new", "parameters": {}})
    copies = gallery.collect(partial)
    assert {path.name for path in copies} == {"fig9.png", "fig9.pdf"}
    assert (partial / "gallery/fig8.png").read_text() == "figures/fig8.png"
    after = json.loads((partial / "gallery/PROVENANCE.json").read_text())
    assert after["commit"] == "new"
    assert after["files"] == dict.fromkeys(["claims.md", "fig8.pdf", "fig8.png"], "old") | dict.fromkeys(
        ["fig9.pdf", "fig9.png"], "new"
    ) | {"powers.csv": "old"}
    assert after["studies"]["scan"] == before["studies"]["scan"] and set(after["studies"]) == {"other", "scan"}
    assert after["experiments"]["one"]["content_sha256"] == read(partial / "experiments/one.nc").attrs["content_sha256"]
    assert after["experiments"]["one"] != before["experiments"]["one"]


def test_a_gallery_without_notes_on_files_gives_them_its_own_commit(results):
    gallery.collect(results)
    note = results / "gallery/PROVENANCE.json"
    note.write_text(json.dumps({"commit": "ancient"}))
    (results / "gallery/fig1.png").write_text("of then")
    gallery.collect(results)
    files = json.loads(note.read_text())["files"]
    assert files["fig1.png"] == "ancient" and files["fig8.png"] != "ancient" and "PROVENANCE.json" not in files


def test_what_is_kept_counts_too(results, monkeypatch):
    (results / "gallery").mkdir()
    (results / "gallery/film.mp4").write_bytes(bytes(1000))
    (results / "gallery/fig8.png").write_bytes(bytes(1000))  # is replaced
    new = sum(path.stat().st_size for pattern in ("figures/fig8.*", "*.csv", "*.md") for path in results.glob(pattern))
    monkeypatch.setattr(gallery, "LIMIT", 1000 + new - 1)
    with pytest.raises(ValueError, match=r"the largest is .*gallery/film.mp4"):
        gallery.collect(results)
    monkeypatch.setattr(gallery, "LIMIT", 1000 + new)
    assert gallery.collect(results)


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

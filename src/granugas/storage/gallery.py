"""The gallery: final figures and tables of a full run, with a note of where they come from.

python -m granugas.storage.gallery results
"""

import json
import shutil
import sys
from collections.abc import Collection, Iterable
from pathlib import Path
from typing import Any

import netCDF4

from granugas.storage.files import replacing
from granugas.storage.provenance import provenance

NOTE = "PROVENANCE.json"

LIMIT = 20e6
"""Bytes that a gallery may have: it is kept under version control."""


def collect(results: str | Path) -> list[Path]:
    """Copy figures and tables of `results` into `results/gallery`, names kept, with a PROVENANCE.json beside them.

    What is in the gallery already and not in `results` stays as it is, origin and all: a build of some figures renews
    those. To begin afresh remove the gallery first.

    Returns:
        The copies.

    Raises:
        ValueError: no figure there, or more than 20 MB in all.
    """
    results = Path(results)
    patterns = ("figures/*.png", "figures/*.pdf", "figures/*.mp4", "*.csv", "*.md")
    files = sorted(path for pattern in patterns for path in results.glob(pattern))
    if not any(path.parent.name == "figures" for path in files):
        raise ValueError(f"{results}: no figures here; `make figures` builds them")
    gallery = results / "gallery"
    _refuse_too_much({path.name: path for path in (*gallery.glob("*.*"), *files) if path.name != NOTE}.values(), results)
    gallery.mkdir(exist_ok=True)
    origin = _renewed(gallery / NOTE, results, files)
    with replacing(gallery / NOTE) as note:
        note.write_text(json.dumps(origin, indent=2) + "\n")
    return [Path(shutil.copyfile(path, gallery / path.name)) for path in files]


def _refuse_too_much(files: Collection[Path], results: Path) -> None:
    size = sum(path.stat().st_size for path in files)
    if size > LIMIT:
        largest = max(files, key=lambda path: path.stat().st_size)
        raise ValueError(f"{results}: {size / 1e6:.1f} MB, allowed are {LIMIT / 1e6:g} MB; the largest is {largest}")


def _renewed(note: Path, results: Path, files: Iterable[Path]) -> dict[str, Any]:
    """Where the gallery comes from: each copy's commit, and studies and experiments; those of before stay if not there now."""
    before = json.loads(note.read_text()) if note.exists() else {}
    origin = provenance({})
    del origin["parameters"]  # each study has its own
    kept = {path.name: before.get("commit") for path in note.parent.glob("*.*") if path != note}
    drawn = {path.name: origin["commit"] for path in files}
    origin["files"] = dict(sorted((kept | before.get("files", {}) | drawn).items()))
    for kind in ("studies", "experiments"):
        found = {path.stem: _origin_of(path) for path in results.glob(f"{kind}/*.nc")}
        origin[kind] = dict(sorted((before.get(kind, {}) | found).items()))
    return origin


def _origin_of(path: Path) -> dict[str, object]:
    with netCDF4.Dataset(path) as file:
        origin = json.loads(file.provenance)
        return {"content_sha256": file.content_sha256, "commit": origin["commit"], "engine": origin["engine"]}


if __name__ == "__main__":
    try:
        print(*collect(sys.argv[1]), sep="\n")
    except ValueError as error:
        sys.exit(f"gallery: {error}")

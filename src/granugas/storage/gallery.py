"""The gallery: final figures and tables of a full run, with a note of where they come from.

python -m granugas.storage.gallery results
"""

import json
import shutil
import sys
from pathlib import Path

import netCDF4

from granugas.storage.files import replacing
from granugas.storage.provenance import provenance

LIMIT = 20e6
"""Bytes that a gallery may have: it is kept under version control."""


def collect(results: str | Path) -> list[Path]:
    """Copy figures and tables of `results` into `results/gallery`, names kept, with a PROVENANCE.json beside them.

    Returns:
        The copies.

    Raises:
        ValueError: no figure there, or more than 20 MB of them.
    """
    results = Path(results)
    patterns = ("figures/*.png", "figures/*.pdf", "figures/*.mp4", "*.csv", "*.md")
    files = sorted(path for pattern in patterns for path in results.glob(pattern))
    if not any(path.parent.name == "figures" for path in files):
        raise ValueError(f"{results}: no figures here; `make figures` builds them")
    size = sum(path.stat().st_size for path in files)
    if size > LIMIT:
        largest = max(files, key=lambda path: path.stat().st_size)
        raise ValueError(f"{results}: {size / 1e6:.1f} MB, allowed are {LIMIT / 1e6:g} MB; the largest is {largest}")
    origin = provenance({})
    del origin["parameters"]  # each study has its own
    for kind in ("studies", "experiments"):
        origin[kind] = {path.stem: _origin_of(path) for path in sorted(results.glob(f"{kind}/*.nc"))}
    gallery = results / "gallery"
    gallery.mkdir(exist_ok=True)
    with replacing(gallery / "PROVENANCE.json") as note:
        note.write_text(json.dumps(origin, indent=2) + "\n")
    return [Path(shutil.copyfile(path, gallery / path.name)) for path in files]


def _origin_of(path: Path) -> dict[str, object]:
    with netCDF4.Dataset(path) as file:
        origin = json.loads(file.provenance)
        return {"content_sha256": file.content_sha256, "commit": origin["commit"], "engine": origin["engine"]}


if __name__ == "__main__":
    try:
        print(*collect(sys.argv[1]), sep="\n")
    except ValueError as error:
        sys.exit(f"gallery: {error}")

"""What all files have in common: whole or not there, chunks that suit a reader, labels as CF wants them."""

import os
import shutil
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from importlib.metadata import version
from math import prod
from pathlib import Path
from typing import Any

import xarray as xr

CHUNK = 2**17
"""Numbers in a chunk of a file, at most: 1 MiB of float64."""


@contextmanager
def replacing(path: str | Path) -> Iterator[Path]:
    """A temporary path beside `path`, which becomes `path` when all went well and is removed when not.

    Nobody ever sees half a file, and two processes that write the same one do not meet.

    Raises:
        OSError: it cannot be written; says which file, why, and how much room there is.
    """
    path = Path(path)
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        yield temporary
        os.replace(temporary, path)
    except (OSError, RuntimeError) as error:  # netCDF's errors are of both kinds
        raise OSError(f"{path}: not written ({error}; {_free(path) / 1e6:.0f} MB are free)") from error
    finally:
        with suppress(OSError):
            temporary.unlink(missing_ok=True)


def _free(path: Path) -> int:
    """Bytes that are free where a file is to be."""
    return shutil.disk_usage(next(folder for folder in path.absolute().parents if folder.exists())).free


def chunk_sizes(shape: Sequence[int]) -> tuple[int, ...]:
    """Chunks that hold the last dimensions whole: one run, one time step lies together."""
    sizes = list(shape)
    for i in range(len(sizes)):
        if prod(sizes) > CHUNK:
            sizes[i] = max(1, min(sizes[i], CHUNK // prod(sizes[i + 1 :])))
    return tuple(sizes)


def encoding(dataset: xr.Dataset) -> dict[str, dict[str, Any]]:
    """How each variable is stored: numbers compressed in chunks, coordinates without a mark of what is missing."""
    stored: dict[str, dict[str, Any]] = {}
    for key, variable in dataset.variables.items():
        name = str(key)
        stored[name] = {"_FillValue": None} if name in dataset.coords else {}
        if variable.size and variable.ndim and variable.dtype.kind in "fiub":
            stored[name] |= {"zlib": True, "complevel": 1, "chunksizes": chunk_sizes(variable.shape)}
    return stored


def labels() -> dict[str, str]:
    """Global attributes of a file; without the date, so that equal data give equal files."""
    return {
        "Conventions": "CF-1.11",
        "title": "Freely cooling granular gas",
        "history": f"written by granugas {version('granugas')}",
    }

"""Datasets on disk: written whole with their provenance and a digest of their content, read back as they were.

The rest of what storage offers can be had from here too: the table of variables, the pooling of runs, packed positions.
"""

import hashlib
import json
import logging
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from granugas.cost import input_output
from granugas.storage.damage import DamagedFile, reading, seal
from granugas.storage.files import encoding, labels, replacing
from granugas.storage.pooling import pool, tell_stops, with_errors
from granugas.storage.positions import read_positions, write_positions
from granugas.storage.provenance import plain, provenance
from granugas.storage.variables import VARIABLES, Variable, describe

__all__ = [
    "VARIABLES",
    "Variable",
    "content_sha256",
    "describe",
    "load_study",
    "pool",
    "read",
    "read_by_name",
    "read_or_make",
    "read_positions",
    "tell_stops",
    "with_errors",
    "write",
    "write_positions",
]

NOT_CONTENT = ("wall_time", "cpu_", "provenance", "content_sha256", "history", "title", "Conventions")
"""Beginnings of the names that `content_sha256` passes over."""

BLOCK = 2**20
"""Numbers that are digested at a time."""


logger = logging.getLogger("granugas")


def content_sha256(dataset: xr.Dataset) -> str:
    """Hexadecimal SHA-256 of what a dataset says: names, dimensions, values, and attributes but those of the table.

    The order of variables, the width and byte order of numbers, chunks and the bits of a NaN do not count, so a dataset
    in memory and the file it is written to have the same digest. Passed over are `wall_time*`, `cpu_*`, the provenance
    and the labels of a file: two runs of one seed agree.
    """
    total = hashlib.sha256()
    total.update(_text(_content_of(dataset.attrs)))
    for name in sorted(_content_of(dataset.variables)):
        variable = dataset.variables[name]
        own = {key: value for key, value in variable.attrs.items() if key not in Variable._fields}
        kind = {"f": "real", "i": "whole", "u": "whole", "b": "whole"}.get(variable.dtype.kind, "text")
        total.update(_text([name, kind, variable.dims, variable.shape, own]))
        for block in _blocks(variable.values, kind):
            total.update(block)
    return total.hexdigest()


@input_output
def write(dataset: xr.Dataset, path: str | Path, parameters: Mapping[str, Any] | None = None) -> None:
    """Write a netCDF file (CF-1.11, compressed) that is either whole or not there; equal data give equal files.

    Args:
        dataset: any of the table's variables; they are described on the way.
        path: its folder is made.
        parameters: all that was asked for, for the provenance; without them the provenance that the dataset has stays,
            and one without any gets the dataset's attributes as parameters.

    Raises:
        KeyError: a variable that is not in the table.
    """
    described = describe(dataset)
    described.attrs = labels() | described.attrs
    described.attrs["content_sha256"] = content_sha256(described)
    if parameters is not None or "provenance" not in described.attrs:
        asked = _content_of(dataset.attrs) if parameters is None else parameters
        described.attrs["provenance"] = json.dumps(provenance(asked), sort_keys=True)
    with replacing(path) as temporary:
        described.to_netcdf(temporary, engine="netcdf4", encoding=encoding(described))
        seal(temporary)


@input_output
def read(path: str | Path) -> xr.Dataset:
    """The dataset of a file, in memory, the file closed.

    Raises:
        FileNotFoundError: no such file.
        DamagedFile: it is not what was written.
    """
    with reading(path):
        return xr.load_dataset(path, engine="netcdf4", decode_times=False)


def read_or_make(path: str | Path, make: Callable[[], xr.Dataset]) -> xr.Dataset:
    """The dataset of a file; where it is damaged it is made and written again, and the log says so.

    The new file has the date zero: it is the same as before, and what was made from that one is not out of date.

    Raises:
        FileNotFoundError: no such file.
    """
    try:
        return read(path)
    except DamagedFile as error:
        logger.warning("%s: it is damaged and made again", error.path)
        write(make(), path)
        os.utime(path, (0, 0))
        return read(path)


def read_by_name(paths: Iterable[str | Path]) -> dict[str, xr.Dataset]:
    """The datasets of files by the files' names, those of studies and experiments: checked, then read where they are used.

    Of a table (.csv) the columns, over `index`.

    Raises:
        FileNotFoundError: no such file.
        DamagedFile: as `read` says.
    """
    files = {path.stem: path for path in map(Path, paths)}
    return {name: _table(path) if path.suffix == ".csv" else read_positions(path) for name, path in files.items()}


def load_study(study: str | Path, output: str | Path = "results") -> xr.Dataset:
    """The pooled dataset of a study, in memory, checked against its seal.

    Every variable is labelled (`units`, `long_name`, `symbol`, `equation`), over the keys of the study's grid, `realization`
    and its own dimensions; NaN where a run had ended. `<variable>_error` is the standard error of its mean over
    realizations, where there are several.

        study = gg.load_study("cluster1999_large")
        study["mean_cluster_size"].mean("realization").sel(distance_factor=1.1).plot(xscale="log", yscale="log")

    Args:
        study: its name, or the path of its file, which ends in `.nc`.
        output: folder of the results, where a name is given: the key `output` of the configuration.

    Raises:
        FileNotFoundError: no such file; names the studies that are there.
        DamagedFile: it is not what was written.
    """
    path = Path(study) if Path(study).suffix == ".nc" else Path(output) / f"studies/{study}.nc"
    if not path.exists():
        there = ", ".join(sorted(other.stem for other in path.parent.glob("*.nc"))) or "none"
        raise FileNotFoundError(f"{path}: no such study; in {path.parent} there are: {there}")
    return read(path)


def _table(path: Path) -> xr.Dataset:
    return xr.Dataset.from_dataframe(pd.read_csv(path))


def _content_of(named: Mapping[Any, Any]) -> dict[str, Any]:
    return {name: value for name, value in named.items() if not str(name).startswith(NOT_CONTENT)}


def _text(value: Any) -> bytes:
    return json.dumps(plain(value), sort_keys=True).encode()


def _blocks(values: np.ndarray, kind: str) -> Iterator[bytes]:
    """The values in one width and byte order, piece by piece."""
    flat = np.ravel(values)
    for start in range(0, flat.size, BLOCK):
        block = flat[start : start + BLOCK]
        if kind == "text":
            yield _text(block.astype(str).tolist())
        elif kind == "whole":
            yield block.astype("<i8").tobytes()
        else:
            block = block.astype("<f8")
            block[np.isnan(block)] = np.nan
            yield block.tobytes()

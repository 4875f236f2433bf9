"""Where a dataset comes from: versions, sources, parameters, machine."""

import os
import platform
import subprocess
from collections.abc import Iterable, Mapping
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from granugas.digest import physics

LIBRARIES = ("numpy", "numba", "xarray", "netCDF4")


def provenance(parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Everything that is needed to make a dataset again, as plain values that JSON can hold.

    Args:
        parameters: all that was asked for: scene, seed, realization, until, samples and so on.
    """
    return {
        "package": f"granugas {version('granugas')}",
        "commit": commit(),
        "engine": physics(),
        "parameters": plain(parameters),
        "machine": f"{platform.machine()}, {os.cpu_count()} processors, {platform.system()} {platform.release()}",
        "python": platform.python_version(),
        "libraries": {name: version(name) for name in LIBRARIES},
    }


def merge(provenances: Iterable[Mapping[str, Any]]) -> dict[str, Any]:
    """One provenance of many: what all have in common stays, what differs becomes the list of its values."""
    collected: dict[str, list[Any]] = {}
    for provenance in provenances:
        for key, value in provenance.items():
            collected.setdefault(key, []).append(value)
    return {key: _merge_values(values) for key, values in collected.items()}


def commit() -> str:
    """The git commit of the package's sources, with `-dirty` after it where files were changed since; or "unknown"."""
    folder = Path(__file__).parent
    command = ["git", "-C", str(folder)]
    try:
        subprocess.run([*command, "cat-file", "-e", f"HEAD:./{Path(__file__).name}"], check=True, capture_output=True)
        described = subprocess.run(
            [*command, "describe", "--always", "--dirty", "--abbrev=40", "--exclude=*"],
            check=True,
            capture_output=True,
            text=True,
        )
    except (OSError, subprocess.CalledProcessError):
        return "unknown"
    return described.stdout.strip()


def plain(value: Any) -> Any:
    """The value as dicts, lists, numbers and texts; a sequence of one is that one, as a netCDF attribute has it."""
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple, set, np.ndarray)):
        items = [plain(item) for item in value]
        return items[0] if len(items) == 1 else items
    return value.item() if isinstance(value, np.generic) else value


def _merge_values(values: list[Any]) -> Any:
    if all(isinstance(value, Mapping) for value in values):
        return merge(values)
    distinct = [value for i, value in enumerate(values) if value not in values[:i]]
    return distinct[0] if len(distinct) == 1 else distinct

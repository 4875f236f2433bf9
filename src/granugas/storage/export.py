"""Snapshots for programs that look at particles: extended XYZ, which OVITO and ASE read."""

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from granugas.storage.files import replacing

if TYPE_CHECKING:
    from extxyz import Frame

SPECIES = "X"
"""Name of all particles: an element that is none."""

COLUMNS = {
    "particle_mass": "mass",
    "spin": "angular_velocity",
    "initial_y": "initial_y",
    "last_collision_time": "last_collision_time",
    "collision_frequency": "collision_frequency",
}
"""What else a particle has, and the names of its columns; others have names that readers know."""

OWN = ("time", "snapshot", "particle", "axis")
"""Dimensions that one run has."""

EXACT = {"R": "%.16e", "I": "%d", "S": "%s"}
"""Numbers come back as they were, to the last bit."""


def export_snapshots(run: xr.Dataset, path: str | Path, time: float | None = None) -> int:
    """Write snapshots of a run as extended XYZ, one frame each; a run without snapshots has its kept positions as frames.

    A frame has the box (the periodic axes are marked), `time` (s), and for each particle `id`, `pos` (m), `velo` (m/s),
    `radius` (m), and those of mass, spin, height at t = 0, last collision and collision frequency that the run has for all of
    them: the format knows no missing numbers. In fewer than three dimensions the rest of each vector is 0, and the box one mean
    diameter high.

    Args:
        run: dataset of one run, or of a study with one run selected: `study.sel(restitution=0.4, realization=0)`.
        path: of the file; its folder is made.
        time: s, one of the snapshots; all of them unless it is given.

    Returns:
        The number of frames.

    Raises:
        ValueError: no positions, more than one run, no snapshot at this time, or the package `extxyz` (extra `export`) missing.
    """
    try:
        from extxyz import write_dicts
    except ModuleNotFoundError as error:
        raise ValueError("export: the package extxyz is missing; `pip install granugas[export]` brings it") from error
    run = run.squeeze([dim for dim, size in run.sizes.items() if size == 1 and dim not in OWN])
    name, along = ("position", "snapshot") if "position" in run else ("trajectory", "time")
    if name not in run:
        raise ValueError("export: the run kept no positions; `--snapshots` or `--keep-positions` of `run` do that")
    if several := [str(dim) for dim in run[name].dims if dim not in OWN]:
        raise ValueError(f"export: several runs, select one of them along {', '.join(several)}")
    frames = [_frame(run.sel({along: at}), name, float(at)) for at in _times(run, along, time)]
    with replacing(path) as temporary:
        write_dicts(str(temporary), frames, use_cextxyz=False, format_dict=EXACT)
    return len(frames)


def _times(run: xr.Dataset, along: str, time: float | None) -> np.ndarray:
    """Coordinates of the frames."""
    times = np.atleast_1d(run[along].values)
    chosen = times if time is None else times[np.isclose(times, time, rtol=1e-9, atol=0.0)]
    if not len(chosen):
        raise ValueError(f"snapshot = {time}: there is none at this time; there are {', '.join(f'{t:.6g}' for t in times)} s")
    return chosen


def _frame(run: xr.Dataset, name: str, time: float) -> "Frame":
    from extxyz import Frame

    there = np.isfinite(run[name].values).all(axis=-1)
    position = run[name].values[there]
    n, dimensions = position.shape
    axes = "xyz"[:dimensions]
    words = str(_of_the_run(run, "boundary", "periodic")).split()
    edges = words * dimensions if len(words) == 1 else words
    diameter = float(_of_the_run(run, "diameter"))
    sides = [float(_of_the_run(run, f"box_{axis}")) for axis in axes] + [diameter] * (3 - dimensions)
    diameters = run["particle_diameter"].values[there] if "particle_diameter" in run else np.full(n, diameter)
    columns = {"species": np.full(n, SPECIES), "pos": _in_space(position)}
    if (velocity := "velocity" if name == "position" else "trajectory_velocity") in run:
        columns["velo"] = _in_space(run[velocity].values[there])
    columns |= {"radius": diameters / 2, "id": np.flatnonzero(there) + 1}
    known = {new: run[old].values[there] for old, new in COLUMNS.items() if old in run}
    columns |= {new: values for new, values in known.items() if np.isfinite(values).all()}
    periodic = [edge == "periodic" for edge in edges] + [False] * (3 - dimensions)
    return Frame(n, np.diag(sides), np.array(periodic), {"time": time}, columns)


def _of_the_run(run: xr.Dataset, key: str, otherwise: object = math.nan) -> Any:
    """A parameter: a variable where runs of a study differ in it, else an attribute."""
    return run[key].item() if key in run.variables else run.attrs.get(key, otherwise)


def _in_space(vectors: np.ndarray) -> np.ndarray:
    """(n, 3) of (n, 1), (n, 2) or (n, 3)."""
    return np.pad(vectors, ((0, 0), (0, 3 - vectors.shape[1])))

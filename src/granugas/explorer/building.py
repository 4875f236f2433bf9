"""The page of the explorer: which frames of which runs it holds, and how they are put into one file."""

import json
import logging
import re
from collections.abc import Mapping, Sequence
from importlib.resources import files
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from granugas.explorer.colours import SCALES, LevelsAt, values_of
from granugas.explorer.packing import LARGEST_FACTOR, Grid, frame_of, grid_of, packed
from granugas.storage.dataset import read, read_positions
from granugas.storage.files import replacing

LIMIT = 29e6
"""Bytes of the page, at most."""

FRAMES, LEAST = 40, 4
"""Of a run, at most, and at least: where runs would get fewer, the largest is left out."""

WEIGHT = 3
"""A run whose motion is kept gets so many times the frames of another."""

SCRIPTS = ("packed", "clusters", "camera", "painter", "colours", "overlay", "curves", "panel", "player", "pointer", "main")
WORKER = ("packed", "clusters", "worker")
"""Scripts of the page and of the worker that finds clusters beside it, each after those that it imports."""

SHOWN = ("kinetic_energy", "collisions_per_particle")
CLUSTERS = ("cluster_count", "mean_cluster_size", "largest_cluster_size")

logger = logging.getLogger("granugas")


class Source(NamedTuple):
    """The files of a run.

    Attributes:
        label: what people call it.
        positions: at the sampling times.
        run: its observables.
        clusters: their analysis; None where there is none.
    """

    label: str
    positions: str | Path
    run: str | Path
    clusters: str | Path | None


class Part(NamedTuple):
    """A run on its way into the page: its source, the samples that it could show, and bytes of a frame."""

    source: Source
    samples: int
    bytes: int
    filmed: bool


def write_explorer(sources: Sequence[Source], path: str | Path) -> None:
    """Write the page, whole or not at all.

    Args:
        sources: of runs in two dimensions. What does not fit into LIMIT is left out, and said: first frames, then runs.
        path: of the HTML file.

    Raises:
        ValueError: no run, or none that fits.
        FileNotFoundError, DamagedFile: of a run.
        OSError: the page cannot be written.
    """
    shares = share_out([_part(source) for source in sources])
    if not shares:
        raise ValueError(f"explorer: none of {len(sources)} runs fits into {LIMIT / 1e6:g} MB")
    told, texts = [], []
    for number, (source, frames) in enumerate(shares):
        run, frame_texts = _run_of(source, frames)
        told.append(run)
        texts += [(f"frame-{number}-{k}", text) for k, text in enumerate(frame_texts)]
        logger.info("%s: %d frames, %.1f MB", source.label, len(frame_texts), sum(map(len, frame_texts)) / 1e6)
    with replacing(path) as temporary:
        temporary.write_text(page(told, texts), encoding="utf-8")


def share_out(parts: Sequence[Part]) -> list[tuple[Source, int]]:
    """How many frames each run gets: FRAMES at most, a filmed one WEIGHT times those of another, all within LIMIT."""
    there = list(parts)
    while there:
        for step in range(FRAMES, 0, -1):
            frames = [min(FRAMES, part.samples, step * (WEIGHT if part.filmed else 1)) for part in there]
            fits = sum(number * part.bytes for number, part in zip(frames, there, strict=True)) <= LIMIT
            if fits and all(number >= min(LEAST, part.samples) for number, part in zip(frames, there, strict=True)):
                return [(part.source, number) for part, number in zip(there, frames, strict=True)]
        largest = max(there, key=lambda part: part.bytes)
        there.remove(largest)
        logger.warning("%s: left out of the explorer, whose limit is %g MB", largest.source.label, LIMIT / 1e6)
    return []


def chosen_samples(times: NDArray[np.float64], number: int) -> NDArray[np.int64]:
    """At most so many samples, ascending: the first, the last, and between them those nearest to equal steps of ln t.

    Args:
        times: (time,) in s, ascending from 0; NaN after the end of a run.
    """
    there = np.flatnonzero(np.isfinite(times))
    if len(there) <= number:
        return there
    logarithm = np.log(times[there[1:]])
    steps = np.linspace(logarithm[0], logarithm[-1], number - 1)
    return np.unique([there[0], *there[1:][abs(logarithm - steps[:, np.newaxis]).argmin(axis=1)]])


def page(runs: Sequence[Mapping[str, Any]], frames: Sequence[tuple[str, str]]) -> str:
    """The text of the file from what is known of the runs and the texts of their frames by identifier."""
    scales = {name: scale.as_dict() for name, scale in SCALES.items()}
    known = {"runs": runs, "scales": scales, "largest_factor": LARGEST_FACTOR}
    pieces = {
        "style": _source("page.css"),
        "known": json.dumps(known, ensure_ascii=False, separators=(",", ":"), allow_nan=False).replace("</", "<\\/"),
        "worker": bundle(WORKER),
        "frames": "\n".join(f'<script type="text/plain" id="{name}">{text}</script>' for name, text in frames),
        "main": bundle(SCRIPTS),
    }
    return re.sub(r"\{\{(\w+)\}\}", lambda match: pieces[match[1]], _source("page.html"))


def bundle(names: Sequence[str]) -> str:
    """Modules as one, in order: what they import from each other stands above already."""
    text = "\n".join(_source(f"{name}.js") for name in names)
    return re.sub(r"^export ", "", re.sub(r"^import .*\n", "", text, flags=re.M), flags=re.M)


def _source(name: str) -> str:
    return (files("granugas.explorer") / "page" / name).read_text(encoding="utf-8")


def _part(source: Source) -> Part:
    """What a run needs, from its last frame: it has the most bonds, and heights in no order."""
    with read_positions(source.positions) as run:
        times = _times(run)
        last = np.flatnonzero(np.isfinite(times))[-1]
        _, text = packed(_frame(_grid(run, _factors(source)), run, values_of(run, times), last))
        return Part(source, int(np.isfinite(times).sum()), len(text), "trajectory_velocity" in run)


def _run_of(source: Source, number: int) -> tuple[dict[str, Any], list[str]]:
    """What the page knows of a run, and the texts of its frames."""
    clusters = None if source.clusters is None else read(source.clusters)
    observed = read(source.run)
    with read_positions(source.positions) as run:
        times, grid = _times(run), _grid(run, _factors(source))
        values = values_of(run, times)
        frames, texts = [], []
        for sample in chosen_samples(times, number):
            layout, text = packed(_frame(grid, run, values, sample))
            shown = {name: float(observed[name][sample]) for name in SHOWN}
            frames.append({"time": float(times[sample]), "layout": layout} | shown)
            texts.append(text)
        about = {name: run.attrs[name] for name in ("n_particles", "area_fraction", "restitution", "diameter")}
        told = {
            "label": source.label,
            **{name: value.item() if isinstance(value, np.generic) else value for name, value in about.items()},
            "contact_time": np.atleast_1d(run.attrs["contact_time"]).tolist(),
            "box": (grid.box / run.attrs["diameter"]).tolist(),
            "periodic": grid.periodic.tolist(),
            "largest_diameter": float(grid.diameters.max() / run.attrs["diameter"]),
            "cells": grid.cells.tolist(),
            "bits": grid.bits,
            "margin": grid.margin,
            "factors": grid.factors.tolist(),
            "colours": [*values],
            "frames": frames,
            "curves": None if clusters is None else _curves(clusters, times),
        }
    return told, texts


def _curves(clusters: xr.Dataset, times: NDArray[np.float64]) -> dict[str, Any]:
    """The dataset's own curves at all its samples after t = 0."""
    there = np.isfinite(times) & (times > 0)
    shown = clusters.sel(distance_factor=clusters["distance_factor"] <= LARGEST_FACTOR)
    curves = {name: shown[name].values[:, there].tolist() for name in CLUSTERS}
    return {"time": times[there].tolist(), "distance_factor": shown["distance_factor"].values.tolist()} | curves


def _frame(grid: Grid, run: xr.Dataset, values: Mapping[str, LevelsAt], sample: int) -> dict[str, NDArray[Any]]:
    levels = {name: at(sample) for name, at in values.items()}
    return frame_of(grid, run["trajectory"][sample].values, levels)


def _grid(run: xr.Dataset, factors: Sequence[float]) -> Grid:
    diameters = run["particle_diameter"].values if "particle_diameter" in run else run.attrs["diameter"]
    return grid_of(run.attrs, np.broadcast_to(diameters, run.sizes["particle"]).astype(float), factors)


def _factors(source: Source) -> list[float]:
    """The S_c at which the page is exact: those of the dataset, and 1."""
    return [1.0, *([] if source.clusters is None else read(source.clusters)["distance_factor"].values)]


def _times(run: xr.Dataset) -> NDArray[np.float64]:
    """(time,) of the samples in s, NaN where there are no positions any more."""
    times = run["sampling_time" if "sampling_time" in run else "time"].values.astype(float)
    return np.where(np.isnan(run["trajectory"][:, 0, 0].values), np.nan, times)

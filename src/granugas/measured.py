"""What claims are measured on: the runs of a study, their series, and several numbers with their errors."""

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from granugas.analysis.comparison import interpolated

Numbers = NDArray[np.float64]
Data = Mapping[str, xr.Dataset]
"""Datasets by the names of studies and experiments."""

MANY = 9
"""More numbers than these are told by their extremes."""


class NotMeasured(Exception):
    """The data do not hold what a claim is about; says what is missing."""


def runs(data: Data, study: str, **point: float | int) -> xr.Dataset:
    """The runs of one point of a study's grid; keys with one value that `point` does not name go, others stay dimensions.

    Raises:
        NotMeasured: no such study, or no runs at such a point.
    """
    if study not in data:
        raise NotMeasured(f"no study {study}")
    chosen = data[study]
    for key, wanted in point.items():
        there = np.atleast_1d(chosen[key].values if key in chosen.variables else chosen.attrs[key])
        if not np.isclose(there, wanted, rtol=1e-9, atol=0).any():
            raise NotMeasured(f"{study} has {key} = {in_words(there)}, not {wanted:g}")
        if key in chosen.dims:
            chosen = chosen.isel({key: int(np.argmin(abs(there - wanted)))})
    kept = ("realization", "time", "snapshot", "particle", "axis")
    chosen = chosen.squeeze([dim for dim, size in chosen.sizes.items() if size == 1 and dim not in kept])
    return chosen.dropna("realization", how="all", subset=["kinetic_energy"])


def experiment(data: Data, name: str) -> xr.Dataset:
    """The dataset of an experiment.

    Raises:
        NotMeasured: it is not there.
    """
    if name not in data:
        raise NotMeasured(f"no experiment {name}")
    return data[name]


def enough_runs(found: xr.Dataset, least: int = 3) -> xr.Dataset:
    """The same runs, if the scatter of one to the other can be told from so many.

    Raises:
        NotMeasured: there are fewer.
    """
    if found.sizes["realization"] < least:
        raise NotMeasured(f"fewer than {least} runs")
    return found


def series(values: xr.DataArray) -> Numbers:
    """(realization, sample) of a quantity over time."""
    return values.transpose("realization", "time").to_numpy()


def common(values: xr.DataArray) -> Numbers:
    """(sample,) of what all realizations have in common, like C/N where the samples are taken at collisions: their mean."""
    return values.mean("realization").to_numpy()


def nearest(values: ArrayLike, wanted: float) -> int:
    """Number of the sample whose value is the nearest."""
    return int(np.abs(np.asarray(values) - wanted).argmin())


def at_times(found: xr.Dataset, name: str, times: ArrayLike) -> Numbers:
    """A positive quantity of (realization, time) at these times in s, where the runs were sampled at others."""
    return interpolated(series(found["sampling_time"]), series(found[name]), times)


def last_common(several: Iterable[xr.Dataset], name: str = "sampling_time") -> float:
    """The time in s, or what else grows, that all realizations of all of these reach, a hair before it."""
    return float(min(np.nanmax(series(found[name]), axis=1).min() for found in several)) * (1 - 1e-12)


def elastic_share(found: xr.Dataset, begin: int | None = None) -> Numbers:
    """(realization,) c_e = C_e/C of the collisions between a sample (None: t = 0) and the last one."""
    elastic, every = (series(found[name]) for name in ("elastic_collisions_per_particle", "collisions_per_particle"))
    if begin is None:
        return np.asarray(elastic[:, -1] / every[:, -1])
    return np.asarray((elastic[:, -1] - elastic[:, begin]) / (every[:, -1] - every[:, begin]))


def side_by_side(pairs: Sequence[tuple[ArrayLike, ArrayLike]]) -> tuple[Numbers, Numbers]:
    """Values (n,) and errors (n,) of n measurements, each (value, error)."""
    values, errors = zip(*pairs, strict=True)
    return np.array(values, dtype=float), np.array(errors, dtype=float)


def in_words(values: ArrayLike, figures: int = 4) -> str:
    """A few numbers in full, many by the least and the largest."""
    values = np.ravel(values)
    if len(values) > MANY:
        return f"{np.nanmin(values):.{figures}g} to {np.nanmax(values):.{figures}g} ({len(values)} values)"
    return ", ".join(f"{number:.{figures}g}" for number in values)

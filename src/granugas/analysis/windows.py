"""Averages over windows of the time of a run, from its samples.

A window runs from one edge, the number of a sample, to the next: what happened between the two samples, and the snapshots
after the first up to the second.
"""

from itertools import pairwise

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

Edges = NDArray[np.int64]

ROUNDING = 1e-9
"""Of times, relative."""


def equal_windows(time: ArrayLike, width: float) -> Edges:
    """Edges (n,) of windows of equal width: the last samples at or before its multiples.

    Args:
        time: (m,), ascending from 0.
        width: in units of time; multiples between the same two samples give one edge.
    """
    time = np.asarray(time, dtype=float)
    ends = width * np.arange(1, int(time[-1] / width * (1 + ROUNDING)) + 1)
    return _samples_at(time, ends)


def growing_windows(time: ArrayLike, first: float, ratio: float) -> Edges:
    """Edges (n,) of windows that end at `first` and then `ratio` times later each: equal ones on a logarithmic axis."""
    time = np.asarray(time, dtype=float)
    count = int(np.log(time[-1] / first) / np.log(ratio) * (1 + ROUNDING))
    return _samples_at(time, first * ratio ** np.arange(count + 1.0))


def ratio_of_changes(part: xr.DataArray, whole: xr.DataArray, edges: Edges) -> xr.DataArray:
    """How much `part` grew in each window by how much `whole` did; NaN where that did not grow.

    Elastic collisions by all collisions is c_e = C_e/C (A Fig. 14), collisions of a particle by time is C_r (A Eq. 18).

    Args:
        part, whole: sums since t = 0 over `time`, and whatever else.
        edges: (n + 1,).

    Returns:
        (..., n) over `time`, without coordinates of time.
    """
    change, by = (_at(values, edges).diff("time") for values in (part, whole))
    return change / by.where(by > 0)


def middles(values: xr.DataArray, edges: Edges) -> xr.DataArray:
    """Means (..., n) of the values at both ends of each window, such as its time."""
    ends = _at(values, edges)
    return ends.rolling(time=2).mean().isel(time=slice(1, None))


def snapshot_means(values: xr.DataArray, edges: Edges, snapshots: int) -> xr.DataArray:
    """Means (..., n) over so many equidistant samples of each window, its end among them; over all where it has fewer.

    Args:
        values: of single instants, over `time`, and whatever else.
        edges: (n + 1,).
        snapshots: how many of a window.
    """
    means = []
    for begin, end in pairwise(edges):
        count = min(snapshots, end - begin)
        taken = end - (end - begin) * np.arange(count) // count
        means.append(values.isel(time=taken).mean("time"))
    return xr.concat(means, "time").transpose(..., "time")


def _samples_at(time: NDArray[np.float64], ends: NDArray[np.float64]) -> Edges:
    """0, then the numbers of the last samples at or before the ends, each once."""
    found = np.searchsorted(time, ends * (1 + ROUNDING), side="right") - 1
    return np.unique(np.concatenate([[0], found]))


def _at(values: xr.DataArray, edges: Edges) -> xr.DataArray:
    """Values at the edges; differences must not be labelled by time, of which they have two."""
    return values.isel(time=edges).drop_vars("time", errors="ignore")

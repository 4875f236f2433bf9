"""Curves compared: how far apart, in which order, from where on different."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

Numbers = NDArray[np.float64]


def log_mean(values: ArrayLike) -> Numbers:
    """(...) ln of the geometric mean over the first axis of positive values (n, ...)."""
    return np.log(np.asarray(values, dtype=float)).mean(axis=0)


def largest_factor(a: ArrayLike, b: ArrayLike) -> float:
    """The largest factor, >= 1, between two curves that are given by their logarithms."""
    return float(np.exp(np.abs(np.asarray(a) - np.asarray(b)).max()))


def smallest_step(values: ArrayLike) -> float:
    """The smallest rise from one value to the next; positive where they ascend."""
    return float(np.diff(values).min())


def onset(x: ArrayLike, deviation: ArrayLike, threshold: float) -> float:
    """The first x at which a deviation is above the threshold; the last x where it never is."""
    above = np.flatnonzero(np.asarray(deviation) > threshold)
    return float(np.asarray(x)[above[0] if len(above) else -1])


def interpolated(x: ArrayLike, y: ArrayLike, at: ArrayLike) -> Numbers:
    """(n, k) Each of n curves at the same places, by straight lines between its points on logarithmic axes.

    Runs that end by collisions have each their own times: here their energies are brought to common ones.

    Args:
        x: (n, m), ascending and positive; a curve ends at its first NaN.
        y: (n, m), positive.
        at: (k,), positive; NaN comes back where a curve does not reach.
    """
    at = np.log(at)
    curves = []
    for abscissa, ordinate in zip(np.log(x), np.log(y), strict=True):
        there = ~np.isnan(abscissa)
        curves.append(np.interp(at, abscissa[there], ordinate[there], left=np.nan, right=np.nan))
    return np.exp(curves)

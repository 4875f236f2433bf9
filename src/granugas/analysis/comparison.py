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

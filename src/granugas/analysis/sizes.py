"""The distribution of cluster sizes (outlook of B section 6), and whether one scaled curve tells it at all times."""

from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from granugas.analysis.statistics import jackknife

Numbers = NDArray[np.float64]

STEPS = 200
"""Places in ln M at which two curves are compared."""


def octaves(numbers: ArrayLike, lower: ArrayLike) -> tuple[Numbers, Numbers, Numbers]:
    """Bins joined to those that begin at 1, 2, 4, 8 ...: so few clusters are large that finer bins stay empty.

    Args:
        numbers: (..., b) clusters in each bin.
        lower: (b,) lower edges of the bins, ascending, all powers of 2 up to the last among them.

    Returns:
        The numbers in the octaves, their lower and upper edges (half-open).
    """
    lower = np.asarray(lower)
    starts = np.flatnonzero((lower & (lower - 1)) == 0)
    return np.add.reduceat(np.asarray(numbers, dtype=float), starts, axis=-1), lower[starts], 2 * lower[starts]


def middle_sizes(lower: ArrayLike, upper: ArrayLike) -> Numbers:
    """Geometric middles of half-open bins of whole sizes, lower <= M < upper."""
    return np.sqrt(np.asarray(lower, dtype=float) * (np.asarray(upper) - 1))


def size_distribution(numbers: ArrayLike, lower: ArrayLike, upper: ArrayLike, n: int) -> Numbers:
    """n(M)/N, clusters of size M a particle: sum M n(M) = N.

    Args:
        numbers: (..., b) clusters in each bin.
        lower, upper: (b,) bins lower <= M < upper.
        n: number of particles N.
    """
    return np.asarray(numbers, dtype=float) / (np.asarray(upper) - np.asarray(lower)) / n


def mass_distribution(numbers: ArrayLike, lower: ArrayLike, upper: ArrayLike, n: int) -> Numbers:
    """M^2 n(M)/N, the share of the particles that is in clusters of size M, by ln M; arguments as `size_distribution`.

    If n(M) = N/s^2 f(M/s) with one growing size s, it is one curve of M/s at all times.
    """
    return size_distribution(numbers, lower, upper, n) * middle_sizes(lower, upper) ** 2


def scaling(
    numbers: ArrayLike, weighted_sizes: ArrayLike, lower: ArrayLike, upper: ArrayLike, n: int, smallest: int
) -> tuple[Numbers, Numbers]:
    """`collapse` of M^2 n(M)/N against M/M_w, from realizations, and its standard error by leaving out one after the other.

    Args:
        numbers: (realizations, t, b) clusters in each bin at t times.
        weighted_sizes: (realizations, t) M_w = sum M_i^2 / N.
        lower, upper: (b,) bins lower <= M < upper.
        n: number of particles N.
        smallest: bins that begin below are left out.
    """
    numbers, weighted = np.asarray(numbers, dtype=float), np.asarray(weighted_sizes, dtype=float)
    kept = np.asarray(lower) >= smallest
    lower, upper = np.asarray(lower)[kept], np.asarray(upper)[kept]

    def of(chosen: NDArray[np.int64]) -> float:
        mean = numbers[chosen.astype(int)][..., kept].mean(axis=0)
        curves = mass_distribution(mean, lower, upper, n)
        return collapse(middle_sizes(lower, upper), curves, weighted[chosen.astype(int)].mean(axis=0))

    return jackknife(of, np.arange(len(numbers)))


def collapse(sizes: ArrayLike, curves: ArrayLike, scales: ArrayLike) -> float:
    """How well curves fall together against M/s: their mean squared distance by that against M; 0 is one curve, 1 no gain.

    The distance of two curves is that of their logarithms, linear between points, where both have points; all pairs of
    curves count by the width of what they share in ln M.

    Args:
        sizes: (b,) M, ascending.
        curves: (t, b) values; what is not positive is no point.
        scales: (t,) s of each curve.

    Returns:
        The ratio; NaN where no two curves share a range or they are equal without scaling.
    """
    before = _mean_square_distance(sizes, curves, np.ones(len(np.atleast_1d(scales))))
    return _mean_square_distance(sizes, curves, scales) / before if before else np.nan


def _mean_square_distance(sizes: ArrayLike, curves: ArrayLike, scales: ArrayLike) -> float:
    points = []
    for curve, scale in zip(np.asarray(curves, dtype=float), np.asarray(scales, dtype=float), strict=True):
        there = curve > 0
        points.append((np.log(np.asarray(sizes)[there] / scale), np.log(curve[there])))
    total = width = 0.0
    for (x, y), (other_x, other_y) in combinations([curve for curve in points if len(curve[0])], 2):
        low, high = max(x[0], other_x[0]), min(x[-1], other_x[-1])
        if high > low:
            shared = np.linspace(low, high, STEPS)
            total += (high - low) * np.mean((np.interp(shared, x, y) - np.interp(shared, other_x, other_y)) ** 2)
            width += high - low
    return total / width if width else np.nan

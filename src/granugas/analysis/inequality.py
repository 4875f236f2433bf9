"""How unevenly something is shared among particles."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

Numbers = NDArray[np.float64]


def lorenz_curve(amounts: ArrayLike) -> tuple[Numbers, Numbers]:
    """Lorenz curve with the largest first: what share of the whole the particles with most have together.

    Args:
        amounts: (n,) >= 0, not all 0.

    Returns:
        (n + 1,) share of the particles and (n + 1,) their share of the whole, both from 0 to 1. The curve is concave; it is
        the diagonal where all have the same.

    Raises:
        ValueError: a negative amount or NaN, or nothing to share.
    """
    largest_first = np.sort(np.asarray(amounts, dtype=float))[::-1]
    if not (largest_first >= 0).all() or not largest_first.sum() > 0:
        raise ValueError("amounts: allowed are numbers >= 0 that are not all 0")
    sums = np.concatenate([[0.0], np.cumsum(largest_first)])
    return np.linspace(0, 1, len(sums)), sums / sums[-1]


def share_of_largest(amounts: ArrayLike, part: float) -> float:
    """Share of the whole that the given part of the particles, those with most, have together; arguments as above."""
    return float(np.interp(part, *lorenz_curve(amounts)))


def gini(amounts: ArrayLike) -> float:
    """Gini coefficient: 0 where all have the same, 1 - 1/n where one of n has everything; arguments as above."""
    of_particles, of_whole = lorenz_curve(amounts)
    return float(2 * np.trapezoid(of_whole, of_particles) - 1)


def poisson_gini(mean: float) -> float:
    """Gini coefficient of counts that differ by chance alone: of a Poisson distribution, mean > 0."""
    counts = np.arange(1, int(mean + 12 * np.sqrt(mean) + 40))
    below = np.cumsum(np.exp(np.concatenate([[0.0], np.cumsum(np.log(mean / counts))]) - mean))
    return float((below * (1 - below)).sum() / mean)  # half the mean difference of two counts, by the mean

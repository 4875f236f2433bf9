"""Errors from the spread over realizations; never over times of one run, which are correlated."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Numbers = NDArray[np.float64]

CONFIDENCE = 0.95
"""Level of every interval."""

NORMAL = 1.959964
STUDENT_T = (12.7062, 4.3027, 3.1824, 2.7764, 2.5706, 2.4469, 2.3646, 2.3060, 2.2622)
"""Two-sided 95 % points: of the normal distribution, and of Student's t for 1, 2 ... 9 degrees of freedom."""

RESAMPLES = 4000
"""Bootstrap samples; the ends of an interval are then stable to some per cent of its width."""


@dataclass(frozen=True)
class PowerLaw:
    """y = amplitude * x^exponent in a window.

    Attributes:
        exponent: mean of the exponents of the realizations.
        interval: its 95 % confidence interval (low, high); NaN for a single realization, whose times are correlated and
            so tell nothing about the error.
        amplitude: of the geometric mean of the realizations.
        window: (low, high) of x.
        exponents: (n,) of the realizations, fitted one by one.
    """

    exponent: float
    interval: tuple[float, float]
    amplitude: float
    window: tuple[float, float]
    exponents: Numbers

    def __call__(self, x: ArrayLike) -> Numbers:
        """Y at x."""
        return self.amplitude * np.asarray(x, dtype=float) ** self.exponent

    @property
    def half_width(self) -> float:
        """Half the width of the interval."""
        return (self.interval[1] - self.interval[0]) / 2


def mean_and_error(values: ArrayLike) -> tuple[Numbers, Numbers]:
    """Mean and standard error over realizations.

    Args:
        values: (n, ...), realizations first; realizations of NaN (runs that have ended) are left out.

    Returns:
        mean and error of shape (...); where there is one realization the error is NaN, where there is none both are.
    """
    values = np.asarray(values, dtype=float)
    there = ~np.isnan(values)
    n = there.sum(axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = np.where(there, values, 0).sum(axis=0) / n
        variance = (np.where(there, values - mean, 0) ** 2).sum(axis=0) / (n - 1)
        return mean, np.sqrt(variance / n)


def student_t(freedom: int) -> float:
    """Two-sided 95 % point of Student's t; above nine degrees of freedom by its expansion, good to 2e-3."""
    if freedom <= len(STUDENT_T):
        return STUDENT_T[freedom - 1]
    return NORMAL + (NORMAL**3 + NORMAL) / (4 * freedom) + (5 * NORMAL**5 + 16 * NORMAL**3 + 3 * NORMAL) / (96 * freedom**2)


def bootstrap_interval(
    values: ArrayLike, statistic: Callable[[Numbers], float] = np.mean, seed: int = 1998
) -> tuple[float, float]:
    """95 % interval of a statistic, from realizations drawn again with replacement.

    The percentiles of n realizations drawn again are too near to each other: a draw scatters by (n - 1)/n too little, and
    its scatter is itself an estimate. So both are moved away from the statistic by sqrt(n/(n - 1)) t/1.96 with Student's t
    of n - 1 degrees of freedom. For the mean of normal values that covers 94 to 95 % from two realizations on, where the
    percentiles as they are cover 52 % of two, 81 % of four and 90 % of ten.

    Args:
        values: (n, ...), realizations first.
        statistic: of an array like values, in which the order of realizations does not count.
        seed: of the draws.

    Returns:
        low and high; NaN for one realization, and where the statistic of some draw is NaN.
    """
    values = np.asarray(values, dtype=float)
    n = len(values)
    if n < 2:
        return np.nan, np.nan
    draws = np.random.default_rng(seed).integers(n, size=(RESAMPLES, n))
    different, which = np.unique(np.sort(draws, axis=1), axis=0, return_inverse=True)  # of six realizations there are 462
    drawn = np.array([statistic(values[draw]) for draw in different])[which.ravel()]
    ends = np.quantile(drawn, [(1 - CONFIDENCE) / 2, (1 + CONFIDENCE) / 2])
    found = float(statistic(values))
    low, high = found + np.sqrt(n / (n - 1)) * student_t(n - 1) / NORMAL * (ends - found)
    return float(low), float(high)


def fit_power_law(x: ArrayLike, y: ArrayLike, window: tuple[float, float]) -> PowerLaw:
    """Least squares of ln y against ln x in a window, for each realization by itself.

    The interval comes from the spread of the realizations' exponents (`bootstrap_interval`): honest, but wide if they are two.

    Args:
        x: (m,), ascending and positive.
        y: (m,) or (n, m), realizations first; those that are NaN or not positive somewhere in the window are left out.
        window: (low, high) of x, both inside.

    Raises:
        ValueError: fewer than three points in the window, or no realization that covers it.
    """
    x, y = np.asarray(x, dtype=float), np.atleast_2d(np.asarray(y, dtype=float))
    inside = (x >= window[0]) & (x <= window[1])
    if inside.sum() < 3:
        raise ValueError(f"window = {window}: {inside.sum()} points in it, at least 3 are needed")
    y = y[(y[:, inside] > 0).all(axis=1)][:, inside]
    if not len(y):
        raise ValueError(f"window = {window}: no realization has positive values throughout")
    exponents, offsets = np.polyfit(np.log(x[inside]), np.log(y).T, 1)
    return PowerLaw(
        float(exponents.mean()), bootstrap_interval(exponents), float(np.exp(offsets.mean())), tuple(window), exponents
    )


def jackknife(statistic: Callable[..., ArrayLike], *groups: ArrayLike) -> tuple[Numbers, Numbers]:
    """A statistic of groups of realizations, and its standard error by leaving out one realization after the other.

    Args:
        statistic: of arrays like the groups, realizations first.
        groups: (n_i, ...) each; groups are independent of each other, what was run from the same start states belongs
            in one group.

    Returns:
        value and error of one shape; the error is NaN where a group has one realization.
    """
    groups = [np.asarray(group, dtype=float) for group in groups]
    variance = 0.0
    for k, group in enumerate(groups):
        n = len(group)
        left = [statistic(*groups[:k], np.delete(group, i, axis=0), *groups[k + 1 :]) for i in range(n)] if n > 1 else [np.nan]
        variance = variance + (n - 1) * np.var(left, axis=0)
    return np.asarray(statistic(*groups), dtype=float), np.sqrt(variance)

"""The growth law of clusters (B Eq. 8): local exponents, what the fit window does to them, where growth begins and ends.

Curves y(t) of several realizations are (n, m), at common times t (m,), positive and ascending. Errors come from the spread
of the realizations; times of one run are correlated and tell nothing about them.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from granugas.analysis.statistics import bootstrap_interval

Numbers = NDArray[np.float64]

WIDTH = float(np.log(4.0))
"""Of the window of a local exponent in ln t: a factor of two to both sides."""

LEAST_RATIO = 2.0
"""Of the ends of a fit window; a power law over less than an octave is none."""

ROUNDING = 1e-9
"""Of ln t."""


class Boundary(NamedTuple):
    """A time, and its 95 % interval over realizations (NaN for one)."""

    time: float
    low: float
    high: float


def local_exponent(t: ArrayLike, y: ArrayLike, width: float = WIDTH) -> Numbers:
    """d ln y / d ln t by least squares in a window of fixed width in ln t that slides along each realization.

    Where the window is centred on the kink between two power laws, the exponent is the mean of theirs. It is linear in ln y:
    the mean over realizations is the local exponent of their geometric mean.

    Args:
        t: (m,).
        y: (..., m), positive.
        width: of the window.

    Returns:
        (..., m); NaN where the samples do not reach across the window, or are fewer than three in it.
    """
    x, y = (np.log(np.asarray(values, dtype=float)) for values in (t, y))
    found = np.full(y.shape, np.nan)
    reach = width / 2 + ROUNDING
    for i in np.flatnonzero((x - x[0] + ROUNDING >= width / 2) & (x[-1] - x + ROUNDING >= width / 2)):
        inside = abs(x - x[i]) <= reach
        if inside.sum() >= 3:
            found[..., i] = _slopes(x[inside], y[..., inside])
    return found


def window_exponents(t: ArrayLike, y: ArrayLike, lows: ArrayLike, highs: ArrayLike) -> Numbers:
    """The exponent of y ~ t^exponent for every fit window of a grid, mean over realizations.

    Args:
        t: (m,).
        y: (n, m), positive.
        lows, highs: (k,) and (l,), beginnings and ends of windows.

    Returns:
        (k, l); NaN where a window is shorter than `LEAST_RATIO`, or has fewer than three samples.
    """
    x, y = np.log(np.asarray(t, dtype=float)), np.log(np.asarray(y, dtype=float)).mean(axis=0)
    found = np.full((len(np.atleast_1d(lows)), len(np.atleast_1d(highs))), np.nan)
    for (i, j), _ in np.ndenumerate(found):
        low, high = np.log(np.atleast_1d(lows)[i]), np.log(np.atleast_1d(highs)[j])
        inside = (x >= low - ROUNDING) & (x <= high + ROUNDING)
        if high - low >= np.log(LEAST_RATIO) - ROUNDING and inside.sum() >= 3:
            found[i, j] = _slopes(x[inside], y[inside])
    return found


def growth_regime(t: ArrayLike, exponent: ArrayLike) -> tuple[float, float]:
    """Where a local exponent rises to half of its maximum, and where it falls to half again, each next to the maximum.

    Between two regimes in which y hardly changes, a power law has this local exponent at both its ends (`local_exponent`), so
    that the times are those of its kinks, whatever the width of the window; and no threshold has to be chosen by eye.

    Args:
        t: (m,).
        exponent: (m,), with NaN at the ends.

    Returns:
        Beginning and end in units of t, interpolated in ln t; NaN where the exponent does not fall to half on that side.
    """
    x, exponent = np.log(np.asarray(t, dtype=float)), np.asarray(exponent, dtype=float)
    there = np.flatnonzero(~np.isnan(exponent))
    peak = there[np.argmax(exponent[there])] if len(there) else 0
    if not exponent[peak] > 0:
        return np.nan, np.nan
    before, after = slice(peak, None, -1), slice(peak, None)
    begin, end = (_falls_to(exponent[peak] / 2, x[side], exponent[side]) for side in (before, after))
    return float(np.exp(begin)), float(np.exp(end))


def growth_window(t: ArrayLike, y: ArrayLike) -> tuple[float, float]:
    """Where a power law is fitted to growing y: the `growth_regime` of the geometric mean of the realizations.

    It ends with the samples where the regime does not end, and holds at least the window of the largest local exponent: the
    regime of a curve that jumps may be narrower than the distance of its samples.

    Args:
        t: (m,).
        y: (n, m), positive.

    Returns:
        Beginning and end in units of t; those of t where nothing grows.
    """
    t = np.asarray(t, dtype=float)
    exponent = local_exponent(t, y).mean(axis=0)
    low, high = growth_regime(t, exponent)
    low, high = t[0] if np.isnan(low) else low, t[-1] if np.isnan(high) else high
    if np.isnan(exponent).all():
        return float(low), float(high)
    steepest, reach = t[np.nanargmax(exponent)], np.exp(WIDTH / 2 + ROUNDING)
    return float(min(low, steepest / reach)), float(max(high, steepest * reach))


def regime_boundaries(t: ArrayLike, y: ArrayLike) -> tuple[Boundary, Boundary]:
    """Beginning and end of the growth of y by `growth_regime` of the geometric mean of the realizations.

    For clusters y is <M>. For the energy it is K by that of homogeneous cooling (B Eq. 1): clustering begins where the
    excess starts to grow, and ends where K decays faster again.

    Args:
        t: (m,).
        y: (n, m), positive.

    Returns:
        Two boundaries; their intervals are bootstrapped over realizations, in ln t, and end with the samples.
    """
    t, exponents, found = np.asarray(t, dtype=float), local_exponent(t, y), []
    for side, time in enumerate(growth_regime(t, exponents.mean(axis=0))):
        interval = bootstrap_interval(exponents, lambda drawn, side=side: np.log(growth_regime(t, drawn.mean(axis=0))[side]))
        found.append(Boundary(time, *(float(end) for end in np.clip(np.exp(interval), t[0], t[-1]))))
    return found[0], found[1]


def _slopes(x: Numbers, y: Numbers) -> Numbers:
    """Least squares of y (..., m) against x (m,)."""
    x = x - x.mean()
    return (y * x).sum(axis=-1) / (x**2).sum()


def _falls_to(level: float, x: Numbers, values: Numbers) -> float:
    """The first x at which values, that begin above a level, are at it; NaN where they never are."""
    below = np.flatnonzero(values < level)
    if not len(below):
        return np.nan
    i = below[0]
    return x[i] + (x[i - 1] - x[i]) * (level - values[i]) / (values[i - 1] - values[i])

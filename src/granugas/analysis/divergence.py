"""How fast two trajectories part that began alike."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from granugas.analysis.statistics import mean_and_error

Numbers = NDArray[np.float64]


def rms_distance(one: ArrayLike, other: ArrayLike, box: Sequence[float]) -> float:
    """Root mean square over the particles of the distance between their places in two trajectories.

    Args:
        one, other: (n, 2) positions in a periodic box; the nearest images count.
        box: (Lx, Ly), in the unit of the positions and of the result.
    """
    apart = np.asarray(one) - np.asarray(other)
    apart = apart - box * np.rint(apart / box)
    return float(np.sqrt((apart**2).sum(axis=1).mean()))


def growth_rate(x: ArrayLike, distance: ArrayLike, window: tuple[float, float]) -> float:
    """lambda of distance ~ exp(lambda x): the Lyapunov exponent, least squares of ln(distance) against x.

    Args:
        x: (m,), ascending: time, or collisions.
        distance: (m,).
        window: (low, high) of the distance; fitted from where it is first above low to where it is first above high.

    Returns:
        In units of 1/x; NaN with fewer than three points in the window.
    """
    x, distance = np.asarray(x, dtype=float), np.asarray(distance, dtype=float)
    begin, end = ((distance > limit).argmax() if (distance > limit).any() else len(x) for limit in window)
    if end - begin < 3:
        return np.nan
    return float(np.polyfit(x[begin:end], np.log(distance[begin:end]), 1)[0])


def lyapunov_exponent(x: ArrayLike, distance: ArrayLike, window: tuple[float, float]) -> tuple[float, float]:
    """`growth_rate` of many copies: mean, and standard error from the spread over realizations.

    Args:
        x: (n, m) of n realizations.
        distance: (n, c, m) of c copies of each; those with fewer than three points in the window are left out.
        window: (low, high) of the distance.
    """
    pairs = zip(np.asarray(x), np.asarray(distance), strict=True)
    mean, error = mean_and_error([np.nanmean([growth_rate(at, copy, window) for copy in copies]) for at, copies in pairs])
    return float(mean), float(error)


def collision_times(tau: ArrayLike, energy: ArrayLike) -> Numbers:
    """The integral of dt / t_E(t), t_E of the energy at the time: the clock of a cooling gas, tau itself at K = 1.

    Args:
        tau: (m,), t / t_E(0) (A Eq. 19).
        energy: (m,), K = E / E(0); t_E(t) = t_E(0) / sqrt(K).
    """
    tau, rate = np.asarray(tau, dtype=float), np.sqrt(np.asarray(energy, dtype=float))
    return np.concatenate([[0.0], np.cumsum(np.diff(tau) * (rate[1:] + rate[:-1]) / 2)])


def relative_spread(copies: ArrayLike, runs: ArrayLike) -> Numbers:
    """Spread over copies that began as the same run did, by the spread over runs that began independently.

    Args:
        copies: (n, c, m) of n realizations, c copies of each, at m times; c > 1.
        runs: (n, m), n > 1.

    Returns:
        (m,) root mean square over realizations of the standard deviation over copies, by the standard deviation over
        realizations; NaN where that is 0.
    """
    of_copies = np.asarray(copies, dtype=float).var(axis=1, ddof=1).mean(axis=0)
    of_runs = np.asarray(runs, dtype=float).var(axis=0, ddof=1)
    return np.sqrt(np.divide(of_copies, of_runs, out=np.full(of_runs.shape, np.nan), where=of_runs > 0))

"""The edge of the inelastic collapse: the coefficient of restitution r_c at which half of the runs collapse (A Eq. 22)."""

from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from granugas.analysis.statistics import bootstrap_interval

Numbers = NDArray[np.float64]


class Threshold(NamedTuple):
    """r_c and its band.

    Attributes:
        value: where the fraction of runs that collapse is one half; NaN where it does not pass one half.
        low, high: 95 % interval from realizations drawn again, never narrower than the step of r that r_c lies in.
    """

    value: float
    low: float
    high: float


def collapsed_within(runs: xr.Dataset, collisions_per_particle: float) -> xr.DataArray:
    """Whether each run collapsed before so many collisions per particle.

    Args:
        runs: stop_reason and events of a pooled study, with `n_particles` among its coordinates.
        collisions_per_particle: C/N, each collision counted for both partners.

    Returns:
        Of the shape of `events`: 1 or 0; NaN where a run ended before without a collapse, which tells nothing.
    """
    passed = 2 * runs["events"] / runs["n_particles"]
    collapsed = runs["stop_reason"] == "inelastic_collapse"
    known = collapsed | (passed >= collisions_per_particle)
    return (collapsed & (passed <= collisions_per_particle)).astype(float).where(known)


def falling(fraction: ArrayLike) -> Numbers:
    """The nearest sequence (least squares) that never rises: neighbours that rise are replaced by their mean.

    Args:
        fraction: (m,).
    """
    blocks: list[tuple[float, int]] = []
    for value in np.asarray(fraction, dtype=float).tolist():
        block = (value, 1)
        while blocks and blocks[-1][0] < block[0]:
            mean, count = blocks.pop()
            total = count + block[1]
            block = ((mean * count + block[0] * block[1]) / total, total)
        blocks.append(block)
    return np.repeat([mean for mean, _ in blocks], [count for _, count in blocks])


def crossing(restitution: ArrayLike, fraction: ArrayLike) -> float:
    """The r where a fraction that falls with r passes one half, on a straight line between two r; NaN where it does not.

    Args:
        restitution: (m,), ascending.
        fraction: (m,); what rises by chance is levelled first (`falling`).
    """
    r, fraction = np.asarray(restitution, dtype=float), falling(fraction)
    above = np.count_nonzero(fraction >= 0.5)
    if above in (0, len(r)):
        return np.nan
    pair = slice(above - 1, above + 1)
    return float(np.interp(-0.5, -fraction[pair], r[pair]))


def collapse_threshold(restitution: ArrayLike, collapsed: ArrayLike) -> Threshold:
    """r_c of realizations that were run at the same r.

    Args:
        restitution: (m,), ascending.
        collapsed: (n, m), realizations first: 1 or 0; NaN in any place gives NaN.
    """
    r, collapsed = np.asarray(restitution, dtype=float), np.asarray(collapsed, dtype=float)
    value = crossing(r, collapsed.mean(axis=0))
    if np.isnan(value):
        return Threshold(np.nan, np.nan, np.nan)
    low, high = bootstrap_interval(collapsed, lambda drawn: crossing(r, drawn.mean(axis=0)))
    return Threshold(value, float(np.fmin(low, r[r <= value].max())), float(np.fmax(high, r[r > value].min())))


def rate_on_approach(time_left: ArrayLike, edges: ArrayLike) -> Numbers:
    """Collisions per time in intervals of the time that is left to the collapse, t* - t.

    Args:
        time_left: (n,) in s, of each collision; NaN is left out.
        edges: (m + 1,) in s, ascending.

    Returns:
        (m,) in 1/s; NaN before the earliest collision that is known.
    """
    left, edges = np.asarray(time_left, dtype=float), np.asarray(edges, dtype=float)
    left = left[~np.isnan(left)]
    counts, _ = np.histogram(left, edges)
    return np.where(edges[1:] <= left.max(initial=0.0), counts / np.diff(edges), np.nan)

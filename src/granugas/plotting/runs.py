"""How runs are drawn: means over realizations as curves with bands, or as points with errors; from each point of a grid."""

from collections.abc import Iterator, Sequence
from itertools import cycle, product
from typing import Any, cast

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter

from granugas.analysis.comparison import interpolated
from granugas.analysis.statistics import mean_and_error
from granugas.plotting.style import MARKERS, SYMBOLS, number, power_of_ten, shades


def grid_points(data: xr.Dataset) -> Iterator[tuple[dict[str, Any], xr.Dataset]]:
    """Each point of a study's grid that has runs: the keys and values of its scene, and its data over `realization`.

    Realizations without any value are left out.
    """
    keys = [dim for dim in data["kinetic_energy"].dims if dim not in ("realization", "time")]
    for values in product(*(data[key].values for key in keys)):
        point = dict(zip(keys, values, strict=True))
        runs = data.sel(point).dropna("realization", how="all", subset=["kinetic_energy"])
        if runs.sizes["realization"]:
            yield data.attrs | point, runs


def times(runs: xr.Dataset) -> xr.DataArray:
    """Times of the samples in s: their coordinate, or the mean over realizations where runs ended by collisions."""
    return runs["sampling_time"].mean("realization") if "sampling_time" in runs else runs["time"]


def point_names(points: Sequence[dict[str, Any]]) -> list[str]:
    """What tells the points of a grid apart, in words for a legend."""
    keys = [key for key in points[0] if len({str(point[key]) for point in points}) > 1]
    return [", ".join(f"{SYMBOLS.get(key, key)} = {number(point[key])}" for key in keys) for point in points]


def thinned(runs: xr.Dataset, count: int = 300) -> xr.Dataset:
    """Runs with no more samples than a logarithmic axis of time shows: t = 0, and those next to `count` equal steps."""
    at = times(runs).values
    wanted = np.geomspace(at[at > 0].min(), np.nanmax(at), count)
    return runs.isel(time=np.unique([0, *(np.abs(at - t).argmin() for t in wanted)]))


def band(axes: Axes, x: xr.DataArray, y: xr.DataArray, *, spread: bool = True, **line: Any) -> Line2D:
    """The mean over realizations as a line, geometric on a logarithmic axis, and their range as a band.

    Both end where the first realization ends. Points that a logarithmic axis cannot show are left out.

    Args:
        axes: with their scales set.
        x: over `time`, or `realization` and `time`; then its mean is taken.
        y: over `realization` and `time`.
        spread: whether the band is drawn.
        line: how the line is drawn.
    """
    logarithmic = axes.get_yscale() == "log"
    at = (x.mean("realization") if "realization" in x.dims else x).values
    values = y.transpose("realization", "time").values
    shown = ~np.isnan(values).any(axis=0)
    if axes.get_xscale() == "log":
        shown &= at > 0
    if logarithmic:
        shown &= (values > 0).all(axis=0)
    at, values = at[shown], values[:, shown]
    mean = np.exp(np.log(values).mean(axis=0)) if logarithmic else values.mean(axis=0)
    (drawn,) = axes.plot(at, mean, **line)
    if spread and len(values) > 1:
        axes.fill_between(at, values.min(axis=0), values.max(axis=0), color=drawn.get_color(), alpha=0.2, linewidth=0)
    return drawn


def mean_and_range(axes: Axes, x: xr.DataArray, y: xr.DataArray, **line: Any) -> Line2D:
    """The arithmetic mean over realizations as points on a line, and their range as a band.

    For counts, of which some realizations may have none: where all have none, a logarithmic axis shows nothing. The limits
    of the axes must be set.

    Args:
        axes: with their scales set.
        x: over `realization` and `time`, or over `time`.
        y: over `realization` and `time`.
        line: how the line is drawn.
    """
    x = x.mean("realization") if "realization" in x.dims else x
    low, mean, high = y.min("realization"), y.mean("realization"), y.max("realization")
    shown = mean > 0 if axes.get_yscale() == "log" else ~np.isnan(mean)
    (drawn,) = axes.plot(x, mean.where(shown), **line)
    if y.sizes["realization"] > 1:
        axes.fill_between(x, low, high, where=shown, color=drawn.get_color(), alpha=0.15, linewidth=0)
    return drawn


def run_and_others(axes: Axes, x: xr.DataArray, y: xr.DataArray, **line: Any) -> Line2D:
    """The first realization as a line, and the range of all the others as a band where all of them are.

    Args:
        axes: with their scales set, logarithmic ones where realizations have each their own x.
        x, y: over `realization` and `time`; x = 0 is left out.
        line: how the line is drawn.
    """
    at, of = (values.transpose("realization", "time").values for values in (x, y))
    shown = (at > 0).all(axis=0) & ~np.isnan(of).any(axis=0)
    at, of = at[:, shown], of[:, shown]
    (drawn,) = axes.plot(at[0], of[0], **line)
    if len(at) > 1:
        alike = np.allclose(at, at[0])
        along = at[0] if alike else np.geomspace(at[1:, 0].max(), at[1:, -1].min(), at.shape[1])
        others = of[1:] if alike else interpolated(at[1:], of[1:], along)
        axes.fill_between(along, others.min(axis=0), others.max(axis=0), color=drawn.get_color(), alpha=0.12, linewidth=0.4)
    return drawn


def power_line(curve: Line2D, window: tuple[float, float], power: float, factor: float, text: str) -> None:
    """A thin line of slope `power` on logarithmic axes to compare a curve with, a text at its middle.

    Args:
        curve: as `band` returns it.
        window: beginning and end in x.
        power: the slope.
        factor: where the line begins, in units of the curve there.
        text: on the side away from the curve.
    """
    x = np.array([window[0], np.sqrt(window[0] * window[1]), window[1]])
    at, values = map(np.asarray, curve.get_data())
    y = factor * np.interp(x[0], at, values) * (x / x[0]) ** power
    axes = cast(Axes, curve.axes)
    axes.plot(x, y, color="0.35", linewidth=0.9)
    above, falling = factor > 1, power < 0
    place: dict[str, Any] = {"ha": "left" if above == falling else "right", "va": "bottom" if above else "top"}
    shift = 3 if above == falling else -3, 2 if above else -2
    axes.annotate(text, (x[1], y[1]), shift, textcoords="offset points", color="0.35", fontsize="small", **place)


def beside(axes: Axes, x: xr.DataArray, y: xr.DataArray, label: str) -> None:
    """Draw another quantity, on a logarithmic axis of its own at the right."""
    right = axes.twinx()
    right.plot(x, y, "D--", color="C1")
    right.set_yscale("log")
    right.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    right.yaxis.set_major_formatter("{x:g}")
    right.yaxis.set_minor_formatter(NullFormatter())
    right.set_ylabel(label, color="C1")
    right.tick_params(axis="y", which="both", colors="C1")


def error_points(axes: Axes, values: xr.DataArray, **style: Any) -> None:
    """Means over realizations against the other dimension, with bars of the standard error where there are several.

    Args:
        axes: with their scales set.
        values: over `realization` and one more dimension; NaN is left out.
        style: of the points.
    """
    (dim,) = set(values.dims) - {"realization"}
    mean, error = mean_and_error(values.transpose("realization", dim).values)
    shown = ~np.isnan(mean)
    bars: dict[str, Any] = {"linestyle": "none", "markersize": 3.5, "markeredgewidth": 0.7, "elinewidth": 0.7, "capsize": 1.5}
    axes.errorbar(values[dim].values[shown], mean[shown], np.nan_to_num(error[shown]), **bars | style)


def by_contact_time(axes: Axes, values: xr.DataArray, **style: Any) -> None:
    """`error_points` for each contact time, the longest first, with a colour and a marker of its own and a label.

    Args:
        axes: with their scales set.
        values: over `contact_time`, `realization` and one more dimension.
        style: of all points.
    """
    times = sorted(values["contact_time"].values, reverse=True)
    for t_c, colour, marker in zip(times, shades(len(times)), cycle(MARKERS), strict=False):
        look: dict[str, Any] = {"color": colour, "marker": marker, "markerfacecolor": "none", "label": power_of_ten(t_c)}
        error_points(axes, values.sel(contact_time=t_c), **look | style)


def each_run(axes: Axes, values: xr.DataArray, branch: xr.DataArray, label: str, **style: Any) -> None:
    """Every realization as a point against the area fraction: an open symbol for the fluid, a filled one for the crystal.

    Args:
        axes: with their scales set.
        values: over `area_fraction` and `realization`.
        branch: like the values, "fluid" or "crystal".
        label: of the open symbols.
        style: of both.
    """
    nu, values, branch = xr.broadcast(values["area_fraction"], values, branch)
    points: dict[str, Any] = {"linestyle": "none", "markeredgewidth": 0.7} | style
    looks: dict[str, dict[str, Any]] = {"fluid": {"markerfacecolor": "none", "label": label}, "crystal": {}}
    for name, look in looks.items():
        there = (branch == name).values
        axes.plot(nu.values[there], values.values[there], **points | look)

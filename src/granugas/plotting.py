"""The style of the figures, and the drawings that they share.

Figures are made without pyplot: no window, no state between two of them.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import wraps
from itertools import cycle, product
from pathlib import Path
from typing import Any, cast

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib import style
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter
from numpy.typing import NDArray
from PIL import Image

from granugas.analysis.comparison import interpolated
from granugas.analysis.statistics import PowerLaw, mean_and_error
from granugas.storage.files import replacing

STYLE = Path(__file__).with_name("granugas.mplstyle")
COLUMN, PAGE = 3.4, 7.0
"""Widths of one column and of a page in inches."""

THEORY = {"color": "black", "linestyle": (0, (5, 2)), "linewidth": 1.0, "zorder": 3}
"""How a closed formula is drawn."""

SYMBOLS = {
    "n_particles": "$N$",
    "area_fraction": r"$\nu$",
    "restitution": "$r$",
    "contact_time": "$t_c$",
    "diameter": "$d$",
    "velocity_half_width": "$w$",
}
"""Of the keys of a scene."""

METADATA = {
    ".png": {"Software": None},
    ".pdf": {"CreationDate": None, "Creator": None, "Producer": None},
    ".svg": {"Date": None, "Creator": None},
}
"""Nothing in a picture file that changes with the day."""

Draw = Callable[[dict[str, xr.Dataset]], Figure]


def styled(draw: Draw) -> Draw:
    """The function `draw`, with granugas.mplstyle in force while it draws."""

    @wraps(draw)
    def drawn(data: dict[str, xr.Dataset]) -> Figure:
        with style.context(STYLE):
            return draw(data)

    return drawn


def save(figure: Figure, *paths: str | Path) -> None:
    """Write a figure to each path, its format by the ending, laid out once; equal figures give equal files."""
    for path in map(Path, paths):
        with style.context(STYLE), replacing(path) as temporary:
            figure.savefig(temporary, format=path.suffix[1:], metadata=METADATA.get(path.suffix))
            if path.suffix == ".png":
                _use_a_palette(temporary)
            figure.set_layout_engine("none")


def _use_a_palette(path: Path) -> None:
    """A picture in its 256 commonest colours, which nobody can tell from all of them: a third of the bytes."""
    with Image.open(path) as picture:
        few = picture.convert("RGB").quantize(256, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
        dpi = picture.info["dpi"]
    few.save(path, format="PNG", optimize=True, dpi=dpi)


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


def number_1_2_5(*panels: Axes) -> None:
    """Numbers at 1, 2 and 5 of each decade, for logarithmic panels of about one."""
    for axes in panels:
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
            axis.set_major_formatter(lambda value, _: _number(value))
            axis.set_minor_formatter(NullFormatter())


def shades(n: int) -> list[tuple[float, ...]]:
    """n colours in order, from dark to light, that differ in brightness too."""
    return [tuple(colour) for colour in mpl.colormaps["viridis"](np.linspace(0, 0.88, n))]


def mark_panels(*panels: Axes) -> None:
    """(a), (b), ... in the upper left corners, outside."""
    for letter, axes in zip("abcdefgh", panels, strict=False):
        axes.set_title(f"({letter})", loc="left")


def power_of_ten(value: float) -> str:
    """A number as people write contact times: 10^-5, 5 x 10^-4, 0."""
    if value == 0:
        return "$0$"
    mantissa, exponent = f"{value:.3e}".split("e")
    factor = "" if float(mantissa) == 1 else rf"{float(mantissa):g}\times"
    return f"${factor}10^{{{int(exponent)}}}$"


def exponent(fit: PowerLaw) -> str:
    """An exponent with its interval, if it has one."""
    error = "" if np.isnan(fit.half_width) else rf" \pm {fit.half_width:.2f}"
    return f"${fit.exponent:.2f}{error}$"


def point_names(points: Sequence[dict[str, Any]]) -> list[str]:
    """What tells the points of a grid apart, in words for a legend."""
    keys = [key for key in points[0] if len({str(point[key]) for point in points}) > 1]
    return [", ".join(f"{SYMBOLS.get(key, key)} = {_number(point[key])}" for key in keys) for point in points]


def _number(value: Any) -> str:
    if isinstance(value, str):
        return value
    return power_of_ten(value) if 0 < value < 0.02 else f"${value:.10g}$"


def thinned(runs: xr.Dataset, count: int = 300) -> xr.Dataset:
    """Runs with no more samples than a logarithmic axis of time shows: t = 0, and those next to `count` equal steps."""
    at = times(runs).values
    wanted = np.geomspace(at[at > 0].min(), np.nanmax(at), count)
    return runs.isel(time=np.unique([0, *(np.abs(at - t).argmin() for t in wanted)]))


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


def draw_disks(
    axes: Axes,
    position: NDArray[np.float64],
    box: Sequence[float],
    diameter: float | NDArray[np.float64],
    colour: NDArray[np.float64],
    walled: Sequence[bool] = (False, False),
) -> None:
    """Disks to scale in their box, in units of their mean diameter, as a picture of dots in every format.

    Args:
        axes: without ticks afterwards.
        position: (n, 2) in m.
        box: sides in m.
        diameter: in m, of all or (n,).
        colour: (n, 4).
        walled: for each axis, whether the box ends there in walls; it is periodic elsewhere.
    """
    unit = float(np.mean(diameter))
    sides, width = np.asarray(box) / unit, np.broadcast_to(np.asarray(diameter) / unit, len(position))
    shifts = product(*[(0,) if wall else (-1, 0, 1) for wall in walled])
    images = [(position / unit + np.array(shift) * sides, colour, width) for shift in shifts]
    place, colour, width = (np.concatenate(parts) for parts in zip(*images, strict=True))
    reach = width[:, np.newaxis] / 2
    seen = ((place > -reach) & (place < sides + reach)).all(axis=1)
    diameters = width[seen]
    axes.add_collection(
        EllipseCollection(
            diameters,
            diameters,
            np.zeros_like(diameters),
            units="xy",
            offsets=place[seen],
            offset_transform=axes.transData,
            facecolors=colour[seen],
            linewidths=0,
            snap=True,  # on whole dots: crisp, and a third of the bytes
            rasterized=True,
        )
    )
    axes.set(xlim=(0, sides[0]), ylim=(0, sides[1]), aspect="equal", xticks=[], yticks=[])


MARKERS = "osD^v<>ph*"
"""In this order where colours alone tell points apart."""


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


def text_table(cells: Sequence[Sequence[str]], widths: Sequence[float], notes: Sequence[str] = ()) -> Figure:
    """A table as a picture, ruled as in a journal: a header, rows, and notes below in small letters.

    Args:
        cells: rows of texts, the header first; the first column begins at its left edge, the others are centred.
        widths: of the columns in inches.
        notes: lines.
    """
    line, right = 0.24, sum(widths)
    height = line * (len(cells) + 0.8 * len(notes) + 0.6)
    figure = Figure(figsize=(right, height), layout="none")  # type: ignore[arg-type]  # the stub knows it as a word of set_layout_engine only
    axes = figure.add_axes((0, 0, 1, 1), xlim=(0, right), ylim=(height, 0))
    axes.axis("off")
    edges = np.cumsum([0, *widths])
    for k, row in enumerate(cells):
        for column, text in enumerate(row):
            x = edges[column] + 0.05 if column == 0 else edges[column : column + 2].mean()
            axes.text(x, line * (k + 0.65), text, ha="left" if column == 0 else "center", va="center")
    for y, width in ((0.1, 1.0), (1.2, 0.6), (len(cells) + 0.2, 1.0)):
        axes.plot([0.02, right - 0.02], [line * y] * 2, color="black", linewidth=width)
    for k, text in enumerate(notes):
        axes.text(0.05, line * (len(cells) + 0.7 + 0.8 * k), text, va="center", fontsize="small")
    return figure


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

"""Relative error against processor time: a panel for each knob, all on the same logarithmic axes."""

import math
from collections.abc import Callable, Mapping, Sequence
from itertools import cycle, product
from typing import Any, NamedTuple, TypeVar

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator

from granugas.analysis.accuracy import bias
from granugas.plotting.style import MARKERS, PAGE, mark_panels, power_of_ten

Data = TypeVar("Data", xr.Dataset, xr.DataArray)

GOALS = {0.1: "10 %", 0.01: "1 %", 0.001: "0.1 %"}
"""Errors that are marked."""

COLUMNS, HEIGHT = 2, 2.35
"""Of panels on the page, and of each in inches."""

CERTAIN = 2.0
"""An error of so many times its own standard error is more than chance; others have open symbols."""

NAMED_POWERS = (-2, -3, -5, -8, -12)
"""Of ten: contact durations whose points have a name."""

GOAL = ("axes fraction", "data")
"""Coordinates of the words beside a goal."""

LEAST = 1e-6
"""Error below which arithmetic changes nothing."""

OUTSIDE = 1.6
"""How near to the edge of the axis what lies outside is drawn, as a factor."""

SIDES: dict[str, dict[str, Any]] = {
    "above": {"xytext": (0, 4), "ha": "center", "va": "bottom"},
    "below": {"xytext": (0, -4), "ha": "center", "va": "top"},
    "right": {"xytext": (5, 0), "ha": "left", "va": "center"},
}
"""Where the name of a point stands."""


class Curve(NamedTuple):
    """What a knob does to one observable.

    Attributes:
        label: in the legend.
        seconds, error, uncertainty: (n,) processor time, relative error and its standard error.
        names: (n,) of the settings, written beside the points; empty: none is.
        side: where they stand, a key of SIDES.
    """

    label: str
    seconds: np.ndarray
    error: np.ndarray
    uncertainty: np.ndarray
    names: Sequence[str] = ()
    side: str = "above"


def curve_of(
    data: xr.Dataset,
    observable: str,
    label: str,
    name: Callable[[float], str] | None = None,
    *,
    case: str | None = None,
    side: str = "above",
) -> Curve:
    """One observable of an experiment of accuracy, over the settings that it was measured at.

    Args:
        data: over case, setting and observable; `case` may be left out where there is one.
        observable: which.
        label, side: as Curve has them.
        name: text of a setting; None: the points have none.
    """
    gas = data.sel(case=case) if case else data.squeeze("case")
    seen = gas[["relative_error", "relative_error_error"]].sel(observable=observable).assign(seconds=gas["cpu_seconds"])
    seen = seen.dropna("setting", how="any")
    names = [name(setting) for setting in seen["setting"].values] if name else []
    return Curve(label, *_values(seen, "seconds"), names, side)


def _values(seen: xr.Dataset, seconds: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Seconds, error and its uncertainty of a curve."""
    return seen[seconds].values, seen["relative_error"].values, seen["relative_error_error"].values


def contact_time(data: xr.Dataset) -> list[Curve]:
    """K and the clusters of the first size at the last look, K of the others; the knob is t_c."""
    end, (first, *others) = f"{data.attrs['looks'][-1]:g} s", data["case"].values

    def name(t_c: float) -> str:
        return power_of_ten(t_c) if round(math.log10(t_c)) in NAMED_POWERS else ""

    names = {"K": "$K$", "<M>": r"$\langle M \rangle$", "M_max": r"$M_{\max}$"}
    curves = [
        curve_of(data, f"{key} at {end}", f"{symbol}, ${first}$", name if key == "K" else None, case=first)
        for key, symbol in names.items()
    ]
    return curves + [curve_of(data, f"K at {end}", f"$K$, ${case}$", name, case=case) for case in others]


def sampling(data: xr.Dataset) -> list[Curve]:
    """Snapshots asked for one t_c, and averages over all collisions; the knobs are their numbers."""
    at, number = " at t_c = 0.0001 s", "{:g}".format
    return [
        curve_of(data, f"n_e{at}", "$n_e$, snapshots", number, case="snapshots"),
        curve_of(data, f"E_e/E{at}", "$E_e/E$, snapshots", case="snapshots"),
        curve_of(data, "P V/E", "$PV/E$, $C/N$ averaged", number, case="duration", side="below"),
        curve_of(data, "collision rate", "$C_r$, $C/N$ averaged", case="duration"),
    ]


def equilibration(data: xr.Dataset) -> list[Curve]:
    """The velocities and the pressure of all gases; the knob is the number of collisions of a particle."""
    names = {"<v^4>/<v^2>^2": r"$\langle v^4 \rangle$", "P V/E": "$PV/E$"}
    curves: list[Curve] = []
    for key, case in product(names, data["case"].values):
        label = f"{names[key]}, " + case.replace("area fraction ", r"$\nu = ") + "$"
        curves.append(curve_of(data, key, label, None if curves else "{:g}".format, case=case))  # one set of names will do
    return curves


def arithmetic(data: xr.Dataset) -> list[Curve]:
    """A curve for each setting instead, where these cost nearly the same: its points are the observables.

    Args:
        data: over one case, setting and observable; settings without any error, which are the truth, are left out, and
            observables that none of them changes.
    """
    gas = data.squeeze("case")
    seen = gas.sel(observable=(gas["relative_error"] > LEAST).any("setting"))
    wrong = seen.sel(setting=(seen["relative_error"] > 0).any("observable"))
    curves: list[Curve] = []
    for setting in wrong["setting"].values:
        at = wrong.sel(setting=setting)
        seconds = np.full(at.sizes["observable"], float(at["cpu_seconds"]))
        names = [] if curves else [str(name) for name in at["observable"].values]
        curves.append(
            Curve(str(setting), seconds, at["relative_error"].values, at["relative_error_error"].values, names, "right")
        )
    return curves


def sizes(data: xr.Dataset) -> list[Curve]:
    """Everything that was looked at, by its bias; the knob is the number of disks N."""
    curves: list[Curve] = []
    for observable in data["observable"].values:
        seen = data.sel(observable=observable)
        names = [f"{n:g}" for n in seen["setting"].values] if not curves else []
        curves.append(Curve(str(observable), *_values(seen, "cpu_seconds"), names))
    return curves


def realizations(data: xr.Dataset, most: float) -> list[Curve]:
    """What to expect of the mean of K over more and more runs, up to `most` seconds: chance falls, the bias of N stays."""
    seen = data.sel(observable=[name for name in data["observable"].values if name.startswith("K ")][-1])
    curves: list[Curve] = []
    for n, one in seen.groupby("setting"):
        cost, bias, spread = (float(one[key].squeeze()) for key in ("cpu_seconds", "relative_error", "relative_spread"))
        runs = np.geomspace(1, max(most / cost, 1), 8)
        error = np.hypot(bias, spread / np.sqrt(runs))
        curves.append(Curve(f"$N = {n:g}$", runs * cost, error, np.zeros_like(error)))
    return curves


def exponents(data: xr.Dataset, most: float) -> list[Curve]:
    """The exponent of <M> of the largest system but one: by chance, over S_c, over fit windows."""
    one = data.sortby("setting").isel(setting=-2)
    chosen = one.sel(distance_factor=data.attrs["distance_factor"], window_shift=1.0)
    seen = chosen.sel(observable="exponent of <M>")
    exponent, spread, cost = (float(abs(seen[key])) for key in ("exponents", "measured_spread", "cpu_seconds"))
    runs = np.geomspace(1, max(most / cost, 1), 6)
    at_factor = one["exponents"].sel(distance_factor=data.attrs["distance_factor"])
    over = {
        "chance": spread / np.sqrt(runs),
        "$S_c$": np.full_like(runs, float(one["exponents"].sel(window_shift=1.0).std("distance_factor"))),
        "fit window": np.full_like(runs, float(at_factor.std("window_shift"))),
    }
    return [Curve(label, runs * cost, error / exponent, np.zeros_like(error)) for label, error in over.items()]


def methods(events: xr.Dataset, others: Mapping[str, xr.Dataset]) -> list[Curve]:
    """K of other methods at the end, against that of the event-driven runs from the same start states.

    Args:
        events: the study that has the truth.
        others: studies by the words of their curves; the knob of soft spheres is the number of steps in a contact.
    """
    last, curves = events["time"].values[-1], []
    truths = _without_single(events["kinetic_energy"].sel(time=last))
    for label, study in others.items():
        seen = _without_single(study[["kinetic_energy", "cpu_time"]].sel(time=last))
        both = sorted({*seen["realization"].values} & {*truths["realization"].values})
        found = bias(seen["kinetic_energy"].sel(realization=both), truths.sel(realization=both))
        cost, error, uncertainty = (
            np.atleast_1d(values)
            for values in (seen["cpu_time"].median("realization"), found["relative_error"], found["relative_error_error"])
        )
        names = [f"{steps}" for steps in np.atleast_1d(seen["steps_per_contact"])] if "steps_per_contact" in seen.dims else []
        curves.append(Curve(label, cost, error, uncertainty, names))
    return curves


def _without_single(data: Data) -> Data:
    """Without keys of the grid that hold one value."""
    return data.squeeze([dim for dim in data.dims if dim != "realization" and data.sizes[dim] == 1], drop=True)


def accuracy_figure(panels: Mapping[str, Sequence[Curve]], seconds: tuple[float, float], error: tuple[float, float]) -> Figure:
    """The page: a panel for each title, the same axes for all.

    Args:
        panels: curves by title.
        seconds, error: limits of the axes; what lies outside is drawn at the edge, its value beside it.
    """
    rows = math.ceil(len(panels) / COLUMNS)
    figure = Figure(figsize=(PAGE, HEIGHT * rows + 0.2))
    shown = figure.subplots(rows, COLUMNS, sharex=True, sharey=True, squeeze=False)
    for axes, (title, curves) in zip(shown.flat, panels.items(), strict=False):
        axes.set(xscale="log", yscale="log", xlim=seconds, ylim=error)
        axes.yaxis.set_major_locator(LogLocator(numticks=20))
        draw_knob(axes, curves)
        axes.set_title(title)
    for axes in shown.flat[len(panels) :]:
        axes.set_axis_off()
    for axes in shown[-1]:
        axes.set_xlabel("processor time of a run (s)")
    for axes in shown[:, 0]:
        axes.set_ylabel("relative error")
    mark_panels(*shown.flat[: len(panels)])
    return figure


def draw_knob(axes: Axes, curves: Sequence[Curve]) -> None:
    """The curves of one knob, and the goals; an open symbol is no more than chance and has a bar upwards only."""
    for goal, words in GOALS.items():
        axes.axhline(goal, color="0.75", linewidth=0.7, zorder=0)
        axes.annotate(words, (0.995, goal), (0, 1), GOAL, "offset points", ha="right", color="0.5", fontsize=7)
    for k, (curve, marker) in enumerate(zip(curves, cycle(MARKERS), strict=False)):
        look: dict[str, Any] = {"color": f"C{k}", "marker": marker, "markersize": 3.8, "markeredgewidth": 0.8}
        axes.plot([], [], linewidth=0.6, label=curve.label, **look)
        _draw(axes, curve, look)
    axes.legend(fontsize=7)


def _draw(axes: Axes, curve: Curve, look: dict[str, Any]) -> None:
    low, high = axes.get_ylim()
    y = np.clip(curve.error, low * OUTSIDE, high / OUTSIDE)
    inside, certain = y == curve.error, curve.error > CERTAIN * curve.uncertainty
    axes.plot(curve.seconds, y, color=look["color"], linewidth=0.6, alpha=0.6)
    for there, face in ((certain, look["color"]), (~certain, "white")):
        up = np.where(inside, curve.uncertainty, 0)[there]
        bars: dict[str, Any] = {"elinewidth": 0.7, "capsize": 1.5, "linestyle": "none"}
        axes.errorbar(curve.seconds[there], y[there], [up * certain[there], up], markerfacecolor=face, **bars, **look)
    for place, value, there, name in zip(zip(curve.seconds, y, strict=True), curve.error, inside, curve.names, strict=False):
        words, side = (name, curve.side) if there else (f"{name}: {power_of_ten(float(f'{value:.1g}'))}", "right")
        axes.annotate(words, place, textcoords="offset points", color=look["color"], fontsize=7, **SIDES[side])

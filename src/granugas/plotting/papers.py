"""Drawings that figures of one paper share: colours and elastic fractions of A, cooling and the growth regime of B."""

from collections.abc import Sequence
from itertools import cycle
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.figure import Figure

from granugas.analysis.growth import growth_regime, local_exponent
from granugas.analysis.windows import equal_windows, middles, ratio_of_changes, snapshot_means
from granugas.plotting.runs import mean_and_range, run_and_others, times
from granugas.plotting.style import MARKERS, PAGE, mark_panels, shades


def blue_green_red(low: float, middle: float, high: float) -> ScalarMappable:
    """The colours of A Figs. 10 and 11: blue below `low`, green about `middle`, red above `high`."""
    place = (middle - low) / (high - low)
    colours = LinearSegmentedColormap.from_list("blue_green_red", [(0, "#2166d1"), (place, "#27a544"), (1, "#d7191c")])
    return ScalarMappable(Normalize(low, high), colours)


def elastic_fractions(
    runs: Sequence[xr.Dataset], lines: Sequence[dict[str, Any]], width: float, limits: Sequence[tuple[float, float]]
) -> Figure:
    """(a) c_e of all collisions in windows of time, (b) n_e and (c) e_e of 20 snapshots in each (A Figs. 14 and 16).

    Args:
        runs: over `realization` and `time`, one dataset a curve.
        lines: how each of them is drawn.
        width: of the windows in s.
        limits: of c_e, and of n_e and e_e.
    """
    figure = Figure(figsize=(PAGE, 2.8))
    panels = figure.subplots(1, 3)
    labels = ("$c_e = C_e/C$", "$n_e = N_e/N$", "$e_e = E_e/E$")
    for axes, label, shown in zip(panels, labels, (limits[0], limits[1], limits[1]), strict=True):
        axes.set(yscale="log", xlabel=r"$\tau$", ylabel=label, ylim=shown)
    for data, line in zip(runs, lines, strict=True):
        line = {"linewidth": 0.8, "marker": ".", "markersize": 2} | line
        edges = equal_windows(times(data), width)
        tau = middles(data["tau"], edges)
        sums = data["elastic_collisions_per_particle"], data["collisions_per_particle"]
        mean_and_range(panels[0], tau, ratio_of_changes(*sums, edges), **line)
        for axes, name in zip(panels[1:], ("elastic_particle_fraction", "elastic_energy_fraction"), strict=True):
            mean_and_range(axes, tau, snapshot_means(data[name], edges, 20), **line)
    mark_panels(*panels)
    return figure


def cooling_views(points: Sequence[tuple[str, xr.Dataset]], title: str, axis_of_collisions: str) -> tuple[Figure, list[Axes]]:
    """(a) K against t, (b) K, (c) t and (d) (K_x - K_z)/K against C/N (B Figs. 1 and 2), and the panels for theories.

    Args:
        points: a label and the runs of each, in the order of `shades`.
        title: of the legend.
        axis_of_collisions: "linear" or "log", of C/N in (b) and (c); it is logarithmic in (d).
    """
    figure = Figure(figsize=(PAGE, 5.0))
    panels = energy, spent, clock, shear = figure.subplots(2, 2).ravel()
    energy.set(xscale="log", yscale="log", xlabel="$t$ (s)", ylabel="$K$")
    spent.set(xscale=axis_of_collisions, yscale="log", xlabel="$C/N$", ylabel="$K$")
    clock.set(xscale=axis_of_collisions, yscale="log", xlabel="$C/N$", ylabel="$t$ (s)")
    shear.set(xscale="log", xlabel="$C/N$", ylabel="$(K_x - K_z)/K$", ylim=(-1.05, 1.05))
    shear.axhline(0, color="0.6", linewidth=0.6, zorder=0)
    for place, ((label, runs), colour, marker) in enumerate(zip(points, shades(len(points)), cycle(MARKERS), strict=False)):
        look: dict[str, Any] = {
            "color": colour,
            "linewidth": 1.0,
            "marker": marker,
            "markerfacecolor": "white",
            "markeredgewidth": 0.7,
        }
        look |= {"markevery": (5 * place, 40), "label": label}
        t, count, total = (runs[name] for name in (_clock(runs), "collisions_per_particle", "kinetic_energy"))
        difference = (runs["kinetic_energy_x"] - runs["kinetic_energy_y"]) / total
        for axes, x, y in ((energy, t, total), (spent, count, total), (clock, count, t), (shear, count, difference)):
            run_and_others(axes, *xr.broadcast(x, y), **look)
    energy.legend(title=title, loc="lower left")
    mark_panels(*panels)
    return figure, list(panels)


def _clock(runs: xr.Dataset) -> str:
    return "sampling_time" if "sampling_time" in runs else "time"


def mark_growth(runs: xr.Dataset, *panels: Axes, distance_factor: float = 1.1) -> None:
    """The growth regime of <M> (`growth_regime` of the geometric mean over realizations), lightly shaded.

    Args:
        runs: mean_cluster_size over `realization`, `time` and `distance_factor`.
        panels: with time as abscissa and everything drawn.
        distance_factor: S_c; the nearest that there is.
    """
    grown = runs.sel(distance_factor=distance_factor, method="nearest").isel(time=slice(1, None))
    exponents = local_exponent(grown["time"], grown["mean_cluster_size"].transpose("realization", "time"))
    begin, end = growth_regime(grown["time"], exponents.mean(axis=0))
    for axes in panels:
        limits = axes.get_xlim()
        if not np.isnan(begin):
            axes.axvspan(begin, limits[1] if np.isnan(end) else end, color="0.93", linewidth=0, zorder=-2)
        axes.set_xlim(limits)

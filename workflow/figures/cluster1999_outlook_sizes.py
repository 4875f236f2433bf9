"""cluster1999, outlook of section 6: distribution of the cluster sizes at six times, and its scaling tried."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.sizes import mass_distribution, middle_sizes, octaves, scaling, size_distribution
from granugas.analysis.statistics import mean_and_error
from granugas.plotting.runs import grid_points
from granugas.plotting.style import MARKERS, PAGE, mark_panels, shades, styled

STUDIES = ("cluster1999_large",)
FACTORS = (1.05, 1.1, 1.2)
TIMES = (0.32, 1.28, 5.12, 20.48, 81.92, 446.6)
"""In s: before growth, three in it, after it, and the end."""
SMALLEST = (2, 16)
"""Sizes from which on the scaling is judged: without single particles; beyond the tail of the small clusters."""


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """A column for each S_c: n(M)/N against M, M^2 n(M)/N against M and against M/M_w, with the quality of the collapse."""
    figure = Figure(figsize=(PAGE, 7.4))
    panels = figure.subplots(3, len(FACTORS), sharey="row")
    ((key, runs),) = grid_points(data[STUDIES[0]])
    for factor, (top, middle, bottom) in zip(FACTORS, panels.T, strict=True):
        found = runs.sel(distance_factor=factor, method="nearest").sel(time=list(TIMES), method="nearest")
        numbers = found["cluster_size_distribution"].transpose("realization", "time", "cluster_size").values
        numbers, lower, upper = octaves(numbers, runs["cluster_size"].values)
        weighted = found["weighted_cluster_size"].transpose("realization", "time").values
        sizes, bins = middle_sizes(lower, upper), (lower, upper, key["n_particles"])
        for k, colour in enumerate(shades(len(TIMES))):
            look = {"color": colour, "marker": MARKERS[k], "label": f"${float(found['time'][k]):.3g}$"}
            points(top, sizes, size_distribution(numbers[:, k], *bins), **look)
            points(middle, sizes, mass_distribution(numbers[:, k], *bins), **look)
            points(bottom, sizes / weighted[:, k].mean(), mass_distribution(numbers[:, k], *bins), **look)
        slope = np.array([3.0, 50.0])
        top.plot(slope, 0.03 * slope**-3, color="0.35", linewidth=0.9)
        top.annotate("$-3$", (7, 0.03 * 7.0**-3), (-3, -3), textcoords="offset points", ha="right", va="top", color="0.35")
        for y, smallest in enumerate(SMALLEST):
            q, error = scaling(numbers, weighted, *bins, smallest)
            says = f"$Q(M \\geq {smallest}) = {q:.2f}$" + ("" if np.isnan(error) else rf"$ \pm {error:.2f}$")
            bottom.text(0.04, 0.14 - 0.09 * y, says, transform=bottom.transAxes, fontsize="small")
        for axes, label in ((top, "$M$"), (middle, "$M$"), (bottom, "$M / M_w$")):
            axes.set(xscale="log", yscale="log", xlabel=label)
        top.set_title(f"$S_c = {factor:g}$")
    for axes, label in zip(panels[:, 0], ("$n(M) / N$", "$M^2\\, n(M) / N$", "$M^2\\, n(M) / N$"), strict=True):
        axes.set_ylabel(label)
    panels[0, -1].legend(title="$t$ (s)")
    mark_panels(*panels[:, 0])
    return figure


def points(axes, x, values, **look):
    """Means over realizations with bars of the standard error; bins without clusters are no points."""
    mean, error = mean_and_error(values)
    there = mean > 0
    bars = np.stack([np.minimum(error, 0.9 * mean), error])[:, there]  # below zero is nothing on a logarithmic axis
    axes.errorbar(x[there], mean[there], np.nan_to_num(bars), markersize=3, linewidth=0.8, elinewidth=0.7, **look)

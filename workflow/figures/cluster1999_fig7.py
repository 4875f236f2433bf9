"""cluster1999 Fig. 7: number of clusters, mean and largest size against time for several distance factors."""

import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.statistics import fit_power_law
from granugas.plotting.papers import mark_growth
from granugas.plotting.runs import band, grid_points, times
from granugas.plotting.style import PAGE, exponent, mark_panels, shades, styled

STUDIES = ("cluster1999_large",)
WINDOW = (1.0, 40.0)
"""The growth regime of the paper, in s."""


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """(a) I_c and (b) <M> with their power laws in the window, (c) M_max; the growth regime of <M> is shaded."""
    figure = Figure(figsize=(PAGE, 3.9))
    panels = count, mean, largest = figure.subplots(1, 3)
    for axes, label in zip(panels, ("$I_c$", r"$\langle M \rangle$", r"$M_{\max}$"), strict=True):
        axes.set(xscale="log", yscale="log", xlabel="$t$ (s)", ylabel=label)
    for key, runs in grid_points(data[STUDIES[0]]):
        t, factors = times(runs), runs["distance_factor"].values
        inside = t[(t >= WINDOW[0]) & (t <= WINDOW[1])]
        for factor, colour in zip(factors, shades(len(factors)), strict=True):
            found = runs.sel(distance_factor=factor)
            for axes, name in ((count, "cluster_count"), (mean, "mean_cluster_size")):
                fit = fit_power_law(t, found[name].transpose("realization", "time"), WINDOW)
                band(axes, t, found[name], color=colour, label=f"${factor:g}$: {exponent(fit)}")
                axes.plot(inside, fit(inside), color="black", linewidth=0.7, linestyle=(0, (3, 1.5)), zorder=3)
            band(largest, t, found["largest_cluster_size"], color=colour, label=f"${factor:g}$")
        largest.axhline(key["n_particles"], color="0.35", linewidth=0.6, zorder=0)
        largest.annotate("$N$", (t[1], key["n_particles"]), (2, -9), textcoords="offset points", color="0.35")
        mark_growth(runs, *panels)
        n, window = runs.sizes["realization"], f"{WINDOW[0]:g} to {WINDOW[1]:g} s"
        error = f"95 % from {n} runs" if n > 1 else "one run, no interval"
        below = {"loc": "upper center", "bbox_to_anchor": (0.5, -0.17)}
        count.legend(title=f"$S_c$: $-\\mathcal{{M}}$ ({window}; {error})", **below)
        mean.legend(title=f"$S_c$: $\\mathcal{{M}}$ ({window}; {error})", **below)
        largest.legend(title="$S_c$", ncols=2, **below)
    mark_panels(*panels)
    return figure

"""How clusters of spheres grow in three dimensions: the outlook of cluster1999, section 6."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from granugas.analysis.growth import growth_window
from granugas.analysis.sizes import middle_sizes, octaves, size_distribution
from granugas.analysis.statistics import fit_power_law
from granugas.analysis.theory import homogeneous_cooling
from granugas.plotting.runs import band, grid_points
from granugas.plotting.style import MARKERS, PAGE, THEORY, exponent, mark_panels, shades, styled

SECTION = "Effects"
STUDIES = ("growth_3d",)
FACTORS = (1.05, 1.1, 1.2)
TIMES = (0.01, 1.0, 4.0, 16.0, 200.0)  # of the size distributions, in s: before growth, its beginning, two in it, the end


def growth(axes: Axes, sizes: xr.DataArray, **look) -> None:
    """A size against time with its power law in its growth window, which the legend tells."""
    sizes = sizes.transpose("realization", "time")[:, 1:]
    fit = fit_power_law(sizes["time"], sizes, growth_window(sizes["time"], sizes))
    words = f"${float(sizes['distance_factor']):g}$: {exponent(fit)} ({fit.window[0]:.2g} to {fit.window[1]:.2g} s)"
    band(axes, sizes["time"], sizes, label=words, **look)
    axes.plot(fit.window, fit(fit.window), color="black", linewidth=0.8, linestyle=(0, (3, 1.5)), zorder=3)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """(a) <M> and (b) M_max with their power laws, (c) K and homogeneous cooling, (d) to (f) n(M)/N for each S_c."""
    figure, ((key, runs),) = Figure(figsize=(PAGE, 5.8)), grid_points(data[STUDIES[0]])
    (mean, largest, energy), numbers = panels = figure.subplots(2, 3)
    n = key["n_particles"]
    for axes, label in ((mean, r"$\langle M \rangle$"), (largest, r"$M_{\max}$"), (energy, "$K$")):
        axes.set(xscale="log", yscale="log", xlabel="$t$ (s)", ylabel=label)
    largest.axhline(n, color="0.35", linewidth=0.6, zorder=0)
    for axes, factor, colour in zip(numbers, FACTORS, shades(len(FACTORS)), strict=True):
        found = runs.sel(distance_factor=factor, method="nearest")
        growth(mean, found["mean_cluster_size"], color=colour)
        growth(largest, found["largest_cluster_size"], color=colour)
        axes.set(xscale="log", yscale="log", xlabel="$M$", title=f"$S_c = {factor:g}$", ylim=(1 / n**2, 2))
        for time, shade, marker in zip(TIMES, shades(len(TIMES)), MARKERS, strict=False):
            at = found["cluster_size_distribution"].mean("realization").sel(time=time, method="nearest")
            counts, *bins = octaves(at, runs["cluster_size"])
            shown = np.where(counts > 0, size_distribution(counts, *bins, n), np.nan)
            axes.plot(middle_sizes(*bins), shown, color=shade, marker=marker, linewidth=0.8, label=f"${at.time:.3g}$")
    mean.set_yticks(ticks := [1, 1.5, 2, 3, 4, 5], [f"${size:g}$" for size in ticks])
    mean.set_yticks([], minor=True)
    largest.annotate("$N$", (0.04, n), (0, -9), largest.get_yaxis_transform(), "offset points", color="0.35")
    band(energy, runs["time"], runs["kinetic_energy"], color="C0", label="simulation")
    haff = homogeneous_cooling(runs["tau"].mean("realization"), key["restitution"], key["dimensions"])
    energy.plot(runs["time"][1:], haff[1:], **THEORY, label="homogeneous cooling")
    for axes, title in ((mean, "$S_c$: exponent (window)"), (largest, "$S_c$: exponent (window)"), (energy, None)):
        axes.legend(title=title, loc="upper center", bbox_to_anchor=(0.5, -0.2))
    numbers[0].set_ylabel("$n(M) / N$")
    numbers[-1].legend(title="$t$ (s)")
    mark_panels(*panels.flat)
    return figure

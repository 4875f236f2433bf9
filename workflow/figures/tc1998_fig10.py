"""tc1998 Fig. 10: six snapshots of N = 22960, coloured by the collision rate of each particle, and how the rates are spread."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from granugas.plotting.papers import blue_green_red
from granugas.plotting.runs import grid_points
from granugas.plotting.snapshots import draw_disks
from granugas.plotting.style import PAGE, shades, styled

STUDIES = ("tc1998_n22960",)

BLUE, GREEN, RED = 300.0, 700.0, 1100.0
"""Collision rates of the print's colours in 1/s."""


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """The snapshots of the first realization in order of time; below, the distributions of the rates at these times."""
    ((key, runs),) = grid_points(data[STUDIES[0]])
    figure = Figure(figsize=(PAGE, 7.0))
    above, below = figure.subfigures(2, 1, height_ratios=(5.0, 2.4))
    rows = -(-runs.sizes["snapshot"] // 3)
    first, scale = runs.isel(realization=0), blue_green_red(BLUE, GREEN, RED)
    for place, (time, shot) in enumerate(first.groupby("snapshot"), start=1):
        axes, particles = above.add_subplot(rows, 3, place), shot.squeeze("snapshot")
        box, rates = (float(particles["box_x"]), float(particles["box_y"])), particles["collision_frequency"].values
        draw_disks(axes, particles["position"].values, box, key["diameter"], scale.to_rgba(rates))
        tau = time * float(particles["enskog_rate"])
        axes.set_title(f"$t = {time:g}$ s, $\\tau = {tau:.0f}$")
    above.colorbar(scale, ax=above.axes, extend="both", label="$C_r^{(i)}$ (s$^{-1}$)", shrink=0.7, aspect=30)
    axes = below.add_subplot(xscale="log", yscale="log", xlabel="$C$ (s$^{-1}$)", ylabel="$N(C_r^{(i)} > C) / N$")
    for time, colour in zip(runs["snapshot"].values, shades(runs.sizes["snapshot"]), strict=True):
        rates = np.sort(runs["collision_frequency"].sel(snapshot=time).values.ravel())
        rates = rates[~np.isnan(rates)]
        axes.step(rates, 1 - np.arange(rates.size) / rates.size, color=colour, label=f"{time:g}")
    for rate in (BLUE, GREEN, RED):
        axes.axvline(rate, color=scale.to_rgba(rate), linewidth=0.8, zorder=0)
    axes.legend(title="$t$ (s)", loc="upper left", bbox_to_anchor=(1, 1))
    return figure

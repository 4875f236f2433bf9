"""cluster1999, remark on Fig. 5: how unevenly the collisions, and so the computing time, are shared among the particles."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.inequality import gini, lorenz_curve, poisson_gini, share_of_largest
from granugas.plotting.runs import grid_points
from granugas.plotting.style import COLUMN, shades, styled
from granugas.record import FREQUENCY_WINDOW

STUDIES = ("cluster1999_large",)
TIMES = (0.64, 2.56, 10.24, 40.96, 446.6)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """Share of the collisions that the particles with the largest collision frequencies have, for each time."""
    ((_, runs),) = grid_points(data[STUDIES[0]])
    figure = Figure(figsize=(COLUMN, 3.0))
    axes = figure.add_subplot(xlim=(0, 1), ylim=(0, 1), xlabel="share of the particles", ylabel="share of the collisions")
    there = runs["snapshot"].values
    chosen = [t for t in TIMES if t in there] or list(there[there > 0])
    for time, colour in zip(chosen, shades(len(chosen)), strict=True):
        counts = [run.values for run in runs["collision_frequency"].sel(snapshot=time).dropna("realization")]
        particles, _ = lorenz_curve(counts[0])
        collisions = np.mean([lorenz_curve(count)[1] for count in counts], axis=0)
        tenth = np.mean([share_of_largest(count, 0.1) for count in counts])
        uneven = np.mean([gini(count) for count in counts])
        chance = poisson_gini(np.mean(counts) * (1 - FREQUENCY_WINDOW) * time)
        label = f"${time:g}$: ${100 * tenth:.0f}$ %, ${uneven:.2f}$ (${chance:.2f}$)"
        thin = slice(None, None, max(1, len(particles) // 500))
        axes.plot(particles[thin], collisions[thin], color=colour, label=label)
    axes.plot([0, 1], [0, 1], color="0.6", linewidth=0.8, zorder=0)
    axes.axvline(0.1, color="0.6", linewidth=0.8, linestyle=":", zorder=0)
    axes.legend(title="$t$ (s): first tenth, Gini (by chance)", loc="lower right")
    return figure

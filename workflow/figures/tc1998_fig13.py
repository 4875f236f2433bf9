"""tc1998 Fig. 13: energy against collisions per particle for nine contact times."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.theory import energy_after_collisions
from granugas.plotting.runs import grid_points, thinned
from granugas.plotting.style import THEORY, power_of_ten, shades, styled

STUDIES = ("tc1998_contact_times",)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """T against C_t/N, one line a realization; homogeneous cooling dashed."""
    figure = Figure(figsize=(4.6, 3.3))
    axes = figure.add_subplot(xscale="log", yscale="log", xlabel="$C_t/N$", ylabel="$T$")
    points = sorted(grid_points(data[STUDIES[0]]), key=lambda point: -point[0]["contact_time"])
    for (key, runs), colour in zip(points, reversed(shades(len(points))), strict=True):
        label = power_of_ten(key["contact_time"])
        for _, run in thinned(runs, 600).groupby("realization"):
            run = run.squeeze("realization").isel(time=slice(1, None))
            axes.plot(run["collisions_per_particle"], run["kinetic_energy"], color=colour, linewidth=0.7, label=label)
            label = None
    limits, lowest = axes.get_xlim(), axes.get_ylim()[0]
    collisions = np.geomspace(*limits, 200)
    axes.plot(collisions, energy_after_collisions(collisions, points[0][0]["restitution"]), **THEORY, label="Eq. (23)")
    axes.set(xlim=limits, ylim=(lowest, 1.5))
    axes.legend(title=r"$t_c$ (s)", loc="upper left", bbox_to_anchor=(1, 1))
    return figure

"""tc1998 Fig. 12: energy against time for nine contact times, and homogeneous cooling."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.theory import homogeneous_cooling
from granugas.plotting.runs import band, grid_points, thinned
from granugas.plotting.style import THEORY, number_1_2_5, power_of_ten, shades, styled

STUDIES = ("tc1998_contact_times",)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """T against tau for each t_c; the inset is the end of the curves, Eq. 23 dashed."""
    figure = Figure(figsize=(4.6, 3.3))
    axes = figure.add_subplot(xscale="log", yscale="log", xlabel=r"$\tau$", ylabel=r"$T$")
    inset = axes.inset_axes([0.14, 0.1, 0.42, 0.42], xscale="log", yscale="log")
    points = sorted(grid_points(data[STUDIES[0]]), key=lambda point: -point[0]["contact_time"])
    for (key, runs), colour in zip(points, reversed(shades(len(points))), strict=True):
        runs = thinned(runs)
        band(axes, runs["tau"], runs["kinetic_energy"], color=colour, label=power_of_ten(key["contact_time"]))
        band(inset, runs["tau"], runs["kinetic_energy"], color=colour, spread=False)
    tau = np.geomspace(*axes.get_xlim(), 200)
    theory = homogeneous_cooling(tau, points[0][0]["restitution"])
    axes.plot(tau, theory, **THEORY, label="Eq. (23)")
    inset.plot(tau, theory, **THEORY)
    lowest = min(float(runs["kinetic_energy"].min()) for _, runs in points)
    last = float(points[0][1]["tau"].max())
    axes.set_xlim(tau[0], tau[-1])
    inset.set(xlim=(last / 5, last), ylim=(0.8 * lowest, 10 * lowest))
    inset.tick_params(labelsize=7)
    number_1_2_5(inset)
    axes.legend(title=r"$t_c$ (s)", loc="upper left", bbox_to_anchor=(1, 1))
    return figure

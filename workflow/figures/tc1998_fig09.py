"""tc1998 Fig. 9: collision rate against time for six sizes of the system, and homogeneous cooling."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.theory import homogeneous_cooling
from granugas.analysis.windows import growing_windows, middles, ratio_of_changes
from granugas.plotting.runs import grid_points, mean_and_range, times
from granugas.plotting.style import COLUMN, THEORY, shades, styled

STUDIES = ("tc1998_n42", "tc1998_n378", "tc1998_n1435", "tc1998_n5740", "tc1998_n22960", "tc1998_n97776")

FIRST, RATIO = 2.0e-3, 1.4
"""End of the first window of time (s), and of each next one by the one before."""


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """C_r against tau, the mean and the range of the realizations of each N; C_r(0) sqrt(T) dashed."""
    figure = Figure(figsize=(COLUMN, 3.1))
    axes = figure.add_subplot(xscale="log", yscale="log", xlabel=r"$\tau$", ylabel=r"$C_r$ (s$^{-1}$)", ylim=(0.6, 900))
    points = [point for name in STUDIES for point in grid_points(data[name])]
    points.sort(key=lambda point: -point[0]["n_particles"])
    for (key, runs), colour in zip(points, shades(len(points)), strict=True):
        edges = growing_windows(times(runs), FIRST, RATIO)
        time = times(runs) + xr.zeros_like(runs["tau"])
        rate = ratio_of_changes(runs["collisions_per_particle"], time, edges)
        label = f"$N = {key['n_particles']}$"
        mean_and_range(axes, middles(runs["tau"], edges), rate, color=colour, marker="o", label=label)
    tau = np.geomspace(*axes.get_xlim(), 200)
    cooling = homogeneous_cooling(tau, points[0][0]["restitution"])
    axes.plot(tau, float(points[0][1]["enskog_rate"].mean()) * np.sqrt(cooling), **THEORY, label="$C_r(0)\\,T^{1/2}$")
    axes.set_xlim(tau[0], tau[-1])
    axes.legend(loc="lower left")
    return figure

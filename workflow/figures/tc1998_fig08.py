"""tc1998 Fig. 8: energy against time for six sizes of the system, and homogeneous cooling."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.theory import homogeneous_cooling
from granugas.plotting.runs import band, grid_points
from granugas.plotting.style import COLUMN, THEORY, shades, styled

STUDIES = ("tc1998_n42", "tc1998_n378", "tc1998_n1435", "tc1998_n5740", "tc1998_n22960", "tc1998_n97776")


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """T against tau, the mean and the range of the realizations of each N; Eq. 23 dashed."""
    figure = Figure(figsize=(COLUMN, 3.1))
    axes = figure.add_subplot(xscale="log", yscale="log", xlabel=r"$\tau$", ylabel=r"$T$")
    points = [point for name in STUDIES for point in grid_points(data[name])]
    points.sort(key=lambda point: -point[0]["n_particles"])
    for (key, runs), colour in zip(points, shades(len(points)), strict=True):
        band(axes, runs["tau"], runs["kinetic_energy"], color=colour, label=f"$N = {key['n_particles']}$")
    tau = np.geomspace(*axes.get_xlim(), 200)
    axes.plot(tau, homogeneous_cooling(tau, points[0][0]["restitution"]), **THEORY, label="Eq. (23)")
    axes.set_xlim(tau[0], tau[-1])
    axes.legend()
    return figure

"""tc1998 Fig. 15: energy against time for seven coefficients of restitution, and homogeneous cooling."""

import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.theory import homogeneous_cooling
from granugas.plotting.runs import band, grid_points, thinned
from granugas.plotting.style import THEORY, number_1_2_5, shades, styled

STUDIES = ("tc1998_restitutions",)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """T against tau for each r, Eq. 23 dashed in the same colour; the inset is the end of the lower curves."""
    figure = Figure(figsize=(4.6, 3.6))
    axes = figure.add_subplot(xscale="log", yscale="log", xlabel=r"$\tau$", ylabel=r"$T$")
    inset = axes.inset_axes([0.12, 0.1, 0.4, 0.4], xscale="log", yscale="log")
    points = [(key["restitution"], thinned(runs)) for key, runs in grid_points(data[STUDIES[0]])]
    points.sort(key=lambda point: -point[0])
    for (r, runs), colour in zip(points, reversed(shades(len(points))), strict=True):
        tau = runs["tau"].mean("realization")[1:]
        for panel in (axes, inset):
            band(panel, runs["tau"], runs["kinetic_energy"], spread=panel is axes, color=colour, label=f"${r:g}$")
            panel.plot(tau, homogeneous_cooling(tau, r), **THEORY | {"color": colour, "linewidth": 0.7})
    axes.plot([], **THEORY, label="Eq. (23)")
    lowest = min(float(runs["kinetic_energy"].min()) for _, runs in points)
    last = float(points[0][1]["tau"].max())
    axes.set(xlim=(0.4, last), ylim=(lowest / 10, 1.5))
    inset.set(xlim=(last / 5, last), ylim=(0.8 * lowest, 10 * lowest))
    inset.tick_params(labelsize=7)
    number_1_2_5(inset)
    axes.legend(title="$r$", loc="upper left", bbox_to_anchor=(1, 1))
    return figure

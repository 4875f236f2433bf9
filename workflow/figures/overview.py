"""Any study at a glance: energy and collisions against time, and clusters where they were asked for."""

from itertools import cycle

import xarray as xr
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from granugas.plotting.runs import band, grid_points, point_names, times
from granugas.plotting.style import PAGE, mark_panels, shades, styled

SECTION = "Studies"
STUDIES = ()

PANELS = {
    "kinetic_energy": "$K$",
    "collisions_per_particle": "$C/N$",
    "mean_cluster_size": r"$\langle M \rangle$",
    "largest_cluster_size": r"$M_{\max}$",
}
DASHES = ("-", "--", "-.", ":", (0, (1, 4)), (0, (8, 2, 1, 2, 1, 2)))
MOST_NAMES = 24


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """Every point of the grid of one study: the mean and the range of its realizations."""
    ((study, whole),) = data.items()
    labels = {name: label for name, label in PANELS.items() if name in whole}
    points = [*grid_points(whole)]
    colours = shades(len(points))
    figure = Figure(figsize=(PAGE, 1.2 + 1.25 * len(labels)))
    figure.suptitle(study, fontsize="medium")
    panels = figure.subplots(len(labels) // 2, 2, squeeze=False).ravel()
    for axes, (name, label) in zip(panels, labels.items(), strict=True):
        axes.set(xscale="log", yscale="log", xlabel="$t$ (s)", ylabel=label)
        for (_, runs), colour in zip(points, colours, strict=True):
            clusters = "distance_factor" in runs[name].dims
            curves = runs[name].transpose("distance_factor", ...) if clusters else [runs[name]]
            for curve, dash in zip(curves, cycle(DASHES), strict=False):
                band(axes, times(runs), curve, color=colour, linestyle=dash)
    mark_panels(*panels)

    names = point_names([key for key, _ in points]) if 1 < len(points) <= MOST_NAMES else []
    lines = [Line2D([], [], color=colour, label=name) for colour, name in zip(colours, names, strict=False)]
    factors = whole["distance_factor"].values if "distance_factor" in whole else []
    lines += [
        Line2D([], [], color="0.4", linestyle=dash, label=f"$S_c = {factor:g}$")
        for factor, dash in zip(factors, cycle(DASHES), strict=False)
    ]
    if lines:
        figure.legend(handles=lines, loc="outside lower center", ncols=min(len(lines), 4), handlelength=2.5)
    return figure

"""tc1998 Fig. 16: elastic collisions, particles and energy against time for seven coefficients of restitution."""

import xarray as xr
from matplotlib.figure import Figure

from granugas.plotting.papers import elastic_fractions
from granugas.plotting.runs import grid_points
from granugas.plotting.style import shades, styled

STUDIES = ("tc1998_restitutions",)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """c_e, n_e and e_e in windows of .2 s."""
    points = sorted(grid_points(data[STUDIES[0]]), key=lambda point: -point[0]["restitution"])
    lines = [
        {"color": colour, "label": f"${key['restitution']:g}$"}
        for (key, _), colour in zip(points, reversed(shades(len(points))), strict=True)
    ]
    figure = elastic_fractions([runs for _, runs in points], lines, 0.2, ((1e-4, 1), (2e-5, 2e-2)))
    figure.axes[-1].legend(title="$r$", loc="upper left", bbox_to_anchor=(1, 1))
    return figure

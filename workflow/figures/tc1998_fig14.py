"""tc1998 Fig. 14: elastic collisions, particles and energy against time for nine contact times."""

import xarray as xr
from matplotlib.figure import Figure

from granugas.plotting.papers import elastic_fractions
from granugas.plotting.runs import grid_points
from granugas.plotting.style import power_of_ten, shades, styled

STUDIES = ("tc1998_contact_times",)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """c_e, n_e and e_e in windows of .1 s."""
    points = sorted(grid_points(data[STUDIES[0]]), key=lambda point: -point[0]["contact_time"])
    lines = [
        {"color": colour, "label": power_of_ten(key["contact_time"])}
        for (key, _), colour in zip(points, reversed(shades(len(points))), strict=True)
    ]
    figure = elastic_fractions([runs for _, runs in points], lines, 0.1, ((1e-4, 1.5), (2e-6, 1.5)))
    figure.axes[-1].legend(title=r"$t_c$ (s)", loc="upper left", bbox_to_anchor=(1, 1))
    return figure

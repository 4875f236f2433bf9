"""tc1998 Fig. 4: collision rate of elastic disks against area fraction, and the rates of their elastic collisions."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.elastic import whole_runs
from granugas.analysis.theory import enskog_rate
from granugas.plotting.runs import by_contact_time, error_points
from granugas.plotting.style import THEORY, styled

STUDIES = ("tc1998_elastic_n1435",)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """C_r with the Enskog rate, and C_r c_e for each t_c."""
    runs = whole_runs(data[STUDIES[0]])
    figure = Figure(figsize=(4.6, 3.6))
    axes = figure.add_subplot(yscale="log", xlabel=r"$\nu$", ylabel="collision rate (s$^{-1}$)", xlim=(0, 0.89))
    nu = np.linspace(0.007, 0.875, 300)
    energy = data[STUDIES[0]].attrs["velocity_half_width"] ** 2 / 3
    axes.plot(nu, enskog_rate(nu, energy, data[STUDIES[0]].attrs["diameter"]), **THEORY | {"linestyle": "-"}, label="Eq. (19)")
    error_points(axes, runs["collision_rate"], marker="o", color="black", markerfacecolor="none", label="$C_r$")
    axes.add_artist(axes.legend(loc="lower right"))
    elastic = runs["collision_rate"] * runs["elastic_collision_fraction"]
    by_contact_time(axes, elastic.where(elastic > 0), linestyle=(0, (4, 2)), linewidth=0.6)
    handles, labels = (entries[-runs.sizes["contact_time"] :] for entries in axes.get_legend_handles_labels())
    axes.legend(handles, labels, title="$C_r c_e$: $t_c$ (s)", loc="upper left", bbox_to_anchor=(1, 1))
    return figure

"""tc1998 section 5.4: how many elastic collisions are missing, by area fraction and contact time, and the exact limit."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.elastic import quality_factors, whole_runs
from granugas.analysis.theory import elastic_collision_fraction, elastic_collision_fraction_shielded, shielding
from granugas.plotting.runs import by_contact_time, error_points
from granugas.plotting.style import PAGE, THEORY, mark_panels, shades, styled

STUDIES = ("tc1998_elastic_n1435",)
DENSITIES = (0.02, 0.1, 0.226725, 0.4, 0.6)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """c_e by mean field with the measured C_r: (a) against nu for each t_c, (b) against t_c C_r for some nu."""
    runs = whole_runs(data[STUDIES[0]])
    factors = quality_factors(runs, 1000, "collision_rate")["q_c"]
    figure = Figure(figsize=(PAGE, 3.2))
    by_density, by_time = panels = figure.subplots(1, 2)
    nu = np.linspace(0, 0.68)
    by_density.plot(nu, shielding(nu), color="C1", zorder=4, label=r"$t_c \to 0$")
    by_contact_time(by_density, factors)
    by_density.set(xlabel=r"$\nu$", ylabel=r"$c_e \,/\, [1 - \exp(-2\, t_c C_r)]$", xlim=(0, 0.89), ylim=(0.7, 1.08))
    by_density.legend(title="$t_c$ (s)", loc="lower left", ncols=2)

    by_time.set(xscale="log", xlabel="$t_c C_r$", xlim=(1e-5, 10), ylim=(0.88, 1.01))
    x = np.geomspace(1e-5, 10, 200)
    densities = np.unique(runs["area_fraction"].sel(area_fraction=list(DENSITIES), method="nearest"))
    for density, colour, marker in zip(densities, shades(len(DENSITIES)), "osD^v", strict=False):
        here = factors.sel(area_fraction=density)
        here = here.assign_coords(contact_time=here["contact_time"] * runs["collision_rate"].sel(area_fraction=density).mean())
        look = {"color": colour, "marker": marker, "markerfacecolor": "none", "label": f"${density:.3g}$"}
        error_points(by_time, here, **look)
        expected = elastic_collision_fraction_shielded(x, 1, density) / elastic_collision_fraction(x, 1)
        by_time.plot(x, expected, color=colour, linewidth=0.8)
    by_time.legend(title=r"$\nu$", loc="lower right")
    for axes in panels:
        axes.axhline(1, **THEORY)
    mark_panels(*panels)
    return figure

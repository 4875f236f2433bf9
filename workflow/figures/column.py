"""A column of beads on a wall (A section 2.1): r_c against N by the ICW and the cushion model, and the TC model below it."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.theory import column_restitution, cushion_restitution
from granugas.plotting.style import MARKERS, PAGE, THEORY, mark_panels, power_of_ten, shades, styled

SECTION = "Hard cases"
STUDIES = ()
EXPERIMENTS = ("column",)
WALLS = {"as beads": "wall with the $r$ of the beads", "elastic": "elastic wall"}


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """(a) chi_c = N (1 - r_c) against N, measured and by two models; (b) collisions of a column of the TC model below r_c."""
    column = data["column"]
    figure = Figure(figsize=(PAGE, 2.9))
    edge, below = figure.subplots(1, 2)
    n = column["n_particles"].values
    edge.set(xlabel="$N$", ylabel=r"$\chi_c = N (1 - r_c)$", xlim=(0, n.max() + 1))
    for wall, colour, marker in zip(WALLS, ("C0", "C1"), MARKERS, strict=False):
        found = column["critical_restitution"].sel(wall=wall).values
        edge.plot(n, n * (1 - found), color=colour, marker=marker, markerfacecolor="none", linestyle="none", label=WALLS[wall])
    sizes = np.linspace(2, n.max(), 200)
    edge.plot(sizes, sizes * (1 - column_restitution(sizes)), **THEORY, label="ICW model")
    edge.plot(sizes, sizes * (1 - cushion_restitution(sizes)), **THEORY | {"linestyle": ":"}, label="cushion model")
    edge.axhline(np.pi, color="0.7", linewidth=0.6, zorder=0)
    edge.legend()
    beads = column.attrs["column_beads"]
    below.set(xlabel=r"$(1 - r)/(1 - r_c)$", ylabel=f"collisions of {beads} beads", yscale="log")
    for t_c, colour, marker in zip(column["contact_time"].values, shades(column.sizes["contact_time"]), MARKERS, strict=False):
        collisions = column["column_collisions"].sel(contact_time=t_c)
        look = {"color": colour, "marker": marker, "markerfacecolor": "none", "label": f"{power_of_ten(t_c)} s"}
        below.plot(column["depth"], collisions, **look)
    below.legend(title="$t_c$")
    mark_panels(edge, below)
    return figure

"""tc1998 Fig. 6: measured fraction of elastic collisions by Eq. 21."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.elastic import LEAST_COUNT, quality_factors, whole_runs
from granugas.analysis.theory import shielding
from granugas.plotting.runs import by_contact_time
from granugas.plotting.style import THEORY, styled

STUDIES = ("tc1998_elastic_n1435",)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """q_c against area fraction for each t_c; the inset is the fluid, with the limit for t_c -> 0."""
    runs = whole_runs(data[STUDIES[0]])
    figure = Figure(figsize=(4.6, 3.6))
    axes = figure.add_subplot(xlabel=r"$\nu$", ylabel="$q_c$", xlim=(0, 0.89), ylim=(0.5, 2.4))
    inset = axes.inset_axes([0.1, 0.5, 0.62, 0.46], xlim=(0, 0.68), ylim=(0.87, 1.03))
    inset.tick_params(labelsize=7)
    nu = np.linspace(0, 0.68)
    for panel, least in ((axes, LEAST_COUNT), (inset, 1000)):
        panel.axhline(1, **THEORY)
        by_contact_time(panel, quality_factors(runs, least)["q_c"])
    inset.plot(nu, shielding(nu), color="C1", zorder=4)
    inset.annotate("limit $t_c \\to 0$", (0.3, 0.91), color="C1", fontsize="small")
    axes.legend(title="$t_c$ (s)", loc="upper left", bbox_to_anchor=(1, 1))
    return figure

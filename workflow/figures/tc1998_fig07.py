"""tc1998 Fig. 7: measured fraction of elastic energy by Eq. 20."""

import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.elastic import quality_factors, whole_runs
from granugas.analysis.theory import ENERGY_OF_ELASTIC_PARTICLES
from granugas.plotting.runs import by_contact_time
from granugas.plotting.style import THEORY, styled

STUDIES = ("tc1998_elastic_n1435",)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """q_e against area fraction for each t_c, and 5/4."""
    factors = quality_factors(whole_runs(data[STUDIES[0]]))
    figure = Figure(figsize=(4.6, 3.2))
    axes = figure.add_subplot(xlabel=r"$\nu$", ylabel="$q_e$", xlim=(0, 0.89), ylim=(0.5, 2.8))
    axes.axhline(1, **THEORY)
    axes.axhline(ENERGY_OF_ELASTIC_PARTICLES, **THEORY | {"linestyle": "-"})
    axes.annotate("$5/4$", (0.8, 1.265), fontsize="small")
    by_contact_time(axes, factors["q_e"])
    axes.legend(title="$t_c$ (s)", loc="upper left", bbox_to_anchor=(1, 1))
    return figure

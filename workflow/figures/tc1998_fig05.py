"""tc1998 Fig. 5: measured fraction of elastic particles by Eq. 20, from snapshots and from the exact time average."""

import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.elastic import quality_factors, whole_runs
from granugas.plotting.runs import by_contact_time
from granugas.plotting.style import PAGE, THEORY, mark_panels, styled

STUDIES = ("tc1998_elastic_n1435",)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """q_n against area fraction for each t_c: (a) 30 snapshots, (b) averages over all times."""
    factors = quality_factors(whole_runs(data[STUDIES[0]]))
    figure = Figure(figsize=(PAGE, 3.2))
    panels = figure.subplots(1, 2, sharey=True)
    for axes, name in zip(panels, ("q_n", "q_n_time"), strict=True):
        axes.set(xlabel=r"$\nu$", xlim=(0, 0.89), ylim=(0.5, 2.4))
        axes.axhline(1, **THEORY)
        by_contact_time(axes, factors[name])
    inset = panels[1].inset_axes([0.12, 0.55, 0.66, 0.38], xlim=(0, 0.68), ylim=(0.965, 1.005))
    inset.tick_params(labelsize=7)
    inset.axhline(1, **THEORY)
    by_contact_time(inset, factors["q_n_time"])
    panels[0].set_ylabel("$q_n$")
    panels[0].legend(title="$t_c$ (s)", loc="upper center", ncols=2)
    mark_panels(*panels)
    return figure

"""tc1998 Fig. 3: reduced pressure of elastic disks against area fraction, for three sizes, and its ratio to Eqs. 16, 17."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis import theory
from granugas.analysis.elastic import whole_runs
from granugas.analysis.literature import COEXISTENCE, PRESSURES
from granugas.plotting.runs import each_run
from granugas.plotting.style import COLUMN, THEORY, mark_panels, styled

STUDIES = ("tc1998_elastic_n1435", "tc1998_elastic_n42", "tc1998_elastic_n16680")
MARKERS = ("o", "s", "^")


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """(a) P_0 - 1 of every run, the other two sizes in the inset; (b) all of them by 2 nu g(2a) of Eq. 17."""
    figure = Figure(figsize=(COLUMN + 0.6, 5.4))
    axes, ratios = figure.subplots(2, 1, sharex=True, height_ratios=(1.6, 1))
    inset = axes.inset_axes([0.5, 0.09, 0.47, 0.4], yscale="log", xlim=(0, 0.89), xticks=[0, 0.2, 0.4, 0.6, 0.8])
    inset.tick_params(labelsize=7)
    axes.set(yscale="log", xlim=(0, 0.89), ylabel="$P_0 - 1$")
    ratios.set(ylim=(0.6, 1.06), xlabel=r"$\nu$", ylabel=r"$(P_0 - 1)\,/\,2 \nu g(2a)$")
    nu = np.linspace(0.007, 0.875, 300)
    for panel in (axes, inset):
        panel.plot(nu, excess(nu), **THEORY | {"linestyle": "-"}, label="Eqs. (16), (17)")
    ratios.axhline(1, **THEORY | {"linestyle": "-"})
    ratios.plot(nu, excess(nu, theory.contact_value_dense(nu)) / excess(nu), **THEORY, label="with $g_4$")
    for index, (name, marker) in enumerate(zip(STUDIES, MARKERS, strict=True)):
        runs = whole_runs(data[name])
        measured, look = runs["reduced_pressure"] - 1, {"marker": marker, "color": f"C{index}"}
        label = f"$N = {runs['n_particles'].max():.0f}$"
        each_run(inset if index else axes, measured, runs["branch"], label, **look)
        each_run(ratios, measured / xr.apply_ufunc(excess, runs["area_fraction"]), runs["branch"], label, **look)
    published = {"marker": "x", "markersize": 4, "linestyle": "none", "label": "$N = 1024^2$"}
    for points, style in ((PRESSURES, published), (COEXISTENCE, {"linewidth": 1.5, "label": "coexistence"})):
        known = np.array([point.area_fraction for point in points])
        there = np.array([point.reduced_pressure for point in points]) - 1
        ratios.plot(known, there / excess(known), color="black", zorder=4, **style)
    ratios.legend(loc="lower left", ncols=2)
    axes.legend(loc="upper left")
    mark_panels(axes, ratios)
    return figure


def excess(nu, g=None):
    """2 nu g(2a)."""
    return theory.reduced_pressure(nu, g) - 1

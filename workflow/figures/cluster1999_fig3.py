"""cluster1999 Fig. 3: energy and collisions of the large system against time, and their local slopes."""

import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.growth import local_exponent
from granugas.analysis.theory import collisions_until, homogeneous_cooling
from granugas.plotting.papers import mark_growth
from granugas.plotting.runs import band, grid_points, power_line, times
from granugas.plotting.style import PAGE, THEORY, mark_panels, styled

STUDIES = ("cluster1999_large",)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """(a) K, lines of slopes -1 and -2, Eq. 1; (b) C/N and its elastic part, slope 1; (c), (d) local slopes beneath."""
    figure = Figure(figsize=(PAGE, 4.6))
    panels = left, right, below, beside = figure.subplots(2, 2, sharex="col", height_ratios=(1.6, 1)).ravel()
    for axes, label in ((left, "$K$"), (right, "$C/N$")):
        axes.set(xscale="log", yscale="log", ylabel=label)
    below.set(xlabel="$t$ (s)", ylabel=r"$\mathrm{d}\,\ln K\,/\,\mathrm{d}\,\ln t$", ylim=(-2.15, 0.05))
    beside.set(xlabel="$t$ (s)", ylabel=r"$\mathrm{d}\,\ln (C/N)\,/\,\mathrm{d}\,\ln t$", ylim=(0, 2))
    for key, runs in grid_points(data[STUDIES[0]]):
        t = times(runs)
        later, tau = runs.isel(time=slice(1, None)), runs["tau"].mean("realization")[1:]
        energy = band(left, t, runs["kinetic_energy"], color="C0", label=f"$N = {key['n_particles']}$")
        power_line(energy, (0.2, 3), -2, 0.35, "$-2$")
        power_line(energy, (2, 60), -1, 2.5, "$-1$")
        collisions = band(right, t, runs["collisions_per_particle"], color="C0", label="all collisions")
        band(right, t, runs["elastic_collisions_per_particle"], color="C1", label="elastic: one within $t_c$ before")
        power_line(collisions, (5, 200), 1, 2, "$1$")
        theories = homogeneous_cooling(tau, key["restitution"]), collisions_until(tau, key["restitution"])
        left.plot(t[1:], theories[0], **THEORY, label="Eq. (1)")
        right.plot(t[1:], theories[1], **THEORY, label="Eq. (4)")
        drawn = zip((below, beside), ("kinetic_energy", "collisions_per_particle"), theories, strict=True)
        for axes, name, theory in drawn:
            slopes = later[name].transpose("realization", "time").copy()
            slopes.values = local_exponent(t[1:], slopes)
            band(axes, t[1:], slopes, color="C0")
            axes.plot(t[1:], local_exponent(t[1:], theory), **THEORY)
        mark_growth(runs, *panels)
    for axes, slopes in ((below, (-2, -1)), (beside, (1,))):
        for slope in slopes:
            axes.axhline(slope, color="0.35", linewidth=0.6, zorder=0)
    left.legend(loc="lower left")
    right.legend()
    mark_panels(*panels)
    return figure

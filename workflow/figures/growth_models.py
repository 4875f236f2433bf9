"""How fast clusters grow in gases that dissipate differently."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from granugas.analysis.growth import growth_window, local_exponent
from granugas.analysis.statistics import fit_power_law
from granugas.plotting.runs import band, grid_points
from granugas.plotting.style import PAGE, mark_panels, styled

SECTION = "Effects"
STUDIES = ("growth_smooth", "growth_rough", "growth_viscoelastic")
FACTOR = 1.1  # S_c


def named(scene: dict) -> str:
    """What distinguishes a gas."""
    if scene["material"] == "viscoelastic":
        return "viscoelastic"
    rough = scene["tangential_restitution"] > -1 and scene["friction"] > 0
    beta = rf", $\beta = {scene['tangential_restitution']:g}$" if rough else ""
    mu = rf", $\mu = {scene['friction']:g}$" if rough and np.isfinite(scene["friction"]) else ""
    return rf"$r = {scene['restitution']:g}${beta}{mu}"


def bars(axes: Axes, place: int, t: xr.DataArray, sizes: xr.DataArray, colour: str) -> str:
    """The exponent between beginning and end of the growth regime, with its interval; the window as text."""
    fit = fit_power_law(t, sizes, growth_window(t, sizes))
    reach = np.nan_to_num(np.abs(np.array(fit.interval) - fit.exponent))[:, np.newaxis]
    axes.errorbar(fit.exponent, place, xerr=reach, fmt="o", color=colour, capsize=2)
    begin, end = (float(f"{time:.2g}") for time in fit.window)
    return f"{begin:g} to {end:g} s"


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """(a) <M> over time, (b) its local exponent, (c) the exponent of its growth regime."""
    figure = Figure(figsize=(PAGE, 6.0))
    growth, local, fits = panels = [*figure.subplot_mosaic("ab;cc").values()]
    growth.set(xscale="log", yscale="log", xlabel="$t$ (s)", ylabel=r"$\langle M \rangle$")
    local.set(xscale="log", xlabel="$t$ (s)", ylabel=r"$\mathrm{d}\,\ln\langle M \rangle\,/\,\mathrm{d}\,\ln t$")
    names = []
    for place, (scene, runs) in enumerate(point for study in STUDIES for point in grid_points(data[study])):
        sizes = runs["mean_cluster_size"].sel(distance_factor=FACTOR, method="nearest").transpose("realization", "time")[:, 1:]
        t, exponents, colour = sizes["time"], local_exponent(sizes["time"], sizes), f"C{place}"
        band(growth, t, sizes, color=colour, label=named(scene))
        band(local, t, sizes.copy(data=exponents), color=colour)
        names.append(f"{named(scene)}\n{bars(fits, place, t, sizes, colour)}")
    growth.legend()
    growth.set_yticks(ticks := [1, 2, 3, 5, 10], ticks)
    growth.set_yticks([], minor=True)
    local.axhline(0.3, color="0.35", linewidth=0.6, zorder=0)
    fits.axvline(0.3, color="0.35", linewidth=0.6, zorder=0)
    fits.set(xlabel=rf"exponent of $\langle M \rangle$, $S_c = {FACTOR:g}$", xlim=(-0.1, 0.7))
    fits.set(yticks=range(len(names)), yticklabels=names, ylim=(len(names) - 0.4, -0.6))
    fits.set_yticks([], minor=True)
    mark_panels(*panels)
    return figure

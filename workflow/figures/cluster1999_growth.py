"""The growth law of clusters in the large system: local exponents, and what S_c and the fit window do to the exponent."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from granugas.analysis.growth import local_exponent, regime_boundaries, window_exponents
from granugas.analysis.statistics import fit_power_law
from granugas.plotting.runs import band, grid_points
from granugas.plotting.style import PAGE, mark_panels, shades, styled

STUDIES = ("cluster1999_large",)
WINDOW = (1.0, 40.0)  # the growth regime of the paper, in s
SIZES = {"mean": r"\langle M \rangle = N/I_c", "weighted": r"\sum M_i^2/N", "largest": r"M_{\max}"}


def map_windows(axes: Axes, t: xr.DataArray, sizes: xr.DataArray, label: str) -> None:
    """The exponent over beginning and end of the fit window; a cross at the paper's."""
    ends = np.geomspace(0.1, t[-1], 60)
    axes.set(xscale="log", yscale="log", xlabel="fitted from $t$ (s)", ylabel="fitted to $t$ (s)")
    found = window_exponents(t, sizes, ends, ends).T
    axes.figure.colorbar(axes.pcolormesh(ends, ends, found, rasterized=True), ax=axes, label=label)
    axes.clabel(axes.contour(ends, ends, found, 5, colors="white", linewidths=0.7), fontsize="small")
    axes.plot(*WINDOW, "+", color="C1", markersize=9, markeredgewidth=1.6)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """(a) Local exponent of <M>, (b) exponents against S_c, (c), (d) those of <M> and M_max over the fit window."""
    figure = Figure(figsize=(PAGE, 5.8))
    panels = local, against, *maps = figure.subplots(2, 2).ravel()
    local.set(xscale="log", xlabel="$t$ (s)", ylabel=r"$\mathrm{d}\,\ln\langle M \rangle\,/\,\mathrm{d}\,\ln t$")
    against.set(yscale="log", ylim=(0.05, 5), xlabel="$S_c$", ylabel=f"exponent, {WINDOW[0]:g} to {WINDOW[1]:g} s")
    for _, runs in grid_points(data[STUDIES[0]]):
        later = runs.isel(time=slice(1, None)).transpose("distance_factor", "realization", "time", ...)
        t, factors, n = later["time"], runs["distance_factor"].values, runs.sizes["realization"]
        chosen = factors[abs(factors - 1.1).argmin()]
        for place, (factor, colour) in enumerate(zip(factors, shades(len(factors)), strict=True), start=1):
            sizes = later["mean_cluster_size"].sel(distance_factor=factor)
            band(local, t, sizes.copy(data=local_exponent(t, sizes)), color=colour, label=f"${factor:g}$")
            time, low, high = np.transpose(regime_boundaries(t, sizes))
            bars, look = np.maximum([time - low, high - time], 0), {"fmt": ".", "elinewidth": 0.8, "capsize": 1.5}
            local.errorbar(time, [-0.025 * place] * 2, xerr=np.nan_to_num(bars), color=colour, **look)
        for index, (name, symbol) in enumerate(SIZES.items()):
            if f"{name}_cluster_size" in later:
                fits = [fit_power_law(t, sizes, WINDOW) for sizes in later[f"{name}_cluster_size"]]
                bars = np.nan_to_num([np.abs(np.array(fit.interval) - fit.exponent) for fit in fits]).T
                style = {"color": f"C{index}", "marker": "osD"[index], "linewidth": 0.7, "capsize": 2}
                against.errorbar(factors, [fit.exponent for fit in fits], bars, label=f"${symbol}$", **style)
        for axes, (name, symbol) in zip(maps, (("mean", r"\langle M \rangle"), ("largest", r"M_{\max}")), strict=True):
            sizes = later[f"{name}_cluster_size"].sel(distance_factor=chosen)
            map_windows(axes, t, sizes, f"exponent of ${symbol}$, $S_c = {chosen:g}$")
        against.legend(title=f"bars: 95 % from {n} runs" if n > 1 else "one run, no interval")
    local.axhline(0.3, color="0.35", linewidth=0.6, zorder=0)
    local.set(xlim=(t[0], t[-1]), ylim=(None, 0.62))
    local.legend(title="$S_c$", loc="upper left", ncols=2)
    mark_panels(*panels)
    return figure

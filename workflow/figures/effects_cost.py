"""What each effect adds to the time of a collision, in two sizes of gases."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from granugas.plotting.style import PAGE, styled

SECTION = "Effects"
STUDIES = ()
EXPERIMENTS = ("effects_cost",)
MARKERS = ("o", "D")
FAR = 3.0
"""How many times as dear as the next one an effect is that does not go into the picture."""


def reach(added: xr.DataArray) -> float:
    """The largest cost (ns) that still is in the picture."""
    sizes = np.sort(added.max("n_particles").values)
    dear = np.flatnonzero(sizes[1:] > FAR * sizes[:-1].clip(np.median(abs(sizes))))
    return float(sizes[dear[0]] if len(dear) else sizes[-1])


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """Medians over the repetitions, bars from the first to the third quartile; what is beyond the axis as a number."""
    timed = data["effects_cost"].drop_sel(effect=data["effects_cost"].attrs["plain"])
    timed = timed.sortby(timed["cpu_added"].median("repetition").mean("n_particles"))
    low, middle, high = (timed["cpu_added"].quantile(q, "repetition") for q in (0.25, 0.5, 0.75))
    places, end = np.arange(timed.sizes["effect"]), 1.35 * reach(middle)
    figure = Figure(figsize=(0.75 * PAGE, 4.6))
    axes = figure.add_subplot(xlabel="processor time added to a collision (ns)", ylim=(-0.7, len(places) - 0.3))
    for k, n in enumerate(timed["n_particles"].values):
        value, first, third = (quantile.sel(n_particles=n).values for quantile in (middle, low, high))
        near, y = value <= end, places + 0.16 * (1 - 2 * k)
        look = {"fmt": MARKERS[k], "color": f"C{k}", "markersize": 3.5, "capsize": 1.5, "elinewidth": 0.8}
        bars = np.array([value - first, third - value])[:, near]
        axes.errorbar(value[near], y[near], xerr=bars, label=f"$N = {n}$", **look)
        for place, beyond in zip(places[~near], value[~near], strict=True):
            text = rf"{beyond / 1000:.1f} $\mathrm{{\mu s}}\;\rightarrow$"
            axes.text(0.98 * end, place, text, color=f"C{k}", ha="right", va=("bottom", "top")[k % 2], fontsize="small")
    axes.set(yticks=places, yticklabels=timed["effect"].values, xlim=(min(1.2 * float(low.min()), -0.1 * end), end))
    axes.axvline(0, color="0.6", linewidth=0.8, zorder=0)
    axes.grid(axis="y", color="0.9", linewidth=0.6)
    axes.tick_params(axis="y", which="both", length=0)
    axes.legend(loc="lower right")
    return figure

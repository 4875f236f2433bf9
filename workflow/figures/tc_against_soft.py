"""Does TC mimic contacts of many? Soft beads against TC and IHS: what a column keeps of its energy at a wall (A section 3)."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from granugas.plotting.style import MARKERS, PAGE, mark_panels, shades, styled

SECTION = "Accuracy"
STUDIES = ()
EXPERIMENTS = ("soft",)
RESTITUTION, SHOWN, SIZES = 0.8, (0.03, 0.3, 1.0, 3.0, 30.0), (2, 5, 10, 20)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """sqrt(E'/E) against the number of beads, (a) soft, (b) TC, for intervals between impacts; (c) against the interval."""
    left = np.sqrt(data["soft"]["energy_left"].sel(restitution=RESTITUTION, method="nearest"))
    figure = Figure(figsize=(PAGE, 2.9))
    panels = soft, hard, both = figure.subplots(1, 3, sharey=True)
    for axes, model in ((soft, "soft"), (hard, "TC")):
        against_number(axes, left.sel(model=model), left.sel(model="IHS"))
        axes.text(0.04, 0.04, {"soft": "soft beads", "TC": "TC model"}[model], transform=axes.transAxes)
    soft.set(ylabel=r"$\sqrt{E'/E}$", ylim=(-0.02, 1.03))
    hard.legend(title="$s/(v t_c)$", loc="center right", bbox_to_anchor=(1.0, 0.6))
    against_interval(both, left)
    mark_panels(*panels)
    return figure


def against_number(axes: Axes, left: xr.DataArray, plain: xr.DataArray) -> None:
    """One model at several intervals, and IHS up to its collapse, which a cross marks."""
    axes.set(xlabel="$N$", xlim=(0, left["n_particles"].max() + 1))
    shown = [interval for interval in SHOWN if interval in left["impact_interval"]]
    for interval, colour, marker in zip(shown, shades(len(shown)), MARKERS, strict=False):
        look = {"color": colour, "marker": marker, "markerfacecolor": "none", "linewidth": 0.8}
        axes.plot(left["n_particles"], left.sel(impact_interval=interval), **look, label=f"{interval:g}")
    ends = plain.isel(impact_interval=-1).dropna("n_particles")
    axes.plot(ends["n_particles"], ends, "k--", linewidth=0.9, label="IHS")
    if ends.sizes["n_particles"] < plain.sizes["n_particles"]:
        axes.plot(ends["n_particles"][-1:], ends[-1:], "kx", markersize=5)


def against_interval(axes: Axes, left: xr.DataArray) -> None:
    """Lines: soft beads; points: TC; dashes on the right: IHS, at no interval in particular."""
    longest = float(left["impact_interval"].max())
    axes.set(xscale="log", xlabel="$s/(v t_c)$", xlim=(left["impact_interval"].min() / 1.5, 5 * longest))
    sizes, handles = [n for n in SIZES if n in left["n_particles"]], []
    for n, colour, marker in zip(sizes, shades(len(sizes)), MARKERS, strict=False):
        soft, hard, plain = (left.sel(n_particles=n, model=model) for model in ("soft", "TC", "IHS"))
        axes.plot(soft["impact_interval"], soft, color=colour)
        look = {"color": colour, "marker": marker, "markerfacecolor": "none"}
        axes.plot(hard["impact_interval"], hard, linestyle=":", linewidth=0.7, **look)
        axes.plot([1.8 * longest, 4 * longest], [plain[-1]] * 2, color=colour, linestyle=(0, (2, 1)))
        handles.append(Line2D([], [], label=f"${n}$", **look))
    axes.text(2.7 * longest, 0.67, "IHS", ha="center", fontsize="small")
    axes.legend(handles=handles, title="$N$; lines: soft,\npoints: TC", loc="lower left")

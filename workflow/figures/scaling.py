"""What the cost of a collision depends on: number of disks, area fraction, clusters, contact duration."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from granugas.plotting import PAGE, mark_panels, styled

SECTION = "Cost"
STUDIES = ()
EXPERIMENTS = ("scaling",)


def rounds(axes: Axes, cost: xr.DataArray, along: str) -> None:
    """Medians, with bars from the fastest to the slowest round."""
    median, fastest, slowest = (cost.sel(statistic=name).values for name in ("median", "fastest", "slowest"))
    axes.errorbar(cost[along], median, yerr=[median - fastest, slowest - median], fmt="o-", capsize=2)
    axes.set_ylim(0, 1.15 * slowest.max())


def beside(axes: Axes, x: xr.DataArray, y: xr.DataArray, label: str) -> None:
    """Another quantity on an axis of its own at the right."""
    right = axes.twinx()
    right.plot(x, y, "D--", color="C1")
    right.set_yscale("log")
    right.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    right.yaxis.set_major_formatter("{x:g}")
    right.yaxis.set_minor_formatter(NullFormatter())
    right.set_ylabel(label, color="C1")
    right.tick_params(axis="y", which="both", colors="C1")


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """ns per collision against (a) N, (b) area fraction, (c) time while clusters grow, (d) t_c."""
    timed = data["scaling"]
    figure = Figure(figsize=(PAGE, 5.2))
    panels = size, fraction, clustering, contact = figure.subplots(2, 2).ravel()
    rounds(size, timed["cpu_by_size"], "n_particles")
    size.set(xscale="log", xlabel="$N$")
    rounds(fraction, timed["cpu_by_area_fraction"], "area_fraction")
    fraction.set(xlabel=r"area fraction $\nu$")
    clustering.plot(timed["time"], timed["cpu_while_clustering"], "o-")
    clustering.set(xscale="log", xlabel="$t$ (s)", ylim=(0, 1.15 * float(timed["cpu_while_clustering"].max())))
    beside(clustering, timed["time"], timed["mean_cluster_size"], r"$\langle M \rangle$")
    contact.plot(timed["contact_time"], timed["cpu_by_contact_time"], "o-")
    contact.set(xscale="log", xlabel="$t_c$ (s)", ylim=(0, 1.15 * float(timed["cpu_by_contact_time"].max())))
    contact.set_xticks(10.0 ** np.arange(-12, -1, 2))
    beside(contact, timed["contact_time"], timed["run_collisions"], "$C/N$ at the end")
    for axes in panels:
        axes.set_ylabel("time of a collision (ns)")
    mark_panels(*panels)
    return figure

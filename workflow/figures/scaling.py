"""What the cost of a collision depends on (number of disks, area fraction, clusters, contact duration), and of the workflow."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from granugas.plotting.runs import beside
from granugas.plotting.style import PAGE, mark_panels, styled

SECTION = "Cost"
STUDIES = ()
EXPERIMENTS = ("scaling",)
TABLES = ("cost",)


def rounds(axes: Axes, cost: xr.DataArray, along: str) -> None:
    """Medians, with bars from the fastest to the slowest round."""
    median, fastest, slowest = (cost.sel(statistic=name).values for name in ("median", "fastest", "slowest"))
    axes.errorbar(cost[along], median, yerr=[median - fastest, slowest - median], fmt="o-", capsize=2)
    axes.set_ylim(0, 1.15 * slowest.max())


def by_rule(axes: Axes, costs: xr.Dataset) -> None:
    """Processor time of all jobs of each rule."""
    minutes = costs[["rule", "cpu_seconds"]].to_dataframe().groupby("rule")["cpu_seconds"].sum().sort_values() / 60
    bars = axes.barh(minutes.index, minutes, height=0.7)
    axes.bar_label(bars, [f"{value:.2g}" for value in minutes], padding=2, fontsize="x-small")
    axes.tick_params(axis="y", which="both", length=0, labelsize="small")
    axes.set(xlim=(0, 1.08 * minutes.max()), xlabel="processor time of the workflow by rule (min)")


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """ns per collision against (a) N, (b) area fraction, (c) time while clusters grow, (d) t_c; (e) the workflow by rule."""
    timed = data["scaling"]
    figure = Figure(figsize=(PAGE, 7.4))
    panels = size, fraction, clustering, contact, rules = [*figure.subplot_mosaic("ab;cd;ee").values()]
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
    by_rule(rules, data["cost"])
    for axes in panels[:-1]:
        axes.set_ylabel("time of a collision (ns)")
    mark_panels(*panels)
    return figure

"""Where the time of the whole reproduction goes: each study and experiment, by what was done."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.figure import Figure

from granugas.plotting.style import PAGE, styled

SECTION = "Cost"
STUDIES = ()
TABLES = ("cost",)
OF_STUDIES = {"equilibrate": "start states", "simulate": "runs", "clusters": "clusters", "pool": "pooling"}
PICTURES = "figures, films, tables, claims"
OTHERS = {
    "experiments": "experiments",
    **dict.fromkeys(("figures", "animations", "tables", "claims", "explorer", "report", "check"), PICTURES),
    "warm_up": "kernels, compiled ahead",
}
NOT_NAMED = "studies of other configurations"


def minutes_of(costs: xr.Dataset) -> pd.DataFrame:
    """CPU minutes: a row for each study, experiment, or kind of other work, from short to long; a column for each kind."""
    table = costs[["study", "rule", "name", "cpu_seconds"]].to_dataframe()
    table["kind"] = table["rule"].map(OF_STUDIES | OTHERS)
    table["group"] = table["study"].fillna(NOT_NAMED).where(table["rule"].isin([*OF_STUDIES]), table["kind"])
    table["group"] = table["name"].where(table["kind"] == "experiments", table["group"])
    minutes = table.pivot_table(index="group", columns="kind", values="cpu_seconds", aggfunc="sum", fill_value=0.0) / 60
    order = [kind for kind in dict.fromkeys((OF_STUDIES | OTHERS).values()) if kind in minutes]
    return minutes.loc[minutes.sum(axis=1).sort_values(kind="stable").index, order]


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """A bar for each row, its kinds one after the other, its sum as a number."""
    minutes = minutes_of(data["cost"])
    places, ends = np.arange(len(minutes)), minutes.cumsum(axis=1)
    figure = Figure(figsize=(PAGE, 1.3 + 0.155 * len(places)))
    axes = figure.add_subplot(xlabel="processor time (min)", ylim=(-0.8, len(places) - 0.2))
    for k, kind in enumerate(minutes):
        axes.barh(places, minutes[kind], left=ends[kind] - minutes[kind], height=0.75, color=f"C{k}", label=kind)
    whole = ends.iloc[:, -1]
    for place, sum_of_row in zip(places, whole, strict=True):
        text = {"xytext": (3, 0), "textcoords": "offset points", "va": "center", "fontsize": "x-small"}
        axes.annotate(f"{sum_of_row:.2g}", (sum_of_row, place), **text)
    axes.set(yticks=places, yticklabels=minutes.index, xlim=(0, 1.08 * whole.max()))
    axes.set_title(f"{whole.sum():.3g} min in all", loc="right", fontsize="medium")
    axes.tick_params(axis="y", which="both", length=0, labelsize="x-small")
    axes.legend(loc="lower right", fontsize="small")
    return figure

"""What each collision model does about the inelastic collapse (A section 3): cooling, collisions, clusters, failures."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from granugas.plotting.style import MARKERS, PAGE, mark_panels, styled

SECTION = "Hard cases"
STUDIES = ()
EXPERIMENTS = ("models",)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """(a) K and (b) C/N against t, (c) costs and clusters at the end, (d) share of runs that collapse, by place."""
    models = data["models"]
    figure = Figure(figsize=(PAGE, 5.6))
    panels = energy, spent, costs, places = figure.subplots(2, 2).ravel()
    energy.set(xscale="log", yscale="log", xlabel="$t$ (s)", ylabel="$K$")
    spent.set(xscale="log", yscale="log", xlabel="$t$ (s)", ylabel="$C/N$")
    for k, name in enumerate(models["model"].values):
        run = models.sel(model=name).isel(time=slice(1, None))
        collapses = (run["stop_reason"] == "inelastic_collapse").all()
        look = {"color": f"C{k % 7}", "linestyle": "--" if collapses else "-", "markevery": (4 + k, 12), "markersize": 3}
        for axes, values in ((energy, run["kinetic_energy"]), (spent, run["collisions_per_particle"])):
            mean = values.mean("realization").dropna("time")
            axes.plot(mean["time"], mean, label=name, marker=MARKERS[k], linewidth=0.9, **look)
            axes.plot(mean["time"][-1:], mean[-1:], "x" if collapses else "", color=look["color"], markersize=6)
    spent.legend(fontsize="xx-small", loc="upper left")
    tell_costs(costs, models), show_places(places, models), mark_panels(*panels)
    return figure


def tell_costs(axes: Axes, models: xr.Dataset) -> None:
    """What a run to the end takes and leaves, mean over realizations; shades are logarithmic in each column."""
    mean = models.drop_vars("stop_reason").mean("realization")
    names = {"$C/N$": 2 * mean["events"] / models.attrs["n_particles"], "CPU s": mean["cpu_time"]}
    names |= {r"$\langle M \rangle$": mean["mean_cluster_size"], r"$M_{\max}$": mean["largest_cluster_size"]}
    values = np.stack([value.values for value in names.values()], axis=1)
    shades_of = np.log(values / values.min(axis=0)) / np.maximum(np.log(values.max(axis=0) / values.min(axis=0)), 1e-9)
    matrix(axes, 0.6 * shades_of, [[f"{value:.3g}" for value in row] for row in values], list(names), models["model"].values)


def show_places(axes: Axes, models: xr.Dataset) -> None:
    """The share of runs that collapse, for each model and place."""
    share = np.isfinite(models["collapse_time"]).mean("realization").transpose("model", "place").values
    texts = [[f"{value:.0%}" for value in row] for row in share]
    matrix(axes, 0.6 * share, texts, [place.replace(" ", "\n") for place in models["place"].values], models["model"].values)
    axes.set_xlabel("share of runs that collapse")


def matrix(axes: Axes, shade: np.ndarray, texts: list[list[str]], columns: list[str], rows: list[str]) -> None:
    """Texts on shaded fields."""
    axes.imshow(shade, cmap="Blues", vmin=0, vmax=1, aspect="auto")
    axes.set(xticks=range(len(columns)), xticklabels=columns, yticks=range(len(rows)), yticklabels=rows)
    axes.tick_params(which="both", length=0, labelsize="x-small")
    for row, column in np.ndindex(shade.shape):
        axes.text(column, row, texts[row][column], ha="center", va="center", fontsize="x-small")

"""What each collision model does about the inelastic collapse (A section 3): cooling, collisions, clusters, failures."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from granugas.plotting import PAGE, mark_panels, shades, styled

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
    for name, colour in zip(models["model"].values, shades(models.sizes["model"]), strict=True):
        run = models.sel(model=name).isel(time=slice(1, None))
        dashed = {"linestyle": "--"} if (run["stop_reason"] == "inelastic_collapse").all() else {}
        for axes, values in ((energy, run["kinetic_energy"]), (spent, run["collisions_per_particle"])):
            axes.plot(run["time"], values.mean("realization"), color=colour, label=name, **dashed)
            if dashed:
                last = int(values.mean("realization").notnull().sum()) - 1
                axes.plot(run["time"][last], values.mean("realization")[last], "x", color=colour, markersize=5)
    energy.legend(fontsize="x-small", loc="lower left")
    tell_costs(costs, models)
    show_places(places, models)
    mark_panels(*panels)
    return figure


def tell_costs(axes: Axes, models: xr.Dataset) -> None:
    """Numbers of a whole run, mean over realizations, as a table."""
    n, mean = models.attrs["n_particles"], models.mean("realization", numeric_only=True)
    rows = [("", "$t_{end}$ (s)", "$C/N$", "CPU s", r"$\langle M \rangle$", r"$M_{\max}$")]
    for name in models["model"].values:
        of = mean.sel(model=name)
        values = (of["stop_time"], 2 * of["events"] / n, of["cpu_time"], of["mean_cluster_size"], of["largest_cluster_size"])
        rows.append((name, *(f"{float(value):.3g}" for value in values)))
    axes.axis("off")
    table = axes.table(rows, loc="center", edges="open", cellLoc="right", colWidths=[0.3, *[0.15] * 5])
    table.auto_set_font_size(False)
    table.set_fontsize(6.5)


def show_places(axes: Axes, models: xr.Dataset) -> None:
    """The matrix of model and place."""
    share = np.isfinite(models["collapse_time"]).mean("realization").transpose("model", "place").values
    axes.imshow(1 - share, cmap="RdYlGn", vmin=-0.4, vmax=1.4, aspect="auto")
    axes.set_xticks(range(models.sizes["place"]), models["place"].values, rotation=20, ha="right")
    axes.set_yticks(range(models.sizes["model"]), models["model"].values)
    axes.tick_params(length=0, labelsize="x-small")
    for (row, column), value in np.ndenumerate(share):
        axes.text(column, row, f"{value:.0%}", ha="center", va="center", fontsize="x-small")
    axes.set_title("share of runs that collapse", fontsize="small")

"""tc1998 section 5.1: the pressure in test volumes, and what the size of the volume and of the interval do to it."""

import numpy as np
import xarray as xr
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from granugas.plotting.runs import error_points
from granugas.plotting.snapshots import draw_disks
from granugas.plotting.style import PAGE, mark_panels, shades, styled

STUDIES = ()
EXPERIMENTS = ("volumes",)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """(a) Parts of the pressure by V_c, (b) its spread by dt, (c) its map, (d) its course in one volume for several dt."""
    found = data["volumes"]
    elastic, clusters = found.sel(restitution=1.0), found.sel(restitution=found["restitution"].min())
    figure = Figure(figsize=(PAGE, 5.8))
    panels = parts, spread, picture, series = figure.subplots(2, 2).ravel()
    parts.set(xscale="log", xlabel=r"$N\,V_c/V$", ylabel="$P V/E$", ylim=(-0.03, 1.35))
    for name, colour, marker in (("kinetic", "C0", "o"), ("streaming", "C1", "s"), ("collisional", "C2", "^")):
        for gas, look in ((clusters, {"label": name}), (elastic, {"markerfacecolor": "none"})):
            values = gas[f"{name}_pressure"].assign_coords(test_volumes=found.attrs["n_particles"] / gas["test_volumes"])
            error_points(parts, values, color=colour, marker=marker, linestyle="-", **look)
    parts.legend(title="open: $r = 1$", loc="upper left", ncols=3, columnspacing=1)
    spread.set(xscale="log", yscale="log", xlabel=r"$C_r\,\Delta t$", ylabel=r"$\sigma_P / \langle P \rangle$", ylim=(4e-3, 3))
    cuts = found["test_volumes"].values[1:]
    for count, colour in zip(cuts, shades(len(cuts)), strict=True):
        for gas, look in ((clusters, {"label": f"$V/{count}$"}), (elastic, {"linestyle": "--", "markerfacecolor": "none"})):
            passed = gas["interval_collisions"].mean("realization").values
            values = gas["pressure_spread"].sel(test_volumes=count).assign_coords(averaging_interval=passed)
            error_points(spread, values, color=colour, **{"marker": "o", "linestyle": "-"} | look)
    spread.legend(title="$V_c$, open: $r = 1$", loc="lower left", ncols=2)
    first = clusters.isel(realization=0)
    box, d = np.array([found.attrs["box_x"], found.attrs["box_y"]]), found.attrs["diameter"]
    draw_disks(picture, first["position"].values, box, d, np.tile([0, 0, 0, 0.5], (first.sizes["particle"], 1)))
    shown = picture.imshow(
        first["pressure_map"], norm=LogNorm(), cmap="YlOrRd", origin="lower", extent=(0, box[0] / d, 0, box[1] / d), zorder=0
    )
    figure.colorbar(shown, ax=picture, label="$P V/E$")
    course, begin, length = (first[name].values for name in ("pressure_series", "record_begin", "record_length"))
    for steps, colour in zip((1, 4, 16), ("0.75", "C0", "C1"), strict=True):
        averages = course.reshape(-1, steps).mean(axis=1)
        edges = begin + length * np.linspace(0, 1, averages.size + 1)
        series.stairs(averages, edges, baseline=None, color=colour, label=f"{1e3 * length / averages.size:g}")
    series.set(xlabel="$t$ (s)", ylabel="$P V/E$", ylim=(0, None))
    series.legend(title=r"$\Delta t$ (ms)")
    mark_panels(*panels)
    return figure

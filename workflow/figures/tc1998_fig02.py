"""tc1998 Fig. 2: a ball that bounces until it rests, and the measured n_s, t_s and Delta t_s beside Eqs. 7 to 10."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from granugas.analysis import theory
from granugas.analysis.at_rest import shown
from granugas.plotting.style import PAGE, THEORY, mark_panels, shades, styled

STUDIES = ()
EXPERIMENTS = ("bouncing",)
MODELS = {"soft": ("soft", "0.6", 0.9), "hard": ("IHS", "C1", 1.8), "contact_time": ("TC", "C0", 0.9)}


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """(a) Heights against time, (b) n_s and (c) t_s against t_c, (d) Delta t_s against r."""
    figure, ball = Figure(figsize=(PAGE, 5.2)), data["bouncing"]
    above, *below = figure.subplot_mosaic("aaa;bcd", height_ratios=(1.2, 1)).values()
    _heights(above, ball)
    _rests(*below, ball, t_1=float(ball["first_period"]))
    mark_panels(above, *below)
    return figure


def _heights(axes: Axes, ball: xr.Dataset) -> None:
    t_1, rest = ball["first_period"].item(), shown(ball)
    zoom = axes.inset_axes([0.47, 0.38, 0.51, 0.58], xlim=(3.2, 4.6), ylim=(-0.018, 0.036))
    axes.set(xlim=(0, 6), ylim=(-0.15, 0.72), xlabel="$t / t_1$", ylabel="$h / h_1$")
    for name, (label, colour, width) in MODELS.items():
        for panel in (axes, zoom):
            height = ball[f"height_{name}"] / (ball["gravity"] * t_1**2 / 8)
            panel.plot(ball["experiment_time"] / t_1, height, color=colour, linewidth=width, label=label)
    for name, label, colour in (("rest_time", "$t_s$ (TC)", "C0"), ("rest_time_hard", "$t_s$ (IHS)", "C1")):
        zoom.axvline(rest[name] / t_1, color=colour, linestyle=":")
        zoom.annotate(label, (rest[name] / t_1, 0.036), (3, -3), textcoords="offset points", va="top", color=colour)
    axes.legend(loc="upper left", bbox_to_anchor=(0.25, 1))


def _rests(hits: Axes, times: Axes, differences: Axes, ball: xr.Dataset, t_1: float) -> None:
    ratio, fine = ball["contact_ratio"], np.geomspace(4e-7, 0.25, 200)
    for k, colour in enumerate(shades(7), 1):
        one, r = ball.isel(restitution=-k), ball["restitution"].values[-k]
        line, points = {"color": colour, "linewidth": 0.8}, {"color": colour, "marker": "o", "linestyle": "none"}
        hits.plot(ratio, one["hits_to_rest"], **points, label=f"$r = {r:g}$")
        hits.plot(fine, theory.hits_to_rest(r, fine), **line)
        times.plot(ratio, one["rest_time"] / t_1, **points)
        times.plot(fine, theory.rest_time(r, fine), **line)
        times.plot(5e-8, one["rest_time_hard"] / t_1, "s", color=colour, markersize=4, markerfacecolor="none")
        differences.plot(np.full(ratio.size, r), one["rest_time_difference"] / t_1 / ratio * (1 - r), **points)
    differences.plot([0.4, 1], [0.4, 1], **THEORY)
    differences.axhline(1, color="black", linewidth=0.8, linestyle=":")
    differences.text(0.7, 0.62, "Eq. (10)")
    times.text(5e-8, 140, "IHS", ha="center", va="center", fontsize="small")
    hits.set(xscale="log", yscale="log", xlabel="$t_c / t_1$", ylabel="$n_s$", ylim=(1, 3e4))
    times.set(xscale="log", yscale="log", xlabel="$t_c / t_1$", ylabel="$t_s / t_1$", xlim=(1e-8, 1), ylim=(0.5, 200))
    differences.set(xlabel="$r$", ylabel=r"$(1 - r)\, \Delta t_s / t_c$", xlim=(0.4, 1.02), ylim=(0.4, 1.05))
    hits.legend(fontsize="x-small", ncols=2, loc="upper right")

"""Does the answer depend on rounding? Copies that differ in the last bit part from their runs and agree in the mean."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.divergence import collision_times, lyapunov_exponent, relative_spread
from granugas.plotting.style import PAGE, mark_panels, styled

SECTION = "Accuracy"
STUDIES = ()
EXPERIMENTS = ("rounding",)
WINDOW = (1e-12, 1e-3)  # of the distance by d, in which the Lyapunov exponent is fitted
LINES = {"last bit": "-", "order": ":"}


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """(a) Distance against C/N, (b) against tau; (c) K of a run, its copies and the others; (d) spread of the copies."""
    figure = Figure(figsize=(PAGE, 5.4))
    panels = *parting, energy, spread = figure.subplots(2, 2).ravel()
    parting[0].set(yscale="log", xlabel="$C/N$", ylabel=r"$\Delta/d$", xlim=(0, 60))
    parting[1].set(yscale="log", xlabel=r"$\tau$", ylabel=r"$\Delta/d$", xlim=(0, 120))
    energy.set(xscale="log", xlabel=r"$\tau$", ylabel=r"$K\,/\,\langle K \rangle$")
    spread.set(yscale="log", xlabel="$C/N$", ylabel="spread of copies by that of runs")
    each = ("change", "copy")
    for index, r in enumerate(data["rounding"]["restitution"].values):
        gas = data["rounding"].sel(restitution=r).isel(stop=slice(1, None)).transpose("realization", "change", "copy", "stop")
        count, tau, k = (gas[name] for name in ("collisions_per_particle", "tau", "kinetic_energy"))
        clock = tau.copy(data=[collision_times(*pair) for pair in zip(tau.values, k.values, strict=True)])
        distances = gas["separation"].stack(each=each).transpose("realization", "each", "stop")
        for axes, x, fitted in ((parting[0], count, count), (parting[1], tau, clock)):
            value, error = lyapunov_exponent(fitted, distances, WINDOW)
            words = rf"\lambda = {value:.2f} \pm {error:.2f}" if axes is parting[0] else rf"t_L = {1 / value:.2f}\,t_E"
            for change, line in LINES.items():
                distance = gas["separation"].sel(change=change)
                mean = np.exp(np.log(distance.where(distance > 0)).mean(("realization", "copy"), skipna=False))
                label = f"$r = {r:g}$: ${words}$" if line == "-" else None
                axes.plot(x.mean("realization"), mean, color=f"C{index}", linestyle=line, label=label)
        quantities = {"collisions_per_particle": "$C/N$"} | ({"kinetic_energy": "$K$"} if r < 1 else {})
        for (name, words), line in zip(quantities.items(), "-:", strict=False):
            copies = gas[f"copy_{name}"].stack(each=each).transpose("realization", "each", "stop")
            ratio = relative_spread(copies, gas[name])
            look = {"color": f"C{index}", "linestyle": line, "label": f"{words}, $r = {r:g}$"}
            spread.plot(count.mean("realization"), np.where(ratio > 0, ratio, np.nan), **look)
        if r == data["rounding"]["restitution"].min():
            relative, mean = k / k.mean("realization"), k.mean("realization")
            energy.fill_between(tau[0], relative.min("realization"), relative.max("realization"), color="0.85", linewidth=0)
            for (change, line), colour in zip(LINES.items(), ("C2", "C3"), strict=True):
                copies = (gas["copy_kinetic_energy"] / mean).isel(realization=0).sel(change=change)
                look = {"color": colour, "linestyle": line, "linewidth": 0.6}
                energy.plot(tau[0], copies.transpose("stop", "copy"), **look)[0].set_label(f"its copies: {change}")
            energy.plot(tau[0], relative[0], color="black", label=f"one run, $r = {r:g}$")
            energy.legend(loc="upper left")
    for change, line in LINES.items():
        parting[0].plot([], [], color="0.3", linestyle=line, label=f"copies: {change}")
    for axes in (*parting, spread):
        axes.legend(loc="lower right")
    mark_panels(*panels)
    return figure

"""tc1998 section 7: how the contact duration slows the first of the cooling, and how the rest changes with it."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.cooling import cooling_with_contact_time, initial_cooling
from granugas.analysis.statistics import mean_and_error
from granugas.analysis.theory import dissipation_factor, elastic_collision_fraction_shielded, loss_shielding
from granugas.plotting.runs import band, grid_points
from granugas.plotting.style import PAGE, THEORY, mark_panels, power_of_ten, shades, styled

STUDIES = ("tc1998_outlook_cooling", "tc1998_outlook_transition")

QUANTITIES = {"cooling_factor": "cooling rate", "inelastic_fraction": "$1 - c_e$"}


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """(a) Cooling rate by that without t_c, and 1 - c_e; (b) both by mean field; (c) T against tau for 1e-3 ... 1e-2 s."""
    figure = Figure(figsize=(PAGE, 3.0))
    factors, quality, whole = panels = figure.subplots(1, 3)
    cooling, transition = (list(grid_points(data[name])) for name in STUDIES)
    nu, x = cooling[0][0]["area_fraction"], np.geomspace(1e-3, 10, 200)
    lines = dissipation_factor(x, 1, nu), 1 - elastic_collision_fraction_shielded(x, 1, nu)
    for line, colour, words in zip((np.exp(-2 * x), *lines), ("k", "C0", "C1"), ("Eq. (21)", None, None), strict=True):
        factors.plot(x, line, **THEORY | {"color": colour})
        quality.plot(x, line * np.exp(2 * x), **THEORY | {"color": colour}, label=words)
    for restitution, marker in zip(sorted({key["restitution"] for key, _ in cooling}, reverse=True), "os", strict=False):
        of_r = [(key, runs) for key, runs in cooling if key["restitution"] == restitution]
        found = xr.concat([initial_cooling(runs, restitution, key["contact_time"]) for key, runs in of_r], "point")
        ratio = found["contact_ratio"].mean("realization")
        for (name, words), colour in zip(QUANTITIES.items(), ("C0", "C1"), strict=True):
            look = {"marker": marker, "color": colour, "linestyle": "none", "markerfacecolor": "none", "elinewidth": 0.7}
            mean, error = mean_and_error(found[name].transpose("realization", "point"))
            factors.errorbar(ratio, mean, error, **look)
            mean, error = (np.where(error < 0.1 * mean, values, np.nan) * np.exp(2 * ratio) for values in (mean, error))
            quality.errorbar(ratio, mean, error, **look, label=f"{words}, $r = {restitution:g}$")
    transition.sort(key=lambda point: -point[0]["contact_time"])
    whole.set(xscale="log", yscale="log", xlabel=r"$\tau$", ylabel="$T$", ylim=(1.5e-4, 1.5))
    for (key, runs), colour in zip(transition, reversed(shades(len(transition))), strict=True):
        band(whole, runs["tau"], runs["kinetic_energy"], color=colour, label=power_of_ten(key["contact_time"]))
        tau, ratio = runs["tau"].mean("realization")[1:], key["contact_time"] * float(runs["enskog_rate"].mean())
        theory = cooling_with_contact_time(tau, key["restitution"], loss_shielding(nu) * ratio)
        whole.plot(tau, theory, **THEORY | {"color": colour, "linewidth": 0.7})
    whole.legend(title="$t_c$ (s)", loc="lower left")
    quality.legend(loc="upper left")
    quality.set_ylim(0.35, 1.9)
    for axes, label in ((factors, "factor"), (quality, "factor by that of Eq. (21)")):
        axes.set(xscale="log", xlabel="$t_c / t_E$", ylabel=label)
    mark_panels(*panels)
    return figure

"""cluster1999, section 6: clusters by relative velocity and by collision frequency, and the length of the structure factor."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.criteria import compare
from granugas.analysis.statistics import fit_power_law
from granugas.analysis.structure import mean_wavelength, structure_factor
from granugas.plotting.runs import band, grid_points
from granugas.plotting.style import PAGE, exponent, mark_panels, shades, styled

STUDIES = ("cluster1999_large",)
FACTOR, REACH, SHORTEST, WINDOW = 1.1, 1.5, 5, (1.0, 41.0)  # S_c; reach and shortest wavelength in d; of the exponents in s
UNITS, THRESHOLDS = ("v(t)", "v(0)", "C_r(t)"), np.array([[0.1, 0.3, 1], [0.01, 0.03, 0.1], [0.5, 1, 2]])
TITLES = (r"$|\vec v_{ij}| \leq x\,v(t)$", r"$|\vec v_{ij}| \leq x\,v(0)$", r"$C_r^{(i)}, C_r^{(j)} \geq x\,C_r(t)$")


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """(a) <M> and (b) M_max by each criterion, three thresholds each; (c) M_w by one of each, S(k), and lengths."""
    ((key, runs),) = grid_points(data[STUDIES[0]])
    shots = [[measured(key, shot.squeeze()) for _, shot in run.groupby("snapshot")] for _, run in runs.groupby("realization")]
    mean, weighted, largest = np.array([[found for found, *_ in run] for run in shots]).transpose(3, 2, 0, 1)
    figure, t, distance = Figure(figsize=(PAGE, 7.8)), runs["snapshot"].rename(snapshot="time"), f"$S_c = {FACTOR:g}$"
    *rows, (sizes, spectrum, lengths) = panels = figure.subplots(3, 3)
    for row, values, name in zip(rows, (mean, largest), (r"$\langle M \rangle$", r"$M_{\max}$"), strict=True):
        for c, axes in enumerate(row):
            labels = [distance, *(f"$x = {x:g}$" for x in THRESHOLDS[c])]
            lines(axes, t, values[[0, *range(1 + 3 * c, 4 + 3 * c)]], labels, name)
            axes.set(title=TITLES[c], ylim=(0.9, 1.3 * values.max()))
    labels = [distance, *(f"${x:g}\\,{unit}$" for x, unit in zip(THRESHOLDS[:, 1], UNITS, strict=True))]
    lines(sizes, t, weighted[[0, 2, 5, 8]], labels, "$M_w$")
    spectrum.set(xscale="log", yscale="log", xlabel="$k d$", ylabel="$S(k)$", title=f"${t[0]:g}$ s (dark) to ${t[-1]:g}$ s")
    for s, colour in enumerate(shades(t.size)):
        spectrum.plot(shots[0][s][1], np.mean([run[s][2] for run in shots], axis=0), color=colour, linewidth=0.8)
    waves = [[mean_wavelength(k, strength, SHORTEST) for _, k, strength in run] for run in shots]
    labels = (r"$2\pi / \langle k \rangle$", r"$\langle M \rangle^{1/2}$", "$M_w^{1/2}$", r"$M_{\max}^{1/2}$")
    lines(lengths, t, [waves, *np.sqrt([mean[0], weighted[0], largest[0]])], labels, "length ($d$)")
    lengths.set_ylim(bottom=0.06)  # room for the legend
    mark_panels(*panels[:, 0])
    return figure


def lines(axes, t, values, labels, name):
    """Means and ranges over realizations; exponents in the labels where three snapshots are in the window."""
    axes.set(xscale="log", yscale="log", xlabel="$t$ (s)", ylabel=name)
    for y, label, colour in zip(values, labels, ("black", *shades(3)), strict=True):
        fit = f": {exponent(fit_power_law(t, y, WINDOW))}" if ((t >= WINDOW[0]) & (t <= WINDOW[1])).sum() > 2 else ""
        band(axes, t, xr.DataArray(y, dims=("realization", "time")), color=colour, marker=".", markersize=3, label=label + fit)
    axes.legend(fontsize="x-small")


def measured(key, shot):
    """Of a snapshot (criteria, 3) <M>, M_w and M_max; k d; S(k)."""
    x, v, rate = (shot[name].values for name in ("position", "velocity", "collision_frequency"))
    d, box = key["diameter"], np.array([shot["box_x"], shot["box_y"]])
    speeds = np.sqrt([[2 * np.square(v).mean()], [2 / 3 * key["velocity_half_width"] ** 2]]) * THRESHOLDS[:2]
    found = compare(x, v, rate, box, FACTOR * d, REACH * d, speeds.ravel(), rate.mean() * THRESHOLDS[2])
    return found, *structure_factor(x / d, box / d, 512)

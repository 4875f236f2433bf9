"""cluster1999 Fig. 3: energy and collisions of the large system against time."""

import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.theory import homogeneous_cooling
from granugas.plotting import PAGE, THEORY, band, grid_points, mark_panels, power_line, styled, times

STUDIES = ("cluster1999_large",)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """(a) K with lines of slopes -1 and -2 and Eq. 1; (b) C/N and its elastic part with a line of slope 1."""
    figure = Figure(figsize=(PAGE, 2.9))
    left, right = figure.subplots(1, 2)
    for axes, label in ((left, "$K$"), (right, "$C/N$")):
        axes.set(xscale="log", yscale="log", xlabel="$t$ (s)", ylabel=label)
    for key, runs in grid_points(data[STUDIES[0]]):
        t = times(runs)
        energy = band(left, t, runs["kinetic_energy"], color="C0", label=f"$N = {key['n_particles']}$")
        cooling = homogeneous_cooling(runs["tau"].mean("realization"), key["restitution"])
        left.plot(t[1:], cooling[1:], **THEORY, label="Eq. (1)")
        power_line(energy, (0.2, 3), -2, 0.35, "$-2$")
        power_line(energy, (2, 60), -1, 2.5, "$-1$")
        collisions = band(right, t, runs["collisions_per_particle"], color="C0", label="all collisions")
        band(right, t, runs["elastic_collisions_per_particle"], color="C1", label="elastic: one within $t_c$ before")
        power_line(collisions, (5, 200), 1, 2, "$1$")
    left.legend(loc="lower left")
    right.legend()
    mark_panels(left, right)
    return figure

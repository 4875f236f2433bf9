"""cluster1999 Fig. 1: cooling of small systems with seven coefficients of restitution, against time and collisions."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.theory import energy_after_collisions, homogeneous_cooling
from granugas.plotting.papers import cooling_views
from granugas.plotting.runs import grid_points, power_line
from granugas.plotting.style import THEORY, shades, styled

STUDIES = ("cluster1999_restitutions",)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """The four views, with Eq. 1 and the slope -2 in (a) and Eq. 3 in (b)."""
    points = sorted(((key["restitution"], runs) for key, runs in grid_points(data[STUDIES[0]])), key=lambda point: -point[0])
    figure, (energy, spent, *_) = cooling_views([(f"${r:g}$", runs) for r, runs in points], "$r$", "linear")
    ends = [(axes.get_xlim(), axes.get_ylim()) for axes in (energy, spent)]
    for (r, runs), colour in zip(points, shades(len(points)), strict=True):
        look = THEORY | {"color": colour, "linewidth": 0.7}
        t, count = np.geomspace(*ends[0][0], 300), np.linspace(0, ends[1][0][1], 300)
        rate = float(runs["enskog_rate"].isel(realization=0))
        energy.plot(t, homogeneous_cooling(rate * t, r), **look)
        spent.plot(count, energy_after_collisions(count, r), **look)
        if r == points[0][0]:
            begin = 4 / (1 - r**2) / rate  # where Eq. 1 turns into t^-2
            power_line(energy.lines[-1], (3 * begin, 60 * begin), -2, 4, "$-2$")
    for axes, (x, y) in zip((energy, spent), ends, strict=True):
        axes.set(xlim=x, ylim=y)
    return figure

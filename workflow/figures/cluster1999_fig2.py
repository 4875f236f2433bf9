"""cluster1999 Fig. 2: cooling of small systems with five contact times, against time and collisions."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.theory import energy_after_collisions, homogeneous_cooling
from granugas.plotting.papers import cooling_views
from granugas.plotting.runs import grid_points
from granugas.plotting.style import THEORY, power_of_ten, styled

STUDIES = ("cluster1999_contact_times",)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """The four views, with Eq. 1 in (a) and Eq. 3 in (b)."""
    points = sorted(grid_points(data[STUDIES[0]]), key=lambda point: -point[0]["contact_time"])
    curves = [(power_of_ten(key["contact_time"]), runs) for key, runs in points]
    figure, (energy, spent, *_) = cooling_views(curves, "$t_c$ (s)", "log")
    r, rate = points[0][0]["restitution"], float(points[0][1]["enskog_rate"].isel(realization=0))
    ends = [(axes.get_xlim(), axes.get_ylim()) for axes in (energy, spent)]
    t, count = (np.geomspace(*x, 300) for x, _ in ends)
    energy.plot(t, homogeneous_cooling(rate * t, r), **THEORY)
    spent.plot(count, energy_after_collisions(count, r), **THEORY)
    for axes, (x, y) in zip((energy, spent), ends, strict=True):
        axes.set(xlim=x, ylim=y)
    return figure

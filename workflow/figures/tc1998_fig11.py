"""tc1998 Fig. 11: snapshots for six contact times, started identically, coloured by the speed of each particle."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.theory import rms_speed
from granugas.plotting.papers import blue_green_red
from granugas.plotting.runs import grid_points
from granugas.plotting.snapshots import draw_disks
from granugas.plotting.style import PAGE, power_of_ten, styled

STUDIES = ("tc1998_contact_times",)

CONTACT_TIMES = (1e-2, 1e-3, 1e-5, 1e-8, 1e-10, 1e-12)
BLUE, GREEN, RED = 0.01, 0.02, 0.045
"""v_T / v_0 of the print's colours."""


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """The last snapshot of the first realization for each t_c of the print that there is."""
    figure = Figure(figsize=(PAGE, 4.5))
    points = {key["contact_time"]: (key, runs) for key, runs in grid_points(data[STUDIES[0]])}
    there = [t for t in CONTACT_TIMES if t in points]
    scale = blue_green_red(BLUE, GREEN, RED)
    for place, contact_time in enumerate(there, start=1):
        axes = figure.add_subplot(-(-len(there) // 3), 3, place)
        key, runs = points[contact_time]
        particles = runs.isel(realization=0, snapshot=-1)
        initial = np.sqrt(np.pi) / 2 * rms_speed(key["velocity_half_width"] ** 2 / 3)  # mean speed of a Maxwellian
        speed = np.hypot(*particles["velocity"].values.T) / initial
        box = float(particles["box_x"]), float(particles["box_y"])
        draw_disks(axes, particles["position"].values, box, key["diameter"], scale.to_rgba(speed))
        axes.set_title(f"$t_c =$ {power_of_ten(contact_time)} s")
    figure.colorbar(scale, ax=figure.axes, extend="both", label=r"$v_T^{(i)} / v_0$", shrink=0.7, aspect=30)
    return figure

"""Eight scenes, each from a configuration of a few lines: examples/*.yaml."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from granugas.plotting.runs import grid_points
from granugas.plotting.snapshots import by_energy, draw_disks, relative_energy
from granugas.plotting.style import PAGE, styled

SECTION = "Effects"
STUDIES = (
    "scene_cooling",
    "scene_spheres",
    "scene_bed",
    "scene_vibrated_bed",
    "scene_rough_gas",
    "scene_mixture",
    "scene_driven_gas",
    "scene_column",
)
SPINNING = "scene_rough_gas"


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """The last snapshot of each, coloured by energy; of the column all snapshots, side by side."""
    figure = Figure(figsize=(PAGE, 4.3))
    for name, axes in zip(STUDIES, figure.subplots(2, 4).ravel(), strict=True):
        ((key, runs),) = grid_points(data[name])
        run = runs.isel(realization=0)
        title = name.removeprefix("scene_").replace("_", " ") + (", spins" if name == SPINNING else "")
        axes.set_title(f"{title}, $t = {float(run['snapshot'][-1]):g}$ s", fontsize="small")
        shots = [run.isel(snapshot=k) for k in (range(run.sizes["snapshot"]) if key["dimensions"] == 1 else [-1])]
        draw_scene(axes, key, shots)
    by_energy().bar(figure, ax=figure.axes, location="bottom", shrink=0.5, aspect=40, pad=0.02)
    return figure


def draw_scene(axes: Axes, key: dict, shots: list[xr.Dataset]) -> None:
    """Disks as they lie, spheres from above, beads as columns."""
    position = np.concatenate([shot["position"].values for shot in shots])
    motion = np.concatenate([shot["spin" if "spin" in shot else "velocity"].values for shot in shots])
    colour = by_energy()(relative_energy(motion.reshape(len(motion), -1)))
    walls = key["boundary"].split() * (3 if " " not in key["boundary"] else 1)
    box, walled = [float(shots[-1][f"box_{a}"]) for a in "xyz"[: position.shape[1]]], [word == "wall" for word in walls]
    diameter = shots[-1]["particle_diameter"].values if "particle_diameter" in shots[-1] else key["diameter"]
    if position.shape[1] == 3:
        order = np.argsort(position[:, 2])
        position, colour = position[order, :2], colour[order]
    elif position.shape[1] == 1:
        columns = np.repeat(np.arange(len(shots)), len(position) // len(shots))
        position = np.column_stack([(columns + 0.5) * box[0] / len(shots), position[:, 0]])
        box, walled = box * 2, [True, True]
    draw_disks(axes, position, box[:2], diameter, colour, walled[:2])

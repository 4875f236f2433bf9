"""The gaps between near disks, as exact as the engine knows them."""

import numpy as np
from scipy.spatial import cKDTree

from granugas.dynamics.events.engine import Engine

NEAR = 1.05
"""Pairs up to this distance (d) are looked at."""

TOLERATED = 1.0e-12
"""Deepest overlap (d) that rounding may leave."""


def smallest_gap(engine: Engine) -> float:
    """The least distance of two disks minus their radii, in d; infinite where none are near.

    The tree on absolute positions only names the near pairs. Their separations come from coordinates relative to the
    cells, which do not lose digits in a large box.
    """
    disks, grid, calendar = (engine.arrays[name] for name in ("disks", "grid", "calendar"))
    box, cells, width = grid["box"][0], grid["cells"][0], grid["width"][0]
    flown = (calendar["now"][0] - disks["t"])[:, np.newaxis]
    in_cell = disks["x"] + disks["v"] * flown
    cell = disks["cell"].astype(np.int64)
    absolute = np.mod(in_cell + (cell + 0.5) * width, box)
    absolute[absolute >= box] = 0.0
    d = engine.state().more.get("diameter", np.full(len(cell), engine.scene.diameter)) / engine.scene.diameter
    i, j = cKDTree(absolute, boxsize=box).query_pairs(NEAR * d.max(), output_type="ndarray").T
    if not len(i):
        return np.inf
    apart = cell[j] - cell[i]
    apart -= cells * np.rint(apart / cells).astype(np.int64)
    separation = in_cell[j] - in_cell[i] + apart * width
    separation -= box * np.rint(separation / box)  # where a box of a few cells leaves two ways around
    return float(np.min(np.linalg.norm(separation, axis=1) - (d[i] + d[j]) / 2))

"""Beads on a ring, at equal distances. A lattice has no other kind in one dimension, and there is no crystal to keep."""

import numpy as np

from granugas.lattices.lattice import Lattice, asked_box
from granugas.scene import Scene

DENSEST: dict[str, float] = {}

MELTED_UP_TO = 1.0
"""Line fraction."""


def filling(scene: Scene) -> Lattice:
    """N sites."""
    box = asked_box(scene)
    return Lattice("line", scene.n_particles, 1, box, box[0] / scene.n_particles)


def site(lattice: Lattice, k: np.ndarray) -> np.ndarray:
    """Positions (n, 1) of sites, in m."""
    return ((k + 0.5) * lattice.box[0] / lattice.nx)[:, np.newaxis]

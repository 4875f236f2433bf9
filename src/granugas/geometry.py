"""Volumes of boxes and particles in one, two and three dimensions."""

import math

SHAPES = {1: (1.0, 1.0), 2: (math.pi, 4.0), 3: (math.pi, 6.0)}
"""Volume of a ball of diameter d: the first by the second number, times d^D."""

CLOSE_PACKING = {1: 1.0, 2: math.pi / (2 * math.sqrt(3)), 3: math.pi / (3 * math.sqrt(2))}
"""Volume fraction of the densest packing of equal balls: 1, .9069, .7405."""

INERTIA = {2: 1 / 2, 3: 2 / 5}
"""q = I / (m a^2), the moment of inertia of uniform disks and spheres of radius a."""

ROTATIONS = {2: 1, 3: 3}
"""Axes about which they spin."""


def box_volume(n_particles: int, fraction: float, diameter: float, dimensions: int) -> float:
    """V = N v / nu in m^D, with the length, area or volume v of a particle of this diameter (m): N pi d^2 / (4 nu) in 2D."""
    first, second = SHAPES[dimensions]
    return n_particles * first * diameter**dimensions / (second * fraction)

"""Square and triangular lattices of disks."""

import math
from dataclasses import replace

import numpy as np

from granugas.geometry import CLOSE_PACKING
from granugas.lattices.lattice import Lattice, asked_box, factors, near_enough, stretch
from granugas.scene import Scene

DENSEST = {"square": math.pi / 4, "triangular": CLOSE_PACKING[2]}
"""Area fractions of touching disks."""

MELTED_UP_TO = 0.70
"""Area fraction."""


def filling(scene: Scene) -> Lattice:
    """In the box as asked the lattice with the widest spacing among those with at least N sites.

    Below melting the square one, which is unstable and forgets itself soon; above, the triangular one. Where only a regular
    lattice fits, the box follows it.
    """
    kind = "square" if scene.area_fraction <= MELTED_UP_TO else "triangular"
    inside = max(_shapes_inside(scene, kind), key=lambda lattice: lattice.spacing)
    if not inside.holds(scene):
        other = max(_shapes_inside(scene, "triangular"), key=lambda lattice: lattice.spacing)
        inside = max(inside, other, key=lambda lattice: lattice.spacing)
    if inside.holds(scene):
        return inside
    regular = [_regular(scene, "triangular", nx, ny) for nx, ny in _shapes_above(scene.n_particles)]
    close = [lattice for lattice in regular if near_enough(lattice, scene)]
    return max([inside, *close], key=lambda lattice: lattice.spacing)


def explicit(scene: Scene) -> Lattice:
    """nx columns times ny rows of exactly N sites, in the box that makes them equidistant; spacing 0 if there is none.

    An odd number of triangular rows leaves a seam across the periodic edge.
    """
    shapes = [_regular(scene, scene.lattice, nx, ny) for nx, ny in factors(scene.n_particles)]
    nearest = sorted(shapes, key=lambda lattice: stretch(lattice, scene))
    fitting = [lattice for lattice in nearest if lattice.holds(scene) and near_enough(lattice, scene)]
    return fitting[0] if fitting else replace(nearest[0], spacing=0.0)


def site(lattice: Lattice, k: np.ndarray) -> np.ndarray:
    """Positions (n, 2) of sites, in m, row by row."""
    row, column = np.divmod(k, lattice.nx)
    shift = 0.5 * (row % 2) if lattice.kind == "triangular" else 0.0
    x = (column + 0.25 + shift) * lattice.box[0] / lattice.nx
    y = (row + 0.5) * lattice.box[1] / lattice.ny
    return np.stack([x, y], axis=1)


def _shapes_inside(scene: Scene, kind: str) -> list[Lattice]:
    """Lattices of at least N sites in exactly the box that was asked for."""
    box = asked_box(scene)
    ratio = scene.aspect_ratio * (math.sqrt(3) / 2 if kind == "triangular" else 1.0)
    middle = math.sqrt(scene.n_particles * ratio)
    found = []
    for nx in range(max(1, int(middle * 0.8) - 2), int(middle * 1.25) + 4):
        ny = -(-scene.n_particles // nx)
        rows = {ny, ny + ny % 2} if kind == "triangular" else {ny}
        found += [Lattice(kind, nx, k, box, _spacing(kind, nx, k, box)) for k in rows]
    return found


def _shapes_above(n: int) -> list[tuple[int, int]]:
    """Columns and even numbers of rows with at least n sites and little more than one row too many."""
    top = int(2 * math.sqrt(n)) + 2
    return [(-(-n // ny), ny) for ny in range(2, top + 1, 2)]


def _regular(scene: Scene, kind: str, nx: int, ny: int) -> Lattice:
    """The box in which nx times ny sites are equidistant, at the scene's area per site of N."""
    ratio = nx / ny * (2 / math.sqrt(3) if kind == "triangular" else 1.0)
    box = (math.sqrt(scene.volume * ratio), math.sqrt(scene.volume / ratio))
    return Lattice(kind, nx, ny, box, _spacing(kind, nx, ny, box))


def _spacing(kind: str, nx: int, ny: int, box: tuple[float, float]) -> float:
    """Least distance of two different sites, or of a site and its own image."""
    a, b = box[0] / nx, box[1] / ny
    if kind == "square":
        return min(a, b)
    slanted = math.hypot(a / 2, b) if ny > 1 else math.inf
    straight = b if ny % 2 else 2 * b  # an odd number of rows leaves a seam where rows lie above each other
    return min(a, slanted, straight)

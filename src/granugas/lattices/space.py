"""Simple cubic and face-centred cubic lattices of spheres."""

import itertools
import math
from collections.abc import Iterator

import numpy as np

from granugas.geometry import CLOSE_PACKING
from granugas.lattices.lattice import Lattice, asked_box, factors, near_enough, stretch
from granugas.scene import Scene

DENSEST = {"cubic": math.pi / 6, "fcc": CLOSE_PACKING[3]}
"""Volume fractions of touching spheres."""

MELTED_UP_TO = 0.49
"""Volume fraction: spheres freeze at .494, and the crystal melts at .545 (Hoover & Ree 1968)."""

SITES = {"cubic": 1, "fcc": 4}
"""Of a cell."""

IN_CELL = {"cubic": ((0.5, 0.5, 0.5),), "fcc": ((0.25, 0.25, 0.25), (0.75, 0.75, 0.25), (0.75, 0.25, 0.75), (0.25, 0.75, 0.75))}
"""Where they are in it."""


def filling(scene: Scene) -> Lattice:
    """In the box as asked the lattice with the widest spacing among those with at least N sites.

    Below melting the simple cubic one, which is unstable and forgets itself soon; where it does not fit, and above, the
    face-centred one. Where only a regular lattice fits, the box follows it.
    """
    kinds = ("cubic", "fcc") if scene.area_fraction <= MELTED_UP_TO else ("fcc",)
    for kind in kinds:
        inside = max(_shapes_inside(scene, kind), key=lambda lattice: lattice.spacing)
        if inside.holds(scene):
            return inside
    regular = [_regular(scene, inside.kind, shape.counts) for shape in _shapes_inside(scene, inside.kind)]
    return max([inside, *(one for one in regular if near_enough(one, scene))], key=lambda lattice: lattice.spacing)


def explicit(scene: Scene) -> Lattice:
    """nx times ny times nz cells of exactly N sites, in the box that makes them cubes; spacing 0 if there is none."""
    cells, left = divmod(scene.n_particles, SITES[scene.lattice])
    shapes = [] if left else [_regular(scene, scene.lattice, counts) for counts in _triples(cells)]
    nearest = sorted(shapes, key=lambda lattice: stretch(lattice, scene))
    fitting = [lattice for lattice in nearest if lattice.holds(scene) and near_enough(lattice, scene)]
    return fitting[0] if fitting else Lattice(scene.lattice, 1, 1, asked_box(scene), spacing=0.0)


def site(lattice: Lattice, k: np.ndarray) -> np.ndarray:
    """Positions (n, 3) of sites, in m, layer by layer."""
    cell, which = np.divmod(k, SITES[lattice.kind])
    row, column = np.divmod(cell, lattice.nx)
    layer, row = np.divmod(row, lattice.ny)
    place = np.stack([column, row, layer], axis=1) + np.array(IN_CELL[lattice.kind])[which]
    return place * np.array(lattice.box) / np.array(lattice.counts)


def _shapes_inside(scene: Scene, kind: str) -> list[Lattice]:
    """Lattices of at least N sites in exactly the box that was asked for."""
    box, cells = asked_box(scene), -(-scene.n_particles // SITES[kind])
    cell = (scene.volume / cells) ** (1 / 3)
    ranges = [range(max(1, int(0.8 * side / cell) - 1), int(1.25 * side / cell) + 3) for side in box[:2]]
    shapes = ((nx, ny, -(-cells // (nx * ny))) for nx, ny in itertools.product(*ranges))
    return [Lattice(kind, nx, ny, box, _spacing(kind, (nx, ny, nz), box), nz) for nx, ny, nz in shapes]


def _regular(scene: Scene, kind: str, counts: tuple[int, ...]) -> Lattice:
    """The box of the scene's volume in which so many cells are cubes."""
    side = (scene.volume / math.prod(counts)) ** (1 / 3)
    box = tuple(count * side for count in counts)
    return Lattice(kind, counts[0], counts[1], box, _spacing(kind, counts, box), counts[2])


def _spacing(kind: str, counts: tuple[int, ...], box: tuple[float, ...]) -> float:
    """Least distance of two different sites, or of a site and its own image."""
    sides = [length / count for length, count in zip(box, counts, strict=True)]
    diagonals = [math.hypot(a, b) / 2 for a, b in itertools.combinations(sides, 2)] if kind == "fcc" else []
    return min(*sides, *diagonals)


def _triples(n: int) -> Iterator[tuple[int, int, int]]:
    """All triples of numbers whose product is n."""
    return ((nx, ny, nz) for nx, rest in factors(n) for ny, nz in factors(rest))

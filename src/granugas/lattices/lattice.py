"""What start lattices of any number of dimensions have in common."""

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass

from granugas.diameters import largest
from granugas.scene import Scene

TOUCH = 1.0 + 1.0e-9
"""Least distance of two centres on a start lattice, in diameters of the largest particle."""

MOST_STRETCH = 1.5
"""How far the box of a regular lattice may leave the aspect ratio that was asked for (a factor)."""


@dataclass(frozen=True)
class Lattice:
    """Sites of a start lattice.

    Attributes:
        kind: "line", "triangular", "square", "cubic" or "fcc".
        nx, ny: columns and rows; sites beyond N stay empty.
        box: sides in m, as many as space has dimensions.
        spacing: least distance of two sites in the periodic box, in m.
        nz: layers; nx, ny and nz count the cells of four sites of "fcc".
    """

    kind: str
    nx: int
    ny: int
    box: tuple[float, ...]
    spacing: float
    nz: int = 1

    @property
    def counts(self) -> tuple[int, ...]:
        """Columns, rows and layers, along each axis of space."""
        return (self.nx, self.ny, self.nz)[: len(self.box)]

    @property
    def n_sites(self) -> int:
        """Number of sites."""
        return self.nx * self.ny * self.nz * (4 if self.kind == "fcc" else 1)

    @property
    def waves(self) -> tuple[int, ...]:
        """Along each axis the least number of waves that meet its columns, rows or layers in phase."""
        return tuple(count * (2 if self.kind == "fcc" else 1) for count in self.counts)

    def holds(self, scene: Scene) -> bool:
        """Whether the particles do not overlap on it."""
        return self.spacing >= scene.diameter * largest(scene) * TOUCH


def asked_box(scene: Scene) -> tuple[float, ...]:
    """The sides (m) that a scene asks for; in 3D L_z = sqrt(L_x L_y)."""
    if scene.dimensions == 2:
        return math.sqrt(scene.volume * scene.aspect_ratio), math.sqrt(scene.volume / scene.aspect_ratio)
    side, ratio = scene.volume ** (1 / scene.dimensions), math.sqrt(scene.aspect_ratio)
    return (side * ratio, side / ratio, side)[: scene.dimensions]


def stretch(lattice: Lattice, scene: Scene) -> float:
    """How far the box of a lattice leaves the ratios of the sides that were asked for: the logarithm of the worst factor."""
    asked = (scene.aspect_ratio, 1.0, math.sqrt(scene.aspect_ratio))
    pairs = itertools.combinations(range(len(lattice.box)), 2)
    return max((abs(math.log(lattice.box[a] / lattice.box[b] / (asked[a] / asked[b]))) for a, b in pairs), default=0.0)


def near_enough(lattice: Lattice, scene: Scene) -> bool:
    """Whether a box is as nearly the one that was asked for as a regular lattice has to be."""
    return stretch(lattice, scene) <= math.log(MOST_STRETCH)


def factors(n: int) -> Iterator[tuple[int, int]]:
    """All pairs of numbers whose product is n."""
    for k in range(1, math.isqrt(n) + 1):
        if n % k == 0:
            yield k, n // k
            if k != n // k:
                yield n // k, k

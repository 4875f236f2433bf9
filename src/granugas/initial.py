"""Where a run starts: disks on a lattice, with uniformly distributed velocity components."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from granugas.geometry import CLOSE_PACKING
from granugas.scene import Scene, SceneError

TOUCH = 1.0 + 1.0e-9
"""Least distance of two centres on a start lattice, in diameters."""

DENSEST = {"square": math.pi / 4, "triangular": CLOSE_PACKING[2]}
"""Area fractions of touching disks."""

MELTED_UP_TO = 0.70
"""Area fraction up to which a start is melted; above, the crystal is the stable phase and is kept."""

MOST_STRETCH = 1.5
"""How far the box of a regular lattice may leave the aspect ratio that was asked for (a factor)."""


@dataclass(frozen=True)
class Lattice:
    """Sites of a start lattice.

    Attributes:
        kind: "triangular" or "square".
        nx, ny: columns and rows; sites beyond N stay empty.
        box: (Lx, Ly) in m.
        spacing: least distance of two sites in the periodic box, in m.
    """

    kind: str
    nx: int
    ny: int
    box: tuple[float, float]
    spacing: float


def check_lattice(scene: Scene) -> None:
    """See whether the disks fit.

    Raises:
        SceneError: they do not; names the largest area fraction or the nearest N that does.
    """
    start_lattice(scene)


def start_lattice(scene: Scene) -> Lattice:
    """The lattice on which a scene starts.

    An explicit lattice is regular: nx columns times ny rows of exactly N sites, in the box (nearest to the aspect ratio)
    that makes them equidistant; an odd number of triangular rows leaves a seam across the periodic edge. "auto" takes the
    box as asked and the lattice with the widest spacing among those with at least N sites: below melting the square one,
    which is unstable and forgets itself soon; above, the triangular one. Where only a regular lattice fits, the box follows it.

    Raises:
        SceneError: the disks do not fit.
    """
    lattice = _auto(scene) if scene.lattice == "auto" else _explicit(scene)
    if lattice.spacing >= scene.diameter * TOUCH:
        return lattice
    if scene.lattice != "auto":
        if scene.area_fraction >= DENSEST[scene.lattice]:
            raise SceneError(
                "area_fraction", scene.area_fraction, f"a {scene.lattice} lattice holds less than {DENSEST[scene.lattice]:.4f}"
            )
        raise SceneError("n_particles", scene.n_particles, _nearest_advice(scene))
    largest = scene.area_fraction * (lattice.spacing / (scene.diameter * TOUCH)) ** 2
    raise SceneError(
        "area_fraction",
        scene.area_fraction,
        f"{scene.n_particles} disks fit on a lattice up to {math.floor(largest * 1e4) / 1e4:.4f}",
    )


def sites(lattice: Lattice, n: int, rng: np.random.Generator) -> np.ndarray:
    """Positions (n, 2) of n disks on the lattice, in m; sites that stay empty are drawn at random."""
    taken = np.sort(rng.permutation(lattice.nx * lattice.ny)[:n]) if n < lattice.nx * lattice.ny else np.arange(n)
    row, column = np.divmod(taken, lattice.nx)
    shift = 0.5 * (row % 2) if lattice.kind == "triangular" else 0.0
    x = (column + 0.25 + shift) * lattice.box[0] / lattice.nx
    y = (row + 0.5) * lattice.box[1] / lattice.ny
    return np.stack([x, y], axis=1)


def start_velocities(scene: Scene, rng: np.random.Generator) -> np.ndarray:
    """Velocities (N, 2) in m/s: components uniform in +-w, mean removed, E = N m w^2 / 3 exactly.

    A single disk keeps its velocity, which is its momentum.
    """
    w = scene.velocity_half_width
    velocity = rng.uniform(-w, w, (scene.n_particles, 2))
    if scene.n_particles > 1:
        velocity -= velocity.mean(axis=0)
    return rescaled(velocity, w)


def rescaled(velocity: np.ndarray, half_width: float) -> np.ndarray:
    """Velocities (N, 2) scaled to the kinetic energy E = N m w^2 / 3."""
    return velocity * math.sqrt(2 * half_width**2 / 3 / np.mean(np.sum(velocity**2, axis=1)))


def random_stream(scene: Scene, seed: int, realization: int) -> np.random.Generator:
    """Random numbers of one start: they depend on seed, realization, N, area fraction and lattice, on nothing else."""
    words = (seed, realization, scene.n_particles, round(scene.area_fraction * 1e12))
    return np.random.default_rng([*words, ("auto", "triangular", "square").index(scene.lattice)])


def _explicit(scene: Scene) -> Lattice:
    shapes = [_regular(scene, scene.lattice, nx, ny) for nx, ny in _factors(scene.n_particles)]
    nearest = sorted(shapes, key=lambda lattice: _stretch(lattice, scene))
    fitting = [lattice for lattice in nearest if lattice.spacing >= scene.diameter * TOUCH]
    near_enough = [lattice for lattice in fitting if _stretch(lattice, scene) <= math.log(MOST_STRETCH)]
    if near_enough:
        return near_enough[0]
    return replace(nearest[0], spacing=0.0)


def _auto(scene: Scene) -> Lattice:
    kind = "square" if scene.area_fraction <= MELTED_UP_TO else "triangular"
    inside = max(_filling(scene, kind), key=lambda lattice: lattice.spacing)
    if inside.spacing < scene.diameter * TOUCH:
        other = max(_filling(scene, "triangular"), key=lambda lattice: lattice.spacing)
        inside = max(inside, other, key=lambda lattice: lattice.spacing)
    if inside.spacing >= scene.diameter * TOUCH:
        return inside
    regular = [_regular(scene, "triangular", nx, ny) for nx, ny in _shapes_above(scene.n_particles)]
    close = [lattice for lattice in regular if _stretch(lattice, scene) <= math.log(MOST_STRETCH)]
    return max([inside, *close], key=lambda lattice: lattice.spacing)


def _filling(scene: Scene, kind: str) -> list[Lattice]:
    """Lattices of at least N sites in exactly the box that was asked for."""
    box = _asked_box(scene)
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


def _stretch(lattice: Lattice, scene: Scene) -> float:
    return abs(math.log(lattice.box[0] / lattice.box[1] / scene.aspect_ratio))


def _asked_box(scene: Scene) -> tuple[float, float]:
    return math.sqrt(scene.volume * scene.aspect_ratio), math.sqrt(scene.volume / scene.aspect_ratio)


def _factors(n: int) -> Iterator[tuple[int, int]]:
    for k in range(1, math.isqrt(n) + 1):
        if n % k == 0:
            yield k, n // k
            if k != n // k:
                yield n // k, k


def _nearest_advice(scene: Scene) -> str:
    """Which N fits, counted from the one that was asked for."""
    for step in range(1, scene.n_particles + 1000):
        for n in (scene.n_particles - step, scene.n_particles + step):
            if n >= 1 and _fits(scene, n):
                return (
                    f"no {scene.lattice} lattice of {scene.n_particles} sites holds disks at area_fraction = "
                    f"{scene.area_fraction}; the nearest that fits is {n}; lattice = 'auto' takes any number"
                )
    return f"no {scene.lattice} lattice holds disks at area_fraction = {scene.area_fraction}"


def _fits(scene: Scene, n: int) -> bool:
    values: dict[str, Any] = scene.as_dict() | {"n_particles": n}
    lattice = _explicit(Scene(**values))
    return lattice.spacing >= scene.diameter * TOUCH

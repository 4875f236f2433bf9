"""Where a run starts: particles on a lattice, with uniformly distributed velocity components (beads: normally distributed)."""

import math
from dataclasses import replace
from types import ModuleType
from typing import Any

import numpy as np

from granugas.diameters import largest, moment
from granugas.lattices import line, plane, space
from granugas.lattices.lattice import TOUCH, Lattice
from granugas.scene import LATTICES, Scene, SceneError

IN_DIMENSIONS: dict[int, ModuleType] = {1: line, 2: plane, 3: space}

FEWEST_LARGEST = 2
"""Largest diameters that go into the box side by side, at least."""

NARROWEST_SOFT = 2.2
"""Diameters that go into a periodic box of soft spheres side by side, at least: a pair is near by one image only."""


def check_lattice(scene: Scene) -> None:
    """See whether the particles fit.

    Raises:
        SceneError: they do not; names the largest fraction or the nearest N that does.
    """
    start_lattice(scene)


def start_lattice(scene: Scene) -> Lattice:
    """The lattice on which a scene starts.

    An explicit lattice is regular: exactly N sites, in the box (nearest to the aspect ratio) that makes them equidistant.
    "auto" takes the box as asked, and a lattice that may have more sites than N. Where sizes differ and it melts, it is that
    of equal particles in the same box: those that are too large for it start smaller, and grow while it melts.

    Raises:
        SceneError: the particles do not fit.
    """
    kinds, d = IN_DIMENSIONS[scene.dimensions], scene.dimensions
    relative = moment(scene, d) / largest(scene) ** d
    grows = scene.sizes != "equal" and scene.lattice == "auto" and melts(scene)
    if grows:
        lattice = kinds.filling(replace(scene, sizes="equal", area_fraction=scene.area_fraction / moment(scene, d)))
    else:
        lattice = kinds.filling(scene) if scene.lattice == "auto" else kinds.explicit(scene)
    if scene.sizes != "equal" and min(lattice.box) < FEWEST_LARGEST * largest(scene) * scene.diameter:
        allowed = f"allowed are so many that the box is {FEWEST_LARGEST} of the largest diameters wide"
        raise SceneError("n_particles", scene.n_particles, allowed)
    _refuse_images_of_one(scene, lattice)
    if grows or lattice.holds(scene):
        _refuse_what_walls_squeeze(scene, lattice)
        return lattice
    if scene.lattice != "auto":
        densest = kinds.DENSEST[scene.lattice] * relative
        if scene.area_fraction >= densest:
            raise SceneError("area_fraction", scene.area_fraction, f"a {scene.lattice} lattice holds less than {densest:.4f}")
        raise SceneError("n_particles", scene.n_particles, _nearest_advice(scene))
    densest = scene.area_fraction * (lattice.spacing / (scene.diameter * largest(scene) * TOUCH)) ** d
    name = {1: "beads", 2: "disks", 3: "spheres"}[d]
    raise SceneError(
        "area_fraction",
        scene.area_fraction,
        f"{scene.n_particles} {name} fit on a lattice up to {math.floor(densest * 1e4) / 1e4:.4f}",
    )


def melts(scene: Scene) -> bool:
    """Whether a start is melted; above, the crystal is the stable phase and is kept."""
    return scene.area_fraction <= IN_DIMENSIONS[scene.dimensions].MELTED_UP_TO


def sites(lattice: Lattice, n: int, rng: np.random.Generator) -> np.ndarray:
    """Positions (n, D) of n particles on the lattice, in m; sites that stay empty are drawn at random."""
    taken = np.sort(rng.permutation(lattice.n_sites)[:n]) if n < lattice.n_sites else np.arange(n)
    return IN_DIMENSIONS[len(lattice.box)].site(lattice, taken)


def start_positions(scene: Scene, lattice: Lattice, rng: np.random.Generator) -> np.ndarray:
    """Positions (N, D) at the start, in m: sites of the lattice, spread out from wall to wall along axes that end in walls."""
    position, near = sites(lattice, scene.n_particles, rng), _widest(scene, lattice) / 2
    for axis, (first, factor) in _spread(scene, lattice).items():
        position[:, axis] = near + (position[:, axis] - first) * factor if factor > 0 else lattice.box[axis] / 2
    return position


def _widest(scene: Scene, lattice: Lattice) -> float:
    """The largest diameter of particles on the lattice (m); those that are larger than it allows are still to grow."""
    return min(largest(scene) * scene.diameter, lattice.spacing / TOUCH)


def _spread(scene: Scene, lattice: Lattice) -> dict[int, tuple[float, float]]:
    """For each axis that ends in walls, where the lattice begins (m), and the factor that takes it from wall to wall.

    The factor is 0 for a single row, which has its place in the middle.
    """
    if not any(scene.walled):
        return {}
    everywhere, widest = sites(lattice, lattice.n_sites, np.random.default_rng(0)), _widest(scene, lattice)
    low, high = everywhere.min(axis=0), everywhere.max(axis=0)
    return {
        axis: (low[axis], (side - widest) / (high[axis] - low[axis]) if high[axis] > low[axis] else 0.0)
        for axis, side in enumerate(lattice.box)
        if scene.walled[axis]
    }


def _refuse_images_of_one(scene: Scene, lattice: Lattice) -> None:
    """Soft spheres know one image of each neighbour."""
    sides = [side for side, wall in zip(lattice.box, scene.walled, strict=True) if not wall]
    if scene.soft and min(sides, default=math.inf) < NARROWEST_SOFT * scene.diameter:
        allowed = (
            f"allowed are so many that the periodic box is {NARROWEST_SOFT} diameters wide, with dynamics = {scene.dynamics}"
        )
        raise SceneError("n_particles", scene.n_particles, allowed)


def _refuse_what_walls_squeeze(scene: Scene, lattice: Lattice) -> None:
    """A lattice of rows that are nearer than a diameter has no room for it between walls."""
    squeezed = min([1.0, *(factor for _, factor in _spread(scene, lattice).values() if factor > 0)])
    if lattice.spacing * squeezed < _widest(scene, lattice):
        allowed = f"{scene.n_particles} particles do not fit between walls on a {lattice.kind} lattice: allowed is less"
        raise SceneError("area_fraction", scene.area_fraction, allowed)


def start_velocities(scene: Scene, rng: np.random.Generator) -> np.ndarray:
    """Velocities (N, D) in m/s: components uniform in +-w, mean removed, E = D N m w^2 / 6 exactly.

    Beads on a line that are equally heavy exchange their velocities and keep the distribution that they start with: theirs
    is normal. A single particle keeps its velocity, which is its momentum.
    """
    w, shape = scene.velocity_half_width, (scene.n_particles, scene.dimensions)
    return as_wanted(rng.normal(0.0, w, shape) if scene.dimensions == 1 else rng.uniform(-w, w, shape), w)


def as_wanted(velocity: np.ndarray, half_width: float, mass: np.ndarray | None = None) -> np.ndarray:
    """Velocities (N, D) at rest as a whole, as long as there are several, and with the kinetic energy E = D N m w^2 / 6.

    mass: (N,) in mean masses m, where they differ.
    """
    if len(velocity) > 1:
        velocity = velocity - np.average(velocity, axis=0, weights=mass)
    return rescaled(velocity, half_width, mass)


def rescaled(velocity: np.ndarray, half_width: float, mass: np.ndarray | None = None) -> np.ndarray:
    """Velocities (N, D) scaled to the kinetic energy E = D N m w^2 / 6."""
    dimensions, squares = velocity.shape[1], np.sum(velocity**2, axis=1)
    return velocity * math.sqrt(dimensions * half_width**2 / 3 / np.average(squares, weights=mass))


def random_stream(scene: Scene, seed: int, realization: int) -> np.random.Generator:
    """Random numbers of one start: they depend on seed, realization, N, area fraction and lattice, on nothing else."""
    words = (seed, realization, scene.n_particles, round(scene.area_fraction * 1e12))
    return np.random.default_rng([*words, LATTICES.index(scene.lattice)])


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
    other = Scene(**values)
    return IN_DIMENSIONS[scene.dimensions].explicit(other).holds(other)

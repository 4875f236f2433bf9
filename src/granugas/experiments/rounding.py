"""Does the answer depend on rounding? The same gases with the last bit of each position changed, and in another order."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import xarray as xr

from granugas.analysis.divergence import rms_distance
from granugas.analysis.enskog import enskog_rate
from granugas.analysis.observables import kinetic_energy
from granugas.dynamics.events.engine import Engine
from granugas.dynamics.state import State
from granugas.equilibrate import equilibrate, state_of
from granugas.scene import Scene

COOLING = Scene(378, 0.226725, restitution=0.9, contact_time=1e-5, lattice="triangular")
SCENES = (replace(COOLING, restitution=1.0, contact_time=0.0), COOLING)
SEED = 1998

STEP, STOPS = 0.5, 240
"""Between two looks, in collisions per particle of a homogeneous gas, and how many of them."""


CHANGES = ("last bit", "order")
"""What is changed in a copy: every coordinate by one unit in its last place, or the numbers that the particles have."""


class Plan(NamedTuple):
    """How much is measured: realizations of each gas, and copies of each run with either change."""

    realizations: int
    copies: int


FULL, SMALL = Plan(8, 4), Plan(3, 2)


def measure(plan: Plan = FULL) -> xr.Dataset:
    """Runs, and copies of each that begin as near to it as double precision can tell.

    Returns:
        Dataset over restitution, realization and stop: tau, kinetic_energy and collisions_per_particle of the runs; over
        change (one of CHANGES) and copy as well: separation, the root mean square distance from the run by d,
        copy_kinetic_energy and copy_collisions_per_particle. All runs of one restitution are looked at at the same times.
    """
    starts = [state_of(equilibrate(SCENES[0], seed=SEED, realization=k)) for k in range(plan.realizations)]
    found = [[_compare(scene, start, k, plan.copies) for k, start in enumerate(starts)] for scene in SCENES]
    data = xr.combine_nested(found, ["restitution", "realization"]).assign_coords(
        restitution=[scene.restitution for scene in SCENES]
    )
    return data.assign_attrs(
        {key: getattr(COOLING, key) for key in ("n_particles", "area_fraction", "contact_time", "diameter")}
    )


def last_bit(start: State, rng: np.random.Generator) -> State:
    """The state with every coordinate moved to one of the two numbers next to it that double precision has."""
    towards = np.where(rng.random(start.position.shape) < 0.5, 0.0, start.box)
    return replace(start, position=np.nextafter(start.position, towards))


def reordered(start: State, order: np.ndarray) -> State:
    """The state with its particles in another order; `order` (n,) is the old number of each."""
    arrays = ("position", "velocity", "last_collision_time", "last_collision_interval", "collisions")
    return replace(start, **{name: getattr(start, name)[order] for name in arrays})


class Path(NamedTuple):
    """A run at its stops.

    Attributes:
        position: (m, n, 2) in m.
        energy: (m,) K = E / E(0).
        collisions: (m,) C/N.
    """

    position: np.ndarray
    energy: np.ndarray
    collisions: np.ndarray


def follow(scene: Scene, start: State, times: np.ndarray) -> Path:
    """The run from a state, looked at at `times` (m,) in s."""
    engine, n, first = Engine(scene, start), scene.n_particles, kinetic_energy(start.velocity).sum()
    path = Path(np.empty((len(times), n, 2)), np.empty(len(times)), np.empty(len(times)))
    for k, time in enumerate(times):
        engine.advance(time)
        state = engine.state()
        path.position[k], path.energy[k] = state.position, kinetic_energy(state.velocity).sum() / first
        path.collisions[k] = 2 * engine.collisions / n
    return path


def separation(one: Path, other: Path, scene: Scene, box: tuple[float, float]) -> np.ndarray:
    """(m,) Root mean square distance of the particles in two runs by d."""
    return np.array([rms_distance(a, b, box) for a, b in zip(one.position, other.position, strict=True)]) / scene.diameter


def stops(restitution: float) -> np.ndarray:
    """Tau at equal steps of C/N in homogeneous cooling (B Eq. 4, solved for tau), from 0 on."""
    collisions, loss = STEP * np.arange(STOPS + 1), (1 - restitution**2) / 4
    return collisions if loss == 0 else np.expm1(loss * collisions) / loss


def _compare(scene: Scene, start: State, realization: int, n_copies: int) -> xr.Dataset:
    """One run and its copies."""
    n, tau = scene.n_particles, stops(scene.restitution)
    rate = float(enskog_rate(scene.area_fraction, kinetic_energy(start.velocity).sum() / n, scene.diameter))
    rng = np.random.default_rng([SEED, realization])
    run = follow(scene, start, tau / rate)
    copies = []
    for _ in range(n_copies):
        order = rng.permutation(n)
        other = follow(scene, reordered(start, order), tau / rate)
        copies.append(
            (follow(scene, last_bit(start, rng), tau / rate), other._replace(position=other.position[:, np.argsort(order)]))
        )
    over = ("change", "copy", "stop")
    table = lambda value: (over, np.moveaxis([[value(path) for path in pair] for pair in copies], 0, 1))  # noqa: E731
    return xr.Dataset(
        {
            "tau": ("stop", tau),
            "kinetic_energy": ("stop", run.energy),
            "collisions_per_particle": ("stop", run.collisions),
            "separation": table(lambda path: separation(run, path, scene, start.box)),
            "copy_kinetic_energy": table(lambda path: path.energy),
            "copy_collisions_per_particle": table(lambda path: path.collisions),
            "enskog_rate": rate,
        },
        {"change": list(CHANGES), "copy": np.arange(n_copies), "stop": np.arange(STOPS + 1)},
    )

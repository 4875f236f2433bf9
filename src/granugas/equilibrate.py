"""Equilibration: elastic collisions until the start lattice is forgotten and the velocities are Maxwellian."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import xarray as xr

from granugas.analysis.observables import anisotropy, species_temperature_ratio, velocity_kurtosis
from granugas.arguments import is_number, need_integer, need_scene
from granugas.diameters import of_particles
from granugas.doubts import doubts_of_start, tell
from granugas.dynamics.events.engine import Engine
from granugas.dynamics.events.growth import growth
from granugas.dynamics.state import State
from granugas.initial import as_wanted, melts, random_stream, start_lattice, start_positions, start_velocities
from granugas.lattices.lattice import TOUCH, Lattice
from granugas.progress import Progress
from granugas.scene import Scene, SceneError
from granugas.storage.variables import describe

COLLISIONS_PER_PARTICLE = 100.0
"""Of one round, by default."""

MOST_ROUNDS = 30
"""Rounds after which a start that is still not in equilibrium is taken as it is, which its dataset says."""

SIGMAS = 4.0
"""Kurtosis and isotropy may deviate by so many standard deviations of a finite sample."""

OF_PARTICLES = {"diameter": "particle_diameter", "mass": "particle_mass", "spin": "spin"}
"""What effects know of each particle, and the variables of a start state (or a run) that has it."""

INTO_A_WALL = 1.0e-9
"""How far a particle may reach into a wall by rounding (radii)."""

MOST_ORDER = 16.0
"""Largest |sum exp(ikr)|^2 / N at the lattice's wave vectors: a fluid of disks has 1 to 5 on average, one of spheres 1 to 3,
beads on a line have 1 (see `_order`), a crystal has of the order of N."""


@dataclass(frozen=True)
class Equilibrium:
    """What is known of a start state.

    Attributes:
        kurtosis: <v^4> / <v^2>^2 of the components, by its value for N disks of this energy and momentum.
        anisotropy: (E_x - E_y) / E, of the two axes where it is the largest.
        order: |sum exp(ikr)|^2 / N, the largest at wave vectors of the start lattice along the axes.
        reached: all three are as in equilibrium (the last one only where a crystal has to melt), every particle has
            collided, and where masses differ light and heavy particles have the same mean energy.
    """

    kurtosis: float
    anisotropy: float
    order: float
    reached: bool


def equilibrate(
    scene: Scene,
    *,
    seed: int = 0,
    realization: int = 0,
    collisions_per_particle: float = COLLISIONS_PER_PARTICLE,
    progress: bool = False,
) -> xr.Dataset:
    """The start state of a scene: in equilibrium, at rest as a whole, with E = D N m w^2 / 6 in D dimensions, at t = 0.

    Rounds of elastic collisions follow each other until a round ends in equilibrium (`judge`). The times of the last
    collisions go on into the run, as negative times. Disks that start above an area fraction of .70, and spheres above a volume
    fraction of .49, stay the crystal that they were. Beads on a line only exchange their velocities, which were drawn from
    the normal distribution: collisions make their positions random and nothing else.

    Returns:
        Dataset with position (m), velocity (m/s), last_collision_time and last_collision_interval (s) of each particle,
        particle_diameter (m) and particle_mass (by the mean one) where they differ, and in its attributes the box, the branch
        ("fluid" or "crystal") and what `judge` found.

    Raises:
        SceneError: the disks do not fit.
        ValueError: a number that makes no sense.
        TypeError: a scene that is none.
    """
    need_scene(scene)
    need_integer("seed", seed)
    need_integer("realization", realization)
    if not is_number(collisions_per_particle) or collisions_per_particle <= 0:
        raise ValueError(f"collisions_per_particle = {collisions_per_particle!r}: allowed is a number > 0")
    lattice = start_lattice(scene)
    rng = random_stream(scene, seed, realization)
    start = on_lattice(scene, lattice, rng)
    engine = engine_at_start(scene, start, lattice)
    found, rounds = judge(start, lattice, melts(scene), scene.diameter), 0
    bar = Progress("equilibrate", shown=progress)
    while not (found.reached and _grown(engine)) and rounds < MOST_ROUNDS and scene.n_particles > 1:
        rounds += 1
        wanted = math.ceil(scene.n_particles * collisions_per_particle / 2)
        bar.follow(engine, collisions=wanted)
        found = judge(engine.state(), lattice, melts(scene), scene.diameter)
    bar.close()
    if not _grown(engine):
        raise SceneError("area_fraction", scene.area_fraction, "the largest of the disks found no room; allowed is less")
    done = 2 * engine.collisions / scene.n_particles
    made = _dataset(scene, lattice, _at_time_zero(engine.state(), scene), found, done)
    tell(doubts_of_start(scene.n_particles, made.attrs))
    return made


def judge(state: State, lattice: Lattice, melts: bool, diameter: float = 0.0) -> Equilibrium:
    """Compare a state with equilibrium; the finite-size value of the kurtosis is that of N - 1 free components an axis.

    On a line, where collisions change no velocity distribution, the kurtosis is not asked for; there alone the diameter (m)
    of the beads counts.
    """
    n, dimensions = state.position.shape
    free = max(n - 1, 1)
    mass = state.more.get("mass", np.ones(n))
    velocity = state.velocity * np.sqrt(mass)[:, np.newaxis]  # whose squares are energies, alike for all
    kurtosis = float(np.mean(velocity_kurtosis(velocity)) / (3 * free / (free + 2)))
    uneven = anisotropy(velocity)
    order = _order(state, lattice, diameter)
    reached = (
        (abs(kurtosis - 1) <= SIGMAS * math.sqrt(24 / (dimensions * n)) / 3 or dimensions == 1)
        and abs(uneven) <= SIGMAS * (2 / dimensions) / math.sqrt(n)
        and (order <= MOST_ORDER or not melts)
        and bool(np.all(state.collisions > 0))
        and _shared_evenly(state.velocity, mass)
    )
    return Equilibrium(kurtosis, uneven, order, reached)


def _shared_evenly(velocity: np.ndarray, mass: np.ndarray) -> bool:
    """Whether the temperatures of heavy and light particles differ by no more than those of finite samples do."""
    heavy, light = np.count_nonzero(mass > mass.mean()), np.count_nonzero(mass <= mass.mean())
    if not heavy:
        return True
    ratio = species_temperature_ratio(velocity, mass)
    return abs(math.log(ratio)) <= SIGMAS * math.sqrt(2 / velocity.shape[1] * (1 / heavy + 1 / light))


def on_lattice(scene: Scene, lattice: Lattice, rng: np.random.Generator) -> State:
    """The particles of a scene on its lattice with uniform velocities, before any collision."""
    position, velocity = start_positions(scene, lattice, rng), start_velocities(scene, rng)
    more = of_particles(scene, rng)
    if "mass" in more:
        velocity = as_wanted(velocity, scene.velocity_half_width, more["mass"])
    return at_rest(position, velocity, lattice.box, **more)


def engine_at_start(scene: Scene, start: State, lattice: Lattice) -> Engine:
    """The elastic gas that a start state is made in; particles that are too large for the lattice grow in it."""
    elastic = scene.at_start()
    if scene.sizes == "equal":
        return Engine(elastic, start)
    fitting = np.minimum(start.more["diameter"], lattice.spacing / TOUCH)
    return Engine(elastic, replace(start, more={**start.more, "diameter": fitting}), drive=growth(elastic, start))


def _grown(engine: Engine) -> bool:
    return engine.effects["drive"].due(math.inf) is None


def at_rest(position: np.ndarray, velocity: np.ndarray, box: tuple[float, ...], **more: np.ndarray) -> State:
    """A state at t = 0 in which nobody has collided yet; `more` as State has it."""
    n = len(position)
    never, endless = np.full(n, -np.inf), np.full(n, np.inf)
    return State(0.0, box, position, velocity, never, endless, np.zeros(n, np.int64), more=more)


def need_start(scene: Scene, start: Any) -> None:
    """Refuse what is no start state of as many disks in a box of the scene's area.

    Raises:
        TypeError, ValueError: say what it is.
    """
    if not isinstance(start, xr.Dataset) or "position" not in start or "box_x" not in start.attrs:
        raise TypeError(f"state = {type(start).__name__}: allowed is a dataset of granugas.equilibrate")
    if start.sizes["particle"] != scene.n_particles:
        raise ValueError(f"state = {start.sizes['particle']} disks: allowed are the {scene.n_particles} of the scene")
    if scene.sizes != "equal" and "particle_diameter" not in start:
        raise ValueError(f"state = disks of one size: allowed is one of a scene with sizes = {scene.sizes!r}")
    volume, unit = math.prod(box_of(start.attrs)), f"m^{scene.dimensions}"
    if len(box_of(start.attrs)) != scene.dimensions or not math.isclose(volume, scene.volume, rel_tol=1e-9):
        raise ValueError(f"state = a box of {volume:g} {unit}: allowed is one of {scene.volume:g} {unit}, as the scene has")
    _need_room_at_walls(scene, start)


def _need_room_at_walls(scene: Scene, start: xr.Dataset) -> None:
    place, box = start["position"].values, np.array(box_of(start.attrs))
    room = np.minimum(place, box - place).min(axis=0) / (scene.diameter / 2)
    if np.any(room[np.array(scene.walled)] < 1 - INTO_A_WALL):
        raise ValueError("state = particles that reach into a wall: allowed is a start state of the same boundary")


def state_of(start: xr.Dataset, *seed: int) -> State:
    """The state in a dataset of `equilibrate`, with the numbers that what is drawn later follows from."""
    return State(
        time=0.0,
        box=box_of(start.attrs),
        position=start["position"].values,
        velocity=start["velocity"].values,
        last_collision_time=start["last_collision_time"].values,
        last_collision_interval=start["last_collision_interval"].values,
        collisions=np.zeros(start.sizes["particle"], np.int64),
        seed=seed,
        more={name: start[variable].values for name, variable in OF_PARTICLES.items() if variable in start},
    )


def box_of(attributes: Mapping[str, Any]) -> tuple[float, ...]:
    """The sides of a box (m) from the attributes box_x, box_y ... of a dataset."""
    return tuple(float(attributes[f"box_{axis}"]) for axis in "xyz" if f"box_{axis}" in attributes)


def _order(state: State, lattice: Lattice, diameter: float) -> float:
    """|sum exp(ikr)|^2 / N, the largest at the wave vectors of the start lattice along the axes.

    Beads on a line are points that pass through each other if their diameters are taken out of it (Tonks 1936): the order is
    that of the points, which is 1 on average at every density.
    """
    place = state.position / np.array(state.box)
    if lattice.kind == "line":
        d = state.more.get("diameter", np.full(len(place), diameter))
        order = np.argsort(state.position[:, 0])
        before = np.cumsum(d[order]) - d[order] / 2
        place = (state.position[order] - before[:, np.newaxis]) / (state.box[0] - d.sum())
    phase = 2 * np.pi * place * np.array(lattice.waves)
    return float(np.max(abs(np.exp(1j * phase).sum(axis=0)) ** 2) / len(phase))


def _at_time_zero(state: State, scene: Scene) -> State:
    return replace(
        state,
        time=0.0,
        velocity=as_wanted(state.velocity, scene.velocity_half_width, state.more.get("mass")),
        last_collision_time=state.last_collision_time - state.time,
    )


def _dataset(scene: Scene, lattice: Lattice, state: State, found: Equilibrium, collisions: float) -> xr.Dataset:
    particles = ("particle",)
    values = {
        "position": ((*particles, "axis"), state.position),
        "velocity": ((*particles, "axis"), state.velocity),
        "last_collision_time": (particles, state.last_collision_time),
        "last_collision_interval": (particles, state.last_collision_interval),
        **{OF_PARTICLES[name]: ((*particles, "axis")[: values.ndim], values) for name, values in state.more.items()},
    }
    axes = "xyz"[: scene.dimensions]
    attributes = {
        **{f"box_{axis}": side for axis, side in zip(axes, state.box, strict=True)},
        "lattice_kind": lattice.kind,
        **dict(zip(("lattice_columns", "lattice_rows", "lattice_layers"), lattice.counts, strict=False)),
        "branch": "fluid" if melts(scene) else "crystal",
        "equilibration_collisions_per_particle": collisions,
        "equilibration_kurtosis": found.kurtosis,
        "equilibration_anisotropy": found.anisotropy,
        "equilibration_order": found.order,
        "equilibration_reached": int(found.reached or scene.n_particles == 1),
    }
    return describe(xr.Dataset(values, coords={"axis": list(axes)}, attrs=attributes))

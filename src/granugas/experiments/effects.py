"""Each effect and model in a short run: what it conserves, one number against theory, and how long its code is."""

import ast
import io
import math
import tokenize
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np
import xarray as xr

from granugas.analysis import theory
from granugas.analysis.observables import kinetic_energy, species_temperature_ratio
from granugas.diameters import diameters
from granugas.digest import SOURCES
from granugas.dynamics import Dynamics, engine_of, lrv
from granugas.dynamics.events import loop
from granugas.dynamics.events.engine import Engine
from granugas.dynamics.state import State
from granugas.equilibrate import at_rest, equilibrate, state_of
from granugas.scene import Scene
from granugas.simulate import simulate

SEED = 1998

PLAIN = Scene(1000, 0.2267, restitution=1.0, contact_time=0.0)
"""Elastic disks: no effect but these."""

HOT = PLAIN.velocity_half_width**2 / 3
"""kT/m of all gases at the start ((m/s)^2)."""

LOSSY = {"restitution": 0.95}
NEARLY_ELASTIC = 0.99999
"""r of gases that stay in equilibrium, under rules that elastic particles have no use for."""

DILUTE = 0.02
"""Area fraction at which neighbours come close to being independent of each other."""

G = 9.81
"""In m/s^2."""

_KICKED = {"restitution": 0.99, "kick_velocity": 0.3}


class Plan(NamedTuple):
    """How much is measured.

    Attributes:
        collisions: of a particle, in the runs whose conserved quantities are measured.
        length: of the checks against theory, by their full length.
        names: of the rows that are measured, None: all; each has a kernel of its own to compile.
    """

    collisions: float
    length: float
    names: tuple[str, ...] | None = None


FEW = ("elastic disks", "contact duration", "walls, gravity", "rough disks, friction")
"""Rows for a preview."""

FULL, SMALL = Plan(30.0, 1.0), Plan(5.0, 0.05, FEW)

Measured = tuple[float, float]
"""What was measured, and what is expected."""


# --- runs -----------------------------------------------------------------------------------------------------------------


def start_of(scene: Scene) -> State:
    """The start state of a scene, and of all that share it."""
    return _start_of(scene.at_start())


@lru_cache(maxsize=16)
def _start_of(scene: Scene) -> State:
    return state_of(equilibrate(scene, seed=SEED, collisions_per_particle=30.0), SEED, 0)


def begun(scene: Scene) -> Dynamics:
    """The dynamics of a scene at t = 0."""
    return engine_of(scene, start_of(scene))


def again(scene: Scene, count: float) -> Iterator[Engine]:
    """Engines that begin with different states of the same elastic gas, at least one."""
    elastic = begun(scene.at_start())
    for _ in range(math.ceil(count)):
        elastic.advance(math.inf, 5 * scene.n_particles)
        yield Engine(scene, elastic.state())


def for_each_particle(engine: Dynamics, collisions: float) -> None:
    """Let an engine go on for so many collisions of a particle."""
    engine.advance(math.inf, math.ceil(collisions * engine.scene.n_particles / 2))


def energy(state: State) -> float:
    """Of translation (m^2/s^2, times mean mass)."""
    return float(kinetic_energy(state.velocity, state.more.get("mass")).sum())


# --- what is conserved ----------------------------------------------------------------------------------------------------


def conservation(scene: Scene, collisions: float) -> Measured:
    """Drift of the momentum by N v_rms, along axes without walls, and of all energy that is there, was lost or put in."""
    engine = begun(scene)
    before = engine.state()
    energy_before = _all_energy(engine, before, engine.observe(before))
    for_each_particle(engine, collisions)
    after, tally = engine.state(), engine.take_tally()
    observed = engine.observe(after, tally, after.time)
    given = observed.get("floor_energy", 0.0) * scene.n_particles * scene.energy_per_mass
    balance = _all_energy(engine, after, observed) + tally.loss - given - energy_before
    return drift(before, after, ~np.array(scene.walled)), abs(balance) / energy(before)


def drift(before: State, after: State, along: np.ndarray) -> float:
    """Of the momentum along axes, by N v_rms at the beginning; NaN where there is no such axis."""
    mass = before.more.get("mass", np.ones(len(before.position)))
    change = abs(mass @ (after.velocity - before.velocity))[along]
    return float(change.max() / math.sqrt(2 * energy(before) * mass.sum())) if len(change) else math.nan


def _all_energy(engine: Dynamics, state: State, observed: dict[str, float]) -> float:
    kept = sum(observed.get(name, 0.0) for name in ("rotational_energy", "internal_energy", "potential_energy"))
    return energy(state) + kept * engine.scene.n_particles * engine.scene.energy_per_mass


# --- checks against theory ------------------------------------------------------------------------------------------------


def virial(scene: Scene, length: float) -> float:
    """P V / (N kT) of a gas in equilibrium (A Eq. 15)."""
    engine = begun(scene)
    for_each_particle(engine, 4000 * length)
    return 1 - np.trace(engine.take_tally().stress) / (2 * energy(engine.state()) * engine.time)


def pressure(scene: Scene, length: float) -> Measured:
    """P V / (N kT): A Eqs. 16 and 17; of a mixture Jenkins & Mancini 1987; of beads Tonks 1936."""
    return virial(scene, length), theory.mixture_pressure(scene.area_fraction, diameters(scene), scene.dimensions)


def pressure_of_spheres(scene: Scene, length: float) -> Measured:
    """P V / (N kT): Kolafa (Boublik & Nezbeda 1986)."""
    return virial(scene, length), float(theory.kolafa_pressure(scene.area_fraction))


def cooling(scene: Scene, length: float) -> Measured:
    """K at tau = 20."""
    return cooled(scene, length, lambda speed: np.full_like(speed, scene.restitution))


def viscoelastic_cooling(scene: Scene, length: float) -> Measured:
    """K at tau = 20."""
    return cooled(scene, length, lambda speed: theory.viscoelastic_restitution(speed, scene.viscosity))


def plastic_cooling(scene: Scene, length: float) -> Measured:
    """K at tau = 20."""
    return cooled(scene, length, lambda speed: theory.plastic_restitution(speed, scene.restitution, scene.yield_velocity))


def cooled(scene: Scene, length: float, restitution: Callable[[np.ndarray], np.ndarray], tau: float = 20.0) -> Measured:
    """K at a time, of a dilute gas: in a dense one collisions come in rows, which slows cooling down."""
    scene = replace(scene, area_fraction=DILUTE)
    time, energies = tau / theory.enskog_rate(scene.area_fraction, scene.energy_per_mass, scene.diameter), []
    for engine in again(scene, 40 * length):
        engine.advance(engine.time + time)
        energies.append(energy(engine.state()) / (scene.n_particles * scene.energy_per_mass))
    return float(np.mean(energies)), float(theory.cooling_by_velocity(tau, restitution, HOT))


def elastic_collisions(scene: Scene, length: float) -> tuple[float, float]:
    """c_e of a gas that hardly cools, and its collision rate (1/s)."""
    engine = begun(replace(scene, restitution=NEARLY_ELASTIC))
    for_each_particle(engine, 2000 * length)
    return engine.take_tally().elastic[0] / engine.collisions, 2 * engine.collisions / (scene.n_particles * engine.time)


def contact_time(scene: Scene, length: float) -> Measured:
    """c_e (A Eq. 21, with what partners hide)."""
    found, rate = elastic_collisions(scene, length)
    return found, float(theory.elastic_collision_fraction_shielded(scene.contact_time, rate, scene.area_fraction))


def contact_distance(scene: Scene, length: float) -> Measured:
    """c_e, from the disks next to a partner that approach."""
    within = scene.contact_time * scene.contact_velocity / scene.diameter
    return elastic_collisions(scene, length)[0], float(theory.elastic_within(scene.area_fraction, within))


def company(scene: Scene, length: float) -> Measured:
    """c_e, from the disks next to a partner."""
    gap = scene.critical_distance / scene.diameter
    return elastic_collisions(scene, length)[0], float(theory.elastic_in_company(scene.area_fraction, gap))


def elastic_particles(scene: Scene, length: float) -> Measured:
    """n_e at the longest t_c (A Eq. 20)."""
    rate = float(theory.enskog_rate(scene.area_fraction, scene.energy_per_mass, scene.diameter))
    once = {"count": 1, "spacing": "linear"}
    run = simulate(scene, 2000 * length / rate, seed=SEED, samples=once, keep_positions=False, progress=False)
    share = run["elastic_particle_time_fraction"].isel(time=-1, contact_time=-1)
    return float(share), float(theory.elastic_particle_fraction(max(scene.contact_times), rate))


def steady(scene: Scene, length: float, expected: float) -> Measured:
    """K on average, later than 100 collisions of a particle."""
    engine, energies = begun(scene), []
    for_each_particle(engine, 100)
    for _ in range(math.ceil(1000 * length)):
        for_each_particle(engine, 1)
        energies.append(energy(engine.state()) / (scene.n_particles * scene.energy_per_mass))
    return float(np.mean(energies)), expected


def kick(scene: Scene, length: float) -> Measured:
    """K where kicks of slow partners give what Maxwellian collisions take."""
    return steady(scene, length, 1.0)


def heating(scene: Scene, length: float) -> Measured:
    """K where random kicks put in what collisions dissipate (van Noije & Ernst 1998)."""
    few = replace(scene, n_particles=500)
    rate = float(theory.enskog_rate(scene.area_fraction, scene.energy_per_mass, scene.diameter)) / math.sqrt(HOT)
    return steady(few, length, float(theory.steady_temperature(scene.heating, scene.restitution, rate)) / HOT)


def internal_modes(scene: Scene, length: float) -> Measured:
    """Energy of the modes of a particle by that of one of its degrees of freedom, kT each (equipartition)."""
    engine, ratios = begun(scene), []
    for_each_particle(engine, 50)
    for _ in range(math.ceil(200 * length)):
        for_each_particle(engine, 2)
        state = engine.state()
        kinetic = energy(state) / (scene.n_particles * scene.energy_per_mass)
        ratios.append(engine.observe(state)["internal_energy"] / kinetic)
    return float(np.mean(ratios)), float(scene.internal_modes)


def impact_on_a_cluster(scene: Scene, length: float) -> Measured:
    """Velocity of the last of ten beads in touch that one hits more slowly than contacts bounce, by its velocity."""
    box = 100 * scene.diameter
    place = scene.diameter * np.concatenate([[2.0], 10.0 + np.arange(10)])[:, np.newaxis]
    start = at_rest(place, np.eye(11, 1), (box,))
    after = lrv.advance(start, math.inf, scene.diameter, lrv.Contact(scene.restitution, 2.0, lrv.FREE))
    return float(after.state.velocity[-1, 0]), 1 / 11


def walls(scene: Scene, length: float) -> Measured:
    """Pressure on the walls by n kT of the box: A Eqs. 16 and 17 at the density away from them."""
    engine, inside = begun(replace(scene, n_particles=200, aspect_ratio=0.5)), []
    height = engine.box[1]
    for _ in range(math.ceil(4000 * length)):
        for_each_particle(engine, 2)
        y = engine.state().position[:, 1]
        inside.append(np.mean((y > 0.25 * height) & (y < 0.75 * height)) * 2)
    density = np.mean(inside)
    found = engine.observe(engine.state(), engine.take_tally(), engine.time)["wall_pressure"]
    return found, float(density * theory.reduced_pressure(scene.area_fraction * density))


def bouncing_ball(scene: Scene, length: float) -> Measured:
    """Time from the first hit of one ball to its collapse, by t_1 (A Eq. 8)."""
    speed, d = 0.2, scene.diameter
    one = replace(scene, n_particles=1, area_fraction=0.001, wall_restitution=0.8)
    side = math.sqrt(one.volume)
    engine = Engine(one, at_rest(np.array([[side / 2, d / 2]]), np.array([[0.0, -speed]]), (side, side)))
    why = engine.advance(1.0)
    time = engine.time if why == loop.WATCH else math.nan
    return time / float(theory.bounce_period(speed, G)), float(theory.rest_time_hard(0.8))


def fed_and_lost(scene: Scene, length: float) -> Measured:
    """Energy that the floor gives by what collisions dissipate, in the steady state."""
    engine = begun(replace(scene, n_particles=30, area_fraction=0.1, aspect_ratio=0.3))
    engine.advance(0.5)
    before = engine.observe(engine.state(), engine.take_tally(), 0.5)
    engine.advance(0.5 + 10 * length)
    after = engine.observe(engine.state(), engine.take_tally(), 10 * length)
    fed, lost = (after[name] - before[name] for name in ("floor_energy", "dissipated_energy"))
    return fed / lost, 1.0


def equipartition(scene: Scene, length: float) -> Measured:
    """Mean energy of a large particle by that of a small one."""
    engine, ratios = begun(scene), []
    for _ in range(math.ceil(1000 * length)):
        for_each_particle(engine, 2)
        state = engine.state()
        ratios.append(species_temperature_ratio(state.velocity, state.more["mass"]))
    return float(np.exp(np.mean(np.log(ratios)))), 1.0


def rough_temperatures(scene: Scene, length: float) -> Measured:
    """T_rot / T_tr of a dilute gas (Huthmann & Zippelius 1997)."""
    ratios = []
    for engine in again(replace(scene, restitution=0.9, area_fraction=DILUTE), 16 * length):
        for_each_particle(engine, 50)
        for _ in range(70):
            for_each_particle(engine, 1)
            ratios.append(engine.observe(engine.state())["temperature_ratio"])
    beta = scene.tangential_restitution
    return float(np.mean(ratios)), float(theory.rough_temperature_ratio(0.9, beta))


def rubbing(scene: Scene, length: float) -> Measured:
    """Energy loss of a collision by kT, before any disk spins."""
    lost, count = 0.0, 0
    for engine in again(scene, 1000 * length):
        for_each_particle(engine, 0.05)
        lost, count = lost + engine.take_tally().loss, count + engine.collisions
    mu = theory.friction_loss(scene.tangential_restitution, scene.friction, scene.restitution)
    return lost / count / HOT, 1 - scene.restitution**2 + mu


# --- the table ------------------------------------------------------------------------------------------------------------


class Row(NamedTuple):
    """One effect.

    Attributes:
        name: in words.
        scene: that has it.
        check: measures one number and says what theory expects.
        theory: how far off theory itself may be, by its value.
        error: three standard errors of a check of full length, by its value.
        files: modules that are this effect and nothing else, below granugas; effects by their name.
    """

    name: str
    scene: Scene
    check: Callable[[Scene, float], Measured]
    theory: float
    error: float
    files: tuple[str, ...]


def _balanced_kick() -> float:
    """Largest energy of a kick with which K stays 1: slow partners get half of it on average, a collision takes
    (1 - r^2) kT, and u_n^2 / 4kT is distributed exponentially."""
    r, v = _KICKED["restitution"], _KICKED["kick_velocity"]
    return 2 * (1 - r**2) * HOT / -math.expm1(-((v / r) ** 2) / (4 * HOT))


def _balanced_heating() -> float:
    """Heating with which Maxwellian velocities would keep K = 1."""
    rate = float(theory.enskog_rate(PLAIN.area_fraction, PLAIN.energy_per_mass, PLAIN.diameter))
    return (1 - LOSSY["restitution"] ** 2) / 2 * rate * HOT


def _plain(**keys: object) -> Scene:
    return replace(PLAIN, **keys)


_TC = {**LOSSY, "contact_time": 2e-5}
_TIMES = (1e-6, 1e-5, 1e-4)
_ALPHA = {"contact_time_exponent": 1.0, "contact_velocity": 0.5}
_VISCOELASTIC = {"material": "viscoelastic", "viscosity": 0.1}
_PLASTIC = {"material": "plastic", "yield_velocity": 0.4}
_WALL = {"boundary": "periodic wall", "gravity": G}
_FALL = {**_WALL, "restitution": 0.95, "wall_restitution": 0.95}
_FLOOR = {"floor": "harmonic", "floor_amplitude": 5e-4, "floor_frequency": 50.0}
_SHAKEN = {**_WALL, **_FLOOR, "restitution": 0.9, "wall_restitution": 0.9, "contact_time": 1e-5, "wall_contact_time": 1e-5}

ROWS = (
    Row("elastic disks", PLAIN, pressure, 0.001, 0.001, ("constant",)),
    Row("constant restitution", _plain(**LOSSY), cooling, 0.01, 0.005, ("hard", "collapse")),
    Row("contact duration", _plain(**_TC), contact_time, 0.01, 0.03, ("contact_time",)),
    Row("elastic shares", _plain(contact_time=_TIMES), elastic_particles, 0.005, 0.005, ("elastic_share", "elastic_time")),
    Row("critical distance", _plain(**LOSSY, critical_distance=1e-5), company, 0.02, 0.02, ("critical_distance",)),
    Row("contact duration of velocity", _plain(**_TC, **_ALPHA), contact_distance, 0.02, 0.03, ("contact_time_of_velocity",)),
    Row("viscoelastic", _plain(**LOSSY, **_VISCOELASTIC), viscoelastic_cooling, 0.015, 0.01, ("viscoelastic",)),
    Row("plastic", _plain(**LOSSY, **_PLASTIC), plastic_cooling, 0.04, 0.01, ("plastic",)),
    Row("random rotation", _plain(**LOSSY, rotation_angle=5.0), cooling, 0.01, 0.01, ("rotation",)),
    Row("energy kicks of slow partners", _plain(**_KICKED, kick_energy=_balanced_kick()), kick, 0.03, 0.01, ("kick",)),
    Row("internal modes", _plain(restitution=0.5, internal_modes=2), internal_modes, 0.005, 0.01, ("internal_modes",)),
    Row("LRV beads", _plain(**LOSSY, dimensions=1, lrv_velocity=0.05), impact_on_a_cluster, 1e-12, 0.0, ("dynamics.lrv",)),
    Row("walls", _plain(boundary="periodic wall"), walls, 0.01, 0.015, ("walls",)),
    Row("walls, gravity", _plain(**_FALL), bouncing_ball, 1e-5, 0.0, ("gravity",)),
    Row("walls, gravity, vibrated floor", _plain(**_SHAKEN), fed_and_lost, 0.0, 0.015, ("vibrated_floor",)),
    Row("bidisperse disks", _plain(sizes="bidisperse", size_share=0.3), equipartition, 0.005, 0.01, ("unequal",)),
    Row("log-normal disks", _plain(sizes="log_normal"), pressure, 0.005, 0.002, ("unequal",)),
    Row("rough disks", _plain(**LOSSY, tangential_restitution=0.5), rough_temperatures, 0.08, 0.01, ("rough",)),
    Row("rough disks, friction", _plain(**LOSSY, tangential_restitution=0.5, friction=0.2), rubbing, 0.01, 0.03, ("rough",)),
    Row("random kicks (driving)", _plain(**LOSSY, heating=_balanced_heating()), heating, 0.03, 0.02, ("kicks",)),
    Row("beads (one dimension)", _plain(dimensions=1), pressure, 1e-4, 5e-4, ("lattices.line",)),
    Row("spheres (three dimensions)", _plain(dimensions=3), pressure_of_spheres, 0.002, 0.002, ("lattices.space",)),
)


def measure(plan: Plan = FULL) -> xr.Dataset:
    """All rows of the plan.

    Returns:
        Dataset over effect: scene_keys and check in words, momentum_drift and energy_balance; measured, expected and allowed
        of the check, where allowed is the largest difference of the two; code_lines.
    """
    wanted = [row for row in ROWS if plan.names is None or row.name in plan.names]
    rows = [measure_row(row, plan) for row in wanted]
    names = {"effect": [row.name for row in wanted]}
    return xr.Dataset({name: ("effect", [row[name] for row in rows]) for name in rows[0]}, names)


def measure_row(row: Row, plan: Plan) -> dict[str, object]:
    """One row, by the names of the variables."""
    momentum, balance = conservation(row.scene, plan.collisions)
    measured, expected = row.check(row.scene, plan.length)
    return {
        "scene_keys": keys_of(row.scene),
        "check": " ".join(row.check.__doc__.split()).removesuffix("."),
        "momentum_drift": momentum,
        "energy_balance": balance,
        "measured": float(measured),
        "expected": float(expected),
        "allowed": abs(expected) * (row.theory + row.error / math.sqrt(plan.length)),
        "code_lines": sum(map(code_lines, row.files)),
    }


def keys_of(scene: Scene) -> str:
    """What a scene names beyond elastic disks."""
    plain = PLAIN.as_dict()
    named = {key: value for key, value in scene.as_dict().items() if value != plain[key]}
    return ", ".join(f"{key}: {value:.6g}" if isinstance(value, float) else f"{key}: {value}" for key, value in named.items())


def code_lines(name: str) -> int:
    """Lines of a module that hold code: no blank ones, no comments, no docstrings."""
    file = SOURCES.joinpath(*(name.split(".") if "." in name else ("dynamics", "events", "effects", name)))
    text = file.with_suffix(".py").read_text()
    without = (tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT, tokenize.ENDMARKER)
    tokens = [token for token in tokenize.generate_tokens(io.StringIO(text).readline) if token.type not in without]
    code = {line for token in tokens for line in range(token.start[0], token.end[0] + 1)}
    return len(code - _docstrings(ast.parse(text)))


def _docstrings(tree: ast.Module) -> set[int]:
    """Lines of all texts that stand alone: docstrings, also those of names."""
    alone = [node for node in ast.walk(tree) if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)]
    return {line for node in alone if isinstance(node.value.value, str) for line in range(node.lineno, node.end_lineno + 1)}

"""What theory says of each effect, and the same number measured: the checks of the table of effects (effects.py)."""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import lru_cache

import numpy as np

from granugas.analysis import theory
from granugas.analysis.observables import kinetic_energy, species_temperature_ratio
from granugas.diameters import diameters
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

NEARLY_ELASTIC = 0.99999
"""r of gases that stay in equilibrium, under rules that elastic particles have no use for."""

DILUTE = 0.02
"""Area fraction at which neighbours come close to being independent of each other."""

G = 9.81
"""In m/s^2."""

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

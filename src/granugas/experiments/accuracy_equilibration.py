"""What is left of the start lattice and the uniform velocities after n collisions of a particle, and what these cost."""

import math
import time
from typing import NamedTuple

import numpy as np
import xarray as xr

from granugas.analysis.accuracy import bias
from granugas.analysis.observables import kinetic_energy, velocity_kurtosis
from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import engine_at_start, on_lattice
from granugas.initial import random_stream, start_lattice
from granugas.scene import Scene
from granugas.warm_up import warm_up

ALONE = ("the processor time of an equilibration",)

GASES = (
    Scene(1435, 0.226725, restitution=1.0, contact_time=0.0, lattice="triangular"),
    Scene(1435, 0.6, restitution=1.0, contact_time=0.0),
)
SEED = 1998

WINDOW = 1.0
"""Collisions of a particle after each setting, in which its rate and its pressure are taken."""

LONG = (100.0, 150.0)
"""Collisions of a particle: the equilibrium is the mean of the windows from the one to the other."""

OBSERVABLES = ("<v^4>/<v^2>^2", "collision rate", "P V/E")


class Plan(NamedTuple):
    """How much is measured: realizations, and numbers of collisions of a particle."""

    realizations: int
    settings: tuple[float, ...] = (0, 1, 2, 3, 5, 10, 20, 50)


FULL = Plan(400)
SMALL = Plan(8, (0, 1, 5, 20))


def measure(plan: Plan = FULL) -> xr.Dataset:
    """Both gases from their lattices on; `equilibrate` would not stop before it finds the velocities Maxwellian.

    Returns:
        Dataset over case (the gases), setting (collisions of a particle) and observable, as `analysis.accuracy.bias` has it:
        the mean kurtosis of the velocity components at that moment, collision rate (s-1) and reduced pressure in the WINDOW
        that follows; the truth is the same run later on. cpu_seconds from the lattice to the setting, the engine's first
        predictions included, median over realizations.
    """
    warm_up(GASES)
    data = xr.concat([_gas(scene, plan) for scene in GASES], "case")
    return data.assign_attrs(
        knob="collisions of a particle before the start", window=WINDOW, n_particles=GASES[0].n_particles, restitution=1.0
    )


def _gas(scene: Scene, plan: Plan) -> xr.Dataset:
    """All realizations of one gas against their own long equilibration."""
    runs = xr.concat([_run(scene, k, plan.settings) for k in range(plan.realizations)], "realization")
    found = bias(runs["value"], runs["truth"]).assign(cpu_seconds=runs["cpu_seconds"].median("realization"))
    return found.assign_coords(case=f"area fraction {scene.area_fraction:.4g}")


def _run(scene: Scene, realization: int, settings: tuple[float, ...]) -> xr.Dataset:
    """One realization: OBSERVABLES at each setting, and in equilibrium."""
    lattice, rng = start_lattice(scene), random_stream(scene, SEED, realization)
    start, clock = on_lattice(scene, lattice, rng), time.process_time()
    engine = engine_at_start(scene, start, lattice)
    values, seconds = [], []
    spent = time.process_time() - clock
    for n in settings:
        spent += _advance(engine, n)
        seconds.append(spent)
        values.append(_look(engine, n + WINDOW))
    _advance(engine, LONG[0])
    truth = np.mean([_look(engine, n + WINDOW) for n in np.arange(*LONG, WINDOW)], axis=0)
    return xr.Dataset(
        {"value": (("setting", "observable"), values), "truth": ("observable", truth), "cpu_seconds": ("setting", seconds)},
        {"setting": np.array(settings, float), "observable": list(OBSERVABLES)},
    )


def _advance(engine: Engine, collisions: float) -> float:
    """Go on to so many collisions of a particle in all; the processor time that it took."""
    clock = time.process_time()
    engine.advance(math.inf, math.ceil(engine.scene.n_particles * collisions / 2) - engine.collisions)
    return time.process_time() - clock


def _look(engine: Engine, until: float) -> list[float]:
    """OBSERVABLES from now on until so many collisions of a particle in all."""
    velocity, begin = engine.state().velocity, engine.time
    engine.take_tally()
    _advance(engine, until)
    tally, duration = engine.take_tally(), engine.time - begin
    stress = tally.stress / (kinetic_energy(velocity).sum() * duration)
    rate = 2 * tally.collisions / (engine.scene.n_particles * duration)
    return [float(velocity_kurtosis(velocity).mean()), rate, 1 - np.trace(stress) / 2]

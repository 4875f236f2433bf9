"""Homogeneous heating: all particles are kicked at random, at regular intervals (Williams & MacKintosh 1996).

The components of a kick are normal variables, independent of each other and of the particles; together the kicks leave the
centre of mass as it is. Kick number k is drawn from a generator of its own, so that a run that is continued goes on with it.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from granugas.dynamics.events import loop
from granugas.dynamics.events.memory import Record, Table
from granugas.dynamics.events.state import Gas
from granugas.dynamics.state import State
from granugas.scene import Scene

PART_OF_FLIGHT = 0.1
"""Interval between two kicks in mean free times of the hotter of the states, at the start and steady."""

ITS_OWN = 0x6B69636B
"""Sets the random numbers of kicks apart from others of the same seed."""

COUNT = np.dtype([("done", "i8"), ("input", "f8")])
"""Kicks so far, and the energy that they have put in since it was last taken (m d^2/s^2)."""


class Kicks(NamedTuple):
    """Kicks at times `interval` (s), 2 `interval` ... of the standard deviation `strength` (d/s) along each axis."""

    count: Record
    interval: float
    strength: float
    dimensions: int
    key: np.ndarray
    mass: np.ndarray

    def due(self, until: float) -> float | None:
        """When the next kick is, if that is not after `until` (s)."""
        time = (self.count.done + 1) * self.interval
        return time if time <= until else None

    def act(self, gas: Gas) -> None:
        """Kick all particles, at the time that is reached."""
        kicks = np.zeros(len(self.mass), [("dv", "f8", (self.dimensions,))])
        kicks["dv"] = self._changes(self.count.done)
        self.count.input += loop.kick(gas, Table(kicks))
        self.count.done += 1

    def take(self, scene: Scene) -> dict[str, float]:
        """The energy per mass put in since it was last taken (m^2/s^2)."""
        taken = float(self.count.input) * scene.diameter**2
        self.count.input = 0.0
        return {"energy_input": taken}

    def observe(self, scene: Scene, state: State, tally: Any, interval: float) -> dict[str, float]:
        """The power of the kicks over an interval."""
        if tally is None or interval <= 0:
            return {}
        return {"heating_power": tally.more["energy_input"] / (scene.n_particles * interval)}

    def _changes(self, k: int) -> np.ndarray:
        """(N, D) changes of the velocities by kick k (d/s)."""
        random = np.random.Generator(np.random.Philox(key=self.key, counter=[0, 0, 0, k]))
        change = self.strength * random.standard_normal((len(self.mass), self.dimensions))
        return change - np.average(change, axis=0, weights=self.mass)


def effect_of(scene: Scene, state: State) -> Kicks:
    """The kicks of a scene; only several particles can be kicked without moving their centre of mass."""
    mass = state.more.get("mass", np.ones(scene.n_particles))
    interval = interval_of(scene)
    free = 1 - np.sum(mass**2) / mass.sum() ** 2  # what of the energy the centre of mass does not take away
    variance = 2 * scene.heating * interval / scene.dimensions / free
    key = np.random.SeedSequence([*state.seed, ITS_OWN]).generate_state(2, np.uint64)
    return Kicks(Record(np.zeros(1, COUNT)), interval, math.sqrt(variance) / scene.diameter, scene.dimensions, key, mass)


def interval_of(scene: Scene) -> float:
    """Time between two kicks in s: a part of the mean free time in the hotter of the states, at the start and steady.

    The collision rate is Enskog's, a sqrt(T), T = kT/m; for g(2a) stands (1 - nu)^-D, which is never too small. Steady is
    heating = (1 - r^2) a T^(3/2) / 2. Elastic particles are heated without end, and kicked as at the start.
    """
    D, nu = scene.dimensions, scene.area_fraction
    a = D * 2**D * nu / (math.sqrt(math.pi) * scene.diameter * (1 - nu) ** D)
    hottest = scene.velocity_half_width**2 / 3
    if scene.restitution < 1:
        hottest = max(hottest, (2 * scene.heating / ((1 - scene.restitution**2) * a)) ** (2 / 3))
    return PART_OF_FLIGHT / (a * math.sqrt(hottest))

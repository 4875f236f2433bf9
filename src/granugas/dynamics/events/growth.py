"""Growth of the particles that are too large for the start lattice.

They start as large as the lattice allows. While the gas moves, each one grows at regular intervals as far as its neighbours
let it, until it has its size. Masses stay, and so does the energy.
"""

import math
from typing import NamedTuple

import numpy as np

from granugas.dynamics.events.boundary import clearance
from granugas.dynamics.events.cells import list_around
from granugas.dynamics.events.composition import inline, kernel
from granugas.dynamics.events.flight import position
from granugas.dynamics.events.loop import predict_anew
from granugas.dynamics.events.memory import Record, Table
from granugas.dynamics.events.sizes import radius, resize
from granugas.dynamics.events.state import NOBODY, Gas
from granugas.dynamics.events.vectors import dot, minus, plus
from granugas.dynamics.state import State
from granugas.scene import Scene

FLOWN = 0.1
"""Diameters that a particle flies between two steps."""

APART = 1.0 - 1.0e-9
"""A particle grows up to this part of the way to its neighbour."""

WANTED = np.dtype([("radius", "f8")])
STEPS = np.dtype([("done", "i8"), ("small", "i8")])
"""Steps so far, and particles that are not as large yet as they should be."""


class Growth(NamedTuple):
    """A drive (driving.py) that ends by itself."""

    wanted: Table
    steps: Record
    interval: float

    def due(self, until: float) -> float | None:
        """When the next step is, if there is one and it is not after `until` (s)."""
        time = (self.steps.done + 1) * self.interval
        return time if self.steps.small > 0 and time <= until else None

    def act(self, gas: Gas) -> None:
        """Let the particles grow."""
        self.steps.small = grow(gas, self.wanted)
        self.steps.done += 1


def growth(scene: Scene, start: State) -> Growth:
    """Growth up to the diameters of a state."""
    wanted, steps = np.zeros(scene.n_particles, WANTED), np.zeros(1, STEPS)
    wanted["radius"] = start.more["diameter"] / scene.diameter / 2
    steps["small"] = scene.n_particles
    return Growth(Table(wanted), Record(steps), FLOWN * scene.diameter / scene.velocity_half_width)


@kernel
def grow(gas, wanted):
    """One step, at the time that is reached; how many particles are still too small."""
    now = gas.calendar.now = gas.calendar.reached
    small = 0
    for i in range(gas.calendar.n_disks):
        if radius(gas.sizes, i) < wanted.radius[i]:
            resize(gas.sizes, i, max(min(wanted.radius[i], _room(gas, i, now)), radius(gas.sizes, i)))
            small += radius(gas.sizes, i) < wanted.radius[i]
    predict_anew(gas)
    return small


@inline
def _room(gas, i, now):
    """The radius with which particle i touches a wall, or nearly touches its nearest neighbour; cells hold the largest pair."""
    x = position(gas, i, now)
    room = clearance(gas.walls, gas, i, x)
    for k in range(list_around(gas.disks.cell[i], gas)):
        j = gas.near.disk[k]
        at = minus(gas.near.at[k], x)
        while j != NOBODY:
            if j != i:
                r = plus(position(gas, j, now), at)
                room = min(room, APART * (math.sqrt(dot(r, r)) - radius(gas.sizes, j)))
            j = gas.disks.next[j]
    return room

"""Gravity: a constant acceleration down along the last axis, parabolas instead of straight lines.

Between particles nothing changes, for all fall alike: they meet as in straight lines. Where a parabola ends is the root of a
quadratic equation, in the form without cancellation.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from granugas.dynamics.events.composition import implements, inline
from granugas.dynamics.events.flight import delay, hastened, leaves_interval, moved, position, pull, settle, velocity
from granugas.dynamics.events.vectors import along
from granugas.dynamics.state import State
from granugas.scene import Scene


class Gravity(NamedTuple):
    """The acceleration, a vector (d/s^2)."""

    a: tuple[float, ...]

    def observe(self, scene: Scene, state: State, tally: Any, interval: float) -> dict[str, float]:
        """Potential energy, zero where every particle would lie on the floor; and the force on the floor, if there is one."""
        mass = state.more.get("mass", np.ones(scene.n_particles))
        heights = state.position[:, -1] - state.more.get("diameter", scene.diameter) / 2
        energy, force = scene.gravity * np.sum(mass * heights), math.nan
        if tally is not None and interval > 0:
            force = -tally.more["wall_momentum"][-1, 0] / interval
        unit = scene.n_particles * scene.energy_per_mass
        return {"potential_energy": float(energy / unit), "floor_force": float(force / (mass.sum() * scene.gravity))}


def effect_of(scene: Scene, state: State) -> Gravity:
    """The force of a scene."""
    return Gravity((0.0,) * (scene.dimensions - 1) + (-scene.gravity / scene.diameter,))


@implements(moved, Gravity)
def _moved(force, x, v, flown):
    return along(x, flown, along(v, 0.5 * flown, force.a))


@implements(hastened, Gravity)
def _hastened(force, v, flown):
    return along(v, flown, force.a)


@implements(settle, Gravity)
def _settle(force, gas, i, time):
    gas.disks.x[i], gas.disks.v[i] = position(gas, i, time), velocity(gas, i, time)
    gas.disks.t[i] = time


@implements(pull, Gravity)
def _pull(force, axis):
    return force.a[axis]


@implements(leaves_interval, Gravity)
def _leaves_interval(force, axis, x, v, low, high):
    g = -force.a[axis]
    if g == 0.0:
        return delay(max(high - x if v > 0.0 else x - low, 0.0), v), v > 0.0
    way = max(high - x, 0.0)
    rest = v * v - 2.0 * g * way
    if v > 0.0 and rest >= 0.0:
        return 2.0 * way / (v + math.sqrt(rest)), True
    return _falls(max(x - low, 0.0), v, g), False


@inline
def _falls(way, v, g):
    """How long a fall takes that begins with the velocity v upwards."""
    speed = math.sqrt(v * v + 2.0 * g * way)
    if v >= 0.0:
        return (v + speed) / g
    return 2.0 * way / (speed - v)

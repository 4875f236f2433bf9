"""Walls at the ends of the box: a particle is thrown back by the coefficient of the wall, elastically within its t_c (A Eq. 4).

A wall is a particle of infinite mass that stands still, or moves as the floor does. It is touched when a centre is a radius
away. Hits stamp the clocks of the particles, and are no collisions of particles: they are counted here. What is ahead of a
particle, the next cell or a wall, is noted down when its next event is planned, so that no rounding can choose another way.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from granugas.dynamics.events.boundary import (
    NO_WALL,
    WALL,
    WALL_AND_CALL,
    bounce,
    clearance,
    climb,
    goes_on_after,
    lands_after,
    peak,
    raised,
    step_ahead,
)
from granugas.dynamics.events.collisions import lose, pass_on
from granugas.dynamics.events.composition import implements, inline
from granugas.dynamics.events.flight import leaves_interval, settle
from granugas.dynamics.events.loop import witness_at_wall
from granugas.dynamics.events.memory import Record, Table
from granugas.dynamics.events.predict import leave_partner
from granugas.dynamics.events.sizes import mass, radius
from granugas.dynamics.events.vectors import plus, scaled, with_component, zeros_like
from granugas.dynamics.on_walls import wall_pressure
from granugas.dynamics.state import State
from granugas.scene import Scene

AHEAD = np.dtype([("axis", "i1"), ("side", "i1"), ("wall", "i1")])
"""Where a particle comes to an end: the axis, +-1 for its upper or lower one, and whether that is a wall."""


class Walls(NamedTuple):
    """r and t_c (s) at the walls; what is AHEAD of each particle; hits and momentum (m d/s) that the walls took up."""

    r: float
    t_c: float
    ahead: Table
    sums: Record

    def take(self, scene: Scene) -> dict[str, Any]:
        """Hits since the sums were last taken, momentum (D, 2) that the lower and upper walls took up, per mass (m/s)."""
        rows = self.sums.rows
        taken = {"wall_hits": int(rows["hits"][0]), "wall_momentum": rows["momentum"][0] * scene.diameter}
        rows["before"] += rows["hits"]
        rows["hits"], rows["momentum"] = 0, 0.0
        return taken

    def observe(self, scene: Scene, state: State, tally: Any, interval: float) -> dict[str, float]:
        """Hits since t = 0, and the pressure on the walls since the sample before (where no weight rests on them)."""
        hits = {"wall_collisions_per_particle": float(self.sums.rows["before"][0] / scene.n_particles)}
        if scene.gravity > 0:
            return hits
        return hits | {"wall_pressure": wall_pressure(scene, state, tally, interval)}


def effect_of(scene: Scene, state: State) -> Walls:
    """The walls of a scene."""
    dimensions = scene.dimensions
    sums = np.dtype([("hits", "i8"), ("before", "i8"), ("momentum", "f8", (dimensions, 2))])
    ahead = Table(np.zeros(scene.n_particles, AHEAD))
    return Walls(float(scene.wall_restitution), float(scene.wall_contact_time), ahead, Record(np.zeros(1, sums)))


@implements(goes_on_after, Walls)
def _to_the_next_cell_or_wall(walls, gas, i, x, v, now):
    last = len(x) - 1
    first, axis_there, upper_there = math.inf, 0, False
    for axis in range(len(x)):
        low, high = _free(gas, i, axis, axis == last)
        delay, upper = leaves_interval(gas.force, axis, x[axis], v[axis], low, high)
        if delay < first:
            first, axis_there, upper_there = delay, axis, upper
    wall = _is_wall(gas, i, axis_there, upper_there)
    if peak(gas.floor) > 0.0 and _bottom(gas, i, last) < peak(gas.floor) + radius(gas.sizes, i):
        y = x[last] + gas.grid.half[last] + _bottom(gas, i, last) - radius(gas.sizes, i)
        delay = lands_after(gas.floor, gas, y, v[last], now, first)
        if delay < first:
            first, axis_there, upper_there, wall = delay, last, False, True
    ahead = walls.ahead
    ahead.axis[i], ahead.side[i], ahead.wall[i] = axis_there, 1 if upper_there else -1, 1 if wall else 0
    return first


@inline
def _bottom(gas, i, axis):
    """The lower edge of the cell of disk i along an axis, from that of the box (d)."""
    return gas.disks.cell[i][axis] * gas.grid.width[axis]


@inline
def _free(gas, i, axis, vertical):
    """Between which coordinates disk i is in its cell and touches no wall that stands still."""
    half, cell = gas.grid.half[axis], gas.disks.cell[i][axis]
    low, high = -half, half
    if gas.grid.box[axis] == math.inf:
        if cell == 0:
            low += radius(gas.sizes, i)
            if vertical and peak(gas.floor) > 0.0:
                low = -half - 1.0  # never reached: the floor is above
        if cell == gas.grid.cells[axis] - 2:
            high -= radius(gas.sizes, i)
    return low, high


@inline
def _is_wall(gas, i, axis, upper):
    """Whether the end of the cell of disk i, the upper or lower one along an axis, is a wall."""
    outermost = gas.grid.cells[axis] - 2 if upper else 0
    return gas.grid.box[axis] == math.inf and gas.disks.cell[i][axis] == outermost


@implements(clearance, Walls)
def _to_the_nearest_wall(walls, gas, i, x):
    nearest = math.inf
    for axis in range(len(x)):
        for side in range(-1, 2, 2):
            if _is_wall(gas, i, axis, side > 0):
                nearest = min(nearest, gas.grid.half[axis] - side * x[axis])
    return nearest


@implements(step_ahead, Walls)
def _step_ahead(walls, gas, i, x, v):
    return with_component(scaled(gas.grid.cells, 0), walls.ahead.axis[i], walls.ahead.side[i])


@implements(bounce, Walls)
def _bounce(walls, gas, i, now):
    if walls.ahead.wall[i] == 0:
        return NO_WALL
    disks, clocks, sums, m = gas.disks, gas.clocks, walls.sums, mass(gas.sizes, i)
    axis, side = walls.ahead.axis[i], walls.ahead.side[i]
    leave_partner(gas, i)
    settle(gas.force, gas, i, now)
    moves = peak(gas.floor) > 0.0 and axis == len(disks.x[i]) - 1 and side < 0
    speed = climb(gas.floor, gas, now) if moves else 0.0
    if not moves:
        low, high = _free(gas, i, axis, False)
        disks.x[i] = with_component(disks.x[i], axis, high if side > 0 else low)
    before = disks.v[i][axis]
    u, since = before - speed, now - clocks.last[i]
    r = 1.0 if since <= walls.t_c else walls.r  # A Eq. 4
    after = speed - r * u
    disks.v[i] = with_component(disks.v[i], axis, after)
    clocks.last[i], clocks.interval[i] = now, since
    sums.hits += 1
    taken = m * (before - after)
    sums.momentum[axis] = plus(sums.momentum[axis], (0.0, taken) if side > 0 else (taken, 0.0))
    lose(gas.tally, 0.5 * m * (1.0 - r * r) * u * u, now)
    raised(gas.floor, -taken * speed)
    nothing = zeros_like(disks.v[i])
    normal, gained = with_component(nothing, axis, 1.0 * side), with_component(nothing, axis, -taken)
    pass_on(normal, gas.tally, gained, radius(gas.sizes, i))  # A Eq. 15, of one partner
    return WALL_AND_CALL if witness_at_wall(gas.watch, gas, i, now, since, -abs(u)) else WALL

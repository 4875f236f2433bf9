"""Steps of velocity Verlet for soft particles: springs and dashpots in contact, straight lines between.

Places and accelerations are known at the times t_n = n dt, velocities in the middle between two of them (leapfrog, the same
trajectory as velocity Verlet). The dashpot needs the velocity at t_n before the forces there are known: it is extrapolated
from the middle by the acceleration before, an error of second order. Where a contact begins or ends the force of the dashpot
jumps: it counts for the part of the step that the contact lasts, or the error would be of first order. Without a dashpot
nothing of that plays a part, the scheme is symplectic and time-reversible, and energy does not drift.

A force at t_n acts from half a step before to half a step after, and so do the sums that are made of it (`Now`).
Lengths are in m, times in s, masses by that of a particle.
"""

import math
from functools import cache
from typing import NamedTuple

import numpy as np

from granugas.dynamics.events.collisions import pass_on
from granugas.dynamics.events.composition import inline, kernel
from granugas.dynamics.events.memory import Record, Table
from granugas.dynamics.events.vectors import along, divided, dot, mapped, minus, plus, scaled, with_component, zeros_like
from granugas.dynamics.neighbours import Grid, nearest

LAST, ENOUGH, LIST = 0, 1, 2
"""Why the steps end: the last one was made, there were enough collisions, the list of the pairs is out of date."""

CLOCKS = np.dtype([("last", "f8"), ("interval", "f8"), ("collisions", "i8"), ("touching", "i4"), ("walls", "i4")])
"""Beginning of the last contact and time between the last two (s), contacts since the start and now, walls touched (bits)."""


@cache
def layouts(dimensions: int) -> dict[str, np.dtype]:
    """The layouts of `motion`, `sums` and `now`; vectors have as many components as space has dimensions."""
    vector, square, ends = ("f8", (dimensions,)), ("f8", (dimensions, dimensions)), ("f8", (dimensions, 2))
    motion = [
        ("x", *vector),  # at t_n
        ("h", *vector),  # velocity at t_n + dt/2
        ("a", *vector),  # acceleration at t_n
        ("v", *vector),  # velocity at t_n as the dashpots see it
    ]
    sums = [
        ("step", "i8"),  # n
        ("pairs", "i8"),  # in the list
        ("nearer", "f8"),  # by how much particles may have come nearer since the list was made (m)
        ("fastest", "f8"),  # speed at t_n + dt/2
        ("collisions", "i8"),  # contacts that began since the start
        ("elastic", "i8"),  # those of them that began while one of the partners was in another contact
        ("hits", "i8"),  # contacts with walls that began
        ("loss", "f8"),  # from here on since the tally was last taken: dissipated energy
        ("loss_time", "f8"),  # sum of the losses times when they were
        ("energy_time", "f8"),  # elastic energy times time
        ("stress", *square),  # dp_a l_b (A Eq. 15)
        ("momentum", *ends),  # that the lower and the upper wall of each axis took up
    ]
    now = [
        ("power", "f8"),  # dissipated
        ("energy", "f8"),  # elastic
        ("stress", *square),  # f_a l_b
        ("momentum", *ends),  # force on the walls
    ]
    return {"motion": np.dtype(motion), "clocks": CLOCKS, "sums": np.dtype(sums), "now": np.dtype(now)}


class Contact(NamedTuple):
    """k and gamma of a force k delta + gamma d(delta)/dt on a particle of mass 1, and the mass that moves: 1/2 of a pair."""

    stiffness: float
    damping: float
    mass: float


class Gas(NamedTuple):
    """All that a step touches.

    Attributes:
        n: number of particles.
        d, dt, skin: diameter (m), step (s), and by how much pairs of the list are farther than d (m).
        begin: time of step 0 (s).
        pair, wall: contacts.
        walled: for each axis, whether it ends in walls; any_wall: whether one does.
        grid, motion, clocks, pairs, sums, now: tables and records.
    """

    n: int
    d: float
    dt: float
    skin: float
    begin: float
    pair: Contact
    wall: Contact
    walled: tuple[bool, ...]
    any_wall: bool
    grid: Grid
    motion: Table
    clocks: Table
    pairs: Table
    sums: Record
    now: Record


@kernel
def run(gas, last, collisions):
    """Step on until the step `last`, or until there are so many collisions; why it ended."""
    sums = gas.sums
    while sums.collisions < collisions:
        if sums.step >= last:
            return LAST
        if sums.nearer + 2.0 * sums.fastest * gas.dt > gas.skin:
            return LIST
        _sum_up(gas)
        _drift(gas)
        _push(gas)
        _kick(gas, 1.0)
    return ENOUGH


@kernel
def start(gas):
    """Forces at step 0, of velocities at that time; the list is new."""
    _push(gas)
    _kick(gas, 0.5)


@kernel
def listed(gas, count):
    """After the list is made anew, of `count` pairs: who touches whom, at the same places as before."""
    motion, clocks, pairs, sums = gas.motion, gas.clocks, gas.pairs, gas.sums
    sums.pairs, sums.nearer = count, 0.0
    for i in range(gas.n):
        clocks.touching[i] = _bits(clocks.walls[i])
    for p in range(count):
        i, j = pairs.i[p], pairs.j[p]
        r = mapped(minus(motion.x[j], motion.x[i]), gas.grid.image, nearest)
        if dot(r, r) < gas.d * gas.d:
            pairs.touching[p] = 1
            clocks.touching[i] += 1
            clocks.touching[j] += 1


@inline
def _bits(number):
    """How many bits are set."""
    count = 0
    while number > 0:
        count += number & 1
        number >>= 1
    return count


@inline
def _sum_up(gas):
    """What is true now holds for a step."""
    sums, now, dt = gas.sums, gas.now, gas.dt
    sums.loss += now.power * dt
    sums.loss_time += now.power * dt * (gas.begin + sums.step * dt)
    sums.energy_time += now.energy * dt
    for axis in range(len(gas.walled)):
        sums.stress[axis] = along(sums.stress[axis], dt, now.stress[axis])
        sums.momentum[axis] = along(sums.momentum[axis], dt, now.momentum[axis])


@inline
def _drift(gas):
    """Move all by a step, and extrapolate their velocities to its end."""
    motion, dt = gas.motion, gas.dt
    for i in range(gas.n):
        h = motion.h[i]
        motion.x[i] = along(motion.x[i], dt, h)
        motion.v[i] = along(h, 0.5 * dt, motion.a[i])
        motion.a[i] = zeros_like(h)
    gas.sums.step += 1
    gas.sums.nearer += 2.0 * gas.sums.fastest * dt


@inline
def _kick(gas, steps):
    """Let the forces change all velocities for some steps, and find the fastest."""
    motion, most = gas.motion, 0.0
    for i in range(gas.n):
        h = along(motion.h[i], steps * gas.dt, motion.a[i])
        motion.h[i] = h
        most = max(most, dot(h, h))
    gas.sums.fastest = math.sqrt(most)


@inline
def _push(gas):
    """The forces of all contacts."""
    motion, pairs, now = gas.motion, gas.pairs, gas.now
    now.power = now.energy = 0.0
    for axis in range(len(gas.walled)):
        now.stress[axis], now.momentum[axis] = zeros_like(now.stress[axis]), (0.0, 0.0)
    for p in range(gas.sums.pairs):
        i, j = pairs.i[p], pairs.j[p]
        r = mapped(minus(motion.x[j], motion.x[i]), gas.grid.image, nearest)
        r_r = dot(r, r)
        if r_r < gas.d * gas.d:
            _touch(gas, p, i, j, r, math.sqrt(r_r))
        elif pairs.touching[p]:
            pairs.touching[p] = 0
            gas.clocks.touching[i] -= 1
            gas.clocks.touching[j] -= 1
    if gas.any_wall:
        _push_from_walls(gas)


@inline
def _touch(gas, p, i, j, r, distance):
    """Particles i and j overlap."""
    motion, clocks, sums = gas.motion, gas.clocks, gas.sums
    n = divided(r, distance)
    overlap, rate = gas.d - distance, dot(minus(motion.v[i], motion.v[j]), n)
    if not gas.pairs.touching[p]:
        now = _beginning(gas, overlap, rate)
        sums.collisions += 1
        sums.elastic += clocks.touching[i] > 0 or clocks.touching[j] > 0
        clocks.collisions[i] += 1
        clocks.collisions[j] += 1
        _stamp(clocks, i, now)
        _stamp(clocks, j, now)
        gas.pairs.touching[p] = 1
    push = _force(gas, gas.pair, overlap, rate)
    motion.a[i] = along(motion.a[i], -push, n)
    motion.a[j] = along(motion.a[j], push, n)
    pass_on(n, gas.now, scaled(n, -push), distance)


@inline
def _force(gas, contact, overlap, rate):
    """k delta + gamma d(delta)/dt; what is dissipated and what is stored are counted."""
    way = abs(rate) * gas.dt
    share = 1.0 if overlap >= way else 0.5 + overlap / way  # of the step, in which the contact began or will end
    gas.now.energy += 0.5 * contact.mass * contact.stiffness * overlap * overlap
    gas.now.power += contact.mass * contact.damping * share * rate * rate
    return contact.mass * (contact.stiffness * overlap + contact.damping * share * rate)


@inline
def _beginning(gas, overlap, rate):
    """When a contact began that is found at the present step (s)."""
    before = overlap / rate if rate * gas.dt > overlap else gas.dt
    return gas.begin + (gas.sums.step * gas.dt - (before if rate > 0.0 else 0.0))


@inline
def _stamp(clocks, i, now):
    """A contact of i began; where another one began in the same step, it may be told before."""
    clocks.interval[i], clocks.last[i] = max(now - clocks.last[i], 0.0), max(now, clocks.last[i])
    clocks.touching[i] += 1


@inline
def _push_from_walls(gas):
    """Forces of the walls."""
    motion, clocks, now = gas.motion, gas.clocks, gas.now
    for i in range(gas.n):
        x = motion.x[i]
        for axis in range(len(x)):
            if gas.walled[axis]:
                for side in range(2):
                    room = gas.grid.side[axis] - x[axis] if side else x[axis]
                    overlap, bit = 0.5 * gas.d - room, 1 << (2 * axis + side)
                    if overlap > 0.0:
                        rate = motion.v[i][axis] if side else -motion.v[i][axis]
                        if not clocks.walls[i] & bit:
                            clocks.walls[i] |= bit
                            gas.sums.hits += 1
                            _stamp(clocks, i, _beginning(gas, overlap, rate))
                        push = _force(gas, gas.wall, overlap, rate)
                        outward = 1.0 if side else -1.0
                        normal = with_component(zeros_like(x), axis, outward)
                        motion.a[i] = along(motion.a[i], -push, normal)
                        now.momentum[axis] = plus(now.momentum[axis], (0.0, push) if side else (-push, 0.0))
                        pass_on(normal, now, scaled(normal, -push), room)
                    elif clocks.walls[i] & bit:
                        clocks.walls[i] ^= bit
                        clocks.touching[i] -= 1

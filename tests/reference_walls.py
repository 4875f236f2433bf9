"""Particles between walls, under gravity, on a floor in motion, by brute force: every pair and every wall at every step."""

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from granugas.dynamics.state import State
from granugas.scene import Scene

LOOKS = 200
"""Looks a period at the distance from a floor in motion, between which it changes its sign once at most."""

JUST_NOW = 1.0e-9
"""Partners that approach each other with less than this part of their velocities, or this part of a diameter away from touching
while they part, have just collided."""


@dataclass
class Happened:
    """Collisions one after the other.

    Attributes:
        time: (C,), in s since the start.
        who: (C, 2), i < j; i = -1: j hits a wall.
        velocity: (N, D), in m/s, after the last of them.
    """

    time: np.ndarray
    who: np.ndarray
    velocity: np.ndarray


def follow_between_walls(state: State, scene: Scene, collisions: int) -> Happened:
    """The next collisions of a state, those with walls among them."""
    box, walled = np.array(state.box), np.array(scene.walled)
    pull = np.zeros(len(box))
    pull[-1] = -scene.gravity
    x, v, last = state.position.copy(), state.velocity.copy(), state.last_collision_time - state.time
    now, times, who = 0.0, [], []
    while len(times) < collisions:
        pair_delay, i, j, normal = _first_pair(x, v, box, walled, scene.diameter)
        wall_delay, k, axis, speed = _first_wall(x, v, pull, box, walled, scene, state.time + now)
        delay = min(pair_delay, wall_delay)
        now, x, v = now + delay, x + v * delay + pull * delay**2 / 2, v + pull * delay
        if wall_delay < pair_delay:
            r = 1.0 if now - last[k] <= scene.wall_contact_time else scene.wall_restitution
            v[k, axis] = speed - r * (v[k, axis] - speed)
            last[k] = now
            who.append((-1, k))
        elif i == j:  # nobody within reach of the images
            continue
        else:
            r = 1.0 if now - max(last[i], last[j]) <= scene.contact_time else scene.restitution
            u_n = (v[j] - v[i]) @ normal
            v[i] += (1 + r) / 2 * u_n * normal
            v[j] -= (1 + r) / 2 * u_n * normal
            last[i] = last[j] = now
            who.append((i, j))
        times.append(now)
    return Happened(np.array(times), np.array(who), v)


def _first_pair(
    x: np.ndarray, v: np.ndarray, box: np.ndarray, walled: np.ndarray, d: float
) -> tuple[float, int, int, np.ndarray]:
    """The earliest meeting of two particles, all of which fall alike, in their nearest images, as long as nobody goes far."""
    i, j = np.triu_indices(len(x), 1)
    nobody = (0, 0, np.zeros(len(box)))
    if not len(i):
        return math.inf, *nobody
    r, u = x[j] - x[i], v[j] - v[i]
    r = np.where(walled, r, r - box * np.round(r / box))
    sides = box[~walled]
    longest = (sides.min() / 2 - d) / np.linalg.norm(u, axis=1).max() if len(sides) else math.inf
    r_u, u_u, gap = np.sum(r * u, axis=1), np.sum(u * u, axis=1), np.sum(r * r, axis=1) - d * d
    root = r_u**2 - u_u * gap
    meets = (r_u < 0) & (root > 0) & ((gap > JUST_NOW * d * d) | (r_u**2 > JUST_NOW**2 * u_u * d * d))
    delay = np.full(len(r), math.inf)
    delay[meets] = np.maximum(gap[meets], 0) / (np.sqrt(root[meets]) - r_u[meets])
    k = int(np.argmin(delay))
    if delay[k] > longest or delay[k] == math.inf:
        return longest, *nobody
    normal = r[k] + u[k] * delay[k]
    return delay[k], i[k], j[k], normal / np.linalg.norm(normal)


def _first_wall(
    x: np.ndarray, v: np.ndarray, pull: np.ndarray, box: np.ndarray, walled: np.ndarray, scene: Scene, now: float
) -> tuple[float, int, int, float]:
    """The earliest hit of a wall: how long until then, who, along which axis, and the velocity of the wall."""
    found = (math.inf, 0, 0, 0.0)
    for axis in np.flatnonzero(walled):
        for k in range(len(x)):
            way, speed = x[k, axis] - scene.diameter / 2, v[k, axis]
            floor = axis == len(box) - 1 and scene.floor != "still"
            top = box[axis] - scene.diameter / 2 - x[k, axis]
            found = min(found, (_reaches(top, -speed, -pull[axis]), k, axis, 0.0))
            if not floor:
                found = min(found, (_reaches(way, speed, pull[axis]), k, axis, 0.0))
            else:
                delay = _meets_floor(way, speed, pull[axis], scene, now, found[0])
                if delay < found[0]:
                    found = (delay, k, axis, floor_at(scene, now + delay)[1])
    return found


def _reaches(way: float, speed: float, pull: float) -> float:
    """How long until a distance, which changes at a speed that changes at `pull`, is zero and falls."""
    way = max(way, 0.0)
    if pull == 0:
        return way / -speed if speed < 0 else math.inf
    if speed**2 < 2 * pull * way:
        return math.inf
    root = math.sqrt(speed**2 - 2 * pull * way)
    if pull > 0 and speed >= 0:
        return math.inf
    return 2 * way / (root - speed) if speed < 0 else (-speed - root) / pull


def floor_at(scene: Scene, time: float) -> tuple[float, float]:
    """Height (m) and velocity (m/s) of the floor at a time (s)."""
    a, f = scene.floor_amplitude, scene.floor_frequency
    if scene.floor == "harmonic":
        return a * (1 - math.cos(2 * math.pi * f * time)), 2 * math.pi * f * a * math.sin(2 * math.pi * f * time)
    return 2 * a * (f * time % 1.0), 2 * a * f


def _meets_floor(way: float, speed: float, pull: float, scene: Scene, now: float, longest: float) -> float:
    """The first sign change of the distance to the floor, looked for in small steps."""

    def distance(t: float) -> float:
        return way + t * (speed + pull * t / 2) - floor_at(scene, now + t)[0]

    if speed >= 0 and pull == 0 and way > 2 * scene.floor_amplitude:
        return math.inf
    whole = math.floor(now * scene.floor_frequency)
    jumps = (np.arange(whole + 1, whole + 61) / scene.floor_frequency - now) * (1 - 1e-13)  # looks just before a sawtooth drops
    looks = np.sort(np.concatenate([np.arange(1, 60 * LOOKS) / (scene.floor_frequency * LOOKS), jumps]))
    t, before = 0.0, distance(0.0)
    if before <= JUST_NOW * scene.diameter and speed < floor_at(scene, now)[1]:
        return 0.0
    for look in looks:
        after = distance(look)
        if after < 0 and (before > 0 or t > 0):
            return brentq(distance, t, look, xtol=1e-16, rtol=1e-15)
        if after < 0:  # it has just left the floor, and is back before the first look
            middle = look
            while distance(middle) < 0 and middle > 1e-12:
                middle /= 2
            return brentq(distance, middle, 2 * middle, xtol=1e-16, rtol=1e-15)
        if look > longest:
            break
        t, before = look, after
    return math.inf

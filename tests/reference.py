"""Hard beads, disks and spheres by brute force: every pair at every step, no cells, no calendar, no memory but clocks."""

from dataclasses import dataclass
from itertools import product

import numpy as np

from granugas.dynamics.state import State

IN_TOUCH = 1.0e-11
"""Two disks so near (d) ..."""

AT_REST = 1.0e-9
"""... that approach with less than this part of their relative velocity have just collided; the rest is rounding."""

RESOLVED = 3.0e-8
"""Where partners come towards each other by less than this (d) between two collisions, rounding decides what follows.

The square of it is what they may still be in touch with whom they hit before: in a small box another image of the same disk.
"""


@dataclass
class Stretch:
    """Collisions one after the other, and how the disks fly after the last.

    Attributes:
        time: (C,), in s since the start of the stretch.
        pair: (C, 2), i < j.
        approach: (C,), in d: how far the partners came towards each other since one of them collided last.
        elastic: (C,), whether that was within t_c.
        velocity: (N, D), in m/s.
        last_collision_time: (N,), in s.
        spin: (N,) or (N, 3), in 1/s.
    """

    time: np.ndarray
    pair: np.ndarray
    approach: np.ndarray
    elastic: np.ndarray
    velocity: np.ndarray
    last_collision_time: np.ndarray
    spin: np.ndarray


def follow(state: State, diameter: float, restitution: float, contact_time: float, collisions: int, rough=None) -> Stretch:
    """The next collisions of a state, up to the first that comes too soon to be resolved, which is still in.

    The disks have the diameters and masses of the state, where it has them.
    rough: beta and mu of surfaces that rub (`rub`), of equal disks.
    """
    box = np.array(state.box)
    x, v, last = state.position.copy(), state.velocity.copy(), state.last_collision_time - state.time
    spin = state.more.get("spin", np.zeros(len(x))).copy()
    pairs = np.triu_indices(len(x), 1)
    d, mass = state.more.get("diameter", np.full(len(x), diameter)), state.more.get("mass", np.ones(len(x)))
    contact = (d[pairs[0]] + d[pairs[1]]) / 2
    now, seen = 0.0, []
    while len(seen) < collisions:
        delay, i, j, normal = first_contact(x, v, pairs, box, contact)
        now, x = now + delay, (x + v * delay) % box
        if i == j:  # nobody, within reach of the images
            continue
        since = now - max(last[i], last[j])
        elastic = since <= contact_time  # A Eq. 4
        r = 1.0 if elastic else restitution
        u_n = (v[j] - v[i]) @ normal
        if rough and not elastic:
            rub(v, spin, i, j, normal, (1 + r) / 2 * abs(u_n), diameter / 2, *rough)
        v[i] += (1 + r) * u_n * mass[j] / (mass[i] + mass[j]) * normal  # A Eq. 2
        v[j] -= (1 + r) * u_n * mass[i] / (mass[i] + mass[j]) * normal
        last[i] = last[j] = now
        seen.append((now, (i, j), -u_n * since / diameter, elastic))
        if seen[-1][2] < RESOLVED:
            break
    return Stretch(*(np.array(column) for column in zip(*seen, strict=True)), v, last + state.time, spin)


def rub(v, spin, i, j, normal, pushed, radius, beta, mu):
    """Rough surfaces of two disks or spheres of mass 1, `pushed` being the normal momentum: both turn, and move sideways.

    The relative velocity g of the surfaces becomes -beta g, unless this takes more momentum than mu times `pushed`.
    """
    in_plane, n = v.shape[1] == 2, np.zeros(3)
    inertia = radius**2 * (1 / 2 if in_plane else 2 / 5)
    n[: v.shape[1]], g, turning = normal, np.zeros(3), np.zeros(3)
    g[: v.shape[1]] = v[j] - v[i]
    turning[2 if in_plane else slice(None)] = spin[i] + spin[j]
    g -= radius * np.cross(turning, n)
    g -= (g @ n) * n
    momentum = (1 + beta) * g / (2 + 2 * radius**2 / inertia)  # 1/m of two partners, radius^2/I of two
    size = np.linalg.norm(momentum)
    momentum *= min(1.0, mu * pushed / size) if size > 0 else 1.0
    v[i] += momentum[: v.shape[1]]
    v[j] -= momentum[: v.shape[1]]
    turn = radius * np.cross(n, momentum) / inertia
    spin[i] += turn[2] if in_plane else turn
    spin[j] += turn[2] if in_plane else turn


def first_contact(
    x: np.ndarray, v: np.ndarray, pairs: tuple[np.ndarray, np.ndarray], box: np.ndarray, d: np.ndarray
) -> tuple[float, int, int, np.ndarray]:
    """The earliest |r + u t| = d of all pairs, d for each: the delay, i and j, and the unit vector from i to j at the contact.

    In a large box a pair meets in its nearest image, as long as it moves by less than L/2 - d before; in a small box in that
    or one beside it, as long as it moves by less than L/2. Where nobody meets in so short a time: that time, and i = j.
    """
    large = box.min() > 4 * d.max()
    images = np.array([*product([0] if large else [-1, 0, 1], repeat=len(box))], float)
    reach = (box.min() / 2 - d.max() * large) / (2 * np.linalg.norm(v, axis=1).max())
    i, j = pairs
    r, u = x[j] - x[i], v[j] - v[i]
    r = (r - box * np.round(r / box)) + (images * box)[:, np.newaxis, :]
    r_u, u_u, gap = np.sum(r * u, axis=-1), np.sum(u * u, axis=-1), np.sum(r * r, axis=-1) - d * d
    root = r_u * r_u - u_u * gap
    meets = (r_u < 0) & (root > 0) & ((gap > 2 * IN_TOUCH * d * d) | (r_u * r_u > u_u * (AT_REST * d) ** 2))
    delay = np.full(root.shape, np.inf)
    delay[meets] = np.maximum(gap[meets], 0) / (np.sqrt(root[meets]) - r_u[meets])
    image, k = np.unravel_index(np.argmin(delay), delay.shape)
    first = delay[image, k]
    if first > reach:
        return reach, 0, 0, np.zeros(len(box))
    normal = r[image, k] + u[k] * first
    return first, i[k], j[k], normal / np.linalg.norm(normal)

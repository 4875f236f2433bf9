"""Hard disks by brute force: every pair in every image at every step, no cells, no calendar, nothing remembered but clocks."""

from dataclasses import dataclass

import numpy as np

from granugas.dynamics.state import State

IMAGES = np.array([(x, y) for x in (-1, 0, 1) for y in (-1, 0, 1)], float)
"""Of a partner, in boxes: enough for a pair that moves by less than half a box relative to each other."""

IN_TOUCH = 1.0e-11
"""Two disks so near (d) ..."""

AT_REST = 1.0e-9
"""... that approach with less than this part of their relative velocity have just collided; the rest is rounding."""


@dataclass
class Stretch:
    """Collisions one after the other, and how the disks fly after the last.

    Attributes:
        time: (C,), in s since the start of the stretch.
        pair: (C, 2), i < j.
        since: (C,), in s, since the last collision of the partner that collided last.
        approach: (C,), in d: how far the partners came towards each other in that time.
        elastic: (C,), whether that time is within t_c.
        velocity: (N, 2), in m/s.
        last_collision_time: (N,), in s.
    """

    time: np.ndarray
    pair: np.ndarray
    since: np.ndarray
    approach: np.ndarray
    elastic: np.ndarray
    velocity: np.ndarray
    last_collision_time: np.ndarray


def follow(state: State, diameter: float, restitution: float, contact_time: float, collisions: int) -> Stretch:
    """The next collisions of a state; fewer where all disks have come to rest."""
    box = np.array(state.box)
    x, v, last = state.position.copy(), state.velocity.copy(), state.last_collision_time - state.time
    now, seen = 0.0, []
    while len(seen) < collisions and (fastest := np.max(np.linalg.norm(v - v.mean(axis=0), axis=1))) > 0:
        reach = box.min() / 2 / (2 * fastest)
        delay, i, j, normal = first_contact(x, v, box, diameter)
        now, x = now + min(delay, reach), x + v * min(delay, reach)
        if delay > reach:
            continue
        since = now - max(last[i], last[j])
        elastic = since <= contact_time  # A Eq. 4
        r = 1.0 if elastic else restitution
        u_n = (v[j] - v[i]) @ normal
        v[i] += (1 + r) / 2 * u_n * normal  # A Eq. 2
        v[j] -= (1 + r) / 2 * u_n * normal
        last[i] = last[j] = now
        seen.append((now, (i, j), since, -u_n * since / diameter, elastic))
    columns = [np.array(column) for column in zip(*seen, strict=True)]
    return Stretch(*columns, v, last + state.time)


def first_contact(
    x: np.ndarray, v: np.ndarray, box: np.ndarray, diameter: float
) -> tuple[float, int, int, np.ndarray]:
    """The earliest |r + u t| = d of all pairs: the delay, i and j, and the unit vector from i to j at the contact."""
    i, j = np.triu_indices(len(x), 1)
    r = x[j] - x[i]
    r = (r - box * np.round(r / box))[:, None, :] + IMAGES * box
    u = (v[j] - v[i])[:, None, :]
    r_u, u_u = (r * u).sum(axis=-1), (u * u).sum(axis=-1)
    gap = (r * r).sum(axis=-1) - diameter**2
    root = r_u**2 - u_u * gap
    meets = (r_u < 0) & (root > 0)
    meets &= (gap > 2 * IN_TOUCH * diameter**2) | (r_u**2 > u_u * (AT_REST * diameter) ** 2)
    delay = np.full(root.shape, np.inf)
    delay[meets] = np.maximum(gap[meets], 0) / (np.sqrt(root[meets]) - r_u[meets])
    pair, image = np.unravel_index(np.argmin(delay), delay.shape)
    first = delay[pair, image]
    normal = r[pair, image] + u[pair, 0] * first if np.isfinite(first) else np.full(2, np.nan)
    return float(first), int(i[pair]), int(j[pair]), normal / np.linalg.norm(normal)

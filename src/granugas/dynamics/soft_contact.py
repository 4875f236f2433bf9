"""Soft contacts: the linear spring with a dashpot, integrated in small steps (A sections 4 and 4.2.2).

One coordinate is enough: the gap h between two particles in one dimension, or the height of one above a plate; they touch
where h < 0, with the overlap -h. Forces are per mass: the reduced mass m_12 of two particles, m of one on a plate.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from granugas.scene import Scene

Numbers = NDArray[np.float64]

BISECTIONS = 50
"""Of a step in which a contact begins or ends: to the last bit."""


class Spring(NamedTuple):
    """k/m_12 (1/s^2) and gamma/m_12 (1/s) of the force -k h - gamma dh/dt."""

    stiffness: float
    damping: float


class Path(NamedTuple):
    """Times (s), gaps h (m) and their velocities (m/s), (n,) each; contacts begin and end where h = 0."""

    time: Numbers
    h: Numbers
    v: Numbers


def spring(contact_time: float, restitution: float) -> Spring:
    """The spring of a contact that lasts t_c (s) and leaves r of the velocity: omega = pi/t_c, eta = -ln(r)/t_c.

    k/m_12 = omega^2 + eta^2, gamma/m_12 = 2 eta. A contact lasts until h = 0 again, also where the dashpot pulls.

    Raises:
        ValueError: t_c <= 0, or r outside (0, 1].
    """
    if not (contact_time > 0 and 0 < restitution <= 1):
        raise ValueError(f"t_c = {contact_time} s, r = {restitution}: allowed are t_c > 0 and 0 < r <= 1")
    omega, eta = math.pi / contact_time, -math.log(restitution) / contact_time
    return Spring(omega**2 + eta**2, 2 * eta)


def wall_contact_time(scene: Scene) -> float:
    """How long a soft particle touches a wall (s): as long as another one, unless its scene says so."""
    return scene.wall_contact_time or scene.contact_time


def step_of(scene: Scene) -> float:
    """dt of soft spheres (s): of the shorter of the contacts with particles and with walls."""
    return min(scene.contact_time, wall_contact_time(scene)) / scene.steps_per_contact


def integrate(spring: Spring, h: float, v: float, until: float, step: float, g: float = 0.0) -> Path:
    """Follow the gap from time 0 on, by Runge and Kutta's method of fourth order.

    Args:
        spring: of the contact.
        h: gap at time 0 (m).
        v: its velocity (m/s).
        until: end (s).
        step: of time (s). A step in which a contact begins or ends is cut there, so no step sees a jump of the force.
        g: gravity that closes the gap (m/s^2).
    """
    time, touching = 0.0, h < 0 or (h == 0 and v < 0)
    rows = [(time, h, v)]
    while time < until:
        dt = min(step, until - time)
        new = _step(spring, h, v, dt, g, touching)
        if (new[0] < 0) != touching:
            dt = _until_change(spring, h, v, dt, g, touching)
            new = 0.0, _step(spring, h, v, dt, g, touching)[1]
            touching = not touching
        time, (h, v) = time + dt, new
        rows.append((time, h, v))
    return Path(*np.array(rows).T)


def contacts(path: Path) -> tuple[Numbers, Numbers]:
    """When the contacts of a path that starts apart begin, and when they end (s); the last one may have no end."""
    changes = path.time[path.h == 0]
    return changes[::2], changes[1::2]


def _step(spring: Spring, h: float, v: float, dt: float, g: float, touching: bool) -> tuple[float, float]:
    """h and v a step later, with or without the contact force throughout."""
    stiffness, damping = spring if touching else (0.0, 0.0)
    a1 = -g - stiffness * h - damping * v
    v2 = v + dt / 2 * a1
    a2 = -g - stiffness * (h + dt / 2 * v) - damping * v2
    v3 = v + dt / 2 * a2
    a3 = -g - stiffness * (h + dt / 2 * v2) - damping * v3
    v4 = v + dt * a3
    a4 = -g - stiffness * (h + dt * v3) - damping * v4
    return h + dt / 6 * (v + 2 * v2 + 2 * v3 + v4), v + dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4)


def _until_change(spring: Spring, h: float, v: float, dt: float, g: float, touching: bool) -> float:
    """Time within a step at which the contact begins or ends."""
    low, high = 0.0, dt
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        changed = (_step(spring, h, v, middle, g, touching)[0] < 0) != touching
        low, high = (low, middle) if changed else (middle, high)
    return high

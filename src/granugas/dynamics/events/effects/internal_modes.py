"""Particles that ring: n modes each take up what a collision does not give back, and may give it back later (A section 3.iii).

The modes oscillate many times between two collisions, so that each has a random phase when it takes part in one. Let z_0 be
an amplitude with |z_0|^2 the energy of the normal relative motion, z_k those of the 2 n modes of both partners. A collision
reflects the vector of them, which keeps the sum of the |z|^2: z' = z - 2 v (v . z), |v| = 1, with

    v_0^2 = (1 + r)/2,    v_k^2 = (1 - r)/(4 n),

r from what decides otherwise. Partners whose modes are at rest collide with exactly this r, as z_0' = -r z_0; at r = 1 modes
take no part. In equilibrium, without damping, each mode has on average the energy kT of an oscillator, as the normal motion
has in a collision. Between collisions the energy of the modes falls as exp(-gamma t): only then does the model dissipate.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from granugas.dynamics.events.collisions import lose, lossless, restitution, store
from granugas.dynamics.events.composition import implements, inline
from granugas.dynamics.events.memory import Record, Table
from granugas.dynamics.events.randomness import stream, symmetric
from granugas.dynamics.events.sizes import reduced_mass
from granugas.dynamics.state import State
from granugas.scene import Scene

MODES = np.dtype([("x", "f8"), ("y", "f8")])
"""Amplitude of each mode, as a complex number (the root of m d^2/s^2); n in a row for each particle."""

RANG = np.dtype([("time", "f8")])
"""When the modes of each particle had these amplitudes (s)."""


class InternalModes(NamedTuple):
    """What decides the coefficient at rest; n modes a particle; gamma (1/s); the modes, and the random numbers."""

    otherwise: Any
    n: int
    damping: float
    modes: Table
    rang: Table
    stream: Record

    def observe(self, scene: Scene, state: State, tally: Any, interval: float) -> dict[str, float]:
        """The energy of all modes by E(0)."""
        e_0 = scene.n_particles * scene.energy_per_mass
        return {"internal_energy": float(self.energies(state.time).sum()) * scene.diameter**2 / e_0}

    def energies(self, time: float) -> np.ndarray:
        """(N, n) at a time in s (m d^2/s^2)."""
        then = (self.modes.rows["x"] ** 2 + self.modes.rows["y"] ** 2).reshape(-1, self.n)
        return then * np.exp(-self.damping * (time - self.rang.rows["time"]))[:, np.newaxis]


def effect_of(scene: Scene, state: State, otherwise: Any) -> InternalModes:
    """The rule of a scene; all modes are at rest."""
    particles, n = len(state.position), scene.internal_modes
    rang = np.zeros(particles, RANG)
    rang["time"] = state.time
    modes = Table(np.zeros(n * particles, MODES))
    return InternalModes(otherwise, n, float(scene.mode_damping), modes, Table(rang), stream(state, "internal_modes"))


@implements(lossless, InternalModes)
def _suspends(rule, gas, i, j, u_n, since):
    return lossless(rule.otherwise, gas, i, j, u_n, since)


@implements(restitution, InternalModes)
def _internal_modes(rule, gas, i, j, u_n, since):
    r = restitution(rule.otherwise, gas, i, j, u_n, since)
    if r == 1.0 or u_n == 0.0:
        return r
    x_i, y_i = _ring(rule, gas, i)
    x_j, y_j = _ring(rule, gas, j)
    v_0, v_k = math.sqrt(0.5 * (1.0 + r)), math.sqrt(0.25 * (1.0 - r) / rule.n)
    z = math.sqrt(0.5 * reduced_mass(gas.sizes, i, j)) * abs(u_n)
    x, y = v_0 * z + v_k * (x_i + x_j), v_k * (y_i + y_j)  # v . z
    _reflect(rule, i, 2.0 * v_k * x, 2.0 * v_k * y)
    _reflect(rule, j, 2.0 * v_k * x, 2.0 * v_k * y)
    x, y = z - 2.0 * v_0 * x, 2.0 * v_0 * y
    _keep(gas, z * z - (x * x + y * y), gas.disks.t[i])
    return math.sqrt(x * x + y * y) / z


@inline
def _keep(gas, energy, now):
    """Energy that goes over into modes is not lost, as it will be counted to be; what they lose by damping is."""
    lose(gas.tally, -energy, now)
    store(gas.tally, energy, now)


@inline
def _ring(rule, gas, i):
    """Let the modes of i ring until now: their amplitudes fall, their phases are anything. Returns the sum of them."""
    modes, now = rule.modes, gas.disks.t[i]  # it has just been placed
    time = gas.calendar.base + now
    left = math.exp(-0.5 * rule.damping * (time - rule.rang.time[i]))
    rule.rang.time[i] = time
    sum_x, sum_y, lost = 0.0, 0.0, 0.0
    for k in range(i * rule.n, (i + 1) * rule.n):
        a, b = _direction(rule)
        x, y = left * modes.x[k], left * modes.y[k]
        lost += (1.0 - left * left) * (modes.x[k] * modes.x[k] + modes.y[k] * modes.y[k])
        modes.x[k], modes.y[k] = a * x - b * y, a * y + b * x
        sum_x += modes.x[k]
        sum_y += modes.y[k]
    _keep(gas, -lost, now)
    return sum_x, sum_y


@inline
def _direction(rule):
    """A unit vector of any direction: of twice the angle of a point in the circle, which needs no root."""
    q = 2.0
    while q > 1.0 or q == 0.0:
        a, b = symmetric(rule.stream), symmetric(rule.stream)
        q = a * a + b * b
    return (a * a - b * b) / q, 2.0 * a * b / q


@inline
def _reflect(rule, i, x, y):
    for k in range(i * rule.n, (i + 1) * rule.n):
        rule.modes.x[k] -= x
        rule.modes.y[k] -= y

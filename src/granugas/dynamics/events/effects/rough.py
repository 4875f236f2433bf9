"""Rough particles: the surfaces rub, and spins take part in the exchange of momentum and energy.

The tangential relative velocity of the surfaces in contact changes from g_t to -beta g_t (Huthmann & Zippelius, Phys. Rev. E
56 (1997) R6275; Luding, Huthmann, McNamara & Zippelius, Phys. Rev. E 58 (1998) 3416), as far as the tangential momentum that
this takes is no more than mu times the normal one (Coulomb): surfaces stick up to there, and slide beyond.
"""

import math
from typing import NamedTuple

import numpy as np

from granugas.dynamics.events.collisions import lose, lossless, pass_on, push, rub, store
from granugas.dynamics.events.composition import implements
from granugas.dynamics.events.memory import Table, allocate
from granugas.dynamics.events.sizes import radius, reach, reduced_mass, shares
from granugas.dynamics.events.vectors import along, cross, dot, minus, scaled, torque
from granugas.dynamics.state import State
from granugas.geometry import INERTIA, ROTATIONS
from granugas.scene import Scene


class Rough(NamedTuple):
    """A table of spins, as vectors (1/s).

    Attributes:
        spins: one row a particle, of the component out of the plane, or of three.
        grip: q (1 + beta) / (1 + q), the part of g_t that passes from one partner to the other where surfaces stick.
        inertia: q.
        friction: mu, infinite without a limit.
        energy: of translation, at the start (m^2/s^2, times mass).
    """

    spins: Table
    grip: float
    inertia: float
    friction: float
    energy: float

    def of_particles(self, scene: Scene) -> dict[str, np.ndarray]:
        """The spins (N,) in 2D, (N, 3) in 3D, in 1/s."""
        spin = self.spins.rows["w"].copy()
        return {"spin": spin[:, 0] if spin.shape[1] == 1 else spin}

    def observe(self, scene: Scene, state: State, tally: object, interval: float) -> dict[str, float]:
        """E_rot / E(0), and R = T_rot / T_tr, both temperatures for one degree of freedom."""
        moment = self.inertia * _mass(state) * (_diameter(scene, state) / 2) ** 2
        rotation = 0.5 * float(np.sum(moment * np.sum(self.spins.rows["w"] ** 2, axis=1)))
        ratio = rotation / _translation(state) * scene.dimensions / ROTATIONS[scene.dimensions]
        return {"rotational_energy": rotation / self.energy, "temperature_ratio": ratio}


def effect_of(scene: Scene, state: State) -> Rough:
    """The surfaces of a scene; spins are those of the state, zero where it has none."""
    q, axes = INERTIA[scene.dimensions], ROTATIONS[scene.dimensions]
    rows = allocate(len(state.position), np.dtype([("w", "f8", (axes,))]))
    if "spin" in state.more:
        rows["w"] = state.more["spin"].reshape(-1, axes)
    grip = q * (1 + scene.tangential_restitution) / (1 + q)
    return Rough(Table(rows), grip, q, float(scene.friction), _translation(state))


@implements(rub, Rough)
def _rough(surface, gas, i, j, n, u, dv_n, since, now):
    if lossless(gas.rule, gas, i, j, dot(u, n), since):
        return
    sizes, tally, w, q = gas.sizes, gas.tally, surface.spins.w, surface.inertia
    a_i, a_j = radius(sizes, i), radius(sizes, j)
    slip = minus(u, cross(along(scaled(w[i], a_i), a_j, w[j]), n))
    slip = along(slip, -dot(slip, n), n)
    change = scaled(slip, surface.grip)
    limit, size_2 = surface.friction * dv_n, dot(change, change)
    if size_2 > limit * limit:  # never where mu is infinite
        change = scaled(change, abs(limit) / math.sqrt(size_2))
        size_2 = dot(change, change)
    push(gas, i, j, 1.0, change)
    (share_i, share_j), turn = shares(sizes, i, j), torque(n, change)
    w[i] = along(w[i], share_i / (q * a_i), turn)
    w[j] = along(w[j], share_j / (q * a_j), turn)
    m = reduced_mass(sizes, i, j)
    loss = m * (dot(slip, change) - 0.5 * (1.0 + 1.0 / q) * size_2)
    lose(tally, loss, now)
    store(tally, m * (dot(u, change) - 0.5 * size_2) - loss, now)
    pass_on(n, tally, scaled(change, m), reach(sizes, i, j))


def _mass(state: State) -> np.ndarray | float:
    return state.more.get("mass", 1.0)


def _diameter(scene: Scene, state: State) -> np.ndarray | float:
    return state.more.get("diameter", scene.diameter)


def _translation(state: State) -> float:
    return 0.5 * float(np.sum(_mass(state) * np.sum(state.velocity**2, axis=1)))

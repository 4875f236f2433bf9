"""Observables of one instant from the arrays of the particles; all masses are equal where none are given."""

from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Numbers = NDArray[np.float64]


def kinetic_energy(velocity: Numbers, mass: Numbers | None = None) -> Numbers:
    """(dim,) kinetic energies E_x/m, E_y/m of the motion along each axis in (m/s)^2.

    Args:
        velocity: (n, dim) in m/s.
        mass: (n,) in units of m.
    """
    if mass is None:
        return 0.5 * np.einsum("ia,ia->a", velocity, velocity)
    return 0.5 * np.einsum("i,ia,ia->a", mass, velocity, velocity)


def species_temperature_ratio(velocity: Numbers, mass: Numbers) -> float:
    """Mean kinetic energy of particles above the mean mass, by that of the others; NaN where all masses are equal.

    Of bidisperse particles: T_large / T_small. Arguments as in `kinetic_energy`; the mean velocity must have been removed.
    """
    heavy = mass > mass.mean()
    if not heavy.any():
        return float("nan")
    energy = mass * np.einsum("ia,ia->i", velocity, velocity)
    return float(energy[heavy].mean() / energy[~heavy].mean())


def velocity_kurtosis(velocity: Numbers) -> Numbers:
    """(dim,) <v^4> / <v^2>^2 of the velocity components: 3 if they are Maxwellian, 9/5 if uniform.

    The mean velocity must have been removed.
    """
    squares = velocity * velocity
    return np.mean(squares * squares, axis=0) / np.mean(squares, axis=0) ** 2


def anisotropy(velocity: Numbers) -> float:
    """(K_x - K_y) / K (B Fig. 1d), between -1 and 1 and 0 if no direction is preferred, from velocities (n, dim) in m/s.

    In three dimensions the largest such difference of two axes, in one 0.
    """
    along = kinetic_energy(velocity)
    differences = (a - b for a, b in combinations(along, 2))
    return float(max(differences, key=abs, default=0.0) / along.sum())


def elastic_particle_fraction(last_collision_time: Numbers, time: float, contact_time: ArrayLike) -> Numbers:
    """n_e = N_e/N, the share of particles that had a collision no longer than t_c ago (A section 5.4).

    Particles that collide at this very moment are left out: a sample taken at a collision, as those counted by collisions
    are, would always find its two partners elastic, 2/N too much however short t_c is.

    Args:
        last_collision_time: (n,) in s, -inf for a particle that never collided.
        time: now, in s.
        contact_time: t_c in s, one or several; the result has its shape. With t_c = 0 nobody is elastic.
    """
    others = ~_colliding(last_collision_time, time)
    return np.sum(_elastic(last_collision_time, time, contact_time) & others, axis=-1) / max(others.sum(), 1)


def elastic_energy_fraction(
    velocity: Numbers, last_collision_time: Numbers, time: float, contact_time: ArrayLike, mass: Numbers | None = None
) -> Numbers:
    """e_e = E_e/E, the share of the kinetic energy that elastic particles carry (A section 5.4).

    Arguments as in `elastic_particle_fraction`, velocities (n, dim) in m/s, masses (n,) where they differ.
    """
    each = np.einsum("ia,ia->i", velocity, velocity) * (1.0 if mass is None else mass)
    energy = np.where(_colliding(last_collision_time, time), 0.0, each)
    return _elastic(last_collision_time, time, contact_time) @ energy / (energy.sum() or 1.0)


def _elastic(last_collision_time: Numbers, time: float, contact_time: ArrayLike) -> NDArray[np.bool_]:
    t_c = np.asarray(contact_time, dtype=float)[..., np.newaxis]
    return (time - last_collision_time <= t_c) & (t_c > 0)


def _colliding(last_collision_time: Numbers, time: float) -> NDArray[np.bool_]:
    return time - last_collision_time <= 4 * np.spacing(time)  # both are sums that may round differently

"""Particles of different sizes and masses."""

from typing import NamedTuple

import numpy as np

from granugas.diameters import largest
from granugas.dynamics.events.composition import implements
from granugas.dynamics.events.memory import Table, allocate
from granugas.dynamics.events.sizes import mass, radius, reach, reduced_mass, resize, shares
from granugas.dynamics.state import State
from granugas.scene import Scene

PARTICLES = np.dtype([("radius", "f8"), ("mass", "f8")])
"""In d and in mean masses."""


class Unequal(NamedTuple):
    """A table of PARTICLES, and the largest diameter that one of them has, or will have when all are grown (d)."""

    particles: Table
    largest: float

    def of_particles(self, scene: Scene) -> dict[str, np.ndarray]:
        """Diameters in m, masses in mean ones."""
        rows = self.particles.rows
        return {"diameter": 2 * rows["radius"] * scene.diameter, "mass": rows["mass"].copy()}


def effect_of(scene: Scene, state: State) -> Unequal:
    """The particles of a state that has their diameters and masses."""
    rows = allocate(len(state.position), PARTICLES)
    rows["radius"], rows["mass"] = state.more["diameter"] / scene.diameter / 2, state.more["mass"]
    return Unequal(Table(rows), max(largest(scene), 2 * float(rows["radius"].max())))


@implements(reach, Unequal)
def _reach(sizes, i, j):
    return sizes.particles.radius[i] + sizes.particles.radius[j]


@implements(radius, Unequal)
def _radius(sizes, i):
    return sizes.particles.radius[i]


@implements(resize, Unequal)
def _resize(sizes, i, radius):
    sizes.particles.radius[i] = radius


@implements(mass, Unequal)
def _mass(sizes, i):
    return sizes.particles.mass[i]


@implements(reduced_mass, Unequal)
def _reduced_mass(sizes, i, j):
    m_i, m_j = sizes.particles.mass[i], sizes.particles.mass[j]
    return m_i * m_j / (m_i + m_j)


@implements(shares, Unequal)
def _shares(sizes, i, j):
    m_i, m_j = sizes.particles.mass[i], sizes.particles.mass[j]
    return m_j / (m_i + m_j), m_i / (m_i + m_j)

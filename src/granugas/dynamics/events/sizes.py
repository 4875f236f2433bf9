"""How large and heavy the particles are. Without an effect that says otherwise: all of diameter 1 and mass 1."""

from typing import NamedTuple

from granugas.dynamics.events.composition import generic, implements


class Equal(NamedTuple):
    """Particles of one size."""

    largest = 1.0


@generic
def reach(sizes, i, j):
    """Distance of the centres of i and j in contact, the sum of their radii (d)."""


@generic
def radius(sizes, i):
    """Of particle i (d)."""


@generic
def mass(sizes, i):
    """Of particle i (m)."""


@generic
def reduced_mass(sizes, i, j):
    """m_i m_j / (m_i + m_j) (m)."""


@generic
def shares(sizes, i, j):
    """Shares of i and j in a change of their relative velocity: reduced mass by mass."""


@generic
def resize(sizes, i, radius):
    """Let particle i have another radius (d)."""


@implements(reach, Equal)
def _reach(sizes, i, j):
    return 1.0


@implements(radius, Equal)
def _radius(sizes, i):
    return 0.5


@implements(mass, Equal)
def _mass(sizes, i):
    return 1.0


@implements(reduced_mass, Equal)
def _reduced_mass(sizes, i, j):
    return 0.5


@implements(shares, Equal)
def _shares(sizes, i, j):
    return 0.5, 0.5

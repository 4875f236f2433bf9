"""The stress tensor of test volumes (A Eqs. 14 and 15), pressure positive; masses are equal, and stress is by that mass.

A test volume V_c is a rectangle of the periodic box. It takes the particles whose centres and the collisions whose points of
contact lie in it. The kinetic part is that of the velocities relative to the mean velocity of the particles in V_c; what the
mean velocity carries stands apart as streaming, which a larger volume takes for kinetic stress.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Numbers = NDArray[np.float64]


class Volumes(NamedTuple):
    """The box cut into columns and rows of equal rectangles, numbered row by row.

    Attributes:
        box: (Lx, Ly) in m.
        columns, rows: how many of them.
    """

    box: tuple[float, float]
    columns: int
    rows: int

    @property
    def count(self) -> int:
        """How many volumes there are."""
        return self.columns * self.rows

    @property
    def area(self) -> float:
        """V_c of each of them in m^2."""
        return self.box[0] * self.box[1] / self.count

    def of(self, place: ArrayLike) -> NDArray[np.int64]:
        """Numbers (n,) of the volumes in which places (n, 2) in m lie, periodic images included."""
        shape = np.array([self.columns, self.rows])
        column, row = np.floor(np.asarray(place) / self.box * shape).astype(np.int64).T % shape[:, np.newaxis]
        return row * self.columns + column


def kinetic_stress(volumes: Volumes, position: ArrayLike, velocity: ArrayLike) -> tuple[Numbers, Numbers]:
    """Kinetic and streaming stress of each volume, 1/V_c sum of v_a v_b (A Eq. 14), in s^-2.

    Args:
        volumes: count of them = m.
        position: (n, 2) in m.
        velocity: (n, 2) in m/s.

    Returns:
        kinetic: (m, 2, 2), of the velocities relative to the mean one of the volume.
        streaming: (m, 2, 2), of the mean velocity; both are 0 where no particle is.
    """
    velocity, inside = np.asarray(velocity), volumes.of(position)
    number = np.bincount(inside, minlength=volumes.count)
    momentum = _sums(velocity, inside, volumes.count)
    mean = momentum / np.maximum(number, 1)[:, np.newaxis]
    relative = velocity - mean[inside]
    kinetic = _sums(relative[:, :, np.newaxis] * relative[:, np.newaxis], inside, volumes.count)
    streaming = momentum[:, :, np.newaxis] * mean[:, np.newaxis]
    return kinetic / volumes.area, streaming / volumes.area


def collisional_stress(
    volumes: Volumes, contact: ArrayLike, normal: ArrayLike, momentum: ArrayLike, diameter: float, interval: float
) -> Numbers:
    """Collisional stress (m, 2, 2) of each volume, -1/(V_c dt) sum of dp_a l_b over both partners (A Eq. 15), in s^-2.

    Args:
        volumes: count of them = m.
        contact: (n, 2), points of contact in m.
        normal: (n, 2), unit vectors from the one partner to the other; l = +-(d/2) n from the centres to the contact.
        momentum: (n,), what the one gains along the normal and the other loses, by mass, in m/s: negative.
        diameter: d in m.
        interval: dt in s, in which these collisions happened.
    """
    normal = np.asarray(normal)
    carried = np.asarray(momentum)[:, np.newaxis, np.newaxis] * diameter * normal[:, :, np.newaxis] * normal[:, np.newaxis]
    return -_sums(carried, volumes.of(contact), volumes.count) / (volumes.area * interval)


def pressure(stress: ArrayLike) -> Numbers:
    """P = (lambda_1 + lambda_2) / 2 (...,) of the eigenvalues of symmetric stress tensors (..., 2, 2) (A section 5.2)."""
    return np.linalg.eigvalsh(stress).mean(axis=-1)


def _sums(values: Numbers, group: NDArray[np.int64], count: int) -> Numbers:
    """(count, ...) sums of values (n, ...) over the members of each group."""
    shape = values.shape[1:]
    columns = values.reshape(len(values), math.prod(shape)).T
    return np.stack([np.bincount(group, column, count) for column in columns], axis=-1).reshape(count, *shape)

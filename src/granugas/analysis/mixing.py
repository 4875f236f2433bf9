"""How the particles of a cluster move against each other (B Fig. 4), and how well those of different origin mix (B Fig. 6)."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from granugas.analysis.structure import cells_of

Numbers = NDArray[np.float64]


def differences_nearby(values: ArrayLike, period: float, positions: ArrayLike, box: ArrayLike, parts: int) -> Numbers:
    """Mean and largest difference of each particle to the others in its cell, of parts x parts cells of a periodic box.

    Args:
        values: (n,) of a periodic quantity, such as the initial height.
        period: of it; differences are at most half of it, and a quarter on average where values are mixed at random.
        positions: (n, 2).
        box: (2,) sides.
        parts: cells along a side.

    Returns:
        (2, n) mean and largest difference in units of `values`; NaN for particles alone in their cell.
    """
    column, row = cells_of(positions, box, parts).T
    cell = column * parts + row
    order = np.argsort(cell, kind="stable")
    cell, value = cell[order], np.asarray(values, dtype=float)[order]
    total, largest, others = np.zeros_like(value), np.zeros_like(value), np.bincount(cell)[cell] - 1
    for step in range(1, others.max() + 1):  # every pair of a cell, once
        first = np.flatnonzero(cell[:-step] == cell[step:])
        second = first + step
        apart = abs(value[first] - value[second]) % period
        apart = np.minimum(apart, period - apart)
        for one in (first, second):
            total[one] += apart
            largest[one] = np.maximum(largest[one], apart)
    with np.errstate(invalid="ignore"):
        found = np.where(others > 0, [total / others, largest], np.nan)
    result = np.empty_like(found)
    result[:, order] = found
    return result


def internal_energy_share(velocity: ArrayLike, positions: ArrayLike, box: ArrayLike) -> float:
    """Share of the kinetic energy of particles that is in no motion of them as a solid body.

    Their mean velocity and the rotation about their centre that fits best are taken away. Particles that lie around the
    whole periodic box have no centre; the share is then too small, if anything.

    Args:
        velocity: (n, 2), not all 0.
        positions: (n, 2) in the unit of the box.
        box: (2,) sides.
    """
    velocity, turns = np.asarray(velocity, dtype=float), np.asarray(positions) / np.asarray(box)
    centre = np.angle(np.exp(2j * np.pi * turns).mean(axis=0)) / (2 * np.pi)
    place = ((turns - centre + 0.5) % 1 - 0.5) * np.asarray(box)
    place, inside = place - place.mean(axis=0), velocity - velocity.mean(axis=0)
    across = np.stack([-place[:, 1], place[:, 0]], axis=1)
    norm = np.square(across).sum()
    rotation = (across * inside).sum() / norm if norm > 0 else 0.0
    return float(np.square(inside - rotation * across).sum() / np.square(velocity).sum())

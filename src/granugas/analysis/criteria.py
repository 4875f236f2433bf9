"""Clusters by relative velocity or collision frequency: the alternatives to the distance that B section 6 names.

Particles are neighbours within a reach; a criterion keeps some of these bonds, and clusters are what is left connected.
"""

from collections.abc import Iterable
from itertools import product

import numpy as np
from numpy.typing import ArrayLike, NDArray

Pairs = NDArray[np.int64]


def neighbours(positions: ArrayLike, box: ArrayLike, reach: float) -> Pairs:
    """Bonds by distance alone (B Eq. 6 for equal diameters, reach = S_c d).

    Args:
        positions: (n, dim) in m, anywhere; their periodic images count.
        box: (dim,) sides of the periodic box in m, or one for all.
        reach: largest distance in m.

    Returns:
        (b, 2) pairs (i, j) of particles with i < j, each once, in no order.

    Raises:
        ValueError: a reach above half a side of the box, where two images of a particle could be neighbours.
    """
    positions = np.asarray(positions, dtype=float)
    n, dim = positions.shape
    box = np.broadcast_to(np.asarray(box, dtype=float), dim)
    if not 0 < reach <= box.min() / 2:
        raise ValueError(f"reach = {reach}: allowed are lengths from 0 to half a side of the box, {box.min() / 2:g} m")
    most = int(np.ceil((4 * n) ** (1 / dim)))
    cells = np.clip(box / (reach * (1 + 1e-9)), 1, most).astype(int)
    inside = positions % box
    place = np.minimum((inside / box * cells).astype(int), cells - 1)
    home = np.ravel_multi_index(tuple(place.T), cells)
    in_order = np.argsort(home, kind="stable")
    start = np.searchsorted(home[in_order], np.arange(cells.prod() + 1))
    bonds = []
    for step in np.unique(np.array(list(product((-1, 0, 1), repeat=dim))) % cells, axis=0):  # fewer where an axis is short
        beside = np.ravel_multi_index(tuple(((place + step) % cells).T), cells)
        first, count = start[beside], start[beside + 1] - start[beside]
        i = np.repeat(np.arange(n), count)
        j = in_order[np.arange(len(i)) + np.repeat(first - np.cumsum(count) + count, count)]
        bonds.append(near(np.column_stack([i, j])[i < j], inside, box, reach))
    return np.concatenate(bonds)


def near(bonds: Pairs, positions: ArrayLike, box: ArrayLike, reach: float) -> Pairs:
    """The bonds (b, 2) of particles no farther apart than `reach`, of their images the nearest; lengths in m."""
    positions = np.asarray(positions, dtype=float)
    apart = positions[bonds[:, 0]] - positions[bonds[:, 1]]
    apart -= np.rint(apart / box) * box
    return bonds[np.einsum("ba,ba->b", apart, apart) <= reach**2]


def slow(bonds: Pairs, velocity: ArrayLike, threshold: float) -> Pairs:
    """The bonds (b, 2) of particles whose relative velocity |v_i - v_j| is at most `threshold`; velocities (n, dim), m/s."""
    velocity = np.asarray(velocity, dtype=float)
    return bonds[np.linalg.norm(velocity[bonds[:, 0]] - velocity[bonds[:, 1]], axis=1) <= threshold]


def busy(bonds: Pairs, frequency: ArrayLike, threshold: float) -> Pairs:
    """The bonds (b, 2) of particles that both collide at least as often as `threshold`; frequencies (n,), 1/s."""
    often = np.asarray(frequency, dtype=float) >= threshold
    return bonds[often[bonds].all(axis=1)]


def connected(n: int, bonds: Pairs) -> NDArray[np.int64]:
    """(n,) the cluster of each of n particles by bonds (b, 2), numbered from 0 in the order of their first particles.

    Every particle hands the lowest number it knows of to its partners, and takes the number of the particle it names.
    """
    i, j = bonds.T
    lowest = np.arange(n)
    while (lowest[i] != lowest[j]).any():
        known = np.minimum(lowest[i], lowest[j])
        for end in (i, j):
            np.minimum.at(lowest, lowest[end], known)
        while (lowest[lowest] != lowest).any():
            lowest = lowest[lowest]
        apart = lowest[i] != lowest[j]
        i, j = i[apart], j[apart]
    return (np.cumsum(lowest == np.arange(n)) - 1)[lowest]


def cluster_sizes(n: int, bonds: Pairs) -> NDArray[np.int64]:
    """(I_c,) numbers of particles M_i of the clusters of n particles that bonds (b, 2) connect."""
    return np.bincount(connected(n, bonds))


def contacts(n: int, bonds: Pairs) -> NDArray[np.int64]:
    """(n,) number of bonds of each particle: 6 for all within 1 <= S_c < sqrt(3) in a close packing of disks."""
    return np.bincount(bonds.ravel(), minlength=n)


def measures(n: int, bonds: Pairs) -> tuple[float, float, float]:
    """<M> = N/I_c, M_w = sum M_i^2 / N and M_max of the clusters of n particles that bonds (b, 2) connect."""
    sizes = cluster_sizes(n, bonds)
    return n / len(sizes), float(np.square(sizes, dtype=float).sum() / n), float(sizes.max())


def compare(
    positions: ArrayLike,
    velocity: ArrayLike,
    frequency: ArrayLike,
    box: ArrayLike,
    contact: float,
    reach: float,
    speeds: Iterable[float],
    rates: Iterable[float],
) -> NDArray[np.float64]:
    """<M>, M_w and M_max of one configuration by all criteria.

    Args:
        positions, velocity, frequency: (n, dim) in m and in m/s, (n,) in 1/s.
        box: (dim,) sides of the periodic box in m.
        contact: S_c d, the distance of particles in contact, in m, at most `reach`.
        reach: distance of neighbours for the other criteria, in m.
        speeds: largest relative velocities in m/s.
        rates: smallest collision frequencies in 1/s.

    Returns:
        (1 + len(speeds) + len(rates), 3): by distance, then by each relative velocity, then by each collision frequency.

    Raises:
        ValueError: a reach above half a side of the box.
    """
    bonds = neighbours(positions, box, reach)
    kept = [near(bonds, positions, box, contact)]
    kept += [slow(bonds, velocity, speed) for speed in speeds]
    kept += [busy(bonds, frequency, rate) for rate in rates]
    return np.array([measures(len(np.asarray(positions)), one) for one in kept])

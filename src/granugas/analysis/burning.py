"""The burning algorithm of B section 5 in continuous space: linked cells, bonds, clusters that grow together.

A line, a plane and space are treated alike: an axis that a system does not have is an open one with a single cell.
"""

import numpy as np

from granugas.digest import use_kernel_cache

use_kernel_cache()

from numba import njit  # noqa: E402  (it reads the folder of its cache when it is imported)

ROWS = np.array([(0, 0), (1, 0), (-1, 1), (0, 1), (1, 1)])
"""Offsets (y, z) to the rows of cells beside one, half of the neighbourhood: every pair of rows is met once."""


@njit(cache=True)
def label_clusters(positions, radii, origin, lengths, periodic, cells, factors):
    """Clusters of B Eq. 6 for every distance factor: bonds are found once, the clusters of a factor grow into the next.

    Args:
        positions: (n, dim) in m, dim <= 3.
        radii: (n,) d_i / 2 in m.
        origin, lengths: (3,) corner and sides of the box (of what holds all centres along an open axis) in m.
        periodic: (3,) bool.
        cells: (3,) cells along each axis, no thinner than the longest bond unless there is only one.
        factors: (k,) S_c, ascending.

    Returns:
        labels (k, n), numbered in the order of first particles; sizes (k, n), the first counts[c] of a row are used;
        counts (k,), the I_c.
    """
    rank, start, disks = sort_into_cells(positions, radii, origin, lengths, periodic, cells)
    parent = np.arange(len(disks)).astype(np.int32)
    bonds, last_bond = join_neighbours(parent, disks, start, lengths, periodic, cells, factors * factors)
    labels = np.empty((len(factors), len(disks)), np.int32)
    sizes = np.zeros((len(factors), len(disks)), np.int32)
    counts = np.zeros(len(factors), np.int64)
    for c in range(len(factors)):
        b = last_bond[c]
        while b >= 0:
            _unite(parent, bonds[b, 0], bonds[b, 1])
            b = bonds[b, 2]
        counts[c] = _number(parent, rank, labels[c], sizes[c])
    return labels, sizes, counts


@njit(cache=True)
def sort_into_cells(positions, radii, origin, lengths, periodic, cells):
    """Counting sort: place of each particle, first place of each cell, and rows (x, y, z, radius) in cell order."""
    n, dim = positions.shape
    home = np.empty(n, np.int32)
    inside = np.empty((n, dim))
    start = np.zeros(cells[0] * cells[1] * cells[2] + 1, np.int32)
    for p in range(n):
        cell = 0
        for a in range(dim - 1, -1, -1):
            x = positions[p, a] - origin[a]
            if periodic[a] and not 0.0 <= x < lengths[a]:
                x %= lengths[a]
            inside[p, a] = x
            cell = cell * cells[a] + min(int(x / lengths[a] * cells[a]), cells[a] - 1)
        home[p] = cell
        start[cell + 1] += 1
    for c in range(1, len(start)):
        start[c] += start[c - 1]

    rank = np.empty(n, np.int32)
    disks = np.zeros((n, 4))
    filled = start.copy()
    for p in range(n):
        q = filled[home[p]]
        filled[home[p]] += 1
        rank[p] = q
        for a in range(dim):
            disks[q, a] = inside[p, a]
        disks[q, 3] = radii[p]
    return rank, start, disks


@njit(cache=True)
def join_neighbours(parent, disks, start, lengths, periodic, cells, squared_factors):
    """Unite what touches at the smallest factor; keep the bonds of the larger ones as linked lists, one a factor.

    Row b of the bonds is (i, j, next bond of the same factor or -1), last_bond[c] the head of the list of factor c.
    """
    nx, ny, nz = cells
    bonds = np.empty((len(disks) + 16, 3), np.int32)
    n_bonds = 0
    last_bond = np.full(len(squared_factors), -1, np.int64)
    for row in range(ny * nz):
        for o in range(len(ROWS)):
            y, shift_y, y_exists = _neighbour(row % ny + ROWS[o, 0], ny, lengths[1], periodic[1])
            z, shift_z, z_exists = _neighbour(row // ny + ROWS[o, 1], nz, lengths[2], periodic[2])
            if not (y_exists and z_exists):
                continue
            home, other = row * nx, (z * ny + y) * nx
            for x in range(nx):
                if start[home + x] == start[home + x + 1]:
                    continue
                for image in range(-1 if o > 0 else 0, 2):
                    low, high = _cells_beside(x, image, nx, periodic[0])
                    first, last = start[other + low], start[other + high]
                    shift_x = image * lengths[0]
                    for i in range(start[home + x], start[home + x + 1]):
                        x_i, y_i, z_i = disks[i, 0] - shift_x, disks[i, 1] - shift_y, disks[i, 2] - shift_z
                        for j in range(i + 1 if o == 0 and image == 0 else first, last):
                            dx, dy, dz = disks[j, 0] - x_i, disks[j, 1] - y_i, disks[j, 2] - z_i
                            squared_distance = dx * dx + dy * dy + dz * dz
                            squared_reach = (disks[i, 3] + disks[j, 3]) ** 2
                            if squared_distance > squared_factors[-1] * squared_reach:
                                continue
                            c = 0
                            while squared_distance > squared_factors[c] * squared_reach:
                                c += 1
                            if c == 0:
                                _unite(parent, i, j)
                            elif _root(parent, i) != _root(parent, j):
                                if n_bonds == len(bonds):
                                    bonds = np.concatenate((bonds, np.empty_like(bonds)))
                                bonds[n_bonds, 0], bonds[n_bonds, 1], bonds[n_bonds, 2] = i, j, last_bond[c]
                                last_bond[c] = n_bonds
                                n_bonds += 1
    return bonds, last_bond


@njit(cache=True)
def _neighbour(k, n, length, periodic):
    """Row k of an axis with n: its place, the shift to the periodic image that is meant, and whether there is one."""
    if 0 <= k < n:
        return k, 0.0, True
    return (n - 1, -length, periodic) if k < 0 else (0, length, periodic)


@njit(cache=True)
def _cells_beside(x, image, nx, periodic):
    """Of a row of cells those from x - 1 to x + 1 that lie in the box (image 0) or in its periodic image at -1 or 1."""
    if image == 0:
        return max(x - 1, 0), min(x + 2, nx)
    if image < 0 and x == 0 and periodic:
        return nx - 1, nx
    if image > 0 and x == nx - 1 and periodic:
        return 0, 1
    return 0, 0


@njit(cache=True)
def _root(parent, i):
    """The particle that stands for the cluster of i; halves the path to it on the way."""
    while parent[i] != i:
        parent[i] = parent[parent[i]]
        i = parent[i]
    return i


@njit(cache=True)
def _unite(parent, i, j):
    """Make one cluster of two. The lower root stays, so that a parent never stands behind its child."""
    i, j = _root(parent, i), _root(parent, j)
    if i < j:
        parent[j] = i
    else:
        parent[i] = j


@njit(cache=True)
def _number(parent, rank, labels, sizes):
    """Fill labels and sizes of one distance factor; return the number of clusters I_c."""
    for q in range(len(parent)):
        parent[q] = parent[parent[q]]
    label_of = np.full(len(parent), -1, np.int32)
    count = 0
    for p in range(len(rank)):
        root = parent[rank[p]]
        if label_of[root] < 0:
            label_of[root] = count
            count += 1
        labels[p] = label_of[root]
        sizes[labels[p]] += 1
    return count

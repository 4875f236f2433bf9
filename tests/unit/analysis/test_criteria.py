"""Clusters by distance, relative velocity and collision frequency from bonds of neighbours."""

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from granugas.analysis.clusters import find_clusters
from granugas.analysis.criteria import busy, cluster_sizes, compare, connected, contacts, measures, near, neighbours, slow


def as_set(bonds):
    return {tuple(pair) for pair in bonds.tolist()}


@pytest.mark.parametrize("dim", [1, 2, 3])
def test_neighbours_equal_scipy(dim):
    """Boxes from two cells a side to many, some of them flat; positions anywhere."""
    rng = np.random.default_rng(dim)
    for _ in range(60):
        box = rng.uniform(2, 12, dim)
        positions = rng.uniform(-box, 2 * box, (80, dim))
        reach = rng.uniform(0.3, 1)
        bonds = neighbours(positions, box, reach)
        assert (bonds[:, 0] < bonds[:, 1]).all()
        assert len(bonds) == len(as_set(bonds))
        assert as_set(bonds) == cKDTree(positions % box, boxsize=box).query_pairs(reach)


def test_neighbours_at_exactly_the_reach_and_through_the_corner():
    assert as_set(neighbours([[0.0, 0.0], [1.25, 0.0], [5.0, 5.0]], 10.0, 1.25)) == {(0, 1)}
    assert as_set(neighbours([[0.25, 9.75], [9.75, 0.25]], 10.0, 1.0)) == {(0, 1)}
    assert len(neighbours([[0.0, 0.0], [5.0, 5.0]], 10.0, 1.0)) == 0


@pytest.mark.parametrize("reach", [0.0, -1.0, 1.1, np.nan])
def test_a_reach_without_meaning_is_refused(reach):
    with pytest.raises(ValueError, match=r"reach = .*: allowed are lengths from 0 to half a side of the box, 1 m"):
        neighbours([[0.0, 0.0]], [2.0, 5.0], reach)


def test_near_keeps_the_shorter_bonds():
    rng = np.random.default_rng(5)
    positions = rng.uniform(0, 10, (200, 2))
    assert as_set(near(neighbours(positions, 10.0, 1.5), positions, 10.0, 0.8)) == as_set(neighbours(positions, 10.0, 0.8))


def test_connected_equals_scipy():
    rng = np.random.default_rng(6)
    for n_bonds in (0, 5, 40, 60, 100, 300):
        bonds = rng.integers(100, size=(n_bonds, 2))
        graph = coo_array((np.ones(n_bonds), bonds.T), shape=(100, 100))
        np.testing.assert_array_equal(connected(100, bonds), connected_components(graph, directed=False)[1])


def test_a_long_chain_in_no_order_is_one_cluster():
    order = np.random.default_rng(7).permutation(5000)
    assert cluster_sizes(5000, np.column_stack([order[:-1], order[1:]])).tolist() == [5000]


def test_sizes_and_measures():
    bonds = np.array([[0, 4], [4, 2], [1, 3]])
    np.testing.assert_array_equal(connected(6, bonds), [0, 1, 0, 1, 0, 2])
    np.testing.assert_array_equal(cluster_sizes(6, bonds), [3, 2, 1])
    assert measures(6, bonds) == (2.0, 14 / 6, 3.0)
    np.testing.assert_array_equal(contacts(6, bonds), [1, 1, 1, 1, 2, 0])


def test_two_touching_groups_that_move_apart():
    """By distance they are one cluster, by relative velocity two."""
    columns, rows = np.meshgrid(np.arange(6), np.arange(3), indexing="ij")
    positions = np.column_stack([columns.ravel(), rows.ravel()]) + 2.0
    right = positions[:, 0] > 4.5
    velocity = np.where(right, 1.0, -1.0)[:, np.newaxis] * [1.0, 0.0]
    bonds = neighbours(positions, 20.0, 1.0)
    assert cluster_sizes(18, bonds).tolist() == [18]
    assert cluster_sizes(18, slow(bonds, velocity, 1.99)).tolist() == [9, 9]
    assert cluster_sizes(18, slow(bonds, velocity, 2.0)).tolist() == [18]
    np.testing.assert_array_equal(connected(18, slow(bonds, velocity, 1.0)), right)


def test_relative_velocity_does_not_know_the_frame():
    rng = np.random.default_rng(8)
    positions, velocity = rng.uniform(0, 10, (200, 2)), rng.normal(size=(200, 2))
    bonds = neighbours(positions, 10.0, 1.5)
    assert as_set(slow(bonds, velocity, 1.0)) == as_set(slow(bonds, velocity + np.array([50.0, -3.0]), 1.0))
    assert 0 < len(slow(bonds, velocity, 1.0)) < len(bonds)


def test_both_partners_must_collide_often():
    chain = np.array([[0, 1], [1, 2], [2, 3]])
    assert as_set(busy(chain, [5.0, 5.0, 1.0, 5.0], 5.0)) == {(0, 1)}
    assert as_set(busy(chain, [5.0, 5.0, 1.0, 5.0], 1.0)) == as_set(chain)
    assert len(busy(chain, [5.0, 5.0, 1.0, 5.0], 5.1)) == 0


def test_all_criteria_at_once():
    rng = np.random.default_rng(9)
    positions, velocity, frequency = rng.uniform(0, 30, (400, 2)), rng.normal(size=(400, 2)), rng.exponential(size=400)
    found = compare(positions, velocity, frequency, [30.0, 30.0], 1.1, 1.5, [0.5, 1e9], [0.3, 0.0])
    clusters = find_clusters(positions, 30.0, 1.0, [1.1, 1.5])
    expected = np.column_stack([clusters.mean_sizes, clusters.weighted_sizes, clusters.largest_sizes])
    np.testing.assert_allclose(found[[0, 2, 4]], expected[[0, 1, 1]])
    bonds = neighbours(positions, 30.0, 1.5)
    assert tuple(found[1]) == measures(400, slow(bonds, velocity, 0.5))
    assert tuple(found[3]) == measures(400, busy(bonds, frequency, 0.3))
    assert (found[[1, 3]] < found[[2, 4]]).all()

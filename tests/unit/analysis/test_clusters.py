"""Clusters against scipy (cKDTree and connected_components) and against configurations whose clusters are known."""

import os
import subprocess
import sys
from itertools import combinations

import numpy as np
import pytest
import xarray as xr
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from granugas.analysis.clusters import PAPER_FACTORS, clusters_of_frames, find_clusters, size_bins


def components(n, pairs):
    """Labels of the connected components of a graph."""
    graph = coo_array((np.ones(len(pairs)), np.reshape(pairs, (-1, 2)).T), shape=(n, n))
    return connected_components(graph, directed=False)[1]


def scipy_labels(positions, box, reach):
    """Labels by scipy; an infinite side is an open axis."""
    box = np.broadcast_to(np.inf if box is None else box, positions.shape[1])
    sides = np.where(np.isfinite(box), box, 0)
    inside = np.where(sides > 0, positions % np.where(sides > 0, sides, 1), positions)
    pairs = cKDTree(inside, boxsize=sides).query_pairs(reach, output_type="ndarray")
    return components(len(positions), pairs)


def brute_force_labels(positions, box, diameters, factor):
    """Every pair with every image, B Eq. 6 as it is written."""
    steps = np.stack(np.meshgrid(*[(-1, 0, 1)] * len(box), indexing="ij"), axis=-1).reshape(-1, len(box))
    inside = positions % box
    pairs = [
        (i, j)
        for i, j in combinations(range(len(positions)), 2)
        if (np.linalg.norm(inside[i] - inside[j] + steps * box, axis=1) <= factor * (diameters[i] + diameters[j]) / 2).any()
    ]
    return components(len(positions), pairs)


def assert_same_clusters(labels, expected):
    """Two labellings are of the same clusters if their names translate into each other one to one."""
    names = len(np.unique(labels)), len(np.unique(expected))
    both = len(np.unique(np.asarray(labels, dtype=np.int64) * (max(expected) + 1) + expected))
    assert (both, both) == names


def filaments(n, rng):
    """Disks of diameter 1 that have condensed into pieces of a crystal, at an area fraction of .25."""
    side, spacing = np.sqrt(n * np.pi), 1.04
    columns, rows = int(side / spacing), int(side / spacing / np.sqrt(0.75))
    row, column = np.divmod(np.arange(rows * columns), columns)
    sites = np.column_stack([column + row % 2 / 2, row * np.sqrt(0.75)]) * spacing
    waves = rng.integers(-8, 9, (20, 2)) * 2 * np.pi / side
    field = np.cos(sites @ waves.T + rng.uniform(0, 2 * np.pi, 20)).sum(axis=1)
    return rng.permutation(sites[np.argsort(field)[:n]] + rng.uniform(-0.15, 0.15, (n, 2))), side


@pytest.mark.parametrize("state", ["homogeneous", "clustered"])
def test_large_systems_equal_scipy(state):
    rng = np.random.default_rng(1)
    positions, side = filaments(20_000, rng)
    if state == "homogeneous":
        positions = rng.uniform(-side, 2 * side, positions.shape)
    found = find_clusters(positions, side, 1.0)
    for labels, factor in zip(found.labels, PAPER_FACTORS, strict=True):
        np.testing.assert_array_equal(labels, scipy_labels(positions, side, factor))


def check_small_boxes(n_configurations, dim, seed):
    """Few particles in boxes from less than a bond to some diameters; for scipy, layers of one tree."""
    rng = np.random.default_rng(seed)
    per_box, n = 250, 8
    for _ in range(n_configurations // per_box):
        box = rng.uniform(0.5, 5, dim)
        positions = rng.uniform(0, box, (per_box, n, dim))
        layers = np.repeat(10.0 * np.arange(per_box), n)[:, np.newaxis]
        labels = np.stack([find_clusters(x, box, 1.0).labels for x in positions])
        unique_labels = labels + n * np.arange(per_box)[:, np.newaxis, np.newaxis]
        for c, factor in enumerate(PAPER_FACTORS):
            layered = np.hstack([positions.reshape(-1, dim), layers])
            assert_same_clusters(unique_labels[:, c].ravel(), scipy_labels(layered, [*box, np.inf], factor))


@pytest.mark.parametrize("dim", [1, 2, 3])
def test_small_boxes_equal_scipy(dim):
    check_small_boxes({1: 1000, 2: 10_000, 3: 1000}[dim], dim, seed=dim)


@pytest.mark.full
def test_many_small_boxes_equal_scipy():
    check_small_boxes(100_000, 2, seed=4)


@pytest.mark.parametrize("box", [None, (np.inf, 12.0), (12.0, np.inf)])
def test_open_axes_equal_scipy(box):
    rng = np.random.default_rng(5)
    positions = rng.uniform(0, 12, (120, 2)) - [0, 6]
    found = find_clusters(positions, box, 1.0)
    for labels, factor in zip(found.labels, PAPER_FACTORS, strict=True):
        np.testing.assert_array_equal(labels, scipy_labels(positions, box, factor))


def test_stretched_boxes_equal_scipy():
    rng = np.random.default_rng(6)
    for box in ([400.0, 1.0], [0.3, 90.0], [4e4, 2.0]):
        positions = rng.uniform(0, box, (150, 2))
        np.testing.assert_array_equal(find_clusters(positions, box, 1.0).labels[-1], scipy_labels(positions, box, 1.4))


@pytest.mark.parametrize("dim", [2, 3])
def test_different_diameters_equal_brute_force(dim):
    rng = np.random.default_rng(7)
    for _ in range(20):
        box = rng.uniform(1, 6, dim)
        positions, diameters = rng.uniform(-6, 12, (15, dim)), rng.uniform(0.05, 1.2, 15)
        found = find_clusters(positions, box, diameters)
        for labels, factor in zip(found.labels, PAPER_FACTORS, strict=True):
            np.testing.assert_array_equal(labels, brute_force_labels(positions, box, diameters, factor))


def test_cluster_that_spans_the_box_and_closes_on_itself():
    """A chain along x: open it is one cluster, without its first link and through the boundary still one."""
    chain = np.column_stack([np.arange(10) + 0.5, np.full(10, 3.0)])
    assert find_clusters(chain, 10.0, 1.0, [1.0]).counts == [1]
    assert find_clusters(np.delete(chain, 4, axis=0), 10.0, 1.0, [1.0]).counts == [1]
    assert find_clusters(np.delete(chain, 4, axis=0), (np.inf, 10.0), 1.0, [1.0]).counts == [2]
    assert find_clusters(np.delete(chain, [4, 7], axis=0), 10.0, 1.0, [1.0]).counts == [2]


def test_contact_through_the_corner():
    pair = [[0.25, 9.75], [9.75, 0.25]]
    assert find_clusters(pair, 10.0, 1.0, [1.0]).counts == [1]
    assert find_clusters(pair, None, 1.0, [1.0]).counts == [2]


def test_particle_that_touches_its_own_image_is_one_cluster():
    assert find_clusters([[0.2, 0.2]], 0.5, 1.0, [1.0]).counts == [1]
    assert find_clusters([[0.2, 0.2], [0.2, 5.2]], (0.5, 10.0), 1.0, [1.0]).counts == [2]


def test_contact_at_exactly_the_reach():
    """Eq. 6 has <=; the next larger distance is none."""
    assert find_clusters([[0.0, 0.0], [1.25, 0.0]], None, 1.0, [1.25]).counts == [1]
    assert find_clusters([[0.0, 0.0], [np.nextafter(1.25, 2), 0.0]], None, 1.0, [1.25]).counts == [2]


def test_positions_on_and_beyond_the_boundary():
    box, tiny = 3.0, -1e-20
    for x in (0.0, tiny, box, 5 * box, 1e20, -1e20):
        assert find_clusters([[x, 1.0], [x + box, 1.0]], box, 1.0, [1.0]).counts == [1]


def test_result_object():
    positions = [[0.0, 0.0], [5.0, 5.0], [1.0, 0.0], [6.15, 5.0], [9.0, 0.0]]
    found = find_clusters(positions, None, 1.0, [1.2, 1.1, 1.2])
    np.testing.assert_array_equal(found.distance_factors, [1.1, 1.2])
    np.testing.assert_array_equal(found.labels, [[0, 1, 0, 2, 3], [0, 1, 0, 1, 2]])
    assert found.labels.dtype == np.int32
    np.testing.assert_array_equal(found.sizes[0], [2, 1, 1, 1])
    np.testing.assert_array_equal(found.sizes[1], [2, 2, 1])
    np.testing.assert_array_equal(found.counts, [4, 3])
    np.testing.assert_allclose(found.mean_sizes, [5 / 4, 5 / 3])
    np.testing.assert_allclose(found.weighted_sizes, [7 / 5, 9 / 5])
    np.testing.assert_array_equal(found.largest_sizes, [2, 2])
    assert repr(found).splitlines()[0] == "Clusters of 5 particles"
    assert repr(found).splitlines()[-1].split() == ["1.2", "3", "1.667", "1.8", "2"]


def test_weighted_sizes_are_those_of_a_particle():
    """M_w is the mean over particles of the size of their cluster, and does not follow from I_c."""
    found = find_clusters(np.random.default_rng(11).uniform(0, 20, (300, 2)), 20.0, 1.0)
    for labels, sizes, weighted in zip(found.labels, found.sizes, found.weighted_sizes, strict=True):
        assert weighted == pytest.approx(sizes[labels].mean())
    pairs, triple = [[0.0], [1.0], [5.0], [6.0]], [[0.0], [1.0], [2.0], [6.0]]
    assert [find_clusters(x, None, 1.0, [1.1]).weighted_sizes[0] for x in (pairs, triple)] == [2.0, 2.5]


def test_weighted_sizes_of_large_clusters_do_not_overflow():
    chain = np.arange(70_000.0)[:, np.newaxis]
    assert find_clusters(chain, None, 1.0, [1.1]).weighted_sizes == [70_000.0]


@pytest.mark.parametrize("dim", [2, 3])
def test_positions_and_a_box_are_enough(dim):
    """Lengths are in diameters where none is given, in a periodic box or in the open."""
    positions = np.random.default_rng(12).uniform(0, 12, (150, dim))
    for box in (None, 12.0, [12.0] * dim):
        np.testing.assert_array_equal(find_clusters(positions, box).labels, find_clusters(positions, box, 1.0).labels)
        for labels, factor in zip(find_clusters(positions, box).labels, PAPER_FACTORS, strict=True):
            np.testing.assert_array_equal(labels, scipy_labels(positions, box, factor))
    assert find_clusters(positions.tolist(), 12.0).counts[0] > 1


@pytest.mark.parametrize("dim", [2, 3])
def test_diameters_of_a_pair_decide(dim):
    """B Eq. 6: half the sum of both diameters, times S_c."""
    pair = np.zeros((2, dim))
    pair[1, 0] = 1.1 * (0.6 + 1.4) / 2
    for box in (None, 10.0):
        assert find_clusters(pair, box, [0.6, 1.4], [1.1 * (1 + 1e-12)]).counts == [1]
        assert find_clusters(pair, box, [0.6, 1.4], [1.1 * (1 - 1e-12)]).counts == [2]
        assert find_clusters(pair, box, [0.6, 1.3], [1.1]).counts == [2]


def test_many_bonds_a_particle():
    """A point set with far more bonds than particles: the lists grow."""
    positions = np.random.default_rng(8).uniform(0, 10, (300, 2))
    found = find_clusters(positions, 10.0, 1.0, [0.001, 0.2, 2.5])
    np.testing.assert_array_equal(found.labels[1], scipy_labels(positions, 10.0, 0.2))
    np.testing.assert_array_equal(found.counts, [300, found.labels[1].max() + 1, 1])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([[0.0, np.nan]], 1.0, 1.0), "positions: some are not finite"),
        (([0.0, 1.0], 1.0, 1.0), r"positions of shape \(2,\)"),
        ((np.zeros((0, 2)), 1.0, 1.0), r"positions of shape \(0, 2\)"),
        ((np.zeros((2, 4)), 1.0, 1.0), r"positions of shape \(2, 4\)"),
        (([[0.0, 0.0]], 1.0, 0.0), "diameter: allowed are a number > 0"),
        (([[0.0, 0.0]], 1.0, [1.0, 1.0]), "diameter: allowed are .* or 1 of them"),
        (([[0.0, 0.0]], -1.0, 1.0), "box = -1.0: allowed are 2 sides > 0"),
        (([[0.0, 0.0]], [1.0, 1.0, 1.0], 1.0), "box = .* allowed are 2 sides"),
        (([[0.0, 0.0]], 1.0, 1.0, []), r"distance_factors = \[\]"),
        (([[0.0, 0.0]], 1.0, 1.0, [1.1, np.nan]), "distance_factors = .*: allowed are numbers > 0"),
    ],
)
def test_arguments_without_meaning_are_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        find_clusters(*arguments)


def test_plain_python_gives_the_same(tmp_path):
    """The text of the kernels, uncompiled and with checked indices."""
    rng = np.random.default_rng(9)
    positions, diameters = rng.uniform(-4, 8, (60, 2)), rng.uniform(0.3, 1, 60)
    np.savez(tmp_path / "in.npz", positions=positions, diameters=diameters)
    script = (
        "import numpy as np; from granugas.analysis.clusters import find_clusters; data = np.load('in.npz');"
        "np.save('out.npy', find_clusters(data['positions'], [12.0, 7.0], data['diameters']).labels)"
    )
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1"}
    subprocess.run([sys.executable, "-c", script], cwd=tmp_path, env=environment, check=True)
    found = find_clusters(positions, [12.0, 7.0], diameters)
    np.testing.assert_array_equal(np.load(tmp_path / "out.npy"), found.labels)
    assert 1 < found.counts[0] < 60


def test_size_bins():
    np.testing.assert_array_equal(size_bins(1), [1, 2])
    np.testing.assert_array_equal(size_bins(8), [1, 2, 3, 4, 6, 8, 12])
    np.testing.assert_array_equal(size_bins(40), [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48])
    for n in range(1, 300):
        assert size_bins(n)[-2] <= n < size_bins(n)[-1]


@pytest.fixture
def run():
    """Some particles that move for three times and are gone at the fourth, and two snapshots of others."""
    rng = np.random.default_rng(10)
    trajectory = rng.uniform(0, 8, (4, 40, 2))
    trajectory[3] = np.nan
    return xr.Dataset(
        {
            "trajectory": (("time", "particle", "axis"), trajectory),
            "position": (("snapshot", "particle", "axis"), rng.uniform(0, 8, (2, 40, 2))),
        },
        coords={"time": [0.0, 0.1, 0.2, 0.4], "snapshot": [0.1, 0.2], "axis": ["x", "y"], "realization": 3},
        attrs={"box_x": 8.0, "box_y": 8.0, "diameter": 1.0, "restitution": 0.8},
    )


def test_clusters_of_a_trajectory(run):
    found = find_clusters(run, distance_factors=[1.2, 1.05])
    assert found.cluster_count.dims == ("distance_factor", "time")
    assert found.cluster_size_distribution.dims == ("distance_factor", "time", "cluster_size")
    np.testing.assert_array_equal(found.time, run.time)
    assert found.attrs["restitution"] == 0.8
    assert found.realization == 3
    for t in range(3):
        clusters = find_clusters(run.trajectory.values[t], 8.0, 1.0, [1.05, 1.2])
        at_t = found.isel(time=t)
        np.testing.assert_array_equal(at_t.cluster_count, clusters.counts)
        np.testing.assert_array_equal(at_t.mean_cluster_size, clusters.mean_sizes)
        np.testing.assert_array_equal(at_t.weighted_cluster_size, clusters.weighted_sizes)
        np.testing.assert_array_equal(at_t.largest_cluster_size, clusters.largest_sizes)
        for c, sizes in enumerate(clusters.sizes):
            lower, upper = found.cluster_size.values, found.cluster_size_upper.values
            expected = [np.sum((sizes >= low) & (sizes < high)) for low, high in zip(lower, upper, strict=True)]
            np.testing.assert_array_equal(at_t.cluster_size_distribution[c], expected)


def test_a_run_that_has_ended_has_no_clusters(run):
    after = find_clusters(run).isel(time=3)
    assert all(after[name].isnull().all() for name in after.data_vars)


def test_variables_are_described(run):
    found = find_clusters(run)
    assert {found[name].attrs["units"] for name in found.data_vars} == {"1"}
    assert found.distance_factor.attrs["long_name"]


def test_clusters_of_snapshots(run):
    found = find_clusters(run.drop_vars("trajectory"), distance_factors=[1.1])
    assert found.mean_cluster_size.dims == ("distance_factor", "snapshot")
    np.testing.assert_array_equal(found.snapshot, [0.1, 0.2])
    expected = find_clusters(run.position.values[1], 8.0, 1.0, [1.1]).mean_sizes
    np.testing.assert_array_equal(found.mean_cluster_size[:, 1], expected)


def test_clusters_of_frames_one_by_one(run):
    """An iterator is enough, and padding is nobody."""
    padded = np.full((50, 2), np.nan)
    padded[:40] = run.trajectory.values[0]
    found = clusters_of_frames(iter([padded, padded + 8]), 8.0, 1.0, [1.1])
    expected = find_clusters(run.trajectory.values[0], 8.0, 1.0, [1.1])
    np.testing.assert_array_equal(found.cluster_count, [[*expected.counts] * 2])
    np.testing.assert_array_equal(found.mean_cluster_size, [[*expected.mean_sizes] * 2])


def test_runs_without_an_answer_are_refused(run):
    with pytest.raises(ValueError, match="neither trajectory nor position"):
        find_clusters(run.drop_vars(["trajectory", "position"]))
    with pytest.raises(ValueError, match="select one run"):
        find_clusters(run.expand_dims(restitution=[0.8]))
    with pytest.raises(ValueError, match="a run brings its own"):
        find_clusters(run, 8.0)
    with pytest.raises(ValueError, match="frames: there is none"):
        clusters_of_frames([], 8.0, 1.0, [1.1])

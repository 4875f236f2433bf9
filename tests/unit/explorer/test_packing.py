"""Frames come back within their steps, and say exactly what is in contact at the S_c of the dataset."""

import base64
import zlib

import numpy as np
import pytest

from granugas.analysis.clusters import find_clusters
from granugas.explorer.packing import LARGEST_FACTOR, SIZES, STEP, frame_of, grid_of, packed

D = 0.002
FACTORS = (1.0, 1.05, 1.1, 1.4)


def unpacked(layout, text):
    """What the page makes of a text: arrays by name."""
    data, arrays = zlib.decompress(base64.b64decode(text)), {}
    for name, kind, length in layout:
        width = int(kind[1:])
        planes, data = np.frombuffer(data[: width * length], np.uint8).reshape(width, length), data[width * length :]
        arrays[name] = sum(plane.astype(np.int64) << (8 * k) for k, plane in enumerate(planes))
    assert not data
    return arrays


def places_of(grid, frame):
    """(n, 2) in m: the middles of the steps."""
    home = np.repeat(np.arange(len(frame["count"])), frame["count"])
    cell = np.stack([home % grid.cells[0], home // grid.cells[0]], axis=1)
    step = np.stack([frame["x"], frame["y"]], axis=1) + 0.5
    return (cell + step / 2**grid.bits) * grid.box / grid.cells


def factors_of(places, diameters, grid):
    """(n, n) distance factors of pairs, by the nearest periodic images."""
    apart = places[:, np.newaxis] - places
    apart -= np.where(grid.periodic, np.rint(apart / grid.box) * grid.box, 0)
    return np.hypot(*np.moveaxis(apart, -1, 0)) / ((diameters[:, np.newaxis] + diameters) / 2)


def sizes_by_the_page(grid, frame, c):
    """Sorted cluster sizes at the c-th S_c: rounded places where they suffice, and the bonds that the frame names."""
    diameters = frame["size"] / SIZES * grid.diameters.max() if "size" in frame else grid.diameters
    joined = factors_of(places_of(grid, frame), diameters, grid) <= grid.factors[c] - grid.margin
    joined[frame[f"first_{c}"], frame[f"second_{c}"]] = True
    labels = np.arange(len(joined))
    for _ in range(len(joined)):
        for i, j in np.argwhere(joined):
            labels[[i, j]] = min(labels[i], labels[j])
        if all(labels[i] == labels[j] for i, j in np.argwhere(joined)):
            break
    return sorted(np.unique(labels, return_counts=True)[1])


def close_calls(box, factors, rng):
    """Pairs whose distance is an S_c or a hundred-thousandth part more or less, far from each other and across edges."""
    middle = np.stack(np.meshgrid(*(np.arange(0, side, 4 * D) for side in box)), axis=-1).reshape(-1, 2)
    angle, length = rng.uniform(0, 2 * np.pi, len(middle)), rng.choice(factors, len(middle)) * D
    length *= 1 + rng.choice([-1e-5, 1e-5], len(middle))
    half = length[:, np.newaxis] * np.stack([np.cos(angle), np.sin(angle)], axis=1) / 2
    return np.concatenate([middle - half, middle + half]) % box


@pytest.mark.parametrize("boundary", ["periodic", "wall", "wall periodic"])
@pytest.mark.parametrize("box", [(40.5, 40.5), (52.0, 22.0), (3.1, 60.0)])
def test_clusters_are_those_of_the_analysis_where_it_is_a_close_call(box, boundary):
    rng, box = np.random.default_rng(1), np.array(box) * D
    places = close_calls(box, FACTORS, rng)
    run = {"box_x": box[0], "box_y": box[1], "boundary": boundary}
    grid = grid_of(run, np.full(len(places), D), FACTORS)
    frame = unpacked(*packed(frame_of(grid, places, {})))
    found = find_clusters(places, np.where(grid.periodic, box, np.inf), D, FACTORS)
    for c, sizes in enumerate(found.sizes):
        assert sizes_by_the_page(grid, frame, c) == sorted(sizes)
    rounded = factors_of(places_of(grid, frame), grid.diameters, grid)
    exact = factors_of(places, grid.diameters, grid)
    wrong = [((rounded <= factor) ^ (np.sort(exact) <= factor)).sum() for factor in FACTORS]
    assert sum(wrong) > 0  # without the bonds that are named it would fail


def test_clusters_of_unequal_disks():
    rng, box = np.random.default_rng(2), np.array([24.0, 24.0]) * D
    places, diameters = rng.random((250, 2)) * box, D * rng.uniform(0.5, 1.0, 250)
    grid = grid_of({"box_x": box[0], "box_y": box[1]}, diameters, FACTORS)
    frame = unpacked(*packed(frame_of(grid, places, {})))
    for c, sizes in enumerate(find_clusters(places, box, diameters, FACTORS).sizes):
        assert sizes_by_the_page(grid, frame, c) == sorted(sizes)


@pytest.mark.parametrize("unequal", [False, True])
def test_rounding_keeps_within_the_margin(unequal):
    rng, box = np.random.default_rng(3), np.array([30.0, 20.0]) * D
    places = rng.random((300, 2)) * box
    diameters = D * rng.uniform(0.5, 1.0, 300) if unequal else np.full(300, D)
    grid = grid_of({"box_x": box[0], "box_y": box[1]}, diameters, FACTORS)
    numbers = np.arange(300, dtype=np.uint16)
    frame = unpacked(*packed(frame_of(grid, places, {"number": numbers})))
    order = frame["number"]
    assert sorted(order) == numbers.tolist()
    assert abs(places_of(grid, frame) - places[order]).max() <= 0.5001 * (grid.box / grid.cells).max() / 2**grid.bits
    stored = frame["size"] / SIZES * diameters.max() if unequal else diameters
    np.testing.assert_allclose(stored, diameters[order], rtol=2e-5)
    exact, rounded = factors_of(places[order], diameters[order], grid), factors_of(places_of(grid, frame), stored, grid)
    near = (exact < LARGEST_FACTOR) & (exact > 0)
    moved = abs(exact - rounded)[near].max()
    assert 0.2 * grid.margin < moved < grid.margin < 2 * np.sqrt(2) * STEP * 1.1 * (2 if unequal else 1)


def test_few_disks_in_a_wide_box_need_no_more_cells_than_they_are_worth():
    grid = grid_of({"box_x": 1e4 * D, "box_y": 1e4 * D}, np.full(50, D), FACTORS)
    assert np.prod(grid.cells) <= 4 * 50 + 64 and grid.bits == 16


def test_a_frame_is_small():
    rng = np.random.default_rng(4)
    side = 100
    sites = (np.stack(np.meshgrid(np.arange(side), np.arange(side)), axis=-1).reshape(-1, 2) + 0.5) * 1.77
    places = (sites + rng.uniform(-0.3, 0.3, sites.shape)) * D
    grid = grid_of({"box_x": 1.77 * side * D, "box_y": 1.77 * side * D}, np.full(side**2, D), FACTORS)
    assert grid.bits == 13
    _, text = packed(frame_of(grid, places, {"level": rng.integers(0, 16, side**2).astype(np.uint8)}))
    assert len(text) / side**2 < 4 / 3 * (2 * 13 / 8 + 0.52 + 0.28 + 0.07)  # places, level, cells, bonds


def test_factors_beyond_the_slider_are_left_out():
    grid = grid_of({"box_x": 0.1, "box_y": 0.1}, np.full(9, D), (1.0, 1.6, 1.7))
    assert grid.factors.tolist() == [1.0, 1.6]

"""The claims of section 6 of the second paper: they hold in a world after the text, and notice where that is wrong."""

import runpy
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from worlds import alike, change, mirrored, times

from granugas.analysis.clusters import size_bins
from granugas.claims import FAILS, HOLDS, NOT_MEASURED, judge

MODULE = runpy.run_path(str(Path(__file__).parents[2] / "workflow/claims/cluster1999_section6.py"))
CLAIMS = {one.id: one for one in MODULE["CLAIMS"]}
GEOMETRY = {"B-6-01", "B-6-05", "B-6-06"}
"""Claims about packings, which no run can make wrong."""
WRONG_ANYWAY = "B-6-10"
"""Thresholds that follow the temperature choose the same particles at any."""
LARGE, RUNS, N, SHOWN, D = "cluster1999_large", 2, 79524, 3000, 0.01
FACTORS = [1.01, 1.05, 1.1, 1.2, 1.3, 1.4]


def gas_and_block(rng):
    """Positions, velocities, frequencies: points at random; a close packing in halves that move apart, one of them busy."""
    row, column = np.divmod(np.arange(SHOWN), 50)
    block = np.column_stack([column + row % 2 / 2, row * np.sqrt(0.75)]) * 1.005 * D + 0.2
    left = column < 25
    drift = np.where(left, 1.0, -1.0)[:, np.newaxis] * [1.0, 0.0] + rng.normal(0, 0.05, (SHOWN, 2))
    gas = rng.random((SHOWN, 2)), rng.normal(size=(SHOWN, 2)), rng.exponential(10, SHOWN)
    return zip(gas, (block, drift, np.where(left, 20.0, 5.0)), strict=True)


@pytest.fixture(scope="module")
def world():
    time = np.concatenate([[0], np.geomspace(5e-3, 446.6, 250)])
    edges, size = size_bins(N), 100 * np.maximum(time, 0.1)[:, np.newaxis]
    whole = np.arange(1, edges[-1])
    density = (whole / size) ** -1.5 * np.exp(-whole / size) / size**2
    density *= N / (density * whole).sum(axis=1, keepdims=True)
    numbers = np.add.reduceat(density, edges[:-1] - 1, axis=1)
    numbers[-1] = np.arange(len(edges) - 1) == len(edges) - 2  # in the end there is one
    over, each = ("realization", "distance_factor", "time"), np.ones((RUNS, len(FACTORS), 1))
    rng = np.random.default_rng(3)
    states = [[np.stack(pair)[[0, 1, 1, 1]] for pair in gas_and_block(rng)] for _ in range(RUNS)]
    position, velocity, frequency = (np.stack(parts) for parts in zip(*states, strict=True))
    at = ("realization", "snapshot", "particle")
    data = xr.Dataset(
        {
            "kinetic_energy": (("realization", "time"), np.ones((RUNS, len(time)))),
            "cpu_time": ("realization", np.full(RUNS, 600.0)),
            "box_x": ("realization", np.ones(RUNS)),
            "box_y": ("realization", np.ones(RUNS)),
            "cluster_count": (over, numbers.sum(axis=1) * each),
            "weighted_cluster_size": (over, size[:, 0] / 2 * each),
            "largest_cluster_size": (over, np.minimum(0.1 * time / 30, 0.6) * N * each),
            "cluster_size_distribution": ((*over, "cluster_size"), numbers * each[..., np.newaxis]),
            "position": ((*at, "axis"), position),
            "velocity": ((*at, "axis"), velocity),
            "collision_frequency": (at, frequency),
        },
        {
            "time": time,
            "realization": np.arange(RUNS),
            "distance_factor": FACTORS,
            "cluster_size": edges[:-1],
            "cluster_size_upper": ("cluster_size", edges[1:]),
            "snapshot": [1.28, 2.56, 40.96, 446.6],
        },
    )
    return {LARGE: data.expand_dims(n_particles=[N], diameter=[D])}


def test_in_a_world_after_the_paper_its_claims_hold(world):
    table = judge(CLAIMS.values(), world).set_index("id")
    others = table[~table["verdict"].str.startswith(HOLDS)]
    assert others["verdict"].to_dict() == {WRONG_ANYWAY: FAILS}


def test_what_does_not_hold_is_explained(world):
    assert "hard particles have no velocity scale" in judge([CLAIMS[WRONG_ANYWAY]], world).iloc[0]["remark"]


def test_a_single_run_has_no_errors(world):
    table = judge(CLAIMS.values(), {LARGE: world[LARGE].isel(realization=[0])}).set_index("id")
    assert (table["verdict"] != NOT_MEASURED).all() and (table["error"] == "").all()


@pytest.mark.parametrize("gone", [{"n_particles": N // 2}, {"snapshot": 1.0}, {"distance_factor": 1.5}])
def test_what_was_not_run_is_no_measurement(world, gone):
    ((name, value),) = gone.items()
    data = world[LARGE].isel({name: [0]}).assign_coords({name: [value]})
    table = judge(CLAIMS.values(), {LARGE: data}).set_index("id")
    missing = set(table.index[table["verdict"] == NOT_MEASURED])
    of_snapshots = {f"B-6-{k:02d}" for k in (2, 3, 4, 7, 8, 9, 10, 11, 12, 13)}
    of_factors = {f"B-6-{k:02d}" for k in (7, 14, 15, 16, 19, 20)}
    assert missing == {"n_particles": set(CLAIMS), "snapshot": of_snapshots, "distance_factor": of_factors}[name]


def frozen(world):
    """All snapshots are as the first."""
    for name in ("position", "velocity", "collision_frequency"):
        world = change(LARGE, name, lambda old: old.isel(snapshot=0, drop=True) + 0 * old)(world)
    return world


WRONG = {
    "B-6-02": change(LARGE, "position", times(1.25), snapshot=446.6),
    "B-6-03": change(LARGE, "position", times(1.02), snapshot=446.6),
    "B-6-04": change(LARGE, "position", times(0.6), snapshot=446.6),
    "B-6-07": change(LARGE, "cluster_count", times(1.1)),
    "B-6-08": change(LARGE, "velocity", 0.0),
    "B-6-09": change(LARGE, "collision_frequency", 0.0),
    "B-6-11": frozen,
    "B-6-12": frozen,
    "B-6-13": frozen,
    "B-6-14": change(LARGE, "cluster_count", mirrored("time")),
    "B-6-15": change(LARGE, "largest_cluster_size", times(0.5)),
    "B-6-16": change(LARGE, "largest_cluster_size", times(10)),
    "B-6-17": change(LARGE, "cpu_time", times(100)),
    "B-6-18": change(LARGE, "cluster_size_distribution", times(1.01)),
    "B-6-19": change(LARGE, "weighted_cluster_size", alike("time")),
    "B-6-20": change(LARGE, "cluster_size_distribution", lambda n: n * n["cluster_size"] ** (0.01 * n["time"])),
}


def test_hardly_a_claim_is_left_out():
    assert CLAIMS.keys() - WRONG.keys() == GEOMETRY | {WRONG_ANYWAY}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_world_is_noticed(world, name):
    row = judge([CLAIMS[name]], WRONG[name](world)).iloc[0]
    assert row["verdict"] == FAILS, f"{row['expected']}: {row['measured']} ± {row['error']} {row['remark']}"

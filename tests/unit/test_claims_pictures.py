"""Claims about B Figs. 4 to 6: they hold in a world that is as the text says, and each notices where it is not."""

import runpy
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from worlds import alike, change, mirrored

from granugas.analysis.structure import density_at
from granugas.claims import FAILS, HOLDS, NOT_MEASURED, judge

MODULE = runpy.run_path(str(Path(__file__).parents[2] / "workflow/claims/cluster1999_section4_pictures.py"))
CLAIMS = {one.id: one for one in MODULE["CLAIMS"]}
LARGE = "cluster1999_large"
N, BAND, DIAMETER = 10_000, 8000, 4.4e-3


def lattice(columns, rows, spacing, begin):
    return (np.stack(np.meshgrid(np.arange(columns), np.arange(rows)), axis=-1).reshape(-1, 2) * spacing + begin)[
        : columns * rows
    ]


def places(seed):
    """Random; in weak bands; most particles in one block, by height; half of these in each of two bands; heights at first."""
    rng = np.random.default_rng(seed)
    start = rng.random((N, 2))
    weak = (start + rng.normal(0, 0.03, (N, 2))) % 1
    weak[:, 1] = (weak[:, 1] + np.sin(6 * np.pi * weak[:, 1]) / (8 * np.pi)) % 1
    block, bands = rng.random((2, N, 2))
    by_height = np.argsort(start[:BAND, 1] + rng.normal(0, 0.1, BAND))
    block[by_height] = lattice(100, 80, 0.0048, 0.1)
    order = rng.permutation(BAND)
    half = BAND // 2
    bands[order[:half]] = lattice(200, 20, 0.0045, [0.0, 0.25])
    bands[order[half:]] = lattice(200, 20, 0.0045, [0.0, 0.65])
    return np.stack([start, weak, block, bands]), start[:, 1]


@pytest.fixture(scope="module")
def world():
    rng, runs = np.random.default_rng(7), 3
    position, height = (np.stack(parts) for parts in zip(*map(places, range(runs)), strict=True))
    patch = (position[:, 3, :, 0] < 0.1) & (np.arange(N) < BAND)
    density = np.stack([density_at(frames[3], (1.0, 1.0), 100) for frames in position])
    dense = density > np.median(density, axis=1, keepdims=True)
    interval = np.where(dense & (np.arange(N) % 20 == 0), 1e-6, 1e-3)
    frequency = np.where(patch, 1000.0, 10.0)
    over = ("realization", "snapshot", "particle")
    each = np.ones((1, 4, 1))
    data = xr.Dataset(
        {
            "kinetic_energy": (("realization", "time"), np.ones((runs, 2))),
            "position": ((*over, "axis"), position),
            "velocity": ((*over, "axis"), rng.normal(size=position.shape)),
            "last_collision_interval": (over, interval[:, np.newaxis] * each),
            "collision_frequency": (over, frequency[:, np.newaxis] * each),
            "initial_y": (("realization", "particle"), height),
            "box_x": ("realization", np.ones(runs)),
            "box_y": ("realization", np.ones(runs)),
        },
        {"realization": np.arange(runs), "time": [0.0, 446.6], "snapshot": [0.64, 2.56, 40.96, 446.6], "axis": ["x", "y"]},
    )
    return {LARGE: data.expand_dims(n_particles=[79524], restitution=[0.8], contact_time=[1e-5], diameter=[DIAMETER])}


def at(time):
    return lambda old: old.sel(snapshot=time, drop=True) + 0 * old


def both(*changes):
    def changed(world):
        for one in changes:
            world = one(world)
        return world

    return changed


SCATTERED = change(LARGE, "position", at(0.64), snapshot=446.6)
RIGID = change(LARGE, "velocity", 0.01)

WRONG = {
    "B-4-31": change(LARGE, "position", mirrored("snapshot")),
    "B-4-32": SCATTERED,
    "B-4-33": SCATTERED,
    "B-4-34": RIGID,
    "B-4-35": RIGID,
    "B-4-36": change(LARGE, "position", at(40.96), snapshot=446.6),
    "B-4-37": change(LARGE, "last_collision_interval", mirrored("particle")),
    "B-4-38": change(LARGE, "collision_frequency", alike("particle")),
    "B-4-39": both(change(LARGE, "collision_frequency", alike("particle")), SCATTERED),
    "B-4-40": change(LARGE, "initial_y", 0.25),
    "B-4-41": change(LARGE, "initial_y", 0.5),
    "B-4-42": change(LARGE, "position", mirrored("snapshot")),
    "B-4-43": change(LARGE, "initial_y", 0.5),
}


def test_no_claim_is_left_out():
    assert WRONG.keys() == CLAIMS.keys()


def test_in_a_world_after_the_paper_the_claims_hold(world):
    table = judge(CLAIMS.values(), world)
    wrong = table[table["verdict"] != HOLDS]
    assert wrong.empty, wrong[["id", "measured", "verdict", "remark"]].to_string()
    assert (table["error"] != "").sum() > 5


@pytest.mark.parametrize("name", WRONG)
def test_a_claim_notices_that_it_is_wrong(world, name):
    row = judge([CLAIMS[name]], WRONG[name](world)).iloc[0]
    assert row["verdict"] == FAILS, f"{row['expected']}: {row['measured']} ± {row['error']} {row['remark']}"


def test_one_run_is_measured_without_an_error(world):
    table = judge(CLAIMS.values(), {LARGE: world[LARGE].isel(realization=[0])})
    assert table["verdict"].str.startswith(HOLDS).all() and (table["error"] == "").all()


@pytest.mark.parametrize(
    "less",
    [
        lambda data: data.assign_coords(n_particles=[1936]),
        lambda data: data.isel(snapshot=[]),
        lambda data: data.isel(realization=[]),
    ],
)
def test_what_is_not_there_is_not_measured(world, less):
    table = judge(CLAIMS.values(), {LARGE: less(world[LARGE])})
    assert set(table["verdict"]) == {NOT_MEASURED}


def test_without_contacts_there_is_nothing_red(world):
    row = judge([CLAIMS["B-4-37"]], change(LARGE, "last_collision_interval", 1.0)(world)).iloc[0]
    assert (row["verdict"], row["remark"]) == (NOT_MEASURED, "no particle with a time between collisions below t_c")

"""The claims on the growth of clusters: each holds in a world after the text, and notices where that is wrong."""

import runpy
from pathlib import Path

import large_system
import numpy as np
import pytest
import xarray as xr
from large_system import END, TIMES
from worlds import change, mirrored, times

from granugas.claims import FAILS, HOLDS, NOT_MEASURED, judge

PROJECT = Path(__file__).parents[2]
FILES = [PROJECT / f"workflow/claims/cluster1999_section{name}.py" for name in ("4_growth", "5")]
CLAIMS = {one.id: one for path in FILES for one in runpy.run_path(str(path))["CLAIMS"]}
LARGE, K, C, CE = "cluster1999_large", "kinetic_energy", "collisions_per_particle", "elastic_collisions_per_particle"
COUNT, MEAN, LARGEST = "cluster_count", "mean_cluster_size", "largest_cluster_size"


@pytest.fixture(scope="module")
def world():
    return large_system.whole()


def bent(points):
    """Times broken power laws through points (t, factor)."""
    later = large_system.broken({TIMES[1]: points.get(0, 1)} | {t: y for t, y in points.items() if t > 0})
    return lambda old: old * xr.DataArray(np.concatenate([[1], later]), {"time": old["time"]})


CONSTANT = {0: 1, 1: 1, 40: 40**-0.3, END: 40**-0.3}
"""Takes the growth away."""

WRONG = {
    "B-0-01": change(LARGE, K, bent({0: 1, 0.1: 1.1, END: 1.1})),
    "B-0-02": change(LARGE, LARGEST, bent({0: 3, 1: 3, 40: 1, END: 1})),
    "B-0-03": change(LARGE, MEAN, bent({0: 1, 0.1: 1.15, END: 1.15})),
    "B-0-04": change(LARGE, LARGEST, times(0.5)),
    "B-1-01": change(LARGE, CE, times(10)),
    "B-4-01": change(LARGE, "box_x", times(1.05)),
    "B-4-02": change(LARGE, C, times(0.8)),
    "B-4-03": change(LARGE, C, times(0.8)),
    "B-4-04": change(LARGE, C, times(0.7)),
    "B-4-05": change(LARGE, C, times(0.6)),
    "B-4-06": change(LARGE, K, bent({0: 1, 0.2: 1.2, END: 1.2})),
    "B-4-07": change(LARGE, K, bent({0: 1, 0.05: 1.2, END: 1.2})),
    "B-4-08": change(LARGE, K, bent({0: 1, 0.2: 1, END: 1 / 300})),
    "B-4-09": change(LARGE, K, bent({0: 1, 1: 1, 40: 40**0.5, END: 40**0.5})),
    "B-4-10": change(LARGE, K, bent({0: 1, 50: 1, END: END / 50})),
    "B-4-11": change(LARGE, K, bent({0: 1, 50: 1, 110: 2.2**0.8, END: 2.2**0.8})),
    "B-4-12": change(LARGE, C, bent({0: 1, 0.01: 1.3, END: 1.3})),
    "B-4-13": change(LARGE, C, bent({0: 1, 100: 1, END: 0.5})),
    "B-4-14": change(LARGE, C, bent({0: 1, 1: 1, 40: 3, END: 3})),
    "B-4-16": change(LARGE, CE, times(10)),
    "B-4-17": change(LARGE, CE, bent({0: 1, 50: 1, END: 0.05})),
    "B-4-18": change(LARGE, K, bent({0: 1, 50: 1, END: (END / 50) ** 0.9})),
    "B-5-01": change(LARGE, COUNT, bent({0: 1, 100: 1, END: 2}), distance_factor=1.3),
    "B-5-02": change(LARGE, MEAN, bent({0: 1, 100: 1, END: 0.5}), distance_factor=1.05),
    "B-5-03": change(LARGE, LARGEST, bent({0: 1, 40: 1, END: 0.3}), distance_factor=1.4),
    "B-5-04": change(LARGE, MEAN, bent(CONSTANT), distance_factor=1.4),
    "B-5-05": change(LARGE, MEAN, bent({0: 1, 1: 1.4, END: 1.4}), distance_factor=1.2),
    "B-5-06": change(LARGE, LARGEST, bent({0: 1, 1: 2, END: 2}), distance_factor=1.2),
    "B-5-07": change(LARGE, MEAN, bent({0: 1, 1: 1, 5: 5**-0.3, END: 5**-0.3})),
    "B-5-08": change(LARGE, MEAN, bent({0: 1, 40: 1, 200: 5**0.3, END: 5**0.3})),
    "B-5-09": change(LARGE, LARGEST, bent({0: 1, 100: 1, END: (END / 100) ** 1.5})),
    "B-5-10": change(LARGE, MEAN, times(0.6), distance_factor=1.4),
    "B-5-11": change(LARGE, MEAN, mirrored("distance_factor")),
    "B-5-12": change(LARGE, LARGEST, times(0.5), distance_factor=1.05),
    "B-5-13": change(LARGE, LARGEST, times(2), distance_factor=1.05),
    "B-5-14": change(LARGE, LARGEST, bent({0: 1, 160: 1, END: 0.8})),
    "B-5-15": change(LARGE, MEAN, bent({0: 1, 1: 1, 40: 40**0.1, END: 40**0.1})),
    "B-5-16": change(LARGE, MEAN, bent({0: 1, 1: 1, 40: 40**-0.1, END: 40**-0.1}), distance_factor=1.4),
    "B-5-17": change(LARGE, COUNT, bent({0: 1, 1: 1, 40: 40**0.1, END: 40**0.1})),
    "B-5-18": change(LARGE, COUNT, bent({0: 1, 1: 1, 40: 1.01, END: 1.01})),
    "B-5-19": change(LARGE, MEAN, bent({0: 1, 40: 1, 200: 5**0.3, END: 5**0.3})),
    "B-5-20": change(LARGE, MEAN, bent({0: 1, 1: 1, 6.3: 6.3**0.03, 40: 1, END: 1})),
    "B-6-51": change(LARGE, MEAN, bent({0: 1, 1: 1, END: END**-0.8})),
    "B-6-52": change(LARGE, LARGEST, bent({0: 1, 1: 1, 40: 0.1, END: 0.1})),
}


def test_in_a_world_after_the_paper_all_holds_but_one_sentence(world):
    """The rate between is not the smaller one by the printed C/N themselves."""
    table = judge(CLAIMS.values(), world)
    others = table[~table["verdict"].str.startswith(HOLDS)].set_index("id")["verdict"].to_dict()
    assert others == {"B-4-15": FAILS}


def test_a_rate_that_grows_would_be_noticed(world):
    late = change(LARGE, C, bent({0: 1, 40: 1, END: 3}))(world)
    assert judge([CLAIMS["B-4-15"]], late).iloc[0]["verdict"].startswith(HOLDS)


def test_no_claim_is_left_out():
    assert CLAIMS.keys() - WRONG.keys() == {"B-4-15"}


@pytest.mark.parametrize("name", WRONG)
def test_a_claim_notices_that_it_is_wrong(world, name):
    row = judge([CLAIMS[name]], WRONG[name](world)).iloc[0]
    assert row["verdict"] == FAILS, f"{row['expected']}: {row['measured']} ± {row['error']} {row['remark']}"


def test_a_reduced_study_is_no_measurement(world):
    small = {LARGE: world[LARGE].assign_coords(n_particles=[1936])}
    assert set(judge(CLAIMS.values(), small)["verdict"]) == {NOT_MEASURED}


def test_what_is_missing_is_named(world):
    few = {LARGE: world[LARGE].sel(distance_factor=[1.05, 1.2])}
    assert judge([CLAIMS["B-5-16"]], few).iloc[0]["remark"] == "no clusters for S_c = 1.3, 1.4"
    short = {LARGE: world[LARGE].isel(time=slice(0, 200))}
    assert set(judge(CLAIMS.values(), short)["remark"]) == {"the runs end before 446.6 s"}
    none = {LARGE: world[LARGE].drop_dims("distance_factor")}
    assert judge([CLAIMS["B-5-01"]], none).iloc[0]["remark"] == "no clusters"


@pytest.mark.filterwarnings("error")
def test_one_realization_is_enough(world):
    table = judge(CLAIMS.values(), {LARGE: world[LARGE].isel(realization=[0])})
    assert not (table["verdict"] == NOT_MEASURED).any()


def test_the_table_has_exponents_and_boundaries(world):
    table = runpy.run_path(str(PROJECT / "workflow/tables/cluster1999_growth.py"))["table"](world)
    assert set(table["realizations"]) == {4}
    at = table[(table["quantity"] == "mean_cluster_size") & (table["distance_factor"] == 1.1)].set_index("what")
    assert at.loc["begins", "value"] == pytest.approx(1, rel=0.12) and at.loc["ends", "value"] == pytest.approx(40, rel=0.1)
    halves = at.loc["exponent"].set_index("window_from").sort_values("window_to")
    assert halves.loc[6.3, "value"] == pytest.approx(0.33, abs=0.01)
    assert (at["low"] <= at["value"]).all() and (at["value"] <= at["high"]).all()
    counts = table[(table["quantity"] == "cluster_count") & (table["distance_factor"] == 1.1)]
    np.testing.assert_allclose(counts["value"], -at.loc["exponent", "value"])
    energy = table[table["quantity"] == "kinetic_energy"].set_index("what")["value"]
    assert energy["begins"] == pytest.approx(0.2, rel=0.15) and energy["ends"] == pytest.approx(50, rel=0.4)

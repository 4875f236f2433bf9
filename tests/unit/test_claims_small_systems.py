"""The claims of sections 2 and 3 of the second paper: each holds in a world after its text, and notices where that is wrong."""

import runpy
from pathlib import Path

import numpy as np
import pytest
import small_systems
import xarray as xr
from worlds import alike, change, mirrored, times

from granugas.analysis.theory import energy_after_collisions, homogeneous_cooling
from granugas.claims import FAILS, HOLDS, NOT_MEASURED, judge

FILES = sorted((Path(__file__).parents[2] / "workflow/claims").glob("cluster1999_section[23]*.py"))
CLAIMS = {one.id: one for path in FILES for one in runpy.run_path(str(path))["CLAIMS"]}
R, TC, BIG, OTHER = "cluster1999_restitutions", "cluster1999_contact_times", "cluster1999_large", "tc1998_restitutions"
K, KX, KZ, T = "kinetic_energy", "kinetic_energy_x", "kinetic_energy_y", "sampling_time"
C, CE = "collisions_per_particle", "elastic_collisions_per_particle"


@pytest.fixture(scope="module")
def world():
    return small_systems.whole()


def after(collisions, factor):
    """A factor from a C/N on."""
    return lambda old: old * xr.DataArray(np.where(collisions < small_systems.COLLISIONS, factor, 1), dims="time")


def by_eq_3(restitution):
    return lambda old: energy_after_collisions(xr.DataArray(small_systems.COLLISIONS, dims="time"), restitution) + 0 * old


def by_eq_1(restitution):
    """K of Eq. 1 with that r."""

    def changed(world):
        tau = world[R]["tau"]
        return change(R, K, tau.copy(data=homogeneous_cooling(tau, restitution)), restitution=restitution)(world)

    return changed


def isotropic(name):
    """(Kx - Kz)/K is .02 everywhere."""
    return lambda world: world | {name: world[name].assign({KX: 0.51 * world[name][K], KZ: 0.49 * world[name][K]})}


def oriented(anisotropy):
    """(Kx - Kz)/K of the contact times, (realization, contact time), from C/N = 40 on."""

    def changed(world):
        data = world[TC]
        late = xr.DataArray(small_systems.COLLISIONS > 40, dims="time")
        shear = late * xr.DataArray(anisotropy, dims=("realization", "contact_time"))
        parts = {KX: data[K] * (1 + shear) / 2, KZ: data[K] * (1 - shear) / 2}
        return world | {TC: data.assign({name: part.transpose(*data[name].dims) for name, part in parts.items()})}

    return changed


WRONG = {
    "B-2-01": change(BIG, "equilibration_kurtosis", 0.6),
    "B-2-02": change(BIG, C, times(1.02)),
    "B-2-03": change(OTHER, K, times(0.85)),
    "B-2-04": change(BIG, K, times(1.2)),
    "B-3-01": change(R, "box_x", times(1.05)),
    "B-3-02": change(R, T, times(1.1)),
    "B-3-03": change(R, C, times(0.9), restitution=0.2),
    "B-3-04": change(R, K, after(800, 3), restitution=0.99),
    "B-3-05": change(R, K, after(800, 3), restitution=0.97),
    "B-3-06": by_eq_1(0.9),
    "B-3-07": change(R, C, times(1.1), restitution=0.99),
    "B-3-08": change(R, K, after(1, 0.7), restitution=0.95),
    "B-3-09": change(R, K, by_eq_3(0.95), restitution=0.95),
    "B-3-10": change(R, K, after(1, 2), restitution=0.8),
    "B-3-11": change(R, K, after(5, 1.5), restitution=0.9),
    "B-3-12": change(R, K, lambda old: old**3, restitution=0.2),
    "B-3-13": change(R, K, alike("realization")),
    "B-3-14": change(BIG, K, lambda old: old * np.exp(old["realization"])),
    "B-3-15": change(R, C, times(1.3), restitution=0.6),
    "B-3-16": change(R, C, times(5), restitution=0.2),
    "B-3-17": change(R, "box_x", times(0.1)),
    "B-3-18": change(TC, CE, times(0.01), contact_time=1e-10),
    "B-3-19": change(R, CE, times(10), restitution=0.8),
    "B-3-21": change(R, T, lambda old: old["time"] + 0 * old),
    "B-3-22": change(R, T, lambda old: np.log1p(old["time"]) + 0 * old, restitution=0.99),
    "B-3-23": change(R, K, by_eq_3(0.6), restitution=0.6),
    "B-3-24": change(R, CE, lambda old: 0.3 * xr.DataArray(small_systems.COLLISIONS, dims="time") + 0 * old, restitution=0.2),
    "B-3-25": change(R, KX, times(-1)),
    "B-3-26": isotropic(R),
    "B-3-27": change(R, KX, mirrored("restitution")),
    "B-3-28": change(TC, K, after(0.5, 2), contact_time=1e-3),
    "B-3-29": change(TC, T, after(0.5, 1.2), contact_time=1e-5),
    "B-3-30": change(TC, K, after(60, 4), contact_time=1e-6),
    "B-3-31": isotropic(TC),
    "B-3-32": oriented(0.9 * np.tile(small_systems.SIGNS[:, :1], 5)),
    "B-3-33": oriented(0.9 * np.tile(small_systems.SIGNS[:, :1], 5) + 0.01 * small_systems.SIGNS),
    "B-3-34": change(TC, KX, times(1.001), contact_time=1e-8),
    "B-3-35": change(TC, K, after(20, 0.1), contact_time=1e-3),
    "B-3-36": change(TC, K, times(0.5), contact_time=1e-3),
    "B-3-37": lambda world: world | {TC: world[TC].assign(sampling_time=world[TC][T].mean("contact_time") + 0 * world[TC][T])},
    "B-3-38": change(TC, CE, times(0.01), contact_time=1e-6),
}


def test_in_a_world_after_the_paper_all_holds_but_one_sentence(world):
    """That r > r_c stays homogeneous contradicts what the paper says of r <= .95."""
    table = judge(CLAIMS.values(), world)
    others = table[~table["verdict"].str.startswith(HOLDS)].set_index("id")["verdict"].to_dict()
    assert others == {"B-3-20": FAILS}


def test_no_claim_is_left_out():
    assert CLAIMS.keys() - WRONG.keys() == {"B-3-20"}


@pytest.mark.parametrize("name", WRONG)
def test_a_claim_notices_that_it_is_wrong(world, name):
    row = judge([CLAIMS[name]], WRONG[name](world)).iloc[0]
    assert row["verdict"] == FAILS, f"{row['expected']}: {row['measured']} ± {row['error']} {row['remark']}"


def test_a_homogeneous_system_above_the_critical_restitution_would_be_noticed(world):
    for r in (0.95, 0.9, 0.8):
        world = by_eq_1(r)(world)
    assert judge([CLAIMS["B-3-20"]], world).iloc[0]["verdict"].startswith(HOLDS)


def test_a_reduced_study_is_no_measurement(world):
    small = {name: data.assign_coords(n_particles=data["n_particles"] // 4) for name, data in world.items()}
    assert set(judge(CLAIMS.values(), small)["verdict"]) == {NOT_MEASURED}


@pytest.mark.filterwarnings("error")
def test_one_realization_is_enough_or_said_to_be_too_few(world):
    one = {name: data.isel(realization=[0]) for name, data in world.items()}
    table = judge(CLAIMS.values(), one).set_index("id")
    few = table["remark"][table["verdict"] == NOT_MEASURED]
    assert set(few) == {"fewer than 3 runs"}
    assert set(few.index) == {"B-3-13", "B-3-14", "B-3-33", "B-3-37"}

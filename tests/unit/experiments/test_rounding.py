"""Runs and their copies, few and short."""

from dataclasses import replace

import numpy as np
import pytest

from granugas.analysis.theory import collisions_until
from granugas.equilibrate import equilibrate, state_of
from granugas.experiments import rounding
from granugas.storage.variables import describe

SCENE = rounding.SCENES[1]


@pytest.fixture(scope="module")
def start():
    return state_of(equilibrate(SCENE, seed=7))


@pytest.fixture(scope="module")
def measured():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(rounding, "STOPS", 80)
        return describe(rounding.measure(rounding.SMALL))


def test_last_bit(start):
    rng = np.random.default_rng(0)
    changed = rounding.last_bit(start, rng).position
    np.testing.assert_array_equal(np.abs(np.spacing(np.minimum(changed, start.position))), np.abs(changed - start.position))
    assert {-1.0, 1.0} == set(np.sign(changed - start.position).ravel())
    corner = rounding.last_bit(replace(start, position=np.zeros_like(start.position)), rng).position
    assert (corner >= 0).all() and (corner < start.box).all()


def test_reordered_is_the_same_gas(start):
    order = np.random.default_rng(0).permutation(SCENE.n_particles)
    other = rounding.reordered(start, order)
    for name in ("position", "velocity", "last_collision_time", "last_collision_interval"):
        np.testing.assert_array_equal(getattr(other, name)[np.argsort(order)], getattr(start, name))


def test_without_a_change_nothing_parts(start):
    times = np.linspace(0, 0.1, 30)
    one, other = (rounding.follow(SCENE, start, times) for _ in range(2))
    np.testing.assert_array_equal(rounding.separation(one, other, SCENE, start.box), 0)


def test_stops_are_equal_steps_of_collisions():
    np.testing.assert_allclose(rounding.stops(1.0)[:3], [0, 0.5, 1.0])
    np.testing.assert_allclose(collisions_until(rounding.stops(0.9), 0.9), rounding.stops(1.0), rtol=1e-9)


def test_copies_begin_together_and_part(measured):
    apart = measured["separation"]
    assert float(apart.isel(stop=0).max()) < 1e-13
    assert float(apart.isel(stop=-1).min()) > 1
    assert (apart.isel(stop=20) > apart.isel(stop=0)).mean() > 0.9  # another order rounds alike for a while
    early = measured.isel(stop=10)  # five collisions a particle: the same to ten digits
    np.testing.assert_allclose(early["copy_kinetic_energy"] / early["kinetic_energy"], 1, atol=1e-9)
    late = measured.sel(restitution=0.9).isel(stop=-1)
    assert (late["copy_kinetic_energy"] != late["kinetic_energy"]).all()


def test_runs_cool_at_equal_times(measured):
    cooling = measured.sel(restitution=0.9)
    np.testing.assert_allclose(measured["kinetic_energy"].sel(restitution=1.0), 1, rtol=1e-9)
    assert (cooling["kinetic_energy"].diff("stop") < 0).all()
    assert np.ptp(cooling["tau"].values, axis=cooling["tau"].get_axis_num("realization")).max() == 0
    counted = cooling["collisions_per_particle"].isel(stop=20)
    np.testing.assert_allclose(counted, 10, rtol=0.05)

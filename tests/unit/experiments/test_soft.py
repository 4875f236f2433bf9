"""Columns of soft beads against TC and IHS: who dissipates when."""

import numpy as np
import pytest

from granugas.experiments import soft
from granugas.storage.variables import describe


@pytest.fixture(scope="module")
def left():
    """sqrt(E'/E) of the small plan."""
    return np.sqrt(describe(soft.measure(soft.SMALL))["energy_left"])


def test_one_bead_bounces_back_with_r(left):
    for r in soft.SMALL.restitutions:
        np.testing.assert_allclose(left.sel(n_particles=1, restitution=r), r, atol=3e-3)


def test_apart_from_each_other_all_models_are_one(left):
    models = left.sel(n_particles=3, impact_interval=30.0)
    np.testing.assert_allclose(models.sel(model="TC"), models.sel(model="IHS"), rtol=1e-9)
    np.testing.assert_allclose(models.sel(model="soft"), models.sel(model="IHS"), atol=5e-3)


def test_contacts_of_many_dissipate_less(left):
    """Refs. 15 to 17 of the paper; the TC model does likewise, and more than that."""
    near = left.sel(impact_interval=0.03)
    for n in (3, 8):
        there = near.sel(n_particles=n)
        assert np.all(there.sel(model="soft") > left.sel(model="soft", n_particles=n, impact_interval=1.0))
        assert np.all(there.sel(model="TC") > there.sel(model="soft"))
    assert np.all(near.sel(model="soft", n_particles=8) > near.restitution + 0.05)
    assert np.all(near.sel(model="IHS", n_particles=3) < near.restitution**2)


def test_a_collapse_is_no_number():
    assert soft.after_impact("IHS", 0.6, 12, 1.0) == (pytest.approx(np.nan, nan_ok=True), -1)
    energy, collisions = soft.after_impact("soft", 0.6, 12, 1.0)
    assert 0 < energy < 1 and collisions >= 11


def test_who_has_parted():
    places = soft.DIAMETER * np.array([0.7, 2.0, 3.1])
    assert soft.has_parted(places, np.array([0.1, 0.1, 0.2]))
    assert not soft.has_parted(places, np.array([-0.1, 0.1, 0.2]))
    assert not soft.has_parted(places, np.array([0.1, 0.3, 0.2]))
    assert not soft.has_parted(soft.DIAMETER * np.array([0.7, 1.6, 3.1]), np.array([0.1, 0.1, 0.2]))

import numpy as np
import pytest

from granugas.experiments.contact import measure
from granugas.storage.variables import describe


@pytest.fixture(scope="module")
def contact():
    return describe(measure())


def test_instants(contact):
    t_c = contact.attrs["contact_time"]
    assert float(contact["contact_end"] - contact["contact_begin"]) == pytest.approx(t_c, rel=1e-7)
    assert float(contact["collision_time"]) == pytest.approx(float(contact["contact_begin"]), rel=1e-12)


@pytest.mark.parametrize("kind", ["soft", "hard"])
def test_both_pairs_leave_alike(contact, kind):
    gap = contact[f"{kind}_position"].diff("particle").values[:, 0]
    speeds = np.diff(gap) / np.diff(contact["experiment_time"])
    assert speeds[0] == pytest.approx(-1.0, rel=1e-9)
    assert speeds[-1] == pytest.approx(contact.attrs["restitution"], rel=1e-6)
    np.testing.assert_allclose(contact[f"{kind}_position"].sum("particle"), 0, atol=1e-15)


def test_only_soft_particles_overlap(contact):
    d = contact.attrs["diameter"]
    assert contact["hard_position"].diff("particle").min() > d * (1 - 1e-12)
    assert 0.7 * d < contact["soft_position"].diff("particle").min() < 0.8 * d


def test_a_sample_is_where_the_particles_turn(contact):
    at = contact["experiment_time"].values
    assert np.abs(at - float(contact["collision_time"])).min() < 1e-15

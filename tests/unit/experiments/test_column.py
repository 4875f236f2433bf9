"""Columns of beads on a wall: exact edges, and what the TC model makes of a collapse."""

import numpy as np
import pytest

from granugas.analysis.theory import column_restitution, cushion_restitution
from granugas.experiments import column
from granugas.storage.variables import describe


@pytest.fixture(scope="module")
def measured():
    return describe(column.measure(column.SMALL))


def test_two_and_three_beads_collapse_below_the_exact_edge():
    """3 - 2 sqrt 2 and 1/3 on a wall of their own kind; on an elastic one a bead less is as a bead more on the other kind."""
    for n in (2, 3):
        edge = float(column_restitution(n))
        assert column.collapses(n, edge - 2e-3, "as beads")
        assert not column.collapses(n, edge + 2e-3, "as beads")
    assert not column.collapses(2, 1e-3, "elastic")
    assert column.critical_restitution(3, "elastic", 1e-3) == pytest.approx(column_restitution(2), abs=1e-3)


def test_ten_beads_lie_between_the_models():
    """The cushion model is the better one towards the elastic limit."""
    edge = column.critical_restitution(10, "as beads", 2e-3)
    assert abs(edge - cushion_restitution(10)) < 0.01
    assert abs(edge - column_restitution(10)) < 0.01


def test_energy_is_lost_as_the_rule_says():
    """One bead bounces back with r of its speed; elastic beads keep all."""
    assert column.parted(1, 0.5, 0.0) == (0, pytest.approx(0.25, rel=1e-12))
    collisions, energy = column.parted(4, 1.0, 0.0)
    assert collisions == 6 and energy == pytest.approx(1.0, rel=1e-12)


def test_below_the_edge_the_tc_model_parts(measured):
    collisions = measured["column_collisions"].transpose("contact_time", "depth").values
    assert np.all(collisions >= column.TC_SIZE * (column.TC_SIZE - 1) / 2)
    assert np.all(np.diff(collisions.mean(axis=1)) > 0)  # a shorter t_c costs more
    assert np.all((measured["energy_left"] > 0) & (measured["energy_left"] < 0.2))


def test_the_edges_of_a_plan(measured):
    edges = measured["critical_restitution"].sel(wall="as beads").values
    np.testing.assert_allclose(edges, column_restitution(measured["n_particles"].values), atol=2e-2)

"""Whole runs and quality factors of a made-up study whose answers are known."""

import numpy as np
import pytest
import xarray as xr
from made_up import RATE, N, elastic_study

from granugas.analysis import theory
from granugas.analysis.elastic import quality_factors, whole_runs


def test_whole_runs():
    runs = whole_runs(elastic_study())
    assert runs["collision_rate"].dims == runs["branch"].dims == ("area_fraction", "realization")
    assert runs["elastic_collision_fraction"].dims == ("contact_time", "area_fraction", "realization")
    np.testing.assert_allclose(runs["collision_rate"], RATE)
    np.testing.assert_allclose(runs["reduced_pressure"], 2)
    np.testing.assert_allclose(runs["n_particles"], N)
    assert runs["snapshots"] == 2
    c_e = theory.elastic_collision_fraction(runs["contact_time"].values, RATE)
    np.testing.assert_allclose(runs["elastic_collision_fraction"].isel(area_fraction=0, realization=2), 0.95 * c_e)


def test_quality_factors():
    factors = quality_factors(whole_runs(elastic_study()), least=0)
    for name, expected in {"q_n": 1.0, "q_n_time": 1.0, "q_c": 0.95, "q_e": 1.25}.items():
        np.testing.assert_allclose(factors[name], expected)


def test_points_with_few_counts_are_hidden():
    """At t_c = 1e-7 s the three runs are expected to have 6 elastic collisions and .03 elastic particles in snapshots."""
    factors = quality_factors(whole_runs(elastic_study()), least=7)
    for factor in factors.values():
        assert np.isnan(factor.isel(contact_time=0)).all()
        assert not np.isnan(factor.isel(contact_time=1)).any()
    some = quality_factors(whole_runs(elastic_study()), least=5.9)
    assert not np.isnan(some["q_c"]).any() and np.isnan(some["q_n"].isel(contact_time=0)).all()
    assert not np.isnan(quality_factors(whole_runs(elastic_study()), least=0.029)["q_n"]).any()


def test_quality_by_the_measured_rate():
    runs = whole_runs(elastic_study())
    half = runs.assign(enskog_rate=runs["enskog_rate"] / 2)
    np.testing.assert_allclose(quality_factors(half, 0)["q_c"].isel(contact_time=0), 1.9, rtol=1e-3)
    np.testing.assert_allclose(quality_factors(half, 0, "collision_rate")["q_c"], 0.95)


def test_a_study_of_several_sizes_is_refused():
    both = xr.concat([elastic_study(), elastic_study().assign_coords(n_particles=[2 * N])], "n_particles")
    with pytest.raises(ValueError, match="length greater than one"):
        whole_runs(both)

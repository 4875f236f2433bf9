"""Few snapshots and short averages err more than many and long ones, about the right mean."""

import numpy as np
import pytest

from granugas.analysis import theory
from granugas.experiments import accuracy_sampling as experiment
from granugas.storage.variables import describe


@pytest.fixture(scope="module")
def measured():
    return describe(experiment.measure(experiment.Plan(8, (5, 20, 80, 640), (1.0, 4.0, 16.0, 128.0))))


def test_the_truth_is_that_of_theory(measured):
    found = measured.sel(case="duration")["truth"]
    assert float(found.sel(observable="P V/E")) == pytest.approx(
        theory.reduced_pressure(experiment.GAS.area_fraction), rel=5e-3
    )
    rate = float(found.sel(observable="collision rate"))
    for t_c in experiment.GAS.contact_time:
        expected = theory.elastic_particle_fraction(t_c, rate)
        assert float(found.sel(observable=f"n_e at t_c = {t_c:g} s")) == pytest.approx(expected, rel=0.03)


def test_both_ways_agree_about_n_e(measured):
    both = measured["truth"].sel(observable="n_e at t_c = 0.0001 s")
    assert float(both.sel(case="snapshots")) == pytest.approx(float(both.sel(case="duration")), rel=0.01)


def test_independent_snapshots_err_by_chance(measured):
    """Within 1e-5 s nearly nobody stays elastic from one snapshot to the next: sqrt((1 - n_e)/(N n_e k))."""
    error = measured["relative_error"].sel(case="snapshots", observable="n_e at t_c = 1e-05 s")
    n_e, n = float(measured["truth"].sel(case="snapshots", observable="n_e at t_c = 1e-05 s")), experiment.GAS.n_particles
    for k in (5, 20, 80):
        assert float(error.sel(setting=k)) == pytest.approx(np.sqrt((1 - n_e) / (n * n_e * k)), rel=0.6)


def test_longer_averages_err_less(measured):
    error = measured["relative_error"].sel(case="duration", observable=["P V/E", "collision rate"])
    assert (error.sel(setting=1) > 2 * error.sel(setting=16)).all() and (error < 0.1).any("setting").all()


def test_more_costs_more(measured):
    seconds = measured["cpu_seconds"]
    assert seconds.sel(case="duration", setting=16) > seconds.sel(case="duration", setting=1)
    assert seconds.sel(case="snapshots", setting=80) > seconds.sel(case="snapshots", setting=5)


def test_nothing_is_measured_where_a_case_has_no_setting(measured):
    assert measured["relative_error"].sel(case="duration", setting=20).isnull().all()
    assert measured["relative_error"].sel(case="snapshots", observable="P V/E").isnull().all()
    assert 640 not in measured["setting"] and 128 not in measured["setting"]

"""A long t_c is wrong, short ones agree, and all begin alike."""

import numpy as np
import pytest

from granugas.experiments import accuracy_contact_time as experiment
from granugas.storage.variables import describe


@pytest.fixture(scope="module")
def measured():
    return describe(experiment.measure(experiment.SMALL)).squeeze("case")


def test_the_limit_is_met_below_the_papers_contact_time(measured):
    short = measured.where(measured["setting"] <= experiment.SHORT, drop=True).dropna("observable")
    assert (short["relative_error"] <= 4 * short["relative_error_error"] + 1e-12).mean() > 0.9
    assert short.sizes == {"setting": 3, "observable": 6}


def test_a_contact_longer_than_the_time_between_collisions_keeps_the_energy(measured):
    elastic = measured.sel(setting=1e-2)
    assert float(elastic["measured"].sel(observable="K at 0.5 s")) > 0.9
    assert float(elastic["relative_error"].sel(observable="K at 0.5 s")) > 100
    early = elastic.sel(observable="<M> at 0.1 s")
    assert early["relative_error"] > 2 * early["relative_error_error"] > 0


def test_what_vanishes_has_values_and_no_relative_error(measured):
    for name in ("n_e at 0.1 s", "E_e/E at 0.1 s"):
        value = measured.sel(observable=name).sortby("setting")
        assert value["truth"] == 0 and value["relative_error"].isnull().all()
        assert np.all(np.diff(value["measured"]) >= 0) and value["measured"][-1] > 0.9
    assert measured["measured"].sel(observable="n_e at 0.1 s", setting=1e-7) < 1e-2


def test_all_begin_alike(monkeypatch):
    """The looks before the first collision that dissipates less are the same for all t_c."""
    monkeypatch.setattr(experiment, "SHORT", 1e-3)
    plan = experiment.Plan((experiment.Size(378, (1e-6, 1e-5, 1e-4), 2),), (1e-6, 2e-6))
    found = experiment.measure(plan).squeeze("case")
    alike = found["measured"].sel(observable=["K at 1e-06 s", "<M> at 2e-06 s"])
    assert (alike == alike.isel(setting=0)).all() and (found["measured_error"].sel(observable="<M> at 1e-06 s") > 0).all()
    long = found.sel(observable="n_e at 1e-06 s", setting=1e-4)
    assert long["measured"] > 0.01 and long["truth"] == 0 and np.isnan(long["relative_error"])  # whatever the line says


def test_the_cost_is_that_of_a_run(measured):
    assert (measured["cpu_seconds"] > 0).all() and (measured["cpu_seconds"] < 5).all()


def test_the_full_plan_is_that_of_the_papers():
    small, large = experiment.FULL.sizes
    assert (small.n_particles, large.n_particles) == (5740, 79524) and experiment.FULL.looks == (1.0, 5.0)
    assert min(small.contact_times) == 1e-12 and max(small.contact_times) == 1e-2 and min(large.contact_times) == 1e-8

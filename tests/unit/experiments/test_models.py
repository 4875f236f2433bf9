"""Every model is a scene that can be simulated, and the plain one collapses where the TC model does not."""

import numpy as np
import pytest

from granugas.dynamics.events.effects import called_by
from granugas.experiments import models
from granugas.storage.variables import describe


@pytest.fixture(scope="module")
def measured():
    return describe(models.measure(models.SMALL._replace(places=("free cooling", "bed"))))


def test_models_differ_in_their_files_and_places_too():
    kinds = {tuple(sorted(called_by(models.scene_of(model)).items())) for model in models.MODELS}
    assert len(kinds) == len(models.MODELS)
    places = {tuple(sorted(called_by(models.scene_of("TC", place)).items())) for place in models.PLACES}
    assert len(places) == len(models.PLACES)


def test_the_plain_model_collapses_and_the_tc_model_does_not(measured):
    assert measured["stop_reason"].sel(model="IHS").values.tolist() == ["inelastic_collapse"]
    assert measured["stop_reason"].sel(model="TC").values.tolist() == ["time"]
    assert np.isfinite(measured["collapse_time"].sel(model="IHS", place="bed")).all()
    assert np.isinf(measured["collapse_time"].sel(model="TC")).all()


def test_runs_are_whole(measured):
    tc = measured.sel(model="TC", realization=0)
    assert tc["kinetic_energy"].isel(time=0) == 1 and tc["kinetic_energy"].notnull().all()
    assert 1 < tc["mean_cluster_size"] < tc["largest_cluster_size"] < measured.attrs["n_particles"]
    collapsed = measured["kinetic_energy"].sel(model="IHS", realization=0)
    assert collapsed.isnull().any() and collapsed[0] == 1

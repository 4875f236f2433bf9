"""What claims are measured on."""

import numpy as np
import pytest
import xarray as xr

from granugas.measured import (
    NotMeasured,
    at_times,
    common,
    elastic_share,
    enough_runs,
    experiment,
    in_words,
    last_common,
    nearest,
    runs,
    series,
    side_by_side,
)


@pytest.fixture
def study():
    energy = xr.DataArray(np.arange(24.0).reshape(1, 2, 3, 4), dims=("n_particles", "contact_time", "realization", "time"))
    energy[0, 0, 2] = np.nan
    coords = {"n_particles": [42], "contact_time": [1e-5, 1e-3], "realization": [0, 1, 2]}
    return xr.Dataset({"kinetic_energy": energy}, coords, {"restitution": 0.4})


def test_runs_of_a_point(study):
    found = runs({"s": study}, "s", n_particles=42, contact_time=1e-5, restitution=0.4)["kinetic_energy"]
    assert found.dims == ("realization", "time")
    assert np.array_equal(found, study["kinetic_energy"].values[0, 0, :2])
    other = runs({"s": study}, "s", contact_time=1e-3)["kinetic_energy"]
    assert np.array_equal(other, study["kinetic_energy"].values[0, 1])
    assert runs({"s": study}, "s", n_particles=42)["kinetic_energy"].dims == ("contact_time", "realization", "time")


@pytest.mark.parametrize(
    ("name", "point", "reason"),
    [
        ("t", {}, "no study t"),
        ("s", {"n_particles": 5740}, "s has n_particles = 42, not 5740"),
        ("s", {"contact_time": 1e-6}, "s has contact_time = 1e-05, 0.001, not 1e-06"),
        ("s", {"restitution": 0.2}, "s has restitution = 0.4, not 0.2"),
    ],
)
def test_what_is_missing_is_named(study, name, point, reason):
    with pytest.raises(NotMeasured, match=reason.replace(".", r"\.")):
        runs({"s": study}, name, **point)


def test_an_experiment_by_its_name(study):
    assert experiment({"contact": study}, "contact") is study
    with pytest.raises(NotMeasured, match="no experiment contact"):
        experiment({}, "contact")


def test_two_runs_are_not_enough_for_their_scatter(study):
    assert enough_runs(study) is study
    with pytest.raises(NotMeasured, match="fewer than 3 runs"):
        enough_runs(study.isel(realization=[0, 1]))


@pytest.fixture
def two_runs():
    """Sampled at times of their own, the second one longer; every tenth collision is elastic, in the second every fifth."""
    count = np.array([[1.0, 2.0, 4.0], [1.0, 3.0, 5.0]])
    variables = {
        "sampling_time": [[1.0, 2.0, 4.0], [1.0, 4.0, 8.0]],
        "kinetic_energy": [[1.0, 0.25, 1 / 16], [1.0, 1 / 16, 1 / 64]],
        "collisions_per_particle": count,
        "elastic_collisions_per_particle": count * [[0.1], [0.2]],
    }
    return xr.Dataset({name: (("realization", "time"), values) for name, values in variables.items()})


def test_series_have_a_row_for_each_realization(two_runs):
    assert series(two_runs["kinetic_energy"].transpose("time", "realization")).shape == (2, 3)
    assert series(two_runs["kinetic_energy"])[1, 2] == 1 / 64


def test_what_the_realizations_have_in_common(two_runs):
    assert list(common(two_runs["collisions_per_particle"])) == [1, 2.5, 4.5]


def test_the_nearest_sample():
    assert [nearest([1, 2, 4], wanted) for wanted in (0, 2.9, 3.1, 9)] == [0, 1, 2, 2]


def test_energies_at_common_times(two_runs):
    assert np.allclose(at_times(two_runs, "kinetic_energy", [2.0, 4.0]), [[1 / 4, 1 / 16], [1 / 4, 1 / 16]])


def test_a_run_that_ends_first_ends_the_common_time(two_runs):
    assert last_common([two_runs, two_runs.isel(realization=[1])]) == pytest.approx(4)
    assert last_common([two_runs]) < 4
    assert not np.isnan(at_times(two_runs, "kinetic_energy", [last_common([two_runs])])).any()


def test_elastic_share_of_the_collisions(two_runs):
    assert np.allclose(elastic_share(two_runs), [0.1, 0.2])
    only_later = two_runs.copy(deep=True)
    only_later["elastic_collisions_per_particle"][:, 0] = 0
    assert np.allclose(elastic_share(only_later, 0), [0.4 / 3, 1 / 4])


def test_measurements_side_by_side():
    values, errors = side_by_side([(1, 0.1), (np.float64(2), 0.2)])
    assert list(values) == [1, 2] and list(errors) == [0.1, 0.2]


def test_many_numbers_are_told_by_their_extremes():
    assert in_words([1, 2.5]) == "1, 2.5"
    assert in_words(range(10)) == "0 to 9 (10 values)"

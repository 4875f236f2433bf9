import json

import numpy as np
import pytest
import xarray as xr

from granugas.storage.pooling import pool, tell_stops, with_errors

BOTH = {"n_particles": 3, "restitution": 0.8}


def test_grid_keys_and_realization_become_the_first_dimensions(make_run):
    parts = [make_run(k, restitution=r) for r in (0.8, 0.4) for k in (0, 1, 2)]
    pooled = pool(parts, ["n_particles", "restitution"])
    assert pooled["position"].dims == ("n_particles", "restitution", "realization", "snapshot", "particle", "axis")
    assert pooled["kinetic_energy"].dims == ("n_particles", "restitution", "realization", "time")
    assert pooled["wall_time"].dims == ("n_particles", "restitution", "realization")
    assert pooled["restitution"].values.tolist() == [0.4, 0.8]
    assert pooled["n_particles"].dtype.kind == pooled["events"].dtype.kind == "i"
    for part in parts:
        where = {key: part.attrs[key] for key in ("n_particles", "restitution")} | {"realization": part["realization"]}
        for name in ("kinetic_energy", "position", "trajectory", "initial_y", "events", "stop_reason", "wall_time"):
            assert (pooled[name].sel(where).values == part[name].values).all()


def test_what_is_missing_is_nan_or_an_empty_text(make_run):
    pooled = pool([make_run(0), make_run(1), make_run(0, **BOTH)], ["n_particles", "restitution"])
    assert pooled.sizes["particle"] == 5
    small = pooled.sel(BOTH, drop=True)
    assert not np.isnan(small["initial_y"].sel(realization=0)[:3]).any()
    assert np.isnan(small["initial_y"].sel(realization=0)[3:]).all()
    assert np.isnan(small["position"].sel(realization=1)).all()
    assert small["stop_reason"].values.tolist() == ["time", ""]
    assert {type(text) for text in small["stop_reason"].values} == {str}
    assert small["events"].values[0] == 40 and np.isnan(small["events"].values[1])
    filled = [pooled[name].notnull().sum().item() for name in ("events", "kinetic_energy", "initial_y", "position")]
    assert filled == [3, 12, 5 + 5 + 3, 4 * (5 + 5 + 3)]


def test_the_order_of_the_parts_does_not_matter(make_run):
    parts = [make_run(k, restitution=r) for r in (0.8, 0.4) for k in (0, 1)]
    xr.testing.assert_identical(pool(parts, ["restitution"]), pool(parts[::-1], ["restitution"]))


def test_a_list_of_contact_times_fills_them_and_repeats_the_rest(make_run):
    elastic = make_run(restitution=1.0, contact_time=(1.0e-4, 1.0e-6))
    others = [make_run(restitution=0.4, contact_time=t) for t in (1.0e-6, 1.0e-5)]
    pooled = pool([elastic, *others], ["restitution", "contact_time"])
    assert pooled["contact_time"].values.tolist() == [1.0e-6, 1.0e-5, 1.0e-4]
    assert pooled["elastic_collision_fraction"].dims == ("restitution", "contact_time", "realization", "time")
    found = pooled["elastic_collision_fraction"].sel(restitution=1.0, realization=0)
    expected = elastic["elastic_collision_fraction"].sel(contact_time=[1.0e-6, 1.0e-4])
    assert (found.sel(contact_time=[1.0e-6, 1.0e-4]).values == expected.values.T).all()
    assert np.isnan(found.sel(contact_time=1.0e-5)).all()
    for t in (1.0e-4, 1.0e-6):
        repeated = pooled.sel(restitution=1.0, contact_time=t, realization=0)
        assert (repeated["position"].values == elastic["position"].values).all()
        assert repeated["events"] == elastic["events"]


def test_a_list_of_one_contact_time_is_pooled_as_any_other(make_run):
    pooled = pool([make_run(restitution=1.0, contact_time=(1.0e-4,))], ["contact_time"])
    assert pooled["contact_time"].values.tolist() == [1.0e-4]
    assert pooled["elastic_collision_fraction"].notnull().all()


def test_runs_that_end_by_collisions_keep_their_own_times(make_run):
    parts = [make_run(0, until_collisions=True), make_run(1, until_collisions=True, samples=6)]
    pooled = pool(parts, ["restitution"])
    assert pooled["time"].values.tolist() == [0, 1, 2, 3, 4, 5]
    assert pooled["sampling_time"].dims == ("restitution", "realization", "time")
    assert pooled["sampling_time"].sel(realization=0).notnull().sum() == 4
    assert (pooled["sampling_time"].sel(realization=1).values[0] == parts[1]["sampling_time"].values).all()
    assert pooled["time"].attrs["long_name"] == "index of the sample"


def test_runs_that_end_in_time_need_the_same_times(make_run):
    pooled = pool([make_run(0), make_run(1)], ["restitution"])
    assert pooled["time"].dims == ("time",) and pooled["time"].attrs["units"] == "s"
    for other in (make_run(1, samples=5), make_run(1).assign_coords(time=[0, 0.1, 0.2, 1.0])):
        with pytest.raises(ValueError, match="time: the sampling times of the runs differ"):
            pool([make_run(0), other], ["restitution"])


def test_clusters_come_along_with_the_bins_of_the_largest_system(make_run):
    def merged(n, k):
        bins = 2 ** np.arange(n)
        found = xr.Dataset(
            {
                "cluster_count": (("time", "distance_factor"), np.full((4, 2), n)),
                "cluster_size_distribution": (("time", "distance_factor", "cluster_size"), np.full((4, 2, n), 1.0 * n)),
            },
            {"cluster_size": bins, "cluster_size_upper": ("cluster_size", 2 * bins), "distance_factor": [1.4, 1.05]},
        )
        return make_run(k, n_particles=n).merge(found)

    pooled = pool([merged(3, 0), merged(5, 0), make_run(1)], ["n_particles"])
    assert pooled["cluster_count"].dims == ("n_particles", "realization", "time", "distance_factor")
    assert pooled["cluster_size"].values.tolist() == [1, 2, 4, 8, 16]
    assert pooled["cluster_size_upper"].dims == ("cluster_size",)
    assert pooled["cluster_size_upper"].values.tolist() == [2, 4, 8, 16, 32]
    small = pooled["cluster_size_distribution"].sel(n_particles=3, realization=0, time=0)
    assert (small[:, :3] == 3).all() and np.isnan(small[:, 3:]).all()
    assert np.isnan(pooled["cluster_count"].sel(n_particles=5, realization=1)).all()


def test_coordinates_are_matched_by_value(make_run):
    gap = make_run(0).isel(snapshot=[0]).merge({"x": 1.0}).drop_vars("x")
    other = make_run(1).assign_coords(snapshot=[0.15, 0.05])
    pooled = pool([gap, other], ["restitution"]).sel(restitution=0.4)
    assert pooled["snapshot"].values.tolist() == [0.05, 0.1, 0.15]
    assert (pooled["position"].sel(realization=1, snapshot=0.15).values == other["position"].values[0]).all()
    assert (pooled["position"].sel(realization=1, snapshot=0.05).values == other["position"].values[1]).all()
    assert np.isnan(pooled["position"].sel(realization=1, snapshot=0.1)).all()


def test_attributes_in_common_stay_and_the_box_becomes_variables(make_run, caplog):
    parts = [make_run(0), make_run(0, **BOTH).assign_attrs(mood="good")]
    for i, part in enumerate(parts):
        part.attrs |= {
            "provenance": json.dumps({"package": "granugas 0", "parameters": {"seed": i}}),
            "history": str(i),
        }
    pooled = pool(parts, ["n_particles", "restitution"])
    assert pooled["box_y"].sel(n_particles=5, restitution=0.4).item() == 7.5
    assert pooled["box_x"].attrs["units"] == "m"
    assert pooled.attrs["diameter"] == 1.0e-3 and pooled.attrs["boundary"] == "periodic"
    assert json.loads(pooled.attrs["provenance"]) == {"package": "granugas 0", "parameters": {"seed": [1, 0]}}
    assert not {"n_particles", "restitution", "box_x", "mood", "history"} & set(pooled.attrs)
    assert len(caplog.records) == 1 and "attribute mood differs" in caplog.text


def test_what_belongs_to_one_run_is_a_variable_even_if_there_is_one_run_only(make_run):
    pooled = pool([make_run(0).assign_attrs(branch="fluid", equilibration_kurtosis=1.01)], [])
    for name, value in {"box_x": 5.0, "branch": "fluid", "equilibration_kurtosis": 1.01}.items():
        assert pooled[name].dims == ("realization",) and pooled[name].item() == value and name not in pooled.attrs


def test_attributes_of_a_variable_stay_where_all_runs_agree(make_run):
    parts = [make_run(k) for k in (0, 1)]
    for k, part in enumerate(parts):
        part["kinetic_energy"].attrs = {"window": "4 samples", "number": k}
    pooled = pool(parts, [])
    assert pooled["kinetic_energy"].attrs["window"] == "4 samples" and "number" not in pooled["kinetic_energy"].attrs


def test_errors_over_realizations_stand_beside_observables(make_run):
    parts = [make_run(k, restitution=r) for r in (0.8, 0.4) for k in (0, 1, 2)]
    pooled = with_errors(pool(parts, ["restitution"]))
    names = {str(name).removesuffix("_error") for name in pooled if str(name).endswith("_error")}
    assert names == {"kinetic_energy", "elastic_collision_fraction"}  # not position, trajectory, seed, events, cpu_time ...
    found, values = pooled["kinetic_energy_error"], pooled["kinetic_energy"].values
    assert found.dims == ("restitution", "time")
    np.testing.assert_allclose(found.values, np.std(values, axis=1, ddof=1) / np.sqrt(3), rtol=1e-13)
    assert pooled["kinetic_energy"].attrs["ancillary_variables"] == "kinetic_energy_error"
    assert found.attrs["units"] == "1" and found.attrs["long_name"].startswith("standard error of the mean over realizations: ")


def test_an_error_needs_two_runs_that_reached_the_sample(make_run):
    parts = [make_run(k, restitution=r) for r, runs in ((0.8, 3), (0.4, 1)) for k in range(runs)]
    parts[1]["kinetic_energy"][2:] = np.nan
    parts[2]["kinetic_energy"][3:] = np.nan
    pooled = with_errors(pool(parts, ["restitution"]))
    found, values = pooled["kinetic_energy_error"], pooled["kinetic_energy"].sel(restitution=0.8).values
    assert np.isnan(found.sel(restitution=0.4)).all()
    error = abs(values[0, 2] - values[2, 2]) / 2  # of two values
    assert found.sel(restitution=0.8).values[2] == pytest.approx(error, rel=1e-13)
    assert np.isnan(found.sel(restitution=0.8).values).tolist() == [False, False, False, True]


def test_whole_numbers_have_errors_too_and_clusters_all_their_dimensions(make_run):
    counts = [np.arange(8).reshape(4, 2) + shift for shift in (0, 3)]
    found = [xr.Dataset({"cluster_count": (("time", "distance_factor"), c)}, {"distance_factor": [1.05, 1.4]}) for c in counts]
    pooled = with_errors(pool([make_run(k).merge(part) for k, part in enumerate(found)], []))
    assert pooled["cluster_count_error"].dims == ("time", "distance_factor")
    np.testing.assert_allclose(pooled["cluster_count_error"], 1.5)


def test_one_realization_has_no_error(make_run):
    pooled = pool([make_run(0)], ["restitution"])
    xr.testing.assert_identical(with_errors(pooled), pooled)


def test_runs_that_stopped_are_counted_aloud(make_run, caplog):
    ends = ["time", "inelastic_collapse", "max_seconds", "inelastic_collapse"]
    parts = [make_run(k).assign(stop_reason=end, stop_time=0.5 - 0.1 * k) for k, end in enumerate(ends)]
    tell_stops(pool([*parts, make_run(0, restitution=0.8)], ["restitution"]))
    assert [record.getMessage() for record in caplog.records] == [
        "inelastic_collapse: 2 of 5 runs stopped before their end, the first at t = 0.2 s, NaN after it",
        "max_seconds: 1 of 5 runs stopped before their end, the first at t = 0.3 s, NaN after it",
    ]


def test_of_runs_that_came_to_their_end_nothing_is_said(make_run, caplog):
    tell_stops(pool([make_run(0), make_run(1).assign(stop_reason="collisions_per_particle")], ["restitution"]))
    assert caplog.records == []


def test_what_cannot_be_pooled_is_refused(make_run):
    with pytest.raises(ValueError, match="no parts"):
        pool([], ["restitution"])
    with pytest.raises(ValueError, match=r"restitution = 0\.4, realization = 1: 2 parts have this place"):
        pool([make_run(0), make_run(1), make_run(1)], ["restitution"])
    with pytest.raises(KeyError, match="charge: no attribute"):
        pool([make_run(0)], ["charge"])
    with pytest.raises(KeyError, match="temperature: no such variable"):
        pool([make_run(0).assign(temperature=1.0)], ["restitution"])

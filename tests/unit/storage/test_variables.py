import numpy as np
import pytest
import xarray as xr

from granugas.scene import SCENE_KEYS
from granugas.storage.variables import VARIABLES, describe, variable_of

UNITS = {
    "1": "tau kinetic_energy kinetic_energy_x kinetic_energy_y collisions_per_particle elastic_collisions_per_particle "
    "elastic_collision_fraction elastic_particle_fraction elastic_energy_fraction reduced_pressure cluster_count "
    "mean_cluster_size weighted_cluster_size largest_cluster_size cluster_size_distribution "
    "collisional_stress_xx collisional_stress_xy "
    "collisional_stress_yx collisional_stress_yy cluster_size distance_factor realization",
    "s": "time sampling_time snapshot contact_time last_collision_time last_collision_interval wall_time cpu_time stop_time",
    "s-1": "collision_rate enskog_rate collision_frequency",
    "m": "position trajectory initial_y diameter box_x box_y",
    "m s-1": "velocity trajectory_velocity velocity_half_width",
}


@pytest.mark.parametrize(("units", "name"), [(units, name) for units, names in UNITS.items() for name in names.split()])
def test_units_of_the_contract(units, name):
    assert VARIABLES[name].units == units


def test_every_variable_is_named_and_texts_have_no_units():
    assert {"seed", "events", "stop_reason", "axis", *SCENE_KEYS} <= set(VARIABLES)
    assert all(variable.long_name for variable in VARIABLES.values())
    texts = {name for name, variable in VARIABLES.items() if variable.units is None}
    of_scene = {"dynamics", "lattice", "boundary", "material", "sizes", "floor"}
    of_experiments = {"change", "effect", "scene_keys", "check", "wall", "model", "place", "case", "setting", "observable"}
    assert texts == {*of_scene, *of_experiments, "lattice_kind", "branch", "axis", "stop_reason", "warnings"}


def test_describe_adds_attributes_and_leaves_the_original_alone():
    plain = xr.Dataset({"collision_rate": ("time", [1.0], {"window": "4 samples"})}, {"time": [0.5]})
    described = describe(plain)
    assert described["collision_rate"].attrs == {
        "units": "s-1",
        "long_name": "collision rate of a particle over the interval since the sample before",
        "symbol": "C_r = 2 C / (N dt)",
        "equation": "A Eq. 18",
        "window": "4 samples",
    }
    assert described["time"].attrs["units"] == "s"
    assert plain["collision_rate"].attrs == {"window": "4 samples"}
    assert plain["time"].attrs == {}


def test_time_is_an_index_where_a_run_ends_by_collisions():
    described = describe(xr.Dataset({"sampling_time": ("time", np.array([0.0, 0.1]))}, {"time": [0, 1]}))
    assert described["time"].attrs == {"units": "1", "long_name": "index of the sample"}
    assert described["sampling_time"].attrs["units"] == "s"


def test_describe_refuses_what_the_table_does_not_know():
    with pytest.raises(KeyError, match="temperature: no such variable"):
        describe(xr.Dataset({"temperature": 1.0}))


def test_errors_follow_from_their_variables():
    assert variable_of("collision_rate_error") == (
        "s-1",
        "standard error of the mean over realizations: collision rate of a particle over the interval since the sample before",
        "error of C_r = 2 C / (N dt)",
        "",
    )
    assert variable_of("events_error").symbol == "error of C" and variable_of("rotational_energy_error").units == "1"
    with pytest.raises(KeyError, match="temperature_error: no such variable"):
        variable_of("temperature_error")

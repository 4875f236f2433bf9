"""The door to a simulation: what a dataset holds, however the run ends."""

import logging

import numpy as np
import pytest

from granugas.analysis.observables import kinetic_energy
from granugas.equilibrate import equilibrate
from granugas.scene import Scene
from granugas.simulate import simulate
from granugas.storage.variables import VARIABLES

QUIET = {"progress": False, "samples": {"count": 20, "first": 1e-3}}

OF_A_RUN = {
    "tau", "kinetic_energy", "kinetic_energy_x", "kinetic_energy_y", "collisions_per_particle", "collision_rate",
    "elastic_collisions_per_particle", "elastic_collision_fraction", "elastic_particle_fraction",
    "elastic_energy_fraction", "reduced_pressure", "enskog_rate", "position", "velocity", "last_collision_time",
    "last_collision_interval", "collision_frequency", "initial_y", "seed", "wall_time", "cpu_time", "events",
    "stop_reason", "stop_time", "trajectory",
}  # fmt: skip


@pytest.fixture(scope="module")
def gas() -> Scene:
    return Scene(n_particles=64, area_fraction=0.25, restitution=0.8, contact_time=1e-4)


@pytest.fixture(scope="module")
def run(gas):
    return simulate(gas, 0.2, seed=3, snapshots=(0.05, 0.2), **QUIET)


def test_every_variable_is_there_and_described(run):
    assert set(run.data_vars) >= OF_A_RUN
    for name, variable in run.variables.items():
        assert variable.attrs.get("units") == VARIABLES[name].units or VARIABLES[name].units is None


def test_it_begins_at_one_and_cools(run):
    energy = run["kinetic_energy"].values
    assert energy[0] == pytest.approx(1, abs=1e-12)
    assert np.all(np.diff(energy) <= 0)
    np.testing.assert_allclose(run["kinetic_energy_x"] + run["kinetic_energy_y"], energy, rtol=1e-12)


def test_the_last_sample_falls_on_the_limit(run):
    assert run["time"].values[-1] == 0.2
    assert run["stop_reason"].item() == "time"
    assert run["collisions_per_particle"].values[-1] * 64 / 2 == run["events"].item()


def test_snapshots_agree_with_the_samples(run, gas):
    velocity, position = run["velocity"].sel(snapshot=0.2).values, run["position"].sel(snapshot=0.2).values
    start = 64 * gas.velocity_half_width**2 / 3
    assert kinetic_energy(velocity).sum() / start == pytest.approx(run["kinetic_energy"].values[-1], rel=1e-12)
    np.testing.assert_array_equal(position, run["trajectory"].values[-1])
    assert np.all((position >= 0) & (position < [run.attrs["box_x"], run.attrs["box_y"]]))


def test_the_motion_at_the_samples_is_that_of_the_snapshots_and_sums(run, gas):
    moved = simulate(gas, 0.2, seed=3, snapshots=(0.05, 0.2), keep_motion=True, **QUIET)
    assert "trajectory_velocity" not in run and "trajectory_collisions" not in run
    np.testing.assert_allclose(moved["trajectory_velocity"][-1], run["velocity"].sel(snapshot=0.2), rtol=1e-6)
    total = moved["trajectory_collisions"].sum("particle").values / 64
    np.testing.assert_allclose(total, run["collisions_per_particle"].values, rtol=1e-12)


def test_frequencies_count_both_partners(run):
    """The window of the last snapshot is the last tenth of the run."""
    frequency = run["collision_frequency"].sel(snapshot=0.2).values
    counted = frequency * 0.02
    np.testing.assert_allclose(counted, np.round(counted), atol=1e-9)
    assert counted.sum() > 0
    assert counted.sum() % 2 < 1e-6 or counted.sum() % 2 > 2 - 1e-6


def test_rates_add_up_to_the_collisions(run):
    steps = np.diff(run["time"].values)
    total = np.nansum(run["collision_rate"].values[1:] * steps)
    assert total == pytest.approx(run["collisions_per_particle"].values[-1], rel=1e-12)


def test_the_same_seed_is_the_same_run(run, gas):
    again = simulate(gas, 0.2, seed=3, snapshots=(0.05, 0.2), **QUIET)
    for name in OF_A_RUN - {"wall_time", "cpu_time"}:
        np.testing.assert_array_equal(again[name].values, run[name].values)


def test_runs_of_one_realization_start_identically(gas):
    first = simulate(gas, 0.01, seed=3, **QUIET)
    other = simulate(Scene(**gas.as_dict() | {"restitution": 0.4, "contact_time": 0.0}), 0.01, seed=3, **QUIET)
    np.testing.assert_array_equal(first["trajectory"].values[0], other["trajectory"].values[0])
    assert not np.array_equal(
        first["trajectory"].values[0],
        simulate(gas, 0.01, seed=3, realization=1, **QUIET)["trajectory"].values[0],
    )


def test_sampling_by_collisions(gas):
    run = simulate(gas, {"collisions_per_particle": 20}, seed=1, samples={"count": 5, "first": 1.0}, progress=False)
    assert run["time"].values.tolist() == list(range(6))
    assert run["stop_reason"].item() == "collisions_per_particle"
    np.testing.assert_array_equal(run["events"], 20 * 64 // 2)
    assert np.all(np.diff(run["sampling_time"].values) > 0)


def test_whichever_limit_comes_first(gas):
    run = simulate(gas, {"time": 50.0, "collisions_per_particle": 5}, seed=1, **QUIET)
    assert run["stop_reason"].item() == "collisions_per_particle"
    ended = run["time"].values > run["stop_time"].item()
    assert ended.any()
    assert np.all(np.isnan(run["kinetic_energy"].values[ended]))
    assert not np.any(np.isnan(run["kinetic_energy"].values[~ended]))


def test_one_trajectory_serves_every_contact_time():
    elastic = Scene(n_particles=64, area_fraction=0.25, restitution=1.0, contact_time=(1e-4, 1e-5, 1e-3))
    run = simulate(elastic, 0.1, seed=2, **QUIET)
    assert run["contact_time"].values.tolist() == [1e-5, 1e-4, 1e-3]
    for t_c in elastic.contact_time:
        alone = simulate(Scene(**elastic.as_dict() | {"contact_time": t_c}), 0.1, seed=2, **QUIET)
        for name in ("elastic_collisions_per_particle", "elastic_particle_fraction", "elastic_energy_fraction"):
            np.testing.assert_allclose(run[name].sel(contact_time=t_c).values, alone[name].values, rtol=1e-14)
    assert run["elastic_collisions_per_particle"].values[-1, 2] > run["elastic_collisions_per_particle"].values[-1, 0]


def test_a_collapse_ends_the_run_and_says_so(caplog):
    sticky = Scene(n_particles=300, area_fraction=0.5, restitution=0.05, contact_time=0.0)
    with caplog.at_level(logging.WARNING, "granugas"):
        run = simulate(sticky, 100.0, seed=1, **QUIET)
    assert run["stop_reason"].item() == "inelastic_collapse"
    assert run["stop_time"].item() < 1.0
    assert "inelastic collapse at t = " in caplog.text
    assert "contact_time > 0" in caplog.text


def test_a_single_disk_flies_on():
    run = simulate(Scene(n_particles=1, area_fraction=0.1), 1.0, seed=1, **QUIET)
    assert run["events"].item() == 0
    np.testing.assert_allclose(run["kinetic_energy"], 1)
    with pytest.raises(ValueError, match="never collides"):
        simulate(Scene(n_particles=1), {"collisions_per_particle": 5}, progress=False)


def test_a_start_state_can_be_given(gas, run):
    given = simulate(gas, 0.2, seed=3, snapshots=(0.05, 0.2), state=equilibrate(gas, seed=3), **QUIET)
    np.testing.assert_array_equal(given["kinetic_energy"].values, run["kinetic_energy"].values)


@pytest.mark.parametrize(("dimensions", "spin"), [(2, ("snapshot", "particle")), (3, ("snapshot", "particle", "axis"))])
def test_rough_particles_in_a_dataset(dimensions, spin):
    """Kinetic energy is that of translation; spins stand in the snapshots."""
    scene = Scene(64, 0.2, restitution=0.8, dimensions=dimensions, tangential_restitution=0.5, friction=0.4)
    run = simulate(scene, 0.02, seed=1, snapshots=[0.0, 0.02], keep_positions=False, progress=False)
    assert run["spin"].dims == spin
    q = {2: 1 / 2, 3: 2 / 5}[dimensions]
    energy = 0.5 * q * (scene.diameter / 2) ** 2 * (run["spin"] ** 2).sum() / 64 / scene.energy_per_mass
    assert run["rotational_energy"].values[-1] == pytest.approx(float(energy), rel=1e-12)
    assert run["rotational_energy"].values[0] == run["temperature_ratio"].values[0] == 0
    ratio = run["rotational_energy"] / run["kinetic_energy"] * {2: 2, 3: 1}[dimensions]
    np.testing.assert_allclose(run["temperature_ratio"], ratio, rtol=1e-12)
    assert np.all(np.diff(run["kinetic_energy"] + run["rotational_energy"]) <= 1e-12)

"""What a run writes down, from states and tallies made by hand."""

import numpy as np
import pytest

from granugas.analysis.mixtures import mixture_rate
from granugas.analysis.theory import enskog_rate
from granugas.dynamics.events.engine import Tally
from granugas.dynamics.state import State
from granugas.record import FREQUENCY_WINDOW, Record
from granugas.sampling import Samples
from granugas.scene import Scene

BOX = (0.02, 0.01)
SCENE = Scene(n_particles=4, area_fraction=0.1, restitution=0.5, contact_time=0.25)
START = np.array([[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]])
NEVER = -np.inf


def state(time, velocity=START, last=(NEVER,) * 4, collisions=(0,) * 4) -> State:
    position = np.arange(8.0).reshape(4, 2) * 1e-3 + time * 1e-4
    interval = np.arange(4.0)
    return State(time, BOX, position, np.array(velocity), np.array(last), interval, np.array(collisions))


def tally(collisions=0, elastic=(0,), loss=0.0, loss_time=0.0, stress=((0.0, 0.0), (0.0, 0.0)), elastic_time=None) -> Tally:
    more = {} if elastic_time is None else {"elastic_time": elastic_time}
    return Tally(collisions, np.array(elastic), loss, loss_time, np.array(stress), more)


def record(scene=SCENE, points=(1.0, 2.0, 4.0), axis="time", snapshots=(), keep_positions=False) -> Record:
    return Record(scene, state(0.0), Samples(axis, np.array(points)), snapshots, keep_positions)


def test_the_first_sample_is_the_start():
    data = record().dataset()
    assert data["time"].values.tolist() == [0.0, 1.0, 2.0, 4.0]
    first = data.isel(time=0)
    assert (first["kinetic_energy"], first["kinetic_energy_x"], first["kinetic_energy_y"]) == (1.0, 0.5, 0.5)
    assert (first["tau"], first["collisions_per_particle"], first["elastic_collisions_per_particle"]) == (0, 0, 0)
    for name in ("collision_rate", "reduced_pressure", "elastic_collision_fraction", "collisional_stress_xy"):
        assert np.isnan(first[name])
    np.testing.assert_array_equal(data["initial_y"], state(0.0).position[:, 1])


def test_what_is_not_reached_is_nan():
    run = record(keep_positions=True)
    run.sample(state(1.0), tally())
    data = run.dataset()
    for name in ("kinetic_energy", "tau", "collisions_per_particle", "elastic_particle_fraction", "trajectory"):
        assert np.isnan(data[name].values[2:]).all()
        assert not np.isnan(data[name].values[:2]).any()


def test_energies_are_shares_of_the_first():
    run = record()
    run.sample(state(1.0, [[1.0, 0.0], [0.0, 0.0], [0.0, 0.5], [0.0, -0.5]]), tally())
    sample = run.dataset().isel(time=1)
    assert (sample["kinetic_energy_x"], sample["kinetic_energy_y"]) == (0.25, 0.125)
    assert sample["kinetic_energy"] == 0.375


def test_tau_is_time_by_enskogs_rate_at_the_start():
    run = record()
    run.sample(state(1.0, START / 2), tally())
    rate = enskog_rate(0.1, 0.5, 1e-3)  # E/M = 1/2 (m/s)^2
    assert run.dataset()["enskog_rate"] == rate
    assert run.dataset()["tau"].values[1] == rate


def test_collisions_count_for_both_partners():
    run = record()
    run.sample(state(1.0), tally(collisions=6, elastic=[2]))
    run.sample(state(2.0), tally(collisions=2, elastic=[1]))
    run.sample(state(4.0), tally(collisions=0, elastic=[0]))
    data = run.dataset()
    assert data["collisions_per_particle"].values.tolist() == [0, 3, 4, 4]
    assert data["elastic_collisions_per_particle"].values.tolist() == [0, 1, 1.5, 1.5]
    assert data["collision_rate"].values[1:].tolist() == [3, 1, 0]  # A Eq. 18
    assert data["elastic_collision_fraction"].values[1:3].tolist() == [1 / 3, 1 / 2]
    assert np.isnan(data["elastic_collision_fraction"].values[3])  # nothing over nothing


def test_pressure_and_stress():
    """A Eqs. 15 and 16: without dissipation V/E times the stress is -sum dp_a l_b / (E dt)."""
    run = record()
    run.sample(state(1.0), tally(collisions=1, stress=[[-4.0, 0.5], [0.25, -2.0]]))
    run.sample(state(2.0), tally())
    sample = run.dataset().isel(time=1)
    assert sample["collisional_stress_xx"] == 2.0  # E = 2
    assert (sample["collisional_stress_xy"], sample["collisional_stress_yx"]) == (-0.25, -0.125)
    assert sample["collisional_stress_yy"] == 1.0
    assert sample["reduced_pressure"] == 1 + (2.0 + 1.0) / 2
    assert run.dataset()["reduced_pressure"].values[2] == 1.0


def test_pressure_is_by_the_mean_energy_of_the_interval():
    """The energy falls from 2 to 1 after a quarter of a second of one: 1.25 on average."""
    run = record()
    after = START / np.sqrt(2)
    run.sample(state(1.0, after), tally(collisions=1, loss=1.0, loss_time=0.75, stress=[[-2.5, 0.0], [0.0, -2.5]]))
    assert run.dataset()["reduced_pressure"].values[1] == pytest.approx(1 + 2.5 / 1.25)


def test_elastic_are_those_whose_last_collision_is_no_longer_ago_than_t_c():
    run = record()
    velocity = [[1.0, 0.0], [2.0, 0.0], [0.0, 1.0], [0.0, 1.0]]
    run.sample(state(1.0, velocity, last=(0.75, 0.9, 0.7, NEVER)), tally())
    sample = run.dataset().isel(time=1)
    assert sample["elastic_particle_fraction"] == 0.5
    assert sample["elastic_energy_fraction"] == 5 / 7


def test_a_list_of_contact_times():
    scene = Scene(n_particles=4, area_fraction=0.1, restitution=1.0, contact_time=(0.5, 0.05))
    run = record(scene)
    run.sample(state(1.0, last=(0.75, 0.96, 0.4, NEVER)), tally(collisions=4, elastic=[1, 3]))
    data = run.dataset()
    assert data["contact_time"].values.tolist() == [0.05, 0.5]
    assert data["elastic_particle_fraction"].dims == ("time", "contact_time")
    assert data["elastic_particle_fraction"].values[1].tolist() == [0.25, 0.5]
    assert data["elastic_collision_fraction"].values[1].tolist() == [0.25, 0.75]
    assert data["elastic_collisions_per_particle"].values[1].tolist() == [0.5, 1.5]


def test_the_time_average_of_the_elastic_particles_counts_what_is_still_going_on():
    scene = Scene(n_particles=4, area_fraction=0.1, restitution=1.0, contact_time=(0.5, 0.05))
    run = record(scene)
    run.sample(state(1.0, last=(0.75, 0.96, 0.4, NEVER)), tally(collisions=2, elastic=[0, 0], elastic_time=np.zeros(2)))
    run.sample(
        state(2.0, last=(0.75, 0.96, 1.6, NEVER)), tally(collisions=1, elastic=[0, 0], elastic_time=np.array([0.05, 0.5]))
    )
    # from t = 1 to 2: disk 0 until 1.25, disk 1 until 1.46 (or 1.01), disk 2 from 1.6 to 2 (or 1.65)
    average = run.dataset()["elastic_particle_time_fraction"].values
    assert average[2] == pytest.approx([(0.01 + 0.05) / 4, (0.25 + 0.46 + 0.4) / 4])


def test_nobody_averages_the_elastic_particles_of_a_dissipative_gas():
    assert "elastic_particle_time_fraction" not in record().dataset()


def test_a_snapshot():
    run = record(snapshots=(2.0, 1.0))
    assert run.snapshots.tolist() == [1.0, 2.0]
    run.open_window(0, state(FREQUENCY_WINDOW, collisions=(3, 0, 1, 1)))
    run.take_snapshot(0, state(1.0, START / 2, last=(0.1, 0.2, 0.3, 0.4), collisions=(5, 0, 2, 1)))
    data = run.dataset()
    np.testing.assert_allclose(data["collision_frequency"].values[0], [20, 0, 10, 0], rtol=1e-12)
    np.testing.assert_array_equal(data["position"].values[0], state(1.0).position)
    np.testing.assert_array_equal(data["velocity"].values[0], START / 2)
    assert data["last_collision_time"].values[0].tolist() == [0.1, 0.2, 0.3, 0.4]
    assert data["last_collision_interval"].values[0].tolist() == [0, 1, 2, 3]
    for name in ("collision_frequency", "position", "velocity", "last_collision_time"):
        assert np.isnan(data[name].values[1]).all()


def test_a_snapshot_of_the_start_has_no_frequency():
    run = record(snapshots=(0.0,))
    run.open_window(0, state(0.0))
    run.take_snapshot(0, state(0.0))
    assert np.isnan(run.dataset()["collision_frequency"]).all()


def test_positions_are_kept_where_asked_for():
    kept = record(keep_positions=True)
    kept.sample(state(1.0), tally())
    trajectory = kept.dataset()["trajectory"]
    assert trajectory.dims == ("time", "particle", "axis")
    np.testing.assert_array_equal(trajectory[1], state(1.0).position)
    assert "trajectory" not in record().dataset()


def test_sampled_by_collisions_the_times_are_a_variable():
    run = record(axis="collisions")
    run.sample(state(0.3), tally(collisions=2))
    data = run.dataset()
    assert data["time"].values.tolist() == [0, 1, 2, 3]
    np.testing.assert_array_equal(data["sampling_time"], [0.0, 0.3, np.nan, np.nan])
    assert data["collision_rate"].values[1] == pytest.approx(1 / 0.3)


def test_two_samples_at_one_instant():
    """As many collisions as particles ask for two samples at once where there are few particles."""
    run = record(axis="collisions")
    run.sample(state(0.3), tally(collisions=2))
    run.sample(state(0.3), tally(collisions=2))
    data = run.dataset().isel(time=2)
    assert data["collisions_per_particle"] == 2
    assert np.isnan(data["collision_rate"])
    assert np.isnan(data["reduced_pressure"])


def test_masses_count_where_they_differ():
    start = state(0.0)
    start.more.update(diameter=np.array([1.5e-3, 0.5e-3, 1e-3, 1e-3]), mass=np.array([2.0, 0.5, 1.0, 0.5]))
    run = Record(SCENE, start, Samples("time", np.array([1.0])), (), False)
    run.sample(state(1.0, [[0.5, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]]), tally())
    data = run.dataset()
    assert data["kinetic_energy_x"].values.tolist() == [2.5 / 4, 1 / 4]
    assert data["species_temperature_ratio"].values[0] == 2 / (2 / 3)
    assert data["particle_mass"].values.tolist() == [2.0, 0.5, 1.0, 0.5]
    assert data["enskog_rate"] == mixture_rate(0.1, 0.5, start.more["diameter"])

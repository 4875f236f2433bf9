"""Start states: Maxwellian, at rest as a whole, with the energy of the papers, and their lattice forgotten."""

import logging
from importlib import import_module

import numpy as np
import pytest
from gases import lattice_gas

from granugas.analysis.observables import kinetic_energy
from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import equilibrate, judge, need_start, state_of
from granugas.initial import rescaled, start_lattice
from granugas.scene import Scene

GAS = Scene(n_particles=378, area_fraction=0.2267)
OTHER_DISSIPATION = [{"restitution": 0.9}, {"contact_time": 0.0}, {"restitution": 1.0, "contact_time": (1e-3, 1e-5)}]


@pytest.fixture(scope="module")
def start():
    return equilibrate(GAS, seed=5)


def test_energy_and_momentum(start):
    velocity = start["velocity"].values
    assert kinetic_energy(velocity).sum() == pytest.approx(378 * 0.5**2 / 3, rel=1e-14)
    np.testing.assert_allclose(velocity.sum(axis=0), 0, atol=1e-12)


def test_it_is_in_equilibrium(start):
    assert start.attrs["equilibration_reached"] == 1
    assert start.attrs["branch"] == "fluid"
    assert abs(start.attrs["equilibration_kurtosis"] - 1) < 0.4
    assert abs(start.attrs["equilibration_anisotropy"]) < 0.21
    assert start.attrs["equilibration_order"] < 16
    assert start.attrs["equilibration_collisions_per_particle"] == pytest.approx(100)


def test_the_clocks_ran_before_time_zero(start):
    last, interval = start["last_collision_time"].values, start["last_collision_interval"].values
    assert np.all(last <= 0)
    assert np.all(last > -1)
    assert np.all((interval > 0) & np.isfinite(interval))


def test_the_box_is_the_lattices(start):
    assert (start.attrs["box_x"], start.attrs["box_y"]) == start_lattice(GAS).box
    assert np.all((start["position"] >= 0) & (start["position"] < [start.attrs["box_x"], start.attrs["box_y"]]))


def test_the_state_comes_back(start):
    state = state_of(start)
    assert state.time == 0
    assert state.box == (start.attrs["box_x"], start.attrs["box_y"])
    np.testing.assert_array_equal(state.velocity, start["velocity"])
    np.testing.assert_array_equal(state.last_collision_time, start["last_collision_time"])
    assert not state.collisions.any()


@pytest.mark.parametrize("other", OTHER_DISSIPATION)
def test_all_r_and_t_c_start_alike(other, start):
    again = equilibrate(Scene(**GAS.as_dict() | other), seed=5)
    assert again.identical(start)


def test_realizations_differ(start):
    for other in ({"seed": 6}, {"seed": 5, "realization": 1}):
        assert not np.array_equal(equilibrate(GAS, **other)["position"], start["position"])


def test_a_longer_equilibration_if_asked_for():
    start = equilibrate(GAS, seed=5, collisions_per_particle=250)
    assert start.attrs["equilibration_collisions_per_particle"] == pytest.approx(250)


def test_dense_fluids_melt_and_crystals_stay():
    melted = equilibrate(Scene(n_particles=400, area_fraction=0.7), seed=1)
    assert (melted.attrs["branch"], melted.attrs["lattice_kind"]) == ("fluid", "square")
    assert melted.attrs["equilibration_order"] < 16
    kept = equilibrate(Scene(n_particles=400, area_fraction=0.8), seed=1)
    assert (kept.attrs["branch"], kept.attrs["lattice_kind"]) == ("crystal", "triangular")
    assert kept.attrs["equilibration_order"] > 100
    assert melted.attrs["equilibration_reached"] == kept.attrs["equilibration_reached"] == 1


def test_spheres_melt_below_freezing_and_crystals_stay():
    melted, kept = (equilibrate(Scene(500, fraction, dimensions=3), seed=1) for fraction in (0.45, 0.6))
    assert [start.attrs["branch"] for start in (melted, kept)] == ["fluid", "crystal"]
    assert melted.attrs["equilibration_order"] < 16 < 100 < kept.attrs["equilibration_order"]
    assert melted.attrs["equilibration_reached"] == kept.attrs["equilibration_reached"] == 1
    assert kinetic_energy(melted["velocity"].values).sum() == pytest.approx(500 * 0.5**2 / 2)
    assert [kept.attrs[f"lattice_{name}"] for name in ("columns", "rows", "layers")] == [5, 5, 5]


@pytest.mark.parametrize("kind", ["cubic", "fcc"])
def test_the_order_of_spheres_on_a_full_lattice_is_n(kind):
    scene = Scene(512 if kind == "cubic" else 500, 0.3, lattice=kind, dimensions=3)
    lattice, state = start_lattice(scene), lattice_gas(scene)
    assert judge(state, lattice, melts=True).order == pytest.approx(scene.n_particles)
    state.position[:, :2] = np.random.default_rng(0).uniform(0, lattice.box[0], (scene.n_particles, 2))
    assert judge(state, lattice, melts=True).order == pytest.approx(scene.n_particles), "layers alone are an order"


@pytest.mark.parametrize("area_fraction", [0.1, 0.95])
def test_beads_forget_their_places_at_any_density(area_fraction):
    """The order is that of points without diameter, so dense beads need not look ordered."""
    scene = Scene(400, area_fraction, dimensions=1)
    assert judge(lattice_gas(scene), start_lattice(scene), True, scene.diameter).order == pytest.approx(400)
    start = equilibrate(scene, seed=1, collisions_per_particle=20)
    assert start.attrs["equilibration_reached"] == 1
    assert start.attrs["equilibration_collisions_per_particle"] == pytest.approx(20)
    assert start.attrs["equilibration_order"] < 10


@pytest.mark.parametrize("n_particles", [1, 2, 3])
def test_few_disks(n_particles):
    start = equilibrate(Scene(n_particles=n_particles, area_fraction=0.2), seed=1)
    assert kinetic_energy(start["velocity"].values).sum() == pytest.approx(n_particles * 0.5**2 / 3)
    assert n_particles == 1 or np.all(start["last_collision_time"] <= 0)


def moved(scene, **values):
    """A lattice gas after a hundred collisions per particle, with some of its columns replaced."""
    engine = Engine(Scene(**scene.as_dict() | {"restitution": 1.0, "contact_time": 0.0}), lattice_gas(scene))
    engine.advance(np.inf, 50 * scene.n_particles)
    state = engine.state()
    for name, value in values.items():
        setattr(state, name, value)
    return state


def test_a_lattice_is_not_equilibrium():
    lattice, state = start_lattice(GAS), lattice_gas(GAS)
    found = judge(moved(GAS, position=state.position), lattice, melts=True)
    assert found.order > 100
    assert not found.reached
    assert judge(moved(GAS, position=state.position), lattice, melts=False).reached
    assert judge(moved(GAS), lattice, melts=True).reached


@pytest.mark.parametrize("kind", ["square", "triangular"])
def test_the_order_of_a_full_lattice_is_n(kind):
    scene = Scene(n_particles=400 if kind == "square" else 420, area_fraction=0.3, lattice=kind)
    assert judge(lattice_gas(scene), start_lattice(scene), melts=True).order == pytest.approx(scene.n_particles)


def test_uniform_velocities_are_not_equilibrium():
    scene = Scene(n_particles=5740)
    found = judge(moved(scene, velocity=lattice_gas(scene).velocity), start_lattice(scene), melts=True)
    assert found.kurtosis == pytest.approx(9 / 5 / 3, abs=0.02)
    assert not found.reached


def test_a_preferred_direction_is_not_equilibrium():
    state = moved(GAS)
    state.velocity = rescaled(state.velocity * [1.5, 1.0], 0.5)
    assert not judge(state, start_lattice(GAS), melts=True).reached


def test_who_never_collided_is_not_in_equilibrium():
    state = moved(GAS)
    state.collisions[17] = 0
    assert not judge(state, start_lattice(GAS), melts=True).reached


@pytest.mark.parametrize("n_particles", [5, 42])
def test_the_kurtosis_of_few_disks_is_one_on_average(n_particles):
    """Energy and momentum are fixed, which lowers <v^4>."""
    scene, rng = Scene(n_particles=n_particles, area_fraction=0.1), np.random.default_rng(6)
    lattice, state = start_lattice(scene), lattice_gas(scene)
    found = []
    for _ in range(4000 // n_particles):
        velocity = rng.normal(size=(n_particles, 2))
        state.velocity = rescaled(velocity - velocity.mean(axis=0), 0.5)
        found.append(judge(state, lattice, melts=True).kurtosis)
    assert np.mean(found) == pytest.approx(1, abs=4 * np.std(found) / np.sqrt(len(found)))
    assert np.std(found) / np.sqrt(len(found)) < 0.03


def test_a_start_that_does_not_get_there_says_so(monkeypatch, caplog):
    monkeypatch.setattr(import_module("granugas.equilibrate"), "MOST_ROUNDS", 0)
    with caplog.at_level(logging.WARNING, "granugas"):
        start = equilibrate(GAS, seed=5)
    assert start.attrs["equilibration_reached"] == 0
    assert "not in equilibrium after 0 collisions per particle" in caplog.text


def test_a_start_of_different_sizes():
    scene = Scene(300, 0.3, sizes="bidisperse", size_share=0.2)
    start = equilibrate(scene, seed=5)
    d, mass, velocity = (start[name].values for name in ("particle_diameter", "particle_mass", "velocity"))
    assert kinetic_energy(velocity, mass).sum() == pytest.approx(300 * 0.5**2 / 3, rel=1e-13)
    np.testing.assert_allclose(mass @ velocity, 0, atol=1e-12)
    assert start.attrs["equilibration_reached"] == 1
    assert state_of(start).more.keys() == {"diameter", "mass"}
    large = d > d.mean()
    assert large.sum() == 60
    uneven = state_of(start)
    uneven.velocity = uneven.velocity * np.where(large, 1.6, 1.0)[:, np.newaxis]
    assert not judge(uneven, start_lattice(scene), melts=False).reached


def test_equal_disks_are_no_start_of_different_sizes():
    scene = Scene(378, 0.2267, sizes="uniform")
    with pytest.raises(ValueError, match="one size"):
        need_start(scene, equilibrate(GAS, seed=5, collisions_per_particle=1))

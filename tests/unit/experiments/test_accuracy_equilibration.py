"""The lattice and the uniform velocities are seen, and forgotten."""

import pytest

from granugas.analysis import theory
from granugas.experiments import accuracy_equilibration as experiment
from granugas.storage.variables import describe


@pytest.fixture(scope="module")
def measured():
    return describe(experiment.measure(experiment.Plan(30, (0, 1, 5, 20))))


def test_at_first_the_velocities_are_uniform(measured):
    kurtosis = measured.sel(observable="<v^4>/<v^2>^2", setting=0)
    assert kurtosis["measured"].values == pytest.approx(1.8, abs=0.01)
    assert (kurtosis["relative_error"] > 0.3).all()


def test_the_bias_dies_out(measured):
    """By 20 collisions of a particle nothing but chance is left."""
    late, early = measured.sel(setting=20), measured.sel(setting=0)
    assert (late["relative_error"] <= 4 * late["relative_error_error"]).all()
    assert (early["relative_error"] > 10 * early["relative_error_error"]).all()
    half_way = measured["relative_error"].sel(observable="<v^4>/<v^2>^2")
    assert (half_way.sel(setting=0) > half_way.sel(setting=1)).all() and (
        half_way.sel(setting=1) > half_way.sel(setting=5)
    ).all()


def test_the_truth_is_equilibrium(measured):
    assert measured["truth"].sel(observable="<v^4>/<v^2>^2").values == pytest.approx(3, rel=0.005)
    for scene, found in zip(experiment.GASES, measured["truth"].sel(observable="P V/E").values, strict=True):
        assert found == pytest.approx(theory.reduced_pressure(scene.area_fraction), rel=0.02)


def test_longer_costs_more(measured):
    assert (measured["cpu_seconds"].diff("setting") > 0).all() and (measured["cpu_seconds"] > 0).all()


def test_a_setting_is_a_number_of_collisions():
    """Of a particle, in all: each stop comes where it is asked for."""
    scene = experiment.GASES[0]
    lattice = experiment.start_lattice(scene)
    start = experiment.on_lattice(scene, lattice, experiment.random_stream(scene, 1, 0))
    engine = experiment.engine_at_start(scene, start, lattice)
    experiment._advance(engine, 2)
    assert engine.collisions == scene.n_particles
    experiment._look(engine, 3.0)
    assert engine.collisions == round(1.5 * scene.n_particles + 0.5)

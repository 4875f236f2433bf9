"""Observables of states whose answers are known."""

import numpy as np
import pytest

from granugas.analysis import observables

VELOCITY = np.array([[1.0, 0.0], [0.0, 2.0], [3.0, 0.0], [0.0, 0.0]])
LAST = np.array([0.9, 0.5, 0.95, -np.inf])


def test_kinetic_energy_by_axis():
    np.testing.assert_array_equal(observables.kinetic_energy(VELOCITY), [5.0, 2.0])


def test_anisotropy():
    assert observables.anisotropy(VELOCITY) == pytest.approx(3 / 7)
    assert observables.anisotropy(VELOCITY[:, ::-1]) == pytest.approx(-3 / 7)


def test_anisotropy_on_a_line_and_in_space():
    assert observables.anisotropy(np.array([[1.0], [-2.0]])) == 0
    assert observables.anisotropy(np.array([[1.0, 2.0, 0.0], [-1.0, 0.0, 1.0]])) == pytest.approx((4 - 1) / 7)


def test_kurtosis_of_known_distributions():
    rng = np.random.default_rng(3)
    maxwellian, uniform = rng.normal(size=200_000), rng.uniform(-1, 1, 200_000)
    np.testing.assert_allclose(observables.velocity_kurtosis(np.column_stack([maxwellian, uniform])), [3, 9 / 5], rtol=0.02)


def test_elastic_fractions():
    """At t = 1 and t_c = .25 the particles 0 and 2 are elastic; they carry 10 of 14 parts of the energy."""
    assert observables.elastic_particle_fraction(LAST, 1.0, 0.25) == 0.5
    assert observables.elastic_energy_fraction(VELOCITY, LAST, 1.0, 0.25) == pytest.approx(10 / 14)


def test_elastic_exactly_at_the_contact_time():
    assert observables.elastic_particle_fraction(LAST, 1.0, 0.5) == 0.75


def test_elastic_fractions_for_several_contact_times():
    contact_times = [0.0, 0.25, 0.6]
    n_e = observables.elastic_particle_fraction(LAST, 1.0, contact_times)
    e_e = observables.elastic_energy_fraction(VELOCITY, LAST, 1.0, contact_times)
    np.testing.assert_array_equal(n_e, [0, 0.5, 0.75])
    np.testing.assert_allclose(e_e, [0, 10 / 14, 1])


def test_partners_of_a_collision_at_this_moment_are_left_out():
    """Samples that are counted by collisions are taken at one; its two partners may round apart from the time."""
    time = 65.59
    last = np.array([time - 0.1, time, np.nextafter(time, 100), time - 1])
    assert observables.elastic_particle_fraction(last, time, 0.2) == 0.5
    assert observables.elastic_energy_fraction(np.diag([1.0, 9.0, 9.0, 3.0]), last, time, 0.2) == pytest.approx(0.1)
    assert observables.elastic_particle_fraction(last[1:3], time, 0.2) == 0
    assert observables.elastic_energy_fraction(np.ones((2, 2)), last[1:3], time, 0.2) == 0


def test_energies_count_masses():
    mass = np.array([2.0, 1.0, 0.5, 0.5])
    np.testing.assert_array_equal(observables.kinetic_energy(VELOCITY, mass), [1 + 9 / 4, 2])
    carried = (2 + 4.5) / (2 + 4 + 4.5)
    assert observables.elastic_energy_fraction(VELOCITY, LAST, 1.0, 0.25, mass) == pytest.approx(carried)


def test_species_temperature_ratio():
    """The first is the heavy one: m v^2 = 2, and (4 + 4.5 + 0)/3 of the others on average."""
    assert observables.species_temperature_ratio(VELOCITY, np.array([2.0, 1.0, 0.5, 0.5])) == pytest.approx(2 * 3 / 8.5)
    assert np.isnan(observables.species_temperature_ratio(VELOCITY, np.ones(4)))

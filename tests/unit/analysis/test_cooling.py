"""The beginning of the cooling, and a homogeneous gas with a contact duration."""

import numpy as np
import pytest
import xarray as xr

from granugas.analysis.cooling import cooling_with_contact_time, initial_cooling
from granugas.analysis.theory import homogeneous_cooling

RATE = 445.0


def slowed(factors, restitution=0.8, until=10.0):
    """Runs that cool `factors` times as fast as hard spheres and have that share of inelastic collisions."""
    tau = np.broadcast_to(np.linspace(0, until, 51), (len(factors), 51))
    factors = np.array(factors)[:, np.newaxis]
    over = ("realization", "time")
    return xr.Dataset(
        {
            "tau": (over, tau),
            "kinetic_energy": (over, homogeneous_cooling(factors * tau, restitution)),
            "collisions_per_particle": (over, tau),
            "elastic_collisions_per_particle": (over, (1 - factors) * tau),
            "enskog_rate": ("realization", np.full(len(factors), RATE)),
        }
    )


@pytest.mark.parametrize("restitution", [0.99, 0.8, 0.4])
def test_the_factor_of_homogeneous_cooling(restitution):
    found = initial_cooling(slowed([1.0, 0.5, 1e-4], restitution, until=2.0), restitution, 1e-3)
    np.testing.assert_allclose(found["cooling_factor"], [1.0, 0.5, 1e-4], rtol=1e-9)
    np.testing.assert_allclose(found["inelastic_fraction"], [1.0, 0.5, 1e-4], rtol=1e-9)


def test_what_comes_after_the_beginning_does_not_count():
    runs = slowed([1.0])
    late = runs["kinetic_energy"] < 0.9
    assert late.any()
    changed = runs.assign(
        kinetic_energy=runs["kinetic_energy"].where(~late, 0.5),
        elastic_collisions_per_particle=runs["elastic_collisions_per_particle"].where(~late, 7.0),
    )
    changed["kinetic_energy"][0, -1] = 0.95  # energy does not come back; noise of a mean must not either
    assert initial_cooling(changed, 0.8, 1e-3).identical(initial_cooling(runs, 0.8, 1e-3))


def test_contact_ratio_is_that_of_the_mean_rate():
    found = initial_cooling(slowed([1.0, 0.0]), 0.8, 2e-3)["contact_ratio"].values
    assert found[1] == pytest.approx(2e-3 * RATE, rel=1e-12)
    assert 0.95 * found[1] < found[0] < found[1]


@pytest.mark.parametrize("restitution", [0.95, 0.4])
def test_without_a_contact_time_it_is_homogeneous_cooling(restitution):
    tau = np.array([[0.0, 0.1], [10.0, 2000.0]])
    np.testing.assert_allclose(
        cooling_with_contact_time(tau, restitution, 0.0), homogeneous_cooling(tau, restitution), rtol=1e-12
    )


@pytest.mark.parametrize("ratio", [0.3, 1.0, 3.0])
def test_it_solves_its_equation(ratio):
    """dK/dtau = -(1 - r^2)/2 K^(3/2) exp(-2 x K^(1/2)), by differences."""
    tau = np.geomspace(0.1, 1000, 20)
    step = 1e-3 * tau
    above, energy, below = (cooling_with_contact_time(tau + k * step, 0.4, ratio) for k in (1, 0, -1))
    expected = -(1 - 0.4**2) / 2 * energy**1.5 * np.exp(-2 * ratio * np.sqrt(energy))
    np.testing.assert_allclose((above - below) / (2 * step), expected, rtol=2e-3)

"""Formulas for mixtures against those for equal particles, and against each other."""

import math

import numpy as np
import pytest

from granugas.analysis import theory
from granugas.analysis.mixtures import SPECIES, mixture_contact_values, mixture_pressure, mixture_rate, species

EQUAL = np.full(10, 2e-3)
MIXED = np.repeat([1.0, 2.0, 3.5], [5, 3, 2])


@pytest.mark.parametrize("nu", [0.01, 0.2267, 0.6])
def test_equal_disks(nu):
    assert mixture_pressure(nu, EQUAL) == pytest.approx(theory.reduced_pressure(nu), rel=1e-14)
    assert mixture_rate(nu, 0.1, EQUAL) == pytest.approx(theory.enskog_rate(nu, 0.1, 2e-3), rel=1e-14)


@pytest.mark.parametrize("nu", [0.01, 0.3, 0.45])
def test_equal_spheres_and_beads(nu):
    """Carnahan & Starling's Z; Tonks'."""
    assert mixture_pressure(nu, EQUAL, 3) == pytest.approx((1 + nu + nu**2 - nu**3) / (1 - nu) ** 3, rel=1e-14)
    assert mixture_pressure(nu, EQUAL, 1) == pytest.approx(1 / (1 - nu), rel=1e-14)
    a, temperature = 1e-3, 0.2 / 3
    g = (1 - nu / 2) / (1 - nu) ** 3
    expected = 12 / a * nu * g * math.sqrt(temperature / math.pi)
    assert mixture_rate(nu, 0.1, EQUAL, 3) == pytest.approx(expected, rel=1e-14)


def test_disks_in_closed_form():
    """Jenkins & Mancini's pressure depends on y = <d>^2/<d^2> alone."""
    nu, y = 0.3, MIXED.mean() ** 2 / np.mean(MIXED**2)
    expected = 1 + nu * (1 + y) / (1 - nu) + 9 / 8 * y * nu**2 / (1 - nu) ** 2
    assert mixture_pressure(nu, MIXED) == pytest.approx(expected, rel=1e-14)


def test_spheres_in_closed_form():
    """Boublik's and Mansoori's compressibility route of the contact values: Z = 1 + (2 pi/3) n <s^3 g>."""
    nu, (m1, m2, m3) = 0.3, (np.mean(MIXED**k) for k in (1, 2, 3))
    expected = 1 / (1 - nu) + 3 * nu / (1 - nu) ** 2 * m1 * m2 / m3 + (3 - nu) * nu**2 / (1 - nu) ** 3 * m2**3 / m3**2
    assert mixture_pressure(nu, MIXED, 3) == pytest.approx(expected, rel=1e-14)


def test_a_tracer_of_no_size_sees_the_free_area():
    """g of a point and a disk is 1/(1 - nu) exactly."""
    g = mixture_contact_values(0.4, np.array([1e-9, 1.0]), np.array([0.0, 1.0]))
    assert g[0, 1] == pytest.approx(1 / 0.6, rel=1e-6)


def test_many_diameters_are_grouped():
    d = np.random.default_rng(1).lognormal(sigma=0.2, size=10 * SPECIES + 7)
    found, shares = species(d)
    assert len(found) == SPECIES
    assert shares.sum() == pytest.approx(1)
    assert shares @ found == pytest.approx(d.mean(), rel=1e-12)
    assert shares @ found**2 == pytest.approx(np.mean(d**2), rel=1e-3)


def test_the_steady_temperature_balances():
    heating, r, rate = 2.0, 0.95, 300.0
    temperature = theory.steady_temperature(heating, r, rate)
    a_2 = theory.sonine_coefficient_heated(r)
    dissipated = (1 - r**2) * temperature * rate * math.sqrt(temperature) / 2 * (1 + 3 * a_2 / 16)
    assert dissipated == pytest.approx(heating)
    assert -0.02 < a_2 < -0.01
    assert theory.sonine_coefficient_heated(math.sqrt(0.5)) == pytest.approx(0, abs=1e-15)

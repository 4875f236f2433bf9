"""Published values: their units, and that they fit what is known beside them."""

import numpy as np
import pytest

from granugas.analysis import theory
from granugas.analysis.literature import COEXISTENCE, PRESSURES, PressurePoint


def test_an_ideal_gas_has_a_reduced_pressure_of_one():
    """P d^2 / kT = (N/V) d^2 = 4 nu / pi."""
    assert PressurePoint(0.3, 4 * 0.3 / np.pi).reduced_pressure == pytest.approx(1)


def test_pressures_lie_below_eq_17_close_to_freezing():
    for point in PRESSURES:
        ratio = (point.reduced_pressure - 1) / (theory.reduced_pressure(point.area_fraction) - 1)
        assert 0.85 < ratio < 0.9


def test_coexistence_has_one_pressure_and_begins_where_the_fluid_ends():
    fluid, hexatic = COEXISTENCE
    assert fluid == PRESSURES[-1]
    assert fluid.pressure == hexatic.pressure and fluid.area_fraction < hexatic.area_fraction
    assert fluid.pressure > PRESSURES[0].pressure

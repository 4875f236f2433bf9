import math

import numpy as np
import pytest

from granugas.dynamics.soft_contact import Spring, contacts, integrate, spring

T_C = 1e-3


def collide(r: float, step: float = 1 / 200):
    return integrate(spring(T_C, r), 1e-3, -2.0, 3 * T_C, step * T_C)


@pytest.mark.parametrize("r", [0.2, 0.6, 0.9, 1.0])
def test_a_contact_lasts_t_c_and_leaves_r(r):
    path = collide(r)
    (begin,), (end,) = contacts(path)
    assert begin == pytest.approx(0.5e-3, rel=1e-12)
    assert end - begin == pytest.approx(T_C, rel=1e-7)
    assert path.v[-1] == pytest.approx(2 * r, rel=1e-7)
    assert path.time[-1] == 3 * T_C


def test_the_path_is_the_damped_oscillation():
    path, r = collide(0.6), 0.6
    omega, eta = math.pi / T_C, -math.log(r) / T_C
    t = path.time - 0.5e-3
    inside = (t >= 0) & (t <= T_C)
    exact = -2.0 / omega * np.exp(-eta * t[inside]) * np.sin(omega * t[inside])
    np.testing.assert_allclose(path.h[inside], exact, atol=1e-8 * 2 * T_C)


def test_fourth_order():
    """Half the step, a sixteenth of the error."""
    errors = [abs(collide(0.6, step).v[-1] - 1.2) for step in (1 / 25, 1 / 50, 1 / 100)]
    ratios = np.divide(errors[:-1], errors[1:])
    assert np.all((ratios > 13) & (ratios < 19))


def test_free_flight_is_exact():
    path = integrate(spring(T_C, 0.5), 5.0, 3.0, 1.0, 0.3, g=9.81)
    np.testing.assert_allclose(path.h, 5 + 3 * path.time - 9.81 * path.time**2 / 2, rtol=1e-14)
    np.testing.assert_allclose(path.v, 3 - 9.81 * path.time, rtol=1e-13)


def test_under_gravity_it_settles_where_the_spring_carries_it():
    soft, g = spring(T_C, 0.5), 9.81
    path = integrate(soft, 0.0, -10 * g * T_C, 80 * T_C, T_C / 100, g)
    assert path.h[-1] == pytest.approx(-g / soft.stiffness, rel=1e-12)
    assert abs(path.v[-1]) < 1e-12 * g * T_C
    begins, ends = contacts(path)
    assert len(begins) == len(ends) + 1 > 2  # the last contact stays


def test_an_undamped_spring_keeps_the_energy():
    soft, g = Spring((math.pi / T_C) ** 2, 0.0), 9.81
    path = integrate(soft, 0.0, -5 * g * T_C, 50 * T_C, T_C / 200, g)
    energy = path.v**2 / 2 + g * path.h + soft.stiffness * np.minimum(path.h, 0) ** 2 / 2
    np.testing.assert_allclose(energy, energy[0], rtol=1e-7)


@pytest.mark.parametrize(("t_c", "r"), [(0.0, 0.5), (-1.0, 0.5), (1.0, 0.0), (1.0, 1.1), (math.nan, 0.5)])
def test_no_such_spring(t_c, r):
    with pytest.raises(ValueError, match="allowed"):
        spring(t_c, r)

"""Vectors of one, two and three components, compiled and not, against numpy."""

import numpy as np
import pytest
from numba import njit
from plain import python_of

from granugas.dynamics.events import vectors


@njit
def _first_less_second(a, b):
    return a - 2 * b


@njit
def _sum_of_three(a, b, c):
    return a + 2 * b + 3 * c


@njit
def everything(a, b, c, s):
    return (
        vectors.dot(a, b),
        vectors.plus(a, b),
        vectors.minus(a, b),
        vectors.times(a, b),
        vectors.along(a, s, b),
        vectors.scaled(a, s),
        vectors.divided(a, s),
        vectors.mapped(a, b, _first_less_second),
        vectors.mapped_three(a, b, c, _sum_of_three),
        vectors.with_component(a, len(a) - 1, s),
        vectors.zeros_like(a),
    )


@njit
def turning(w, a, b):
    return vectors.cross(w, a), vectors.torque(a, b)


@pytest.mark.parametrize("run", [turning, python_of(turning)], ids=["compiled", "plain"])
def test_spins_in_a_plane_are_those_in_space(run):
    a, b, w = np.random.default_rng(4).normal(size=(3, 3))
    np.testing.assert_allclose(run(tuple(w), tuple(a), tuple(b)), (np.cross(w, a), np.cross(a, b)), rtol=1e-15)
    a[2] = b[2] = w[0] = w[1] = 0.0
    velocity, moment = run((w[2],), tuple(a[:2]), tuple(b[:2]))
    np.testing.assert_allclose((*velocity, 0.0), np.cross(w, a), rtol=1e-15)
    np.testing.assert_allclose((0.0, 0.0, *moment), np.cross(a, b), rtol=1e-15)


@pytest.mark.parametrize("dimensions", [1, 2, 3])
@pytest.mark.parametrize("run", [everything, python_of(everything)], ids=["compiled", "plain"])
def test_as_numpy_has_it(dimensions, run):
    a, b, c = np.random.default_rng(dimensions).normal(size=(3, dimensions))
    last = a.copy()
    last[-1] = 0.7
    wanted = (a @ b, a + b, a - b, a * b, a + 0.7 * b, a * 0.7, a / 0.7, a - 2 * b, a + 2 * b + 3 * c, last, 0 * a)
    for found, expected in zip(run(tuple(a), tuple(b), tuple(c), 0.7), wanted, strict=True):
        np.testing.assert_allclose(found, expected, rtol=1e-15, atol=1e-16)

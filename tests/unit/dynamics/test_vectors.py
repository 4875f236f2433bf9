"""Vectors of one, two and three components, compiled and not, against numpy."""

import numpy as np
import pytest
from numba import njit

from granugas.dynamics.events import vectors
from granugas.dynamics.events.composition import inline


@inline
def _first_less_second(a, b):
    return a - 2 * b


@inline
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


@pytest.mark.parametrize("dimensions", [1, 2, 3])
@pytest.mark.parametrize("run", [everything, everything.py_func], ids=["compiled", "plain"])
def test_as_numpy_has_it(dimensions, run):
    a, b, c = np.random.default_rng(dimensions).normal(size=(3, dimensions))
    last = a.copy()
    last[-1] = 0.7
    wanted = (a @ b, a + b, a - b, a * b, a + 0.7 * b, a * 0.7, a / 0.7, a - 2 * b, a + 2 * b + 3 * c, last, 0 * a)
    for found, expected in zip(run(tuple(a), tuple(b), tuple(c), 0.7), wanted, strict=True):
        np.testing.assert_allclose(found, expected, rtol=1e-15, atol=1e-16)

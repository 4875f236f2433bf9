"""Diameters are the quantiles of their distribution; random is who has which."""

import numpy as np
import pytest

from granugas.diameters import diameters, largest, moment, of_particles
from granugas.scene import Scene

N = 10_000


def test_bidisperse_numbers_are_exact():
    d = diameters(Scene(1000, sizes="bidisperse", size_ratio=3.0, size_share=0.25))
    small, large = np.unique(d)
    assert large / small == pytest.approx(3)
    assert np.count_nonzero(d == large) == 250
    assert d.mean() == pytest.approx(1)


@pytest.mark.parametrize("share", [0.0, 1.0])
def test_one_kind_alone_is_equal_particles(share):
    assert set(diameters(Scene(100, sizes="bidisperse", size_share=share))) == {1.0}


def test_uniform():
    d = diameters(Scene(N, sizes="uniform", size_spread=0.3))
    np.testing.assert_allclose(d, 1 + 0.3 * np.linspace(-1, 1, N), atol=1e-4)


def test_log_normal():
    d = diameters(Scene(N, sizes="log_normal", size_spread=0.3))
    assert d.mean() == pytest.approx(1)
    assert d.std() == pytest.approx(0.3, rel=0.01)
    logarithm = np.log(d)
    assert np.mean((logarithm - logarithm.mean()) ** 3) == pytest.approx(0, abs=1e-12)
    assert np.all(np.diff(d) > 0)


@pytest.mark.parametrize("sizes", ["bidisperse", "uniform", "log_normal"])
def test_masses_are_those_of_one_density(sizes):
    scene = Scene(500, sizes=sizes, diameter=2e-3)
    found = of_particles(scene, np.random.default_rng(1))
    d, mass = found["diameter"], found["mass"]
    assert mass.mean() == pytest.approx(1)
    assert d.mean() == pytest.approx(2e-3)
    np.testing.assert_allclose(mass / d**2, mass[0] / d[0] ** 2)
    assert d.max() == largest(scene) * 2e-3
    assert moment(scene, 2) == pytest.approx(np.mean(d**2) / np.mean(d) ** 2)
    np.testing.assert_array_equal(np.sort(d), diameters(scene) * 2e-3)
    assert np.any(np.diff(d) < 0)
    assert not np.array_equal(d, of_particles(scene, np.random.default_rng(2))["diameter"])


def test_equal_particles_draw_nothing():
    rng = np.random.default_rng(1)
    assert of_particles(Scene(100), rng) == {}
    assert rng.random() == np.random.default_rng(1).random()
    assert largest(Scene(100)) == 1.0

"""How fast trajectories part, on made-up ones."""

import numpy as np
import pytest

from granugas.analysis.divergence import collision_times, growth_rate, lyapunov_exponent, relative_spread, rms_distance
from granugas.analysis.theory import collisions_until, homogeneous_cooling


def test_distance_is_to_the_nearest_image():
    box = (2.0, 1.0)
    one = np.array([[0.1, 0.5], [1.0, 0.95], [0.3, 0.3]])
    other = np.array([[1.9, 0.5], [1.0, 0.05], [0.3, 0.3]])
    assert rms_distance(one, other, box) == pytest.approx(np.sqrt((0.2**2 + 0.1**2) / 3))
    assert rms_distance(one, one, box) == 0


def test_growth_rate_is_that_of_the_window():
    """Noise below, saturation above: neither may count."""
    x = np.arange(0, 60, 0.5)
    distance = 3e-15 * np.exp(1.3 * x) + 1e-14
    saturated = distance / (1 + distance)
    assert growth_rate(x, saturated, (1e-12, 1e-3)) == pytest.approx(1.3, rel=2e-3)
    assert growth_rate(x, saturated, (1e-15, 10.0)) < 1
    back = saturated.copy()
    back[-1] = 1e-5  # once outside, what comes back does not count
    assert growth_rate(x, back, (1e-12, 1e-3)) == growth_rate(x, saturated, (1e-12, 1e-3))


def test_growth_needs_three_points():
    assert np.isnan(growth_rate([0, 1, 2, 3], [1e-3, 1e-2, 1.0, 1.0], (1e-4, 0.1)))
    assert np.isnan(growth_rate([0, 1, 2, 3], [0.0, 0.0, 0.0, 0.0], (1e-4, 0.1)))


def test_exponent_and_its_error_over_realizations():
    """Two realizations of exponents 1 and 2, of the first one a copy that never comes into the window."""
    x = np.tile(np.arange(20.0), (2, 1))
    distance = 1e-14 * np.exp(np.array([[1.0], [2.0]])[:, np.newaxis] * np.stack([x, x], axis=1))
    distance[0, 1] = 1e-14
    assert lyapunov_exponent(x, distance, (1e-13, 1e-3)) == pytest.approx((1.5, 0.5))


def test_clock_of_a_cooling_gas():
    """In homogeneous cooling it counts collisions (B Eq. 4)."""
    tau = np.linspace(0, 50, 2001)
    np.testing.assert_allclose(collision_times(tau, homogeneous_cooling(tau, 0.8)), collisions_until(tau, 0.8), rtol=1e-4)
    np.testing.assert_allclose(collision_times(tau, np.ones_like(tau)), tau, rtol=1e-12)


def test_relative_spread():
    rng = np.random.default_rng(3)
    runs = rng.normal(size=(4000, 2))
    copies = runs[:, np.newaxis] + rng.normal(scale=[0.1, 2.0], size=(4000, 5, 2))
    np.testing.assert_allclose(relative_spread(copies, runs), [0.1, 2.0], rtol=0.05)
    assert np.isnan(relative_spread(np.ones((3, 2, 1)), np.ones((3, 1)))).all()

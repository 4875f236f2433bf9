"""How unevenly something is shared."""

import numpy as np
import pytest

from granugas.analysis.inequality import gini, lorenz_curve, poisson_gini, share_of_largest


def test_the_curve_begins_with_the_largest():
    particles, whole = lorenz_curve([1, 5, 0, 2])
    np.testing.assert_allclose(particles, [0, 0.25, 0.5, 0.75, 1])
    np.testing.assert_allclose(whole, [0, 5 / 8, 7 / 8, 1, 1])


def test_shares_of_the_largest():
    assert share_of_largest([3] * 10, 0.3) == pytest.approx(0.3)
    assert share_of_largest([1] * 90 + [81] * 10, 0.1) == pytest.approx(0.9)
    assert share_of_largest([1, 0], 0.25) == pytest.approx(0.5)


def test_gini_coefficients():
    assert gini([2.0] * 7) == pytest.approx(0)
    assert gini([0] * 9 + [4]) == pytest.approx(0.9)
    assert gini([1, 2, 3]) == pytest.approx(2 / 9)  # mean difference 8/9, by twice the mean
    assert gini(np.random.default_rng(0).exponential(3, 100_000)) == pytest.approx(0.5, abs=0.01)


@pytest.mark.parametrize("mean", [0.5, 3.0, 400.0])
def test_gini_of_chance(mean):
    counts = np.random.default_rng(1).poisson(mean, 200_000)
    assert poisson_gini(mean) == pytest.approx(gini(counts), rel=0.01)


@pytest.mark.parametrize("amounts", [[0, 0], [1, -1, 3], [1, np.nan], []])
def test_nothing_to_share(amounts):
    with pytest.raises(ValueError, match="allowed are numbers >= 0 that are not all 0"):
        gini(amounts)

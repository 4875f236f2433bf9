"""The last collisions before a collapse."""

import numpy as np
import pytest

from granugas.analysis.threshold import rate_on_approach
from granugas.experiments import approach
from granugas.storage.variables import describe


@pytest.fixture(scope="module")
def measured():
    with pytest.MonkeyPatch.context() as patch:
        for name, value in (("RESTITUTIONS", (0.3, 0.5)), ("REALIZATIONS", 12), ("LAST", 20_000)):
            patch.setattr(approach, name, value)
        return describe(approach.measure())


def test_time_runs_backwards_from_the_collapse(measured):
    """Also at r = .5, where the origin of the engine's times moves several times before."""
    left = measured["time_left"].transpose("restitution", "realization", "collisions_left").values.reshape(24, -1)
    there = ~np.isnan(left)
    assert (there.sum(axis=1) > 100).all()
    for run, known, end in zip(left, there, measured["stop_time"].values.ravel(), strict=True):
        assert np.all(np.diff(run[known]) >= 0) and not known[known.sum() :].any()
        assert 0 <= run[0] < 1e-6 and run[known][-1] <= end
    assert (measured["disks_involved"] >= 3).all() and (measured["disks_involved"] < 100).all()


def test_the_rate_diverges_as_the_inverse_of_the_time_left(measured):
    """Over eight decades; a handful of disks collides at a rate 1e6 times that of the gas before.

    -.95 with a standard error of .04; some runs end by rounding before the last 1e-12 s.
    """
    edges = 10.0 ** np.arange(-12, -3)
    rate = np.mean([rate_on_approach(run, edges) for run in measured["time_left"].sel(restitution=0.3)], axis=0)
    slope = np.polyfit(np.log(edges[:-1]), np.log(rate), 1)[0]
    assert slope == pytest.approx(-1, abs=0.15)
    assert rate[0] > 1e6 * float(measured["enskog_rate"])


def test_a_gas_that_does_not_collapse_is_refused(monkeypatch):
    monkeypatch.setattr(approach, "RESTITUTIONS", (0.95,))
    monkeypatch.setattr(approach, "REALIZATIONS", 1)
    monkeypatch.setattr(approach, "MOST_COLLISIONS", 5)
    with pytest.raises(RuntimeError, match=r"r = 0\.95: no collapse in 5 collisions per particle"):
        approach.measure()

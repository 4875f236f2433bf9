"""Sizes of one gas: what is looked at, and how the limit of large systems and the spread come about."""

import numpy as np
import pytest

from granugas.experiments import accuracy_sizes
from granugas.experiments.accuracy_sizes import GAS, SEED, SMALL
from granugas.scene import Scene
from granugas.simulate import simulate
from granugas.storage.variables import describe


@pytest.fixture(scope="module")
def measured():
    return describe(accuracy_sizes.measure(SMALL))


def test_means_and_spreads_are_those_of_the_runs(measured):
    """K of the same runs through the door, sampled otherwise."""
    scene = Scene(42, **GAS)
    runs = [
        simulate(scene, 0.1, seed=SEED, realization=k, samples={"count": 1}, keep_positions=False, progress=False)
        for k in range(SMALL.realizations[42])
    ]
    energies = [float(run["kinetic_energy"][-1]) for run in runs]
    found = measured.sel(setting=42, observable="K at 0.1 s")
    assert float(found["measured"]) == pytest.approx(np.mean(energies), rel=1e-9)
    assert float(found["measured_error"]) == pytest.approx(np.std(energies, ddof=1) / np.sqrt(len(energies)), rel=1e-9)
    assert float(found["relative_spread"]) == pytest.approx(np.std(energies, ddof=1) / float(found["truth"]), rel=1e-9)


def test_errors_are_of_the_limit_of_large_systems(measured):
    found = measured.sel(setting=378)
    np.testing.assert_allclose(found["relative_error"], abs(found["measured"] - found["truth"]) / abs(found["truth"]))
    assert (found["relative_error_error"] >= found["truth_error"] / abs(found["truth"])).all()
    assert float(measured["truth"].sel(observable="P V/E at r = 1")) == pytest.approx(1.683, rel=0.05)
    assert 0 < float(measured["truth"].sel(observable="K at 0.2 s")) < float(measured["truth"].sel(observable="K at 0.1 s"))


def test_the_chosen_exponent_is_one_of_many(measured):
    one = measured["exponents"].sel(distance_factor=accuracy_sizes.CHOSEN, window_shift=1.0)
    np.testing.assert_array_equal(one, measured["measured"].sel(observable="exponent of <M>"))
    assert measured["exponents"].shape == (3, 5, 3) and measured["exponents"].notnull().all()
    assert (measured["cpu_seconds"] > 0).all()

"""Other flags change the last digits and the order of collisions, and stay out of the cache of kernels."""

import numpy as np
import pytest

from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import equilibrate, state_of
from granugas.experiments import accuracy_arithmetic as experiment
from granugas.storage.variables import describe

PLAN = experiment.Plan(("strict", "fused"), 2, 12_000, 10_000, (0.01, 0.02))


@pytest.fixture(scope="module")
def cache(tmp_path_factory):
    """The cache of kernels of processes with flags: one of their own, as others fill the usual one meanwhile."""
    return tmp_path_factory.mktemp("kernels")


@pytest.fixture(scope="module")
def measured(cache):
    run = experiment._in_own_process

    def watched(flags, *arguments):
        with pytest.MonkeyPatch.context() as patch:
            if flags:
                patch.setenv("NUMBA_CACHE_DIR", str(cache))
            return run(flags, *arguments)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(experiment, "_in_own_process", watched)
        return describe(experiment.measure(PLAN))


def test_nothing_with_flags_is_kept(measured, cache):
    assert measured["setting"].values.tolist() == ["strict", "fused"]
    assert not [path for path in cache.rglob("*.nb*")]


def test_fused_operations_change_the_order_after_a_while(measured):
    """Rounding differs at once, what it decides only after it has grown for some collisions of a particle."""
    first = measured["first_difference"]
    assert first.sel(setting="strict").isnull().all()
    assert (first.sel(setting="fused") > 2000).all() and (first.sel(setting="fused") <= PLAN.followed).all()
    assert (measured["rms_gap"].sel(setting="fused") != measured["rms_gap"].sel(setting="strict")).any()


def test_rounding_is_all_that_changes(measured):
    assert (abs(measured["smallest_gap"]) < 1e-12).all() and (measured["rms_gap"] > 1e-17).all()
    assert (abs(measured["energy_balance"]) < 1e-12).all()
    cooled = measured.sel(observable=[name for name in measured["observable"].values if name.startswith("K")]).squeeze("case")
    assert (cooled["relative_error"] < 1e-6).all() and (cooled["measured"] < 0.5).all()


def test_the_first_setting_is_the_truth(measured):
    strict = measured.sel(setting="strict").squeeze("case")
    assert (strict["relative_error"] == 0).all() and (strict["measured"] == strict["truth"]).all()
    assert (measured["cpu_per_collision"] > 10).all() and (measured["cpu_seconds"] > 0).all()


def test_the_gap_of_disks_in_contact_is_zero_and_grows_as_they_leave():
    """Across cells and the ends of the box."""
    scene = experiment.COOLING
    engine = Engine(scene, state_of(equilibrate(scene)))
    for _ in range(200):
        engine.advance(1.0, 1)
        i, j = np.flatnonzero(engine.arrays["clocks"]["last"] == engine.arrays["calendar"]["now"])
        assert abs(experiment.gap(engine, i, j)) < 1e-13
    engine.arrays["disks"]["x"][j, 0] += 1e-3 * np.sign(engine.arrays["disks"]["x"][j, 0])
    assert abs(experiment.gap(engine, i, j)) > 1e-6

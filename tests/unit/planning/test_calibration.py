"""The speed of a machine is measured once, and what is measured does not matter here."""

import pytest

from granugas.planning import calibration
from granugas.planning.calibration import Calibration, measure

MADE_UP = Calibration((100, 10_000), (300.0, 500.0), 1.5, 1e-5, 2e-8)


def test_between_sizes_the_cost_is_linear_in_the_logarithm_and_goes_on_beyond():
    assert [MADE_UP.collision(n) for n in (10, 100, 1000, 10_000, 1_000_000)] == pytest.approx([300, 300, 400, 500, 700])


def test_what_is_measured_makes_sense():
    found = measure((30, 300), timed=3000)
    assert found.sizes == (30, 300) and all(10 < cost < 1e5 for cost in found.ns_per_collision)
    assert 0.1 < found.start_seconds < 100
    assert found.sample_seconds >= 0 and found.sample_seconds_per_particle >= 0


def test_a_machine_is_measured_once_for_the_same_kernels(tmp_path, monkeypatch):
    calls = []
    monkeypatch.setattr(calibration, "kernel_cache_directory", lambda: tmp_path)
    monkeypatch.setattr(calibration, "measure", lambda: calls.append(1) or MADE_UP)
    assert calibration.calibration() == calibration.calibration() == MADE_UP and len(calls) == 1
    (file,) = tmp_path.iterdir()
    for damaged in ("{", "[1]", '{"sizes": [1]}'):
        file.write_text(damaged)
        assert calibration.calibration() == MADE_UP
    assert len(calls) == 4
    monkeypatch.setattr("platform.node", lambda: "another")
    calibration.calibration()
    assert len(calls) == 5 and len([*tmp_path.iterdir()]) == 2

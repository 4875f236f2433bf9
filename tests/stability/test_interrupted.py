"""A run that is interrupted and goes on equals one that was never stopped, bit for bit."""

import math
import os
import signal

import numpy as np
import pytest

from granugas import progress, simulate
from granugas.equilibrate import equilibrate
from granugas.interruption import Interrupted
from granugas.scene import Scene
from granugas.storage.checkpoint import Checkpoint
from granugas.storage.dataset import content_sha256

SCENES = {
    "cooling, filmed": (
        Scene(300, 0.4, restitution=0.7, contact_time=1e-4),
        {"until": 0.3, "samples": {"count": 40}, "snapshots": (0.0, 0.05, 0.3), "keep_motion": True},
    ),
    "elastic, many contact times": (
        Scene(200, 0.3, restitution=1.0, contact_time=(1e-5, 1e-4, 1e-3)),
        {"until": {"collisions_per_particle": 60}, "samples": {"count": 7, "spacing": "linear"}},
    ),
    "collapse": (Scene(500, 0.3, restitution=0.1, contact_time=0.0), {"until": 5.0, "samples": {"count": 30}}),
    "beads that merge": (
        Scene(60, 0.3, restitution=0.6, contact_time=0.0, dimensions=1, lrv_velocity=0.02),
        {"until": 1.0, "samples": {"count": 30}, "snapshots": (0.05, 1.0), "keep_motion": True},
    ),
    "soft spheres": (
        Scene(60, 0.4, restitution=0.7, contact_time=1e-3, dynamics="soft_spheres", boundary="wall", steps_per_contact=10),
        {"until": 0.05, "samples": {"count": 20}, "snapshots": (0.0, 0.01, 0.05), "keep_motion": True},
    ),
    "random partners": (
        Scene(500, 0.3, restitution=0.7, contact_time=1e-4, dynamics="dsmc"),
        {"until": {"time": 0.2, "collisions_per_particle": 40}, "samples": {"count": 40}, "snapshots": (0.0, 0.02)},
    ),
    "few disks": (Scene(5, 0.1, restitution=0.9, contact_time=1e-6), {"until": 2.0, "samples": {"count": 100}}),
}


@pytest.mark.parametrize("name", SCENES)
def test_pieces_add_up_to_the_whole(name, tmp_path, monkeypatch):
    scene, asked = SCENES[name]
    start = equilibrate(scene, seed=3)
    whole = simulate(scene, **asked, seed=3, state=start, progress=False)
    monkeypatch.setattr(progress, "SLICE", int(whole["events"]) // 9 + 1)
    kept = Checkpoint(tmp_path / "run.npz", "physics", every=1e9)
    pieces = []
    while not pieces or pieces[-1]["stop_reason"] == "max_seconds":
        piece = simulate(scene, **asked, seed=3, state=start, progress=False, max_seconds=0.0, checkpoint=kept)
        pieces.append(piece)
    assert len(pieces) > 9
    assert content_sha256(pieces[-1]) == content_sha256(whole)
    times = [float(piece["stop_time"]) for piece in pieces]
    assert times == sorted(times)
    for piece in pieces[:-1]:
        there = ~np.isnan(piece["kinetic_energy"].values)
        np.testing.assert_array_equal(piece["kinetic_energy"].values[there], whole["kinetic_energy"].values[there])


def interrupted_after(slices, number, monkeypatch):
    """A signal comes while the engine works on the slice of that number."""
    tell, seen = progress.Progress._tell, []

    def told(bar, engine):
        seen.append(engine)
        if len(seen) == slices:
            os.kill(os.getpid(), number)
        tell(bar, engine)

    monkeypatch.setattr(progress, "SLICE", 500)
    monkeypatch.setattr(progress.Progress, "_tell", told)


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_signal_writes_the_checkpoint_and_ends_the_run(number, tmp_path, monkeypatch):
    scene, asked = SCENES["cooling, filmed"]
    start = equilibrate(scene, seed=4)
    whole = simulate(scene, **asked, seed=4, state=start, progress=False)
    handler = signal.getsignal(number)
    kept = Checkpoint(tmp_path / "run.npz", "physics")
    with pytest.MonkeyPatch.context() as patch:
        interrupted_after(20, number, patch)
        with pytest.raises(Interrupted, match=rf"^{signal.Signals(number).name} at t = 0\.\d+ s; the same command goes on"):
            simulate(scene, **asked, seed=4, state=start, progress=False, checkpoint=kept)
    assert signal.getsignal(number) is handler
    assert kept.load() is not None
    rest = simulate(scene, **asked, seed=4, state=start, progress=False, checkpoint=kept)
    assert content_sha256(rest) == content_sha256(whole)


def test_without_a_checkpoint_signals_do_what_they_do(monkeypatch):
    scene, asked = SCENES["cooling, filmed"]
    interrupted_after(20, signal.SIGINT, monkeypatch)
    with pytest.raises(KeyboardInterrupt):
        simulate(scene, **asked, seed=4, progress=False)


def test_processor_time_is_that_of_all_attempts(tmp_path):
    scene, asked = SCENES["elastic, many contact times"]
    kept = Checkpoint(tmp_path / "run.npz", "physics")
    simulate(scene, **asked, seed=3, progress=False, max_seconds=0.0, checkpoint=kept)
    saved = kept.load()
    kept.save(saved | {"spent": np.array([1000.0, 2000.0])})
    rest = simulate(scene, **asked, seed=3, progress=False, checkpoint=kept)
    assert 1000 < rest["wall_time"] < 1100 and 2000 < rest["cpu_time"] < 2100


def test_a_number_of_collisions_stops_a_run_where_it_is(caplog):
    scene, asked = SCENES["cooling, filmed"]
    run = simulate(scene, **asked, seed=3, progress=False, max_collisions=1234)
    assert (run["events"], run["stop_reason"]) == (1234, "max_collisions")
    assert "max_collisions reached at t = " in caplog.text
    after = run["time"].values > float(run["stop_time"])
    assert np.isnan(run["kinetic_energy"].values[after]).all() and not np.isnan(run["kinetic_energy"].values[~after]).any()
    assert math.isfinite(run["cpu_time"])

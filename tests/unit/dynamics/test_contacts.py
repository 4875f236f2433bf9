"""The watch that writes contacts down; run as a program, this file writes what it sees, for the comparison of both modes."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from gases import lattice_gas

from granugas.dynamics.events import loop
from granugas.dynamics.events.effects.contacts import SEEN, contacts, take
from granugas.dynamics.events.engine import Engine
from granugas.dynamics.events.memory import COMPILED
from granugas.equilibrate import at_rest
from granugas.scene import Scene

GAS = Scene(64, 0.5, restitution=0.4, contact_time=1e-5)


def seen_until(scene: Scene, until: float, room: int) -> tuple[np.ndarray, Engine]:
    engine = Engine(scene, lattice_gas(scene), watch=contacts(room))
    parts = []
    while engine.advance(until) == loop.WATCH:
        assert engine.watch.count.n == room
        parts.append(take(engine.watch))
    return np.concatenate([*parts, take(engine.watch)]), engine


SCENES = {
    "elastic": Scene(64, 0.5, restitution=1.0, contact_time=0.0),
    "dissipative": GAS,
    "sticking": Scene(64, 0.5, restitution=0.0, contact_time=1e-3),
    "few cells": Scene(2, 0.3, restitution=1.0, contact_time=0.0),
}


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)
def test_contacts_are_those_of_the_tally(scene):
    """Number and dp_a l_b of both partners agree with the sums of the engine, and each contact lies where it must."""
    seen, engine = seen_until(scene, 0.2, room=100)
    tally = engine.take_tally()
    assert len(seen) == tally.collisions > 50
    normal = np.stack([seen["nx"], seen["ny"]], axis=1)
    np.testing.assert_allclose(np.linalg.norm(normal, axis=1), 1, atol=1e-13)
    stress = np.einsum("n,na,nb->ab", seen["dp"], normal, normal) * scene.diameter**2
    np.testing.assert_allclose(stress, tally.stress, rtol=1e-12, atol=1e-15)
    assert (seen["dp"] < 0).all()
    sides = np.array(engine.box) / scene.diameter
    for axis, side in zip("xy", sides, strict=True):
        assert -0.5 <= seen[axis].min() < 1
        assert side - 1 < seen[axis].max() <= side + 0.5


def test_time_is_that_of_the_gas_however_long_it_runs():
    """The origin of the engine's own times has moved on by then."""
    seen, engine = seen_until(GAS, 20.0, room=1000)
    assert engine.arrays["calendar"]["base"][0] > 1.0
    assert np.all(np.diff(seen["time"]) >= 0)
    assert 0 < seen["time"][0] < 0.01
    assert 15 < seen["time"][-1] <= 20.0


def test_a_full_watch_keeps_nothing_more():
    engine = Engine(GAS, lattice_gas(GAS), watch=contacts(5))
    whole = engine.watch.seen.rows
    assert [engine.advance(1.0) for _ in range(3)] == [loop.WATCH] * 3
    assert engine.watch.count.n == 5 == len(whole)
    assert len(take(engine.watch)) == 5


def test_how_often_it_is_emptied_changes_nothing():
    often, one = seen_until(GAS, 0.05, room=7)
    seldom, other = seen_until(GAS, 0.05, room=100_000)
    assert often.tobytes() == seldom.tobytes()
    assert one.arrays["disks"].tobytes() == other.arrays["disks"].tobytes()


@pytest.mark.parametrize("restitution", [1.0, 0.4])
@pytest.mark.parametrize("middle", [(4.0, 4.0), (0.0, 4.0), (8.0, 0.0)], ids=str)
def test_one_contact_by_hand(middle, restitution):
    """Two disks of d = .5 head on with u = 2 along (3, 4)/5, in the middle and across the edges of the box."""
    scene = Scene(2, 0.01, restitution, contact_time=1e-9 if restitution < 1 else 0.0, diameter=0.5)
    along, middle = np.array([0.6, 0.8]), np.array(middle)
    position = np.mod(middle + np.outer([-1.0, 1.0], along), 8.0)
    velocity = np.outer([1.0, -1.0], along)
    engine = Engine(scene, at_rest(position, velocity, (8.0, 8.0)), watch=contacts(5))
    engine.advance(1.0)
    (seen,) = take(engine.watch)
    apart = np.array([seen["x"], seen["y"]]) * 0.5 - middle
    np.testing.assert_allclose(apart - 8 * np.round(apart / 8), 0, atol=1e-12)
    assert abs(seen["nx"] * 0.6 + seen["ny"] * 0.8) == pytest.approx(1, abs=1e-13)
    assert seen["dp"] * 0.5 == pytest.approx(-(1 + restitution) / 2 * 2, rel=1e-12)
    assert seen["time"] == pytest.approx(0.75, rel=1e-12)
    assert len(take(engine.watch)) == 0


@pytest.mark.skipif(not COMPILED, reason="compares the other mode with this one")
def test_both_modes_see_the_same_bit_for_bit(tmp_path):
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1", "PYTHONPATH": str(Path(__file__).parents[2])}
    command = [sys.executable, "-W", "error", __file__, str(tmp_path / "plain.npy")]
    subprocess.run(command, check=True, env=environment, timeout=600)
    compiled, _ = seen_until(GAS, 0.01, room=50)
    plain = np.load(tmp_path / "plain.npy")
    assert plain.dtype == SEEN
    assert len(plain) > 100
    assert plain.tobytes() == compiled.tobytes()


if __name__ == "__main__":
    np.save(sys.argv[1], seen_until(GAS, 0.01, room=50)[0])

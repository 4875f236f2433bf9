"""Progress drives the engine without touching its way, and says where it is."""

import logging
import math

import pytest
from gases import lattice_gas

from granugas import progress
from granugas.dynamics.events import loop
from granugas.dynamics.events.engine import Engine
from granugas.progress import Progress
from granugas.scene import Scene

SCENE = Scene(42, 0.3, restitution=0.9, contact_time=1e-5)


@pytest.fixture
def slices(monkeypatch):
    """Of a few events, so that there are many of them."""
    monkeypatch.setattr(progress, "SLICE", 50)


def test_it_ends_where_the_engine_would(slices):
    straight, followed = Engine(SCENE, lattice_gas(SCENE)), Engine(SCENE, lattice_gas(SCENE))
    straight.advance(0.1)
    bar = Progress("run", 0.1, shown=False)
    assert bar.follow(followed, 0.1) == loop.TIME
    assert followed.arrays["disks"].tobytes() == straight.arrays["disks"].tobytes()
    assert followed.time == straight.time
    bar.close()


def test_it_counts_collisions_over_slices(slices):
    engine, bar = Engine(SCENE, lattice_gas(SCENE)), Progress("run", shown=False)
    for wanted in (100, 333):
        assert bar.follow(engine, collisions=wanted - engine.collisions) == loop.COLLISIONS
        assert engine.collisions == wanted


def test_the_log_says_where_it_is(slices, monkeypatch, caplog):
    monkeypatch.setattr(progress, "LOG_EVERY", 0.0)
    engine, bar = Engine(SCENE, lattice_gas(SCENE)), Progress("N = 42", 0.05, shown=False)
    with caplog.at_level(logging.INFO, "granugas"):
        bar.follow(engine, 0.05)
    assert len(caplog.messages) > 3
    assert caplog.messages[0].startswith("N = 42: t = ")
    assert caplog.messages[-1] == f"N = 42: t = 0.05 s, {engine.collisions} collisions (100%), 0 s to go"


def test_without_an_end_it_does_not_guess_one(slices, monkeypatch, caplog):
    monkeypatch.setattr(progress, "LOG_EVERY", 0.0)
    engine, bar = Engine(SCENE, lattice_gas(SCENE)), Progress("equilibrate", shown=False)
    with caplog.at_level(logging.INFO, "granugas"):
        bar.follow(engine, math.inf, 100)
    assert "to go" not in caplog.text


def test_nothing_is_drawn_where_nobody_looks(slices, capfd):
    engine = Engine(SCENE, lattice_gas(SCENE))
    for shown in (False, True):  # the captured output is no terminal
        bar = Progress("run", 0.1, shown=shown)
        bar.follow(engine, engine.time + 0.01)
        bar.close()
    assert capfd.readouterr() == ("", "")

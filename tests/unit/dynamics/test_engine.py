"""The engine as Python sees it: resumed and looked at without a trace."""

import math

import numpy as np
import pytest
from gases import lattice_gas

from granugas.dynamics.events import loop
from granugas.dynamics.events.engine import Engine
from granugas.scene import Scene

SCENES = [
    Scene(42, 0.25, restitution=1.0, contact_time=0.0),
    Scene(300, 0.05, restitution=0.8, contact_time=1e-5),
    Scene(300, 0.7, restitution=1.0, contact_time=(1e-5, 1e-3)),
    Scene(64, 0.4, restitution=0.95, contact_time=0.0),
    Scene(64, 0.25, restitution=0.8, contact_time=1e-5, tangential_restitution=0.5, friction=0.3),
]


def same(one: Engine, other: Engine) -> bool:
    """Bit for bit, but for the scratch table and what Python alone notes down."""
    for name, rows in one.arrays.items():
        fields = [f for f in rows.dtype.names if (name, f) not in {("calendar", "until"), ("calendar", "reached")}]
        if name != "near" and any(rows[f].tobytes() != other.arrays[name][f].tobytes() for f in fields):
            return False
    return True


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("collisions", [1, 17, 1000])
def test_a_continued_run_is_the_uninterrupted_one(scene, collisions):
    straight, first = Engine(scene, lattice_gas(scene)), Engine(scene, lattice_gas(scene))
    straight.advance(math.inf, collisions + 2000)
    first.advance(math.inf, collisions)
    saved = {name: rows.copy() for name, rows in first.arrays.items()}
    first.advance(math.inf, 500)  # the saved copy is not touched
    second = Engine(scene, lattice_gas(scene))
    second.restore(saved)
    assert second.collisions == collisions
    second.advance(math.inf, 2000)
    assert same(straight, second)


@pytest.mark.parametrize("scene", SCENES)
def test_looking_more_often_changes_nothing(scene):
    rarely, often = Engine(scene, lattice_gas(scene)), Engine(scene, lattice_gas(scene))
    until = 0.3
    rarely.advance(until)
    for time in np.linspace(0, until, 501)[1:]:
        often.advance(time)
        often.state()
    assert often.time == pytest.approx(until, rel=1e-15)
    assert same(rarely, often)


def test_slices_of_events_are_the_whole():
    scene = SCENES[1]
    whole, sliced = Engine(scene, lattice_gas(scene)), Engine(scene, lattice_gas(scene))
    whole.advance(0.2)
    while sliced.advance(0.2, most_events=37) == loop.EVENTS:
        pass
    assert same(whole, sliced)


def test_a_state_is_exact_at_the_time_asked_for():
    scene = Scene(1, 0.1)
    start = lattice_gas(scene)
    engine = Engine(scene, start)
    engine.advance(0.37)
    expected = (start.position + 0.37 * start.velocity) % start.box
    np.testing.assert_allclose(engine.state().position, expected, rtol=0, atol=1e-15)
    assert engine.time == 0.37


def test_times_of_the_last_collisions_are_absolute():
    scene = SCENES[0]
    engine = Engine(scene, lattice_gas(scene))
    engine.advance(5.0)  # the origin of times has moved
    assert engine.arrays["calendar"]["base"][0] > 0
    state = engine.state()
    assert np.all(state.last_collision_time <= 5.0)
    assert np.all(state.last_collision_time > 4.8)
    assert np.all(state.last_collision_interval > 0)


def test_tallies_add_up():
    scene = SCENES[1]
    engine = Engine(scene, lattice_gas(scene))
    before = 0.5 * np.sum(engine.state().velocity ** 2)
    parts = []
    for time in (0.01, 0.05, 0.2):
        engine.advance(time)
        parts.append(engine.take_tally())
    after = 0.5 * np.sum(engine.state().velocity ** 2)
    assert sum(part.loss for part in parts) == pytest.approx(before - after, rel=1e-12)
    assert sum(part.collisions for part in parts) == engine.collisions
    np.testing.assert_allclose(parts[1].stress, parts[1].stress.T, rtol=1e-12)


@pytest.mark.parametrize(
    ("scene", "rule", "watch"),
    [
        (Scene(restitution=1.0, contact_time=0.0), "Elastic", "Nobody"),
        (Scene(restitution=1.0, contact_time=1e-5), "ElasticShare", "ElasticTime"),
        (Scene(restitution=0.4, contact_time=1e-5), "ContactTime", "Nobody"),
        (Scene(restitution=0.4, contact_time=0.0), "Constant", "CollapseWatch"),
    ],
)
def test_a_scene_calls_for_its_effects_only(scene, rule, watch):
    engine = Engine(scene, lattice_gas(scene))
    assert type(engine.rule).__name__ == rule
    assert type(engine.watch).__name__ == watch


def test_a_collapse_names_the_disks():
    scene = Scene(64, 0.5, restitution=0.0, contact_time=0.0)
    engine = Engine(scene, lattice_gas(scene))
    assert engine.advance(100.0) == loop.WATCH
    assert 3 <= len(engine.involved()) <= 64
    assert engine.time < 1.0

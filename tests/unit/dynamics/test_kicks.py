"""Random kicks: from the seed alone, whoever looks and wherever the run was interrupted."""

import math
from dataclasses import replace

import numpy as np
import pytest
from gases import lattice_gas

from granugas.dynamics.events import loop
from granugas.dynamics.events.effects.kicks import interval_of
from granugas.dynamics.events.engine import Engine
from granugas.scene import Scene

SCENE = Scene(100, 0.2, restitution=0.9, contact_time=0.0, heating=2.0)
SEED = (7, 0)


def engine_of(scene: Scene = SCENE, seed: tuple[int, ...] = SEED) -> Engine:
    return Engine(scene, replace(lattice_gas(scene), seed=seed))


def same(one: Engine, other: Engine) -> bool:
    """Bit for bit, but for the scratch table and what Python alone notes down."""
    passed_over = {("calendar", "until"), ("calendar", "reached")}
    return all(
        rows[field].tobytes() == other.arrays[name][field].tobytes()
        for name, rows in one.arrays.items()
        for field in rows.dtype.names
        if name != "near" and (name, field) not in passed_over
    )


def test_a_continued_run_is_the_uninterrupted_one():
    straight, first, second = engine_of(), engine_of(), engine_of()
    straight.advance(0.06)
    first.advance(0.025)
    assert 0 < first.effects["drive"].count.done < straight.effects["drive"].count.done
    second.restore({name: rows.copy() for name, rows in first.arrays.items()})
    second.advance(0.06)
    assert same(straight, second)


def test_looking_more_often_changes_nothing():
    rarely, often = engine_of(), engine_of()
    interval = interval_of(SCENE)
    rarely.advance(50.5 * interval)
    for time in np.linspace(0, 50.5, 102)[1:] * interval:  # at the kicks and between them
        often.advance(time)
        often.state()
    assert rarely.effects["drive"].count.done == 50
    assert same(rarely, often)


def test_slices_and_numbers_of_collisions_are_the_whole():
    whole, sliced, counted = engine_of(), engine_of(), engine_of()
    whole.advance(math.inf, 777)
    while sliced.advance(math.inf, 777 - sliced.collisions, most_events=130) == loop.EVENTS:
        pass
    for _ in range(7):
        assert counted.advance(math.inf, 111) == loop.COLLISIONS
    assert whole.collisions == sliced.collisions == counted.collisions == 777
    assert same(whole, sliced) and same(whole, counted)


def test_the_seed_decides():
    one, same_seed, other = engine_of(), engine_of(), engine_of(seed=(8, 0))
    for engine in (one, same_seed, other):
        engine.advance(0.02)
    assert same(one, same_seed)
    assert not np.array_equal(one.state().velocity, other.state().velocity)


def test_a_kick_changes_velocities_and_nothing_else():
    scene = replace(SCENE, n_particles=4000)
    engine, interval = engine_of(scene), interval_of(scene)
    engine.advance(interval * (1 - 1e-9))
    before, collided = engine.state(), engine.collisions
    engine.advance(interval)
    after = engine.state()
    assert engine.collisions == collided
    apart = (after.position - before.position) / engine.box
    assert np.abs(apart - np.rint(apart)).max() < 1e-9
    change = after.velocity - before.velocity
    np.testing.assert_allclose(change.mean(axis=0), 0, atol=1e-15)
    variance = scene.heating * interval  # 2 heating dt / D
    assert np.mean(change**2) == pytest.approx(variance, rel=0.05)
    assert np.mean(change**4) == pytest.approx(3 * variance**2, rel=0.15)


def test_kicks_differ_from_each_other():
    first, second = (engine_of().effects["drive"]._changes(k) for k in (0, 1))
    assert abs(np.corrcoef(first.ravel(), second.ravel())[0, 1]) < 0.3


def test_the_interval_is_short_at_the_start_and_in_the_steady_state():
    """A tenth of the mean free time, of the hotter of the two."""
    cool, hot = (interval_of(replace(SCENE, heating=heating)) for heating in (1e-9, 1e3))
    assert cool == interval_of(replace(SCENE, heating=0.1))
    assert hot < cool / 5
    assert interval_of(replace(SCENE, restitution=1.0, heating=1e3)) == cool


def test_events_are_predicted_anew():
    """After many kicks every disk's next event is what an engine finds that starts from here."""
    engine = engine_of()
    engine.advance(20 * interval_of(SCENE))
    afresh = Engine(replace(SCENE, heating=0.0), engine.state())
    goes_on = engine_of(replace(SCENE, heating=1e-30))
    for name, rows in engine.arrays.items():
        if not name.startswith("drive"):
            goes_on.arrays[name][:] = rows
    goes_on.effects["drive"].count.done = 10**9
    for one in (afresh, goes_on):
        one.advance(math.inf, 20)
    assert goes_on.time == pytest.approx(afresh.time, rel=1e-9)
    np.testing.assert_array_equal(goes_on.state().collisions, afresh.state().collisions)

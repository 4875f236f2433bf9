"""Scenes at the edge of what is allowed: they neither hang nor crash, and nothing overlaps."""

from dataclasses import replace

import numpy as np
import pytest
from gaps import TOLERATED, smallest_gap

from granugas.analysis.observables import kinetic_energy
from granugas.dynamics.events import loop
from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import at_rest, equilibrate, state_of
from granugas.initial import random_stream, sites, start_lattice
from granugas.scene import Scene

pytestmark = pytest.mark.timeout(600, method="thread")  # a signal would wait for the compiled code to return

MOST_EVENTS = 100_000_000
RULES = [(1.0, 0.0), (0.9, 1e-6), (0.4, 1e-9), (0.0, 1e-5)]
"""(r, t_c in s)."""


def started(scene: Scene) -> Engine:
    return Engine(scene, state_of(equilibrate(scene, seed=1998, collisions_per_particle=30)))


def on_lattice(scene: Scene, velocity: np.ndarray) -> Engine:
    lattice = start_lattice(scene)
    position = sites(lattice, scene.n_particles, random_stream(scene, 1998, 0))
    return Engine(scene, at_rest(position, velocity, lattice.box))


def energy(engine: Engine) -> float:
    return float(kinetic_energy(engine.state().velocity).sum())


def run_and_check(engine: Engine, until: float = np.inf, collisions: int = 2**62, parts: int = 10) -> None:
    """Advance in parts; no overlap, no step back in time, energy constant at r = 1 and never rising."""
    start = before = energy(engine)
    elastic = engine.scene.restitution == 1
    for part in range(1, parts + 1):
        stop = until * part / parts
        why = engine.advance(stop, collisions // parts, MOST_EVENTS)
        assert why == (loop.TIME if until < np.inf else loop.COLLISIONS)
        assert smallest_gap(engine) >= -TOLERATED
        assert energy(engine) <= before * (1 + 1e-11)
        before = energy(engine)
    assert engine.backwards == 0
    if elastic:
        assert before == pytest.approx(start, rel=1e-11)


@pytest.mark.parametrize(("restitution", "contact_time"), RULES)
@pytest.mark.parametrize("area_fraction", [0.001, 0.01, 0.3, 0.7, 0.72, 0.8, 0.88])
def test_area_fractions(area_fraction, restitution, contact_time):
    collisions = 100_000 if restitution == 1 else 8_000  # a dilute gas that cools further is at rest
    run_and_check(started(Scene(378, area_fraction, restitution, contact_time)), collisions=collisions)


@pytest.mark.parametrize(("restitution", "contact_time"), [(1.0, 0.0), (0.6, 1e-6)])
@pytest.mark.parametrize(
    ("n_particles", "area_fraction", "aspect_ratio"),
    [(2, 0.01, 0.01), (60, 0.01, 0.001), (60, 0.01, 1000.0), (60, 0.2, 0.01), (60, 0.45, 30.0), (1000, 0.4, 500.0)],
)
def test_needles(n_particles, area_fraction, aspect_ratio, restitution, contact_time):
    """Boxes from hardly wider than one disk to thousands of times longer than wide."""
    scene = Scene(n_particles, area_fraction, restitution, contact_time, aspect_ratio=aspect_ratio)
    engine = started(scene)
    assert engine.box[0] / engine.box[1] == pytest.approx(aspect_ratio, rel=0.5)
    run_and_check(engine, collisions=50 * n_particles)


@pytest.mark.parametrize(("restitution", "contact_time"), [(1.0, 0.0), (0.4, 1e-6)])
@pytest.mark.parametrize(
    ("n_particles", "area_fraction"),
    [(2, 0.05), (2, 0.7), (3, 0.65), (4, 0.7), (5, 0.45), (6, 0.55), (8, 0.75), (9, 0.7), (12, 0.88)],
)
def test_tiny_boxes(n_particles, area_fraction, restitution, contact_time):
    """Boxes of one to three cells, in which a disk meets several images of the same neighbour."""
    collisions = 50_000 if restitution == 1 else 20 * n_particles
    run_and_check(started(Scene(n_particles, area_fraction, restitution, contact_time)), collisions=collisions)


@pytest.mark.parametrize("area_fraction", [0.001, 0.3, 0.785])
def test_one_disk_flies_on(area_fraction):
    """1e6 s across its own periodic edges, to where a straight line leads."""
    scene = Scene(1, area_fraction, velocity_half_width=1e-6)
    engine = started(scene)
    start = engine.state()
    run_and_check(engine, until=1e6)
    assert engine.collisions == 0
    end = engine.state()
    np.testing.assert_array_equal(end.velocity, start.velocity)
    apart = end.position - start.position - 1e6 * start.velocity
    apart -= np.array(end.box) * np.rint(apart / end.box)
    np.testing.assert_allclose(apart, 0, atol=1e-9 * scene.diameter)


@pytest.mark.parametrize("length", [12.0, 2.5, 2.02])
@pytest.mark.parametrize("restitution", [1.0, 0.9, 0.5])
def test_two_disks_collide_when_they_must(restitution, length):
    """Head on, then around the box (d) through its edge, where they have L - 2d to go: u -> r u at each collision."""
    scene = Scene(2, 0.01, restitution, contact_time=0.0, diameter=1.0)
    position, velocity = np.array([[0.25, 0.4], [0.75, 0.4]]) * length, np.array([[0.25, 0.0], [-0.25, 0.0]])
    engine = Engine(scene, at_rest(position, velocity, (length, length)))
    expected, u = 0.0, 0.5
    for n in range(1, 11):
        expected += (length / 2 - 1 if n == 1 else length - 2) / u
        u *= restitution
        engine.advance(np.inf, most_collisions=1)
        assert engine.time == pytest.approx(expected, rel=1e-12)
        np.testing.assert_allclose(engine.state().velocity[:, 0], (-1) ** n * np.array([u, -u]) / 2, rtol=1e-12)


@pytest.mark.parametrize(("restitution", "contact_time"), RULES)
@pytest.mark.parametrize("area_fraction", [0.01, 0.3, 0.85])
def test_all_at_rest_but_one(area_fraction, restitution, contact_time):
    """One disk of a thousand moves: the rate of events grows a thousandfold from where the calendar expected it."""
    scene = Scene(1000, area_fraction, restitution, contact_time)
    velocity = np.zeros((1000, 2))
    velocity[123] = 0.3, 0.4
    engine = on_lattice(scene, velocity)
    assert engine.advance(20.0, 300_000, MOST_EVENTS) in (loop.TIME, loop.COLLISIONS)
    assert engine.collisions > 30
    assert engine.backwards == 0
    assert smallest_gap(engine) >= -TOLERATED
    assert energy(engine) <= 0.125 * (1 + 1e-11)


def test_all_alike_but_one():
    """A common velocity only carries all along: the same disks collide as at rest."""
    scene = Scene(64, 0.3, restitution=1.0, contact_time=0.0)
    alone = np.zeros((64, 2))
    alone[7] = 0.3, 0.4
    still, drifting = on_lattice(scene, alone), on_lattice(scene, alone + np.array([0.125, -0.0625]))
    for _ in range(8):  # later, rounding makes two trajectories of them
        for engine in (still, drifting):
            engine.advance(np.inf, most_collisions=1)
        np.testing.assert_array_equal(still.state().collisions, drifting.state().collisions)
        assert drifting.time == pytest.approx(still.time, rel=1e-9)


@pytest.mark.parametrize("velocity", [0.0, 0.3], ids=["at rest", "alike"])
def test_nothing_ever_happens(velocity):
    """No relative velocity, no collision; the end comes at once however far it is."""
    engine = on_lattice(Scene(100, 0.8, restitution=0.4), np.full((100, 2), velocity))
    assert engine.advance(10.0, most_events=MOST_EVENTS) == loop.TIME
    assert engine.time == pytest.approx(10.0, rel=1e-14)
    assert engine.collisions == 0


def test_speeds_over_twelve_orders_of_magnitude():
    """From picometres to metres per second, at rest for ages until something comes along."""
    scene = Scene(400, 0.05, restitution=1.0, contact_time=0.0)
    rng = np.random.default_rng(1998)
    speed, angle = 10.0 ** rng.uniform(-12, 0, 400), rng.uniform(0, 2 * np.pi, 400)
    engine = on_lattice(scene, speed[:, np.newaxis] * np.stack([np.cos(angle), np.sin(angle)], axis=1))
    run_and_check(engine, collisions=200_000)


def test_long_rests_between_collisions():
    """Each rest is ten times longer than the one before, up to 1e29 s: windows of the calendar in which nothing happens."""
    scene = Scene(2, 1e-4, restitution=0.1, contact_time=0.0)
    velocity = np.array([[1.0, 0.0], [-1.0, 0.0]])
    engine = Engine(scene, at_rest(np.array([[0.01, 0.05], [0.05, 0.05]]), velocity, (0.1, 0.1)))
    for n in range(1, 31):
        assert engine.advance(np.inf, 1, MOST_EVENTS) == loop.COLLISIONS
        assert np.abs(engine.state().velocity[:, 0]) == pytest.approx(0.1**n, rel=1e-9)
    assert engine.backwards == 0


@pytest.mark.parametrize(
    ("restitution", "contact_time", "until"), [(0.9, 1e-6, 1e6), (0.4, 1e-12, 1e6), (0.99, 0.0, 1e6), (0.8, 1e-5, 1e12)]
)
def test_long_cooling(restitution, contact_time, until):
    """From milliseconds between collisions to days and centuries."""
    engine = started(Scene(42, 0.2267, restitution, contact_time))
    run_and_check(engine, until=until)
    assert engine.time == pytest.approx(until, rel=1e-12)


@pytest.mark.parametrize("origin", [1e6, -3e9])
def test_the_origin_of_time_does_not_matter(origin):
    """A clock that shows 1e6 s or more at the start changes no bit of the trajectory."""
    scene = Scene(378, 0.3, restitution=1.0, contact_time=0.0)
    state = state_of(equilibrate(scene, seed=1998))
    here = Engine(scene, state)
    later = Engine(scene, replace(state, time=origin, last_collision_time=state.last_collision_time + origin))
    for engine in (here, later):
        engine.advance(np.inf, most_collisions=200_000)
    np.testing.assert_array_equal(later.state().position, here.state().position)
    np.testing.assert_array_equal(later.state().velocity, here.state().velocity)
    assert later.time - origin == pytest.approx(here.time, abs=1e-6)

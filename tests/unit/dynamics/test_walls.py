"""Walls: when they are touched, and what a hit does."""

import math

import numpy as np
import pytest
from gases import lattice_gas
from reference_walls import follow_between_walls

from granugas.dynamics.events import loop
from granugas.dynamics.events.effects.recorder import recorder
from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import at_rest
from granugas.scene import Scene

BOX = (8.0, 6.0)


def between_walls(position, velocity, size=100, **keys) -> Engine:
    """Disks of diameter 1 in a box of 8 x 6 with walls; the engine stops after `size` collisions, those with walls too."""
    n = len(position)
    keys = {"restitution": 1.0, "contact_time": 0.0, "boundary": "wall"} | keys
    scene = Scene(n, n * math.pi / 4 / math.prod(BOX), diameter=1.0, **keys)
    watch = None if size == 0 else recorder(size)
    return Engine(scene, at_rest(np.array(position, float), np.array(velocity, float), BOX), watch=watch)


def test_a_wall_is_touched_when_the_centre_is_a_radius_away():
    engine = between_walls([[2.0, 3.0]], [[-1.0, 0.25]], 3)
    assert engine.advance(20.0) == loop.WATCH
    np.testing.assert_allclose(engine.watch.seen.rows["time"], [1.5, 8.5, 10.0], rtol=1e-15)  # x, x, y
    assert engine.watch.seen.rows[["i", "j"]].tolist() == [(-1, 0)] * 3
    np.testing.assert_allclose(engine.state().position, [[6.0, 5.5]], rtol=1e-15)
    np.testing.assert_array_equal(engine.state().velocity, [[-1.0, -0.25]])


def test_a_corner_throws_back_where_one_came_from():
    engine = between_walls([[2.5, 2.5]], [[-0.5, -0.5]])
    engine.advance(7.0)
    np.testing.assert_allclose(engine.state().position, [[2.0, 2.0]], rtol=1e-15)
    np.testing.assert_array_equal(engine.state().velocity, [[0.5, 0.5]])
    assert engine.take_tally().more["wall_hits"] == 2


def test_nobody_meets_another_through_a_wall():
    through = ([[0.6, 3.0], [7.4, 3.0]], [[-1.0, 0.0], [1.0, 0.0]])
    walled, periodic = between_walls(*through), between_walls(*through, boundary="periodic wall")
    walled.advance(0.5)
    periodic.advance(0.5)
    assert (walled.collisions, periodic.collisions) == (0, 1)
    assert walled.take_tally().more["wall_hits"] == 2


def test_a_hit_at_a_wall_releases_the_partner():
    """The two have an appointment, until the one that flies ahead turns round: they meet earlier."""
    engine = between_walls([[4.0, 3.0], [6.5, 3.0]], [[2.0, 0.0], [1.0, 0.0]], 2)
    engine.advance(10.0)
    assert engine.watch.seen.rows[["i", "j"]].tolist() == [(-1, 1), (0, 1)]
    np.testing.assert_allclose(engine.watch.seen.rows["time"], [1.0, 1.0 + 0.5 / 3], rtol=1e-14)


@pytest.mark.parametrize("order", [[0, 1, 2], [1, 0, 2]])
def test_hits_and_collisions_that_follow_each_other_closely_are_those_of_brute_force(order):
    """The second is to meet the first, but is turned by the wall, then by the third: the old appointment is gone."""
    position = np.array([[7.45, 4.75], [7.2, 2.0], [6.5, 3.3]])[order]
    velocity = np.array([[0.0, 0.0], [0.6, 2.0], [0.0, 0.0]])[order]
    engine = between_walls(position, velocity, 3)
    expected = follow_between_walls(engine.state(), engine.scene, 3)
    engine.advance(10.0)
    seen = engine.watch.seen.rows
    np.testing.assert_array_equal(np.stack([seen["i"], seen["j"]], axis=1), expected.who)
    np.testing.assert_allclose(seen["time"], expected.time, rtol=1e-12)


def test_a_wall_takes_energy_and_momentum():
    engine = between_walls([[2.0, 3.0]], [[-1.0, 0.5]], wall_restitution=0.5)
    engine.advance(6.0)  # hits at 1.5 along x, at 5.0 along y
    tally = engine.take_tally()
    np.testing.assert_array_equal(engine.state().velocity, [[0.5, -0.25]])
    np.testing.assert_array_equal(tally.more["wall_momentum"], [[-1.5, 0.0], [0.0, 0.75]])
    assert tally.loss == pytest.approx(0.5 * (1.25 - 0.3125), rel=1e-15)
    assert tally.loss_time == pytest.approx(0.375 * 4.5 + 0.09375 * 1.0, rel=1e-14)
    np.testing.assert_allclose(tally.stress, [[-0.75, 0.0], [0.0, -0.375]], rtol=1e-15)  # dp by the radius, towards the wall
    assert engine.observe(engine.state())["wall_collisions_per_particle"] == 2.0


@pytest.mark.parametrize(("contact_time", "speed"), [(0.0, 0.9**4), (0.9, 0.9**4), (1.1, 0.9**3)])
def test_a_second_hit_within_the_contact_time_is_elastic(contact_time, speed):
    """Into the corner, to walls after 1 s and 2 s; then to those across, at times that are 1.2 s or more apart."""
    engine = between_walls([[1.5, 2.5]], [[-1.0, -1.0]], wall_restitution=0.9, wall_contact_time=contact_time)
    engine.advance(2.5)
    vx, vy = engine.state().velocity[0]
    assert (vx, vy) == (0.9, 0.9 if contact_time < 1 else 1.0)
    engine.advance(10.0)
    assert abs(np.prod(engine.state().velocity)) == pytest.approx(speed, rel=1e-14)


def test_hits_at_walls_make_the_next_collision_elastic():
    """The clock of a particle does not ask what it has hit (A Eq. 4)."""
    hit_before = ([[0.6, 3.0], [2.1, 3.0]], [[-1.0, 0.0], [0.0, 0.0]])
    for contact_time, loss in ((0.3, 0.75 / 4), (0.7, 0.0)):
        engine = between_walls(*hit_before, restitution=0.5, contact_time=contact_time)
        engine.advance(1.0)
        assert engine.collisions == 1
        assert engine.take_tally().loss == pytest.approx(loss, rel=1e-14)


def test_a_channel_has_one_pair_of_walls():
    engine = between_walls([[7.0, 3.0]], [[1.0, 1.0]], boundary="periodic wall")
    assert engine.cells == tuple(engine.arrays["grid"]["cells"][0] - [0, 1])
    engine.advance(3.0)
    np.testing.assert_allclose(engine.state().position, [[2.0, 5.0]], rtol=1e-15)


def test_elastic_particles_add_up_their_times_after_hits_too():
    engine = between_walls([[4.0, 3.0]], [[1.0, 0.0]], 0, contact_time=(1e-3, 2.0))
    engine.advance(39.0)  # hits at 3.5, 10.5, 17.5, 24.5, 31.5, 38.5: before the first it was never elastic, by its clock
    np.testing.assert_allclose(engine.take_tally().more["elastic_time"], [6e-3, 12.0])


def test_walls_of_the_lattice_hold_dense_gases():
    scene = Scene(100, 0.7, restitution=1.0, contact_time=0.0, boundary="wall")
    start = lattice_gas(scene)
    away = np.minimum(start.position, np.array(start.box) - start.position).min()
    assert away == pytest.approx(scene.diameter / 2, rel=1e-12)
    engine = Engine(scene, start, watch=recorder(30000))
    assert engine.advance(math.inf) == loop.WATCH
    state = engine.state()
    assert np.sum(state.velocity**2) == pytest.approx(np.sum(start.velocity**2), rel=1e-12)
    assert np.minimum(state.position, np.array(start.box) - state.position).min() >= scene.diameter / 2 * (1 - 1e-12)
    assert engine.backwards == 0

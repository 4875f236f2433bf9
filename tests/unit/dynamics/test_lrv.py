"""Beads on a line whose slow contacts merge: it ends, keeps momentum, and is the hard-bead model at threshold 0."""

import math

import numpy as np
import pytest

from granugas.dynamics.lrv import FREE, PERIODIC, WALLS, Contact, advance
from granugas.equilibrate import at_rest

D = 1.0


def beads(position, velocity, box=20.0):
    return at_rest(np.array(position, float)[:, np.newaxis], np.array(velocity, float)[:, np.newaxis], (box,))


def gas(n, seed=0, box=None):
    """Beads at random gaps, in any order, with no momentum."""
    rng = np.random.default_rng(seed)
    gaps = rng.uniform(0.1, 1.0, n)
    order = rng.permutation(n)
    velocity = rng.normal(size=n)
    place = (np.cumsum(gaps + D) - D / 2)[order]
    return beads(place, velocity - velocity.mean(), box or np.sum(gaps + D))


def energy(state):
    return 0.5 * float(np.sum(state.velocity**2))


def gaps_of(state):
    place = np.sort(state.position[:, 0])
    return np.diff(place, append=place[0] + state.box[0]) - D


def hard_beads(state, r, until):
    """The model without a threshold by brute force, on a ring: position, velocity and number of collisions."""
    x, v, (box,), now, done = state.position[:, 0].copy(), state.velocity[:, 0].copy(), state.box, 0.0, 0
    order = np.argsort(x)
    after = np.roll(order, -1)
    while True:
        gap, u = (x[after] - x[order]) % box - D, v[order] - v[after]
        gap[gap > box / 2] -= box
        delay = np.where(u > 0, np.maximum(gap, 0) / np.where(u > 0, u, 1), math.inf)
        k = np.argmin(delay)
        if now + delay[k] > until:
            return (x + v * (until - now)) % box, v, done
        x, now, done = x + v * delay[k], now + delay[k], done + 1
        i, j = order[k], after[k]
        v[i], v[j] = v[i] - (1 + r) / 2 * u[k], v[j] + (1 + r) / 2 * u[k]


@pytest.mark.parametrize("r", [1.0, 0.9])
@pytest.mark.parametrize("n", [2, 3, 8])
def test_without_a_threshold_beads_are_hard(n, r):
    start = gas(n)
    passage = advance(start, 6.0, D, Contact(r, 0.0))
    position, velocity, collisions = hard_beads(start, r, 6.0)
    assert passage.collisions == collisions > n
    assert passage.merged == 0
    np.testing.assert_allclose(passage.state.velocity[:, 0], velocity, atol=1e-9)
    np.testing.assert_allclose((passage.state.position[:, 0] - position + 1) % start.box[0], 1.0, atol=1e-9)
    assert passage.state.collisions.sum() == 2 * collisions


def test_elastic_beads_exchange_their_velocities():
    start = gas(20)
    after = advance(start, 50.0, D, Contact(1.0, 0.0)).state
    np.testing.assert_allclose(np.sort(after.velocity, axis=0), np.sort(start.velocity, axis=0), atol=1e-11)


@pytest.mark.parametrize("boundary", [PERIODIC, FREE])
@pytest.mark.parametrize("r", [0.0, 0.3, 0.9, 1.0])
@pytest.mark.parametrize("threshold", [1e-4, 0.1])
def test_it_ends_and_keeps_momentum(threshold, r, boundary):
    """Where hard beads collapse at once, too: 40 beads at r = 0 and .3. All losses are counted."""
    start = gas(40)
    passage = advance(start, 100.0, D, Contact(r, threshold, boundary))
    state = passage.state
    assert state.time == 100.0
    assert abs(state.velocity.sum()) < 1e-12
    assert energy(state) + passage.loss == pytest.approx(energy(start), rel=1e-12)
    assert np.all(gaps_of(state)[: None if boundary == PERIODIC else -1] > -1e-11)
    assert (passage.merged > 0) == (r < 0.9 or threshold == 0.1)


def test_on_a_ring_one_cluster_at_rest_is_left():
    """With r = 0 every gap but those of the free length closes in the end."""
    state = advance(gas(12), math.inf, D, Contact(0.0, 10.0)).state
    np.testing.assert_allclose(state.velocity, 0.0, atol=1e-13)


def test_slow_beads_merge_and_hang_together():
    """Masses 1 and 1, then 2 and 1."""
    passage = advance(beads([1.0, 3.0, 8.0], [0.2, 0.1, 0.0]), 90.0, D, Contact(0.9, 0.5, FREE))
    assert passage.merged == 2 and passage.collisions == 0
    assert passage.state.velocity[:, 0].tolist() == [passage.state.velocity[0, 0]] * 3
    assert passage.state.velocity[0, 0] == pytest.approx(0.1)
    np.testing.assert_allclose(np.diff(passage.state.position[:, 0]), D, atol=1e-13)


def test_an_impact_is_passed_through_a_cluster():
    """Newton's cradle: three beads at rest that touch; the last one leaves, and the others stay as they are (r = 1)."""
    cluster = beads([5.0, 6.0, 7.0, 1.0], [0.0, 0.0, 0.0, 1.0])
    passage = advance(cluster, 5.0, D, Contact(1.0, 0.1, FREE))
    np.testing.assert_allclose(passage.state.velocity[:, 0], [0.0, 0.0, 1.0, 0.0], atol=1e-15)
    assert passage.collisions == 3


def test_the_largest_relative_velocity_is_next():
    """r = .5: 1 -> (.25, .75), then .75 -> (.1875, .5625), whose neighbour then has .25 - .1875 < .1 and merges: .21875."""
    passage = advance(beads([1.0, 3.0, 4.0], [1.0, 0.0, 0.0]), 2.0, D, Contact(0.5, 0.1, FREE))
    np.testing.assert_allclose(passage.state.velocity[:, 0], [0.21875, 0.21875, 0.5625])
    assert (passage.collisions, passage.merged) == (2, 1)


def test_a_weak_impact_moves_the_cluster_as_a_whole():
    passage = advance(beads([1.0, 3.0, 4.0, 5.0], [0.4, 0.0, 0.0, 0.0]), 9.0, D, Contact(0.5, 0.5, FREE))
    np.testing.assert_allclose(passage.state.velocity[:, 0], 0.1)
    assert passage.loss == pytest.approx(0.5 * 0.75 * 0.16)


def test_walls_turn_beads_round_and_hold_slow_ones():
    contact = Contact(0.5, 0.3, WALLS)
    passage = advance(beads([2.5], [-1.0], box=5.0), 2.5, D, contact)
    assert passage.state.velocity.item() == 0.5
    assert passage.state.position.item() == pytest.approx(0.75)
    later = advance(passage.state, 100.0, D, contact)
    assert later.state.velocity.item() == 0.0
    assert later.state.position.item() == pytest.approx(0.5)
    assert (later.collisions, later.merged) == (1, 1)  # .5 becomes .25 at the one wall and 0 at the other


@pytest.mark.parametrize("boundary", [PERIODIC, WALLS, FREE])
def test_pieces_make_the_whole(boundary):
    """A cluster is known again from positions and velocities."""
    contact, start = Contact(0.6, 0.05, boundary), gas(15, seed=3)
    whole = advance(start, 30.0, D, contact)
    state, collisions, merged = start, 0, 0
    for time in np.linspace(0, 30.0, 301)[1:]:
        piece = advance(state, time, D, contact)
        state, collisions, merged = piece.state, collisions + piece.collisions, merged + piece.merged
    assert (collisions, merged) == (whole.collisions, whole.merged)
    np.testing.assert_allclose(state.velocity, whole.state.velocity, atol=1e-12)
    np.testing.assert_array_equal(state.collisions, whole.state.collisions)
    np.testing.assert_allclose(state.last_collision_time, whole.state.last_collision_time, atol=1e-11)


def test_so_many_impacts():
    passage = advance(gas(10), math.inf, D, Contact(1.0, 0.0), most_impacts=7)
    assert passage.collisions == 7
    assert passage.state.last_collision_time.max() == passage.state.time


def test_nobody_meets_anybody():
    start = beads([1.0, 5.0], [-1.0, 1.0])
    passage = advance(start, 3.0, D, Contact(0.5, 0.1, FREE))
    np.testing.assert_allclose(passage.state.position[:, 0], [-2.0, 8.0])
    assert passage.collisions == passage.merged == 0

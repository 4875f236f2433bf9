"""Beads on a line whose slow contacts merge: it ends, keeps momentum, and is the hard-bead model at threshold 0."""

import math
from dataclasses import replace

import numpy as np
import pytest

from granugas.checks import findings
from granugas.dynamics import engine_of
from granugas.dynamics.events.engine import Engine
from granugas.dynamics.events.loop import COLLISIONS, EVENTS, TIME
from granugas.dynamics.lrv import FREE, PERIODIC, WALLS, Beads, Contact, advance
from granugas.equilibrate import at_rest
from granugas.execute import perform, start_states
from granugas.runs import Run
from granugas.scene import Scene
from granugas.simulate import simulate
from granugas.storage.dataset import content_sha256
from granugas.storage.pooling import pool
from granugas.warm_up import warm_up

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


# --- as the dynamics of a scene

SCENE = Scene(40, 0.5, restitution=0.3, contact_time=0.0, dimensions=1, diameter=D, velocity_half_width=1.0, lrv_velocity=0.05)


def dynamics(scene=SCENE, start=None):
    return engine_of(scene, start or gas(scene.n_particles))


def test_a_scene_has_these_dynamics_where_it_says_so():
    assert isinstance(dynamics(), Beads)
    assert isinstance(dynamics(Scene(40, 0.5, restitution=0.3, contact_time=0.0, dimensions=1, diameter=D)), Engine)


def test_the_dynamics_do_not_depend_on_looks():
    """Sampled or not, in slices or at once: the same beads to the last bit."""
    straight, looked = dynamics(), dynamics()
    assert straight.advance(20.0) == TIME
    for time in np.linspace(0, 20.0, 301)[1:]:
        while looked.advance(time, most_events=1) == EVENTS:
            pass
        looked.state()
        looked.observe(looked.state(), looked.take_tally(), 1.0)
    assert looked.collisions == straight.collisions > 60
    for name in ("position", "velocity", "last_collision_time", "last_collision_interval", "collisions"):
        np.testing.assert_array_equal(getattr(looked.state(), name), getattr(straight.state(), name))
    alone = advance(gas(40), 20.0, D, Contact(0.3, 0.05)).state
    np.testing.assert_array_equal(straight.state().velocity, alone.velocity)


def test_it_goes_on_from_a_copy_of_its_arrays():
    straight, resumed = dynamics(), dynamics()
    straight.advance(1.0, 30)
    resumed.restore(saved := straight.arrays)
    for beads_ in (straight, resumed):
        beads_.advance(20.0)
    assert (resumed.time, resumed.collisions) == (20.0, straight.collisions)
    for name, rows in straight.arrays.items():
        np.testing.assert_array_equal(resumed.arrays[name], rows)
    assert not np.array_equal(saved["v"], straight.arrays["v"])
    a, b = straight.take_tally(), resumed.take_tally()
    assert (a.collisions, a.loss, a.loss_time) == (b.collisions, b.loss, b.loss_time)


def test_why_it_stops():
    engine = dynamics()
    assert engine.advance(math.inf, 5) == COLLISIONS and engine.collisions >= 5
    assert engine.advance(math.inf, -1) == COLLISIONS
    now = engine.time
    assert engine.advance(math.inf, most_events=1) == EVENTS and engine.time > now
    free = dynamics(start=beads(np.arange(40) * 2.0 + 1, np.full(40, 0.3), box=80.0))
    assert free.advance(7.0) == TIME and free.time == 7.0
    np.testing.assert_allclose(free.state().position[:, 0], (np.arange(40) * 2.0 + 3.1) % 80.0)
    assert free.advance(math.inf) == TIME and free.time == 7.0


def test_its_sums():
    """Two beads meet after 1 s with u = 1, r = .3; two others at u = .04 merge after 25 s. Taken at 10 and 30 s."""
    scene = replace(SCENE, n_particles=4)
    engine = dynamics(scene, beads([10.0, 12.0, 110.0, 112.0], [0.0, -1.0, 0.04, 0.0], box=300.0))
    engine.advance(10.0)
    tally = engine.take_tally()
    loss = 0.25 * (1 - 0.3**2)
    assert (tally.collisions, tally.elastic.tolist()) == (1, [0])
    assert (tally.loss, tally.loss_time) == pytest.approx((loss, 9 * loss))
    assert np.isnan(tally.stress).all() and tally.stress.shape == (1, 1)
    engine.advance(30.0)
    tally = engine.take_tally()
    assert tally.collisions == 1
    assert (tally.loss, tally.loss_time) == pytest.approx((0.25 * 0.0016, 5 * 0.25 * 0.0016))
    assert engine.state().collisions.tolist() == [1, 1, 1, 1]


def test_a_run_goes_on_where_hard_beads_collapse():
    asked = {"seed": 1, "samples": {"count": 30}, "snapshots": (100.0,), "progress": False}
    hard = simulate(replace(SCENE, lrv_velocity=0.0), 100.0, **asked)
    run = simulate(SCENE, 100.0, **asked)
    assert (hard["stop_reason"].item(), run["stop_reason"].item()) == ("inelastic_collapse", "time")
    np.testing.assert_allclose(run["trajectory"].values[0], hard["trajectory"].values[0], rtol=1e-14)
    assert np.all(np.diff(run["kinetic_energy"]) <= 1e-15) and run["kinetic_energy"].values[-1] < 1e-3
    assert abs(run["velocity"].sum()) < 1e-13
    assert run["events"].item() == run["collisions_per_particle"].values[-1] * 20 > 100
    assert np.isnan(run["reduced_pressure"]).all() and np.isnan(run["collisional_stress_xx"]).all()
    assert run.attrs["lrv_velocity"] == 0.05


def test_it_ends_where_one_cluster_is_left():
    run = simulate(replace(SCENE, lrv_velocity=10.0), {"collisions_per_particle": 1e4}, seed=1, progress=False)
    assert run["stop_reason"].item() == "no_more_events"
    assert 0 < run["stop_time"].item() < math.inf


class Kept:
    """Checkpoints in memory: one at every look."""

    is_due = True

    def __init__(self, last=None):
        self.saved, self._last = [], last

    def load(self):
        return self._last

    def save(self, arrays):
        self.saved.append({name: np.array(values) for name, values in arrays.items()})


def test_a_resumed_run_is_the_same_run():
    asked = {"seed": 1, "samples": {"count": 20}, "snapshots": (1.0, 20.0), "keep_motion": True, "progress": False}
    whole = simulate(SCENE, 20.0, checkpoint=(kept := Kept()), **asked)
    assert len(kept.saved) > 20
    for saved in kept.saved[5:20:7]:
        assert content_sha256(simulate(SCENE, 20.0, checkpoint=Kept(saved), **asked)) == content_sha256(whole)


def test_a_job_of_the_workflow_has_nothing_to_find():
    """Start states, runs, pool, checks; what is compiled ahead is the equilibration alone."""
    warm_up([SCENE])
    samples = {"spacing": "log", "count": 20, "first": 0.1, "axis": "collisions"}
    run = Run(SCENE, 1, (0, 1), {"collisions_per_particle": 8.0}, samples, (0.5,), 10.0, True)
    data = pool([perform(run, start_states(run))], ["restitution"])
    assert findings(data) == []
    assert np.all(data["events"] >= 160)

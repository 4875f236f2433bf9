"""Rules and watches, in runs of few disks."""

import math
from dataclasses import replace

import numpy as np
import pytest
from gases import lattice_gas

from granugas.dynamics.events import loop
from granugas.dynamics.events.effects.collapse import UNRESOLVED
from granugas.dynamics.events.effects.constant import Constant, Elastic
from granugas.dynamics.events.effects.contact_time import ContactTime
from granugas.dynamics.events.effects.elastic_share import ElasticShare
from granugas.dynamics.events.effects.recorder import recorder
from granugas.dynamics.events.engine import Engine
from granugas.dynamics.state import State
from granugas.equilibrate import at_rest
from granugas.scene import Scene

GAS = Scene(100, 0.4, restitution=1.0, contact_time=0.0)


def ran(scene, rule, collisions=3000) -> Engine:
    engine = Engine(scene, lattice_gas(scene), rule=rule)
    engine.advance(math.inf, collisions)
    return engine


def test_shares_count_what_each_contact_time_alone_would():
    times = (0.0, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2)
    scene = replace(GAS, contact_time=times)
    together = Engine(scene, lattice_gas(scene))
    together.advance(math.inf, 3000)
    alone = [ran(GAS, ContactTime(Constant(1.0), t_c)).take_tally().elastic[0] for t_c in times]
    counted = together.take_tally().elastic
    assert counted.tolist() == alone
    assert counted[0] == 0 < counted[1] < counted[-1] <= 3000
    assert together.take_tally().elastic.tolist() == [0] * len(times)  # taken is taken


def test_elastic_disks_collide_alike_under_every_rule():
    scene = replace(GAS, contact_time=(1e-5, 1e-3))
    rules = [
        Elastic(),
        Constant(1.0),
        ContactTime(Constant(1.0), 1e-4),
        ContactTime(Constant(0.3), math.inf),
        Engine(scene, lattice_gas(scene)).rule,
    ]
    first, *others = (ran(GAS, rule).arrays["disks"].tobytes() for rule in rules)
    assert isinstance(rules[-1], ElasticShare)
    assert all(other == first for other in others)


def test_without_a_contact_time_the_tc_rule_is_the_constant_one():
    assert (
        ran(GAS, ContactTime(Constant(0.8), 0.0)).arrays["disks"].tobytes() == ran(GAS, Constant(0.8)).arrays["disks"].tobytes()
    )


def test_the_clock_runs_on_when_the_origin_of_times_moves():
    """An elastic fraction that is as large late as early: the clocks are relative to the same origin as the rest."""
    engine = Engine(GAS, lattice_gas(GAS), rule=ContactTime(Constant(1.0), 2e-4))
    engine.advance(1.0)
    early = engine.take_tally()
    engine.advance(3.0)
    late = engine.take_tally()
    assert engine.arrays["calendar"]["base"][0] > 2.0
    share = [tally.elastic[0] / tally.collisions for tally in (early, late)]
    assert share[1] == pytest.approx(share[0], rel=0.02)
    assert 0.1 < share[0] < 0.9


def beads(drift: float) -> State:
    """Three disks in a row that moves: seen from it, the outer two fly towards the one in the middle, which rests."""
    position = np.array([[3.7, 5.0], [5.0, 5.0], [6.33, 5.0]])
    velocity = np.array([[1.0, 0.0], [0.0, 0.0], [-1.0, 0.0]])
    velocity += [drift, 0.4 * drift]
    return at_rest(position, velocity, (10.0, 10.0))


def bead_run(r: float, t_c: float = 0.0, drift: float = 0.0) -> tuple[int, Engine]:
    engine = Engine(Scene(3, 0.02, restitution=r, contact_time=t_c, diameter=1.0), beads(drift))
    return engine.advance(3.0), engine


@pytest.mark.parametrize("drift", [0.0, 0.8])
@pytest.mark.parametrize("r", [0.0, 1e-6, 0.03, 0.06, 0.07])
def test_three_beads_collapse_below_the_exact_bound(r, drift):
    """r < 7 - 4 sqrt(3) = .0718 (A section 2.1; exact for three free beads)."""
    why, engine = bead_run(r, drift=drift)
    assert why == loop.WATCH
    assert 20 < engine.collisions < 2 * UNRESOLVED
    assert engine.time < 0.33
    assert engine.involved().tolist() == [0, 1, 2]


@pytest.mark.parametrize("drift", [0.0, 0.8])
def test_who_goes_on_after_a_collapse_is_stopped_again(drift):
    _, engine = bead_run(0.03, drift=drift)
    for _ in range(3):
        assert engine.advance(3.0) == loop.WATCH
        assert engine.time < 0.33


@pytest.mark.parametrize("drift", [0.0, 0.8])
@pytest.mark.parametrize("r", [0.075, 0.09, 0.2, 0.8])
def test_three_beads_part_above_it(r, drift):
    why, engine = bead_run(r, drift=drift)
    assert why == loop.TIME
    assert engine.collisions < 50
    assert len(engine.involved()) == 0


def test_a_resumed_watch_remembers():
    scene = Scene(64, 0.5, restitution=0.0, contact_time=0.0)
    straight = Engine(scene, lattice_gas(scene))
    while len(straight.involved()) < 4:
        straight.advance(math.inf, 1)
    resumed = Engine(scene, lattice_gas(scene))
    resumed.restore(straight.arrays)
    assert resumed.involved().tolist() == straight.involved().tolist()
    assert straight.advance(100.0) == resumed.advance(100.0) == loop.WATCH
    assert resumed.collisions == straight.collisions
    assert resumed.involved().tolist() == straight.involved().tolist()


def test_a_contact_time_avoids_the_collapse():
    why, engine = bead_run(0.03, 1e-6)
    assert why == loop.TIME
    assert engine.collisions < 50


def test_the_recorder_writes_every_collision_down():
    scene = replace(GAS, n_particles=20)
    engine = Engine(scene, lattice_gas(scene), watch=recorder(200))
    assert engine.advance(math.inf) == loop.WATCH
    seen = engine.watch.seen.rows
    assert engine.collisions == 200 == engine.watch.count.n
    assert np.all(seen["i"] < seen["j"])
    np.testing.assert_array_equal(np.bincount(np.concatenate([seen["i"], seen["j"]]), minlength=20), engine.state().collisions)
    assert np.all(np.diff(seen["time"]) > 0)

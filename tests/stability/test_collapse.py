"""Inelastic collapse is noticed, and only where there is one; the TC model avoids it (A section 2)."""

import logging

import numpy as np
import pytest
from gaps import TOLERATED, smallest_gap

from granugas.dynamics.events import loop
from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import equilibrate, state_of
from granugas.scene import Scene
from granugas.simulate import simulate
from granugas.warm_up import warm_up

pytestmark = pytest.mark.timeout(600, method="thread")  # a signal would wait for the compiled code to return


def simulated(scene: Scene, until: float, realization: int = 0):
    spaced = {"spacing": "log", "count": 50}
    options = {"seed": 1998, "realization": realization, "keep_positions": False, "progress": False}
    return simulate(scene, until, samples=spaced, **options)


@pytest.mark.parametrize("realization", range(3))
@pytest.mark.parametrize("n_particles", [1435, 5740])
def test_strong_dissipation_without_contact_time_stops_by_itself(n_particles, realization, caplog):
    """Far below the r_c of A Eq. 22, in seconds of computing; what was sampled before stays."""
    scene = Scene(n_particles, restitution=0.4, contact_time=0.0)
    warm_up([scene])  # what compilation takes is apart
    with caplog.at_level(logging.WARNING, "granugas"):
        run = simulated(scene, 5.0, realization)
    assert run["stop_reason"] == "inelastic_collapse"
    stop = float(run["stop_time"])
    assert 0.01 < stop < 5.0
    np.testing.assert_array_equal(run["kinetic_energy"].notnull(), run["time"] <= stop)
    assert float(run["cpu_time"]) < 30
    (message,) = [line for line in caplog.messages if "inelastic collapse" in line]
    assert f"inelastic collapse at t = {stop:.9g} s" in message
    assert "contact_time > 0" in message


def test_who_collapses_is_near_each_other():
    """A handful of disks: three or more of them touch, the others did so a moment ago."""
    scene = Scene(5740, restitution=0.4, contact_time=0.0)
    engine = Engine(scene, state_of(equilibrate(scene, seed=1998)))
    assert engine.advance(5.0) == loop.WATCH
    who, state = engine.involved(), engine.state()
    assert 3 <= len(who) <= 100
    apart = state.position[who, np.newaxis] - state.position[who]
    apart -= np.array(state.box) * np.rint(apart / state.box)
    distance = np.hypot(apart[..., 0], apart[..., 1]) / scene.diameter
    np.fill_diagonal(distance, np.inf)
    nearest = distance.min(axis=1)
    assert np.sum(np.abs(nearest - 1) < 1e-12) >= 3
    assert nearest.max() < 1.1


@pytest.mark.parametrize(
    "until",
    [1.0, pytest.param(5.0, marks=[pytest.mark.full, pytest.mark.timeout(1800, method="thread")])],
)
def test_any_contact_time_avoids_it(until):
    """The same start states, t_c = 1e-12 s: far beyond the time of the collapse, nothing overlaps, energy still falls."""
    for realization in range(3):
        scene = Scene(5740, restitution=0.4, contact_time=1e-12)
        engine = Engine(scene, state_of(equilibrate(scene, seed=1998, realization=realization)))
        energy = []
        for stop in np.linspace(0.0, until, 26)[1:]:
            assert engine.advance(stop) == loop.TIME
            assert smallest_gap(engine) >= -TOLERATED
            energy.append(np.sum(engine.state().velocity ** 2))
        assert np.all(np.diff(energy) < 0)
        assert engine.backwards == 0


@pytest.mark.parametrize(("n_particles", "restitution"), [(42, 0.4), (378, 0.8), (1435, 0.9), (5740, 0.95)])
def test_clusters_alone_are_no_collapse(n_particles, restitution):
    """Above r_c runs without contact time go on to the end, strongly clustered or not."""
    run = simulated(Scene(n_particles, restitution=restitution, contact_time=0.0), 20.0)
    assert run["stop_reason"] == "time"
    assert float(run["kinetic_energy"][-1]) < 1e-3


@pytest.mark.parametrize("area_fraction", [0.05, 0.3, 0.7])
def test_disks_that_stick_collapse_at_once(area_fraction):
    """r = 0: three disks that meet collide without end."""
    scene = Scene(1435, area_fraction, restitution=0.0, contact_time=0.0)
    engine = Engine(scene, state_of(equilibrate(scene, seed=1998)))
    assert engine.advance(1.0, most_collisions=1_000_000) == loop.WATCH
    assert smallest_gap(engine) >= -TOLERATED


@pytest.mark.parametrize(("area_fraction", "reached"), [(0.05, 1.0), (0.3, 0.02), (0.7, 1e-3), (0.85, 1e-4)])
def test_time_goes_on_where_disks_stick(area_fraction, reached):
    """r = 0 with t_c = 1e-12 s: hundreds of collisions at one instant flood the calendar; they end, and time goes on."""
    scene = Scene(5740, area_fraction, restitution=0.0, contact_time=1e-12)
    engine = Engine(scene, state_of(equilibrate(scene, seed=1998)))
    engine.advance(reached, most_collisions=3_000_000)
    assert engine.time == pytest.approx(reached, rel=1e-12)
    assert engine.backwards == 0
    assert smallest_gap(engine) >= -TOLERATED

"""Direct simulation Monte Carlo: the dynamics as such. Its physics is in validation/test_dsmc.py."""

import math
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import binom

from granugas import simulate
from granugas.analysis.enskog import contact_value
from granugas.checks import findings
from granugas.dynamics import dsmc, engine_of
from granugas.dynamics.events.engine import Engine
from granugas.dynamics.events.loop import COLLISIONS, EVENTS, TIME
from granugas.dynamics.events.memory import COMPILED
from granugas.equilibrate import at_rest
from granugas.execute import perform, start_states
from granugas.runs import Run
from granugas.scene import Scene, SceneError
from granugas.storage.pooling import pool
from granugas.warm_up import warm_up

SCENE = Scene(300, 0.3, restitution=0.8, contact_time=1e-4, dynamics="dsmc", particles_per_cell=10.0)
SPHERES = replace(SCENE, dimensions=3, restitution=0.9)


def points(scene, seed=0):
    """Random places, normal velocities of the energy of the scene, no momentum."""
    rng, n, dimensions = np.random.default_rng(seed), scene.n_particles, scene.dimensions
    velocity = rng.normal(size=(n, dimensions))
    velocity -= velocity.mean(axis=0)
    velocity *= math.sqrt(2 * scene.energy_per_mass * n / np.sum(velocity**2))
    box = (scene.volume ** (1 / dimensions),) * dimensions
    return replace(at_rest(rng.uniform(0, box, (n, dimensions)), velocity, box), seed=(seed,))


def gas(scene=SCENE, seed=0):
    return engine_of(scene, points(scene, seed))


def bits(engine):
    """All of the particles, to the last bit."""
    state = engine.state()
    names = ("position", "velocity", "last_collision_time", "last_collision_interval", "collisions")
    return b"".join(getattr(state, name).tobytes() for name in names) + np.float64(state.time).tobytes()


def write_bits(path):
    """What `bits` are after some steps, for another process to compare."""
    found = []
    for scene in (replace(SCENE, n_particles=60), replace(SPHERES, n_particles=60), replace(SCENE, n_particles=2)):
        engine = gas(scene)
        engine.advance(math.inf, 300)
        tally = engine.take_tally()
        found.append(bits(engine) + np.array([tally.loss, tally.loss_time]).tobytes() + tally.stress.tobytes())
    Path(path).write_bytes(b"".join(found))


def test_a_scene_has_these_dynamics_where_it_says_so():
    assert isinstance(gas(), dsmc.Dsmc)
    assert isinstance(engine_of(Scene(300, 0.001), points(Scene(300, 0.001))), Engine)


@pytest.mark.parametrize("scene", [SCENE, SPHERES], ids=["disks", "spheres"])
def test_the_dynamics_do_not_depend_on_looks(scene):
    """Sampled often, in slices, by collisions and time, or not at all: the same particles to the last bit."""
    straight, looked = gas(scene), gas(scene)
    assert straight.advance(0.03) == TIME
    for time in np.linspace(0, 0.03, 101)[1:]:
        looked.advance(time, 7)
        while looked.advance(time, most_events=1) == EVENTS:
            pass
        looked.observe(looked.state(), looked.take_tally(), 1.0)
    assert looked.collisions == straight.collisions > 1000
    assert bits(looked) == bits(straight)


def test_a_look_into_a_step_sees_what_has_happened_so_far():
    engine, times, counts = gas(), [], []
    for _ in range(200):
        assert engine.advance(math.inf, 3) == COLLISIONS
        state = engine.state()
        times.append(engine.time)
        counts.append(engine.collisions)
        assert state.last_collision_time.max() <= state.time == engine.time
        assert state.collisions.sum() == 2 * engine.collisions
    assert counts == list(range(3, 603, 3))
    assert np.all(np.diff(times) > 0)
    again = gas()
    for time, count in zip(times, counts, strict=True):
        again.advance(time)
        assert abs(again.collisions - count) <= 1  # the last one may be at this time
    assert abs(again.state().position - state.position).max() < 1e-12


def test_tallies_add_up():
    """Whatever the pieces: loss is energy that is gone, and its time is when it went."""
    whole, parts = gas(), gas()
    before = 0.5 * np.sum(whole.state().velocity ** 2)
    whole.advance(0.02)
    total, pieces = whole.take_tally(), []
    for time in np.linspace(0, 0.02, 41)[1:]:
        parts.advance(time)
        pieces.append((time, parts.take_tally()))
    assert sum(piece.collisions for _, piece in pieces) == total.collisions == whole.collisions
    assert sum(piece.elastic for _, piece in pieces) == total.elastic > 0
    assert sum(piece.loss for _, piece in pieces) == pytest.approx(total.loss, rel=1e-12)
    assert before - 0.5 * np.sum(whole.state().velocity ** 2) == pytest.approx(total.loss, rel=1e-12)
    np.testing.assert_allclose(sum(piece.stress for _, piece in pieces), total.stress, rtol=1e-9, atol=1e-9)
    later = sum(piece.loss_time + piece.loss * (0.02 - time) for time, piece in pieces)
    assert later == pytest.approx(total.loss_time, rel=1e-9)
    assert 0 < total.loss_time < total.loss * 0.02
    assert whole.take_tally().collisions == 0


@pytest.mark.parametrize("within", [0.0101, 0.02])
def test_it_goes_on_from_a_copy_of_its_arrays(within):
    straight, resumed = gas(), gas(seed=1)
    straight.advance(within)
    straight.take_tally()
    straight.advance(math.inf, 11)
    resumed.restore({name: rows.copy() for name, rows in straight.arrays.items()})
    assert (resumed.time, resumed.collisions) == (straight.time, straight.collisions)
    for engine in (straight, resumed):
        engine.advance(0.04)
    assert bits(resumed) == bits(straight)
    a, b = straight.take_tally(), resumed.take_tally()
    assert (a.collisions, a.loss, a.loss_time) == (b.collisions, b.loss, b.loss_time)
    np.testing.assert_array_equal(a.stress, b.stress)


def test_threads_change_no_bit(tmp_path, monkeypatch):
    monkeypatch.setattr(dsmc.config, "NUMBA_NUM_THREADS", max(dsmc.config.NUMBA_NUM_THREADS, 1))
    scene = replace(SCENE, n_particles=3000)
    found = []
    for number in ("1", "2"):
        monkeypatch.setenv("OMP_NUM_THREADS", number)
        engine = gas(scene)
        engine.advance(0.01)
        engine.advance(0.0102)
        tally = engine.take_tally()
        found.append((bits(engine), tally.collisions, tally.loss, tally.loss_time, tally.stress.tobytes()))
    assert found[0] == found[1]


def test_as_many_threads_as_a_job_may_have(monkeypatch):
    monkeypatch.setattr(dsmc.config, "NUMBA_NUM_THREADS", 4)
    for said, number in {"1": 1, "3": 3, "99": 4, "0": 1, "": 1, "many": 1}.items():
        monkeypatch.setenv("OMP_NUM_THREADS", said)
        assert dsmc.threads() == number
    monkeypatch.delenv("OMP_NUM_THREADS")
    assert dsmc.threads() == 1


@pytest.mark.skipif(not COMPILED, reason="compares the other mode with this one")
def test_plain_python_does_the_same_bit_for_bit(tmp_path):
    write_bits(tmp_path / "compiled")
    path = os.pathsep.join([str(Path(__file__).parents[2]), *filter(None, [os.environ.get("PYTHONPATH")])])
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1", "PYTHONPATH": path}
    command = [sys.executable, "-W", "error", __file__, str(tmp_path / "plain")]
    subprocess.run(command, check=True, env=environment, timeout=300)
    assert (tmp_path / "plain").read_bytes() == (tmp_path / "compiled").read_bytes()


@pytest.mark.parametrize(("n", "n_cells", "nu", "dimensions"), [(2000, 50, 0.25, 2), (2000, 100, 0.6, 2), (1000, 50, 0.4, 3)])
def test_the_contact_value_has_no_bias(n, n_cells, nu, dimensions):
    """Its mean over points in cells, weighted by their pairs, is g(2a); g(n v/V_c) itself is too large."""
    values = dsmc.contact_values(Scene(n, nu, dimensions=dimensions, dynamics="dsmc"), n_cells)
    k = np.arange(n + 1)
    pairs = binom.pmf(k, n, 1 / n_cells) * k * (k - 1) / (n * (n - 1) / n_cells**2)
    mean = pairs @ values[np.minimum(k, len(values) - 1)]
    g = float(contact_value(nu, dimensions))
    assert mean == pytest.approx(g, rel=0.02 if nu > 0.5 else 1e-4)
    assert pairs @ contact_value(np.minimum(k * nu * n_cells / n, 0.9), dimensions) > 1.02 * g


def test_cells_are_nearly_cubes():
    scene = Scene(4000, 0.25, dynamics="dsmc", particles_per_cell=40.0)
    assert dsmc.cells_of(scene, (1.0, 1.0)) == (10, 10)
    assert dsmc.cells_of(scene, (4.0, 0.25)) == (40, 2)
    assert dsmc.cells_of(replace(scene, particles_per_cell=1e4), (1.0, 1.0)) == (1, 1)
    assert dsmc.cells_of(replace(scene, dimensions=3), (1.0, 1.0, 1.0)) == (5, 5, 5)


def test_one_collision():
    """Two disks: momentum and A Eqs. 2 and 3, by what is lost and passed on."""
    scene = Scene(2, 0.2, restitution=0.5, contact_time=0.0, dynamics="dsmc")
    engine = gas(scene)
    before = engine.state()
    assert engine.advance(math.inf, 1) == COLLISIONS
    after, tally = engine.state(), engine.take_tally()
    change = after.velocity[0] - before.velocity[0]
    u = before.velocity[1] - before.velocity[0]
    n = -change / np.linalg.norm(change)
    u_n = u @ n
    assert u_n < 0
    np.testing.assert_allclose(after.velocity.sum(axis=0), 0.0, atol=1e-16)
    assert (after.velocity[1] - after.velocity[0]) @ n == pytest.approx(-0.5 * u_n)
    assert tally.loss == pytest.approx(0.25 * (1 - 0.5**2) * u_n**2)
    np.testing.assert_allclose(tally.stress, scene.diameter * np.outer(change, n), rtol=1e-12)
    assert after.last_collision_time[0] == after.last_collision_time[1] > 0
    assert after.collisions.tolist() == [1, 1]


@pytest.mark.parametrize("n", [1, 2, 3, 10])
def test_few_particles(n):
    engine = gas(Scene(n, 0.05, restitution=1.0, contact_time=0.0, dynamics="dsmc")) if n > 1 else None
    if engine is None:
        lone = at_rest(np.array([[1e-3, 1e-3]]), np.zeros((1, 2)), (0.01, 0.01))
        engine = engine_of(Scene(1, 0.05, dynamics="dsmc"), lone)
        assert engine.advance(math.inf) == TIME and engine.advance(3.0) == TIME
        assert (engine.time, engine.collisions) == (3.0, 0)
        return
    assert engine.advance(math.inf, 1000) == COLLISIONS
    assert engine.collisions == 1000
    assert np.sum(engine.state().velocity ** 2) / 2 == pytest.approx(n * engine.scene.energy_per_mass, rel=1e-11)


def test_why_it_stops():
    engine = gas()
    assert engine.advance(math.inf, 0) == COLLISIONS and engine.collisions == 0
    assert engine.advance(math.inf, most_events=1) == EVENTS
    now = engine.time
    assert now > 0 and engine.advance(now / 2) == TIME and engine.time == now
    assert engine.advance(now + 1e-9) == TIME and engine.time == now + 1e-9


def test_particles_stay_in_the_box():
    for scene in (SCENE, replace(SCENE, n_particles=3, area_fraction=1e-6)):
        engine = gas(scene)
        for _ in range(20):
            engine.advance(math.inf, scene.n_particles)
            position = engine.state().position
            assert np.all((position >= 0) & (position < engine.box))


WRONG = [
    ({"dimensions": 1}, "dynamics = 'dsmc': allowed is events in one dimension"),
    ({"boundary": "wall"}, "dynamics = 'dsmc': allowed is events with boundary: dsmc knows smooth equal particles"),
    ({"sizes": "uniform", "heating": 1.0}, "allowed is events with sizes, heating"),
    ({"tangential_restitution": 0.0}, "allowed is events with tangential_restitution"),
    ({"material": "plastic", "yield_velocity": 0.1}, "allowed is events with material, yield_velocity"),
    ({"internal_modes": 1}, "allowed is events with internal_modes"),
    ({"critical_distance": 1e-5}, "allowed is events with critical_distance"),
    ({"rotation_angle": 1.0}, "allowed is events with rotation_angle"),
    ({"particles_per_cell": 1.0}, "particles_per_cell = 1.0: allowed is a number >= 2 and <= 10000"),
    ({"dynamics": "events", "particles_per_cell": 20.0}, "particles_per_cell = 20.0: allowed is 40 unless dynamics = dsmc"),
]


@pytest.mark.parametrize(("values", "said"), WRONG, ids=[said for _, said in WRONG])
def test_what_it_does_not_know_is_refused(values, said):
    with pytest.raises(SceneError) as raised:
        Scene(**({"dynamics": "dsmc"} | values))
    assert said in str(raised.value)


@pytest.mark.parametrize(("axis", "until"), [("time", {"time": 0.05}), ("collisions", {"collisions_per_particle": 10.0})])
def test_a_run_from_the_shared_start_state(axis, until):
    """Studies have what they have of events; states and checks too."""
    samples = {"spacing": "log", "count": 20, "first": 1e-3, "axis": axis}
    runs = [
        Run(replace(SCENE, dynamics=name, particles_per_cell=40.0), 1, (0, 1), until, samples, (0.001, 0.01), 20.0, True)
        for name in ("events", "dsmc")
    ]
    assert runs[0].state_address == runs[1].state_address and runs[0].address != runs[1].address
    states = start_states(runs[0])
    found = [perform(run, states) for run in runs]
    assert findings(pool(found, ["dynamics"])) == []
    np.testing.assert_allclose(found[0]["trajectory"].isel(time=0), found[1]["trajectory"].isel(time=0), rtol=1e-13)
    assert found[1]["kinetic_energy"].values[:, -1] == pytest.approx(found[0]["kinetic_energy"].values[:, -1], rel=0.4)
    if axis == "collisions":
        counts = found[1]["collisions_per_particle"].values[:, 1:]
        wanted = np.ceil(np.geomspace(1e-3, 10, 20) * 150) / 150
        np.testing.assert_allclose(counts, np.tile(wanted, (2, 1)))


def test_where_a_grid_has_several_contact_times_at_r_1():
    times = (1e-5, 1e-4, 1e-3)
    scene = replace(SCENE, restitution=1.0, contact_time=times)
    run = simulate(scene, {"collisions_per_particle": 60}, seed=1, samples={"count": 3}, progress=False)
    assert np.all(np.diff(run["elastic_collision_fraction"].values[-1]) > 0)
    held = run["elastic_particle_time_fraction"].values[-1]
    assert np.all((held > 0) & (held < 1)) and np.all(np.diff(held) > 0)


def test_it_is_compiled_ahead():
    warm_up([SCENE])


if __name__ == "__main__":
    write_bits(sys.argv[1])

"""Soft spheres: two that collide, many against plain numpy without lists, what is counted, and what looking does not change."""

import math
from dataclasses import replace

import numpy as np
import pytest
from gases import lattice_gas

from granugas.checks import findings
from granugas.dynamics import engine_of, softspheres
from granugas.dynamics.events.loop import COLLISIONS, EVENTS, TIME
from granugas.dynamics.neighbours import grid_of
from granugas.dynamics.soft_contact import spring, step_of
from granugas.dynamics.softspheres import SoftSpheres
from granugas.equilibrate import at_rest
from granugas.execute import perform, start_states
from granugas.runs import Run
from granugas.scene import Scene
from granugas.storage.pooling import pool
from granugas.warm_up import warm_up

D, T_C, U = 1e-3, 1e-4, 1.0
SOFT = {"dynamics": "soft_spheres", "contact_time": T_C}


def energy(state):
    return 0.5 * float(np.sum(state.velocity**2))


def two(r, steps, phase, dimensions=2):
    """Two that meet head on along a diagonal, U apart in velocity: r, duration (t_c), balance of energy, the dynamics."""
    scene = Scene(2, 0.01, restitution=r, dimensions=dimensions, steps_per_contact=steps, **SOFT)
    n, centre = np.ones(dimensions) / math.sqrt(dimensions), np.full(dimensions, 10 * D)
    gap = (3 + phase) * U * T_C / steps
    position = np.array([centre - n * (D + gap) / 2, centre + n * (D + gap) / 2])
    engine = engine_of(scene, at_rest(position, np.array([n, -n]) * U / 2, (20 * D,) * dimensions))
    engine.advance(2 * T_C)
    state, tally = engine.state(), engine.take_tally()
    rate = float((state.velocity[1] - state.velocity[0]) @ n)
    end = 2 * T_C - float((state.position[1] - state.position[0]) @ n - D) / rate
    balance = (energy(state) + tally.loss + tally.stored) / (U**2 / 4) - 1
    return np.array([rate / U - r, (end - gap / U) / T_C - 1, balance]), engine


@pytest.mark.parametrize("r", [1.0, 0.9, 0.6, 0.37, 0.1])
def test_a_pair_parts_with_r_after_t_c(r):
    """At every phase of the step in which the contact begins; three times as many steps, errors of a third at most."""
    phases = np.random.default_rng(1).uniform(size=60)
    errors = {steps: np.array([two(r, steps, phase)[0] for phase in phases]) for steps in (66, 200)}
    assert np.abs(errors[200]).max() < 3e-3
    coarse, fine = (np.sqrt(np.mean(error**2, axis=0)) for error in errors.values())
    assert np.all(fine < coarse / 3)
    assert r < 1 or np.abs(errors[200][:, ::2]).max() < 1e-6


@pytest.mark.parametrize("dimensions", [1, 2, 3])
def test_two_in_all_dimensions(dimensions):
    error, engine = two(0.6, 200, 0.3, dimensions)
    assert np.all(np.abs(error) < 3e-3)
    state = engine.state()
    assert abs(state.velocity.sum()) < 1e-12
    assert engine.collisions == 1 and state.collisions.tolist() == [1, 1]
    np.testing.assert_allclose(state.last_collision_time, 3.3 * T_C / 200, rtol=1e-9)


def plain(scene, state, steps):
    """The same steps in plain numpy, all pairs at every step, no list: places and velocities after each."""
    dt, k_gamma, d = step_of(scene), np.array(spring(scene.contact_time, scene.restitution)) / 2, scene.diameter
    wall, radius = np.array(spring(scene.wall_contact_time or scene.contact_time, scene.wall_restitution)), scene.diameter / 2
    box, walled = np.array(state.box), np.array(scene.walled)
    i, j = np.triu_indices(scene.n_particles, 1)

    def push(overlap, rate, law):
        way = np.abs(rate) * dt
        share = np.where(overlap >= way, 1.0, 0.5 + overlap / np.where(way > 0, way, 1.0))
        return np.where(overlap > 0, law[0] * overlap + law[1] * share * rate, 0.0)

    def acceleration(x, v):
        a, r = np.zeros_like(x), x[j] - x[i]
        r -= np.where(walled, 0.0, box * np.round(r / box))
        distance = np.sqrt(np.sum(r**2, axis=1))
        n = r / distance[:, np.newaxis]
        force = push(d - distance, np.sum((v[i] - v[j]) * n, axis=1), k_gamma)[:, np.newaxis] * n
        np.add.at(a, i, -force)
        np.add.at(a, j, force)
        low, high = push(radius - x, -v, wall), push(radius - box + x, v, wall)
        return a + np.where(walled, low - high, 0.0)

    x, v = state.position.copy(), state.velocity.copy()
    a = acceleration(x, v)
    rows = []
    for _ in range(steps):
        half = v + a * dt / 2
        x = x + half * dt
        a = acceleration(x, half + a * dt / 2)
        v = half + a * dt / 2
        rows.append((x, v))
    return rows


@pytest.mark.parametrize(
    "scene",
    [
        Scene(64, 0.5, restitution=0.8, **SOFT),
        Scene(40, 0.3, restitution=1.0, **SOFT | {"contact_time": 1e-3}),
        Scene(6, 0.5, restitution=0.9, **SOFT | {"contact_time": 5e-4}),
        Scene(64, 0.3, restitution=0.6, dimensions=3, **SOFT | {"contact_time": 5e-4}),
        Scene(40, 0.6, restitution=0.8, dimensions=1, **SOFT | {"contact_time": 5e-4}),
        Scene(64, 0.5, restitution=0.8, boundary="periodic wall", wall_restitution=0.5, wall_contact_time=5e-5, **SOFT),
    ],
    ids=["dense", "long contacts", "few", "spheres", "beads", "walls"],
)
def test_lists_change_nothing(scene):
    """As far as rounding has not grown: some collisions of each."""
    start, steps = lattice_gas(scene), 600
    middle = np.array(start.box) / 2
    start = replace(start, position=middle + 0.999 * (start.position - middle))  # nobody touches a wall
    engine = engine_of(scene, start)
    dt = step_of(scene)
    for k, (x, v) in enumerate(plain(scene, start, steps), 1):
        if k % 60 == 0:
            engine.advance((k + 1e-6) * dt)
            state = engine.state()
            box = np.array(start.box)
            apart = state.position - x - v * 1e-6 * dt
            assert np.abs(apart - box * np.round(apart / box)).max() < 1e-9 * D
            np.testing.assert_allclose(state.velocity, v, atol=1e-7)
    assert engine.collisions > scene.n_particles / 5
    assert engine._rows["sums"]["nearer"][0] < dt * k  # the list was made anew on the way


@pytest.mark.parametrize("walled", [(False, False), (True, False), (True, True)])
@pytest.mark.parametrize("count", [(1, 1), (2, 3), (2, 1), (5, 4)])
def test_each_pair_of_neighbouring_cells_is_there_once(count, walled):
    grid = grid_of(tuple(1.01 * n for n in count), walled, 1.0, 1000)
    assert grid.count == count
    first, beside = grid.cells.rows["first"], grid.beside.rows["cell"]
    found = [(c, int(o)) for c in range(grid.n_cells) for o in beside[first[c] : first[c + 1]]]
    expected = set()
    for a in np.ndindex(*count):
        for step in np.ndindex(3, 3):
            b = np.array(a) + step - 1
            inside = (b >= 0) & (b < count)
            if np.all(inside | ~np.array(walled)):
                pair = sorted(int(np.ravel_multi_index(tuple(np.mod(c, count)), count)) for c in (a, b))
                expected.add(tuple(pair))
    assert sorted(found) == sorted(pair for pair in expected if pair[0] != pair[1])


GAS = Scene(60, 0.4, restitution=0.8, **SOFT)


def dynamics(scene=GAS):
    return engine_of(scene, lattice_gas(scene))


def test_a_scene_has_these_dynamics_where_it_says_so():
    assert isinstance(dynamics(), SoftSpheres)
    assert not isinstance(dynamics(Scene(60, 0.4)), SoftSpheres)


@pytest.mark.parametrize("scene", [GAS, replace(GAS, boundary="wall", wall_restitution=0.7)], ids=["periodic", "walls"])
def test_the_dynamics_do_not_depend_on_looks(scene):
    straight, looked = dynamics(scene), dynamics(scene)
    assert straight.advance(0.02) == TIME
    sums = []
    for time in np.linspace(0, 0.02, 301)[1:]:
        while looked.advance(time, most_events=1) == EVENTS:
            pass
        sums.append(looked.take_tally())
        looked.observe(looked.state(), sums[-1], 1.0)
    assert looked.collisions == straight.collisions == sum(tally.collisions for tally in sums) > 300
    for name in ("position", "velocity", "last_collision_time", "last_collision_interval", "collisions"):
        np.testing.assert_array_equal(getattr(looked.state(), name), getattr(straight.state(), name))
    tally = straight.take_tally()
    for name in ("loss", "stored", "stress"):
        np.testing.assert_allclose(sum(getattr(each, name) for each in sums), getattr(tally, name), rtol=1e-9, atol=1e-12)
    left = np.linspace(0, 0.02, 301)[:0:-1] - 0.02 / 300  # of the whole interval, after the end of each piece
    for name in ("loss", "stored"):
        moment = sum(getattr(t, f"{name}_time") + getattr(t, name) * rest for t, rest in zip(sums, left, strict=True))
        assert moment == pytest.approx(getattr(tally, f"{name}_time"), rel=1e-9)


def test_it_goes_on_from_a_copy_of_its_arrays():
    straight, resumed = dynamics(), dynamics()
    straight.advance(0.0031)
    saved = {name: rows.copy() for name, rows in straight.arrays.items()}
    resumed.restore(saved)
    for engine in (straight, resumed):
        engine.advance(0.02)
    assert (resumed.time, resumed.collisions) == (0.02, straight.collisions)
    for name, rows in straight.arrays.items():
        assert rows.tobytes() == resumed.arrays[name].tobytes(), name
    a, b = straight.take_tally(), resumed.take_tally()
    assert (a.collisions, a.loss, a.loss_time, a.stored_time) == (b.collisions, b.loss, b.loss_time, b.stored_time)


def test_why_it_stops():
    engine = dynamics()
    assert engine.advance(math.inf, 5) == COLLISIONS and 5 <= engine.collisions < 10
    assert engine.advance(math.inf, 0) == COLLISIONS
    now = engine.time
    assert engine.advance(math.inf, most_events=1) == EVENTS and engine.time == pytest.approx(now + step_of(GAS), rel=1e-9)
    assert engine.advance(0.0123) == TIME and engine.time == 0.0123
    assert engine.advance(0.0123, 0) == COLLISIONS and engine.time == 0.0123
    assert engine.involved().size == 0 and len(engine.cells) == 2


@pytest.mark.compiled
def test_energy_momentum_and_overlaps():
    """What is lost is counted; without loss, energy is kept to the error of a step within contacts."""
    for r, error in ((1.0, 1e-4), (0.8, 3e-3)):
        engine = dynamics(replace(GAS, restitution=r))
        before = energy(engine.state())
        engine.advance(0.05)
        state, tally = engine.state(), engine.take_tally()
        assert tally.collisions > 500 and (tally.loss > 0) == (r < 1)
        assert abs(state.velocity.sum(axis=0)).max() < 1e-12
        assert energy(state) + tally.loss + tally.stored == pytest.approx(before, rel=error)
        overlap = engine.observe(state)["elastic_energy"] * before
        assert overlap == pytest.approx(tally.stored, abs=1e-15 * before)
        assert overlap > 0 or r < 1


def test_what_is_counted():
    """Newton's cradle: the first two contacts begin one after the other, the third while the second lasts."""
    position = np.array([[1.0, 5.0], [2.5, 5.0], [3.51, 5.0], [4.52, 5.0]]) * D
    velocity = np.array([[U, 0.0], [0.0, 0.0], [0.0, 0.0], [0.0, 0.0]])
    engine = engine_of(replace(GAS, n_particles=4, restitution=1.0), at_rest(position, velocity, (10 * D, 10 * D)))
    engine.advance(9e-4)
    tally, state = engine.take_tally(), engine.state()
    assert (tally.collisions, tally.elastic.tolist()) == (3, [2])
    assert state.collisions.tolist() == [1, 2, 2, 1]
    assert state.last_collision_time[0] == pytest.approx(0.5e-3, rel=1e-9)
    assert 0 < state.last_collision_interval[1] < T_C and state.last_collision_interval[0] == math.inf
    # all momentum goes on along the row: its sum over partners is that of the force times the distance of the centres
    assert -tally.stress[0, 0] == pytest.approx(3 * U * D, rel=0.05)
    assert abs(tally.stress[1]).max() == 0


@pytest.mark.parametrize(("r", "wall_time"), [(0.5, 0.0), (1.0, 0.0), (0.7, 5e-5)])
def test_a_wall_gives_back_r_after_its_t_c(r, wall_time):
    scene = Scene(1, 0.01, boundary="wall", wall_restitution=r, wall_contact_time=wall_time, steps_per_contact=200, **SOFT)
    start = at_rest(np.array([[1.0 * D, 5 * D]]), np.array([[-U, 0.1]]), (10 * D, 10 * D))
    engine = engine_of(scene, start)
    engine.advance(1e-3)
    state, tally = engine.state(), engine.take_tally()
    assert state.velocity[0] == pytest.approx([r * U, 0.1], abs=3e-3)
    lasts = 1e-3 - 0.5e-3 - (state.position[0, 0] - 0.5 * D) / state.velocity[0, 0]
    assert lasts == pytest.approx(wall_time or T_C, abs=3e-3 * T_C)
    taken = tally.more["wall_momentum"]
    np.testing.assert_allclose(taken, [[-(1 + r) * U, 0], [0, 0]], atol=3e-3)
    assert tally.loss == pytest.approx((1 - r**2) * U**2 / 2, abs=2e-3)
    found = engine.observe(state, tally, 1e-3)
    assert found["wall_collisions_per_particle"] == 1
    assert tally.stress[0, 0] == pytest.approx(-(1 + r) * U * D / 2, rel=0.06)
    force, area, unit = (1 + r) * U / 1e-3, 40 * D, (10 * D) ** 2
    mean = (0.5e-3 * U**2 + 0.4e-3 * r**2) / 1e-3 + 0.01  # of v^2, but for the contact
    assert found["wall_pressure"] == pytest.approx(force / area * unit / (mean / 2), rel=0.15)


@pytest.mark.compiled
def test_a_job_of_the_workflow_has_nothing_to_find():
    """Start states, runs, pool, checks, at r = 1 and below."""
    warm_up([GAS])
    samples = {"spacing": "linear", "count": 20, "first": 1e-3, "axis": "time"}
    runs = [Run(replace(GAS, restitution=r), 1, (0, 1), {"time": 0.02}, samples, (0.01,), 10.0, True) for r in (0.8, 1.0)]
    data = pool([perform(run, start_states(run)) for run in runs], ["restitution"])
    assert findings(data) == []
    assert np.all(data["events"] > 100) and np.all(data["elastic_energy"] >= 0)
    assert not data["reduced_pressure"].isel(time=slice(1, None)).isnull().any()
    assert findings(data.drop_vars("elastic_energy")) != []


def test_a_list_that_grows_on_the_way_has_room(monkeypatch):
    """A cloud that falls together: pairs are more than the first table holds, and nothing is written into an old one."""
    scene = Scene(64, 0.02, restitution=0.4, **SOFT)
    side = math.sqrt(scene.volume)
    place = (np.stack(np.meshgrid(np.arange(8), np.arange(8)), axis=-1).reshape(-1, 2) + 0.5) * side / 8
    engine = SoftSpheres(scene, at_rest(place, (side / 2 - place) * 50.0, (side, side)))
    rows, seen = len(engine._rows["pairs"]), []
    original = softspheres.listed

    def listed(gas, count):
        seen.append((count, gas.pairs.rows is engine._rows["pairs"]))
        original(gas, count)

    monkeypatch.setattr(softspheres, "listed", listed)
    engine.advance(0.03)
    assert max(count for count, _ in seen) > rows
    assert all(same for _, same in seen)

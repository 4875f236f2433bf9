"""Scenes that are hard on numbers, one by one; d = 1 unless a gas is asked for. More of them stand in test_extremes.py."""

import math

import numpy as np
import pytest
from gaps import TOLERATED, smallest_gap
from gases import lattice_gas

from granugas.dynamics.events import loop
from granugas.dynamics.events.effects.recorder import recorder
from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import at_rest, equilibrate, state_of
from granugas.scene import Scene
from granugas.simulate import simulate

pytestmark = pytest.mark.timeout(300, method="thread")  # a signal would wait for the compiled code to return

MOST_EVENTS = 20_000_000
THRESHOLD = 7 - 4 * math.sqrt(3)
"""r below which three disks in a row collapse (A section 2.1)."""


def engine_of(position, velocity, box, r=1.0, t_c=0.0, watch=None) -> Engine:
    position, velocity = np.array(position, float), np.array(velocity, float)
    scene = Scene(len(position), 0.02, restitution=r, contact_time=t_c, diameter=1.0)
    return Engine(scene, at_rest(position, velocity, box), watch=watch)


def row(x, velocity, angle=0.0, middle=(8.0, 8.0)) -> tuple[np.ndarray, np.ndarray]:
    """Disks in a row through the middle of the box that move along it: positions (N, 2) and velocities (N, 2)."""
    along = np.array([math.cos(angle), math.sin(angle)])
    return np.array(middle) + np.outer(x, along), np.outer(velocity, along)


def energy(engine: Engine) -> float:
    return float(np.sum(engine.state().velocity ** 2) / 2)


def check(engine: Engine, why: int) -> None:
    assert why != loop.EVENTS
    assert engine.backwards == 0
    assert smallest_gap(engine) >= -TOLERATED


# dissipation at its strongest


@pytest.mark.parametrize("angle", [0.0, math.pi / 2, 1.0])
@pytest.mark.parametrize(("part", "least", "most"), [(0.95, 31, 200), (1.05, 3, 19)])
def test_three_in_a_row_near_the_threshold(part, least, most, angle):
    """Below it they collide until rounding ends it, which is noticed; above it they part after some collisions."""
    engine = engine_of(*row([-1.3, 0.0, 1.33], [1.0, 0.0, -1.0], angle), (16.0, 16.0), r=part * THRESHOLD)
    why = engine.advance(3.0, 10_000)
    check(engine, why)
    assert least <= engine.collisions <= most
    assert why == (loop.WATCH if part < 1 else loop.TIME)


@pytest.mark.parametrize("contact_time", [0.0, 1e-9])
@pytest.mark.parametrize("restitution", [0.0, 1e-3])
@pytest.mark.parametrize("area_fraction", [0.05, 0.5, 0.85])
def test_hardly_any_restitution(area_fraction, restitution, contact_time):
    """Without a contact time the collapse is named; with one time goes on."""
    scene = Scene(200, area_fraction, restitution, contact_time)
    engine = Engine(scene, lattice_gas(scene))
    start, before = energy(engine), 0.0
    for _ in range(10):
        why = engine.advance(math.inf, 1000, MOST_EVENTS)
        check(engine, why)
        if why == loop.WATCH:
            break
        assert engine.time > before
        before = engine.time
    assert why == (loop.WATCH if contact_time == 0 else loop.COLLISIONS)
    assert energy(engine) + engine.take_tally().loss == pytest.approx(start, rel=1e-12)


@pytest.mark.parametrize("contact_time", [1.0, 1e3, 1e9])
@pytest.mark.parametrize("area_fraction", [0.01, 0.5, 0.86])
def test_contact_time_far_above_the_free_time(area_fraction, contact_time):
    """The first collision of two fresh disks dissipates, and none after that."""
    scene = Scene(200, area_fraction, 0.4, contact_time)
    engine = Engine(scene, lattice_gas(scene))
    while np.any(engine.state().collisions == 0):
        check(engine, engine.advance(math.inf, 100, MOST_EVENTS))
    tally, left = engine.take_tally(), energy(engine)
    assert engine.time < contact_time
    assert 0 < tally.collisions - tally.elastic[0] <= 100
    check(engine, engine.advance(math.inf, 50_000, MOST_EVENTS))
    assert engine.take_tally().elastic.tolist() == [50_000]
    assert energy(engine) == pytest.approx(left, rel=1e-12)


# hardly any disks, hardly any room


@pytest.mark.parametrize("restitution", [1.0, 0.5, 0.0])
def test_two_disks_one_at_rest(restitution):
    """Head on: the centre of mass moves on with u/2, and they part with r u."""
    engine = engine_of([[2.0, 4.0], [6.0, 4.0]], [[1.0, 0.0], [0.0, 0.0]], (64.0, 64.0), restitution)
    why = engine.advance(10.0)
    check(engine, why)
    assert engine.collisions == 1
    np.testing.assert_allclose(engine.state().velocity, [[(1 - restitution) / 2, 0], [(1 + restitution) / 2, 0]], atol=1e-15)


@pytest.mark.parametrize("restitution", [1.0, 0.4])
@pytest.mark.parametrize(("nx", "ny"), [(1, 100), (100, 1), (2, 50), (4, 30)])
def test_needle_in_which_disks_cannot_pass(nx, ny, restitution):
    """A box hardly wider than its columns of disks; where there is but one column, their order along it stays."""
    room = 1.05
    columns, rows = np.meshgrid(np.arange(nx), np.arange(ny))
    position = (np.stack([columns.ravel(), rows.ravel()], axis=1) + 0.5) * room
    velocity = np.random.default_rng(1998).uniform(-1, 1, position.shape)
    engine = engine_of(position, velocity, (nx * room, ny * room), restitution, t_c=1e-6)
    for _ in range(10):
        check(engine, engine.advance(math.inf, 20 * nx * ny, MOST_EVENTS))
    axis = 0 if nx > ny else 1
    if min(nx, ny) == 1:
        x = engine.state().position[:, axis]
        around = np.diff(np.concatenate([x, x[:1]])) % engine.box[axis]
        assert around.sum() == pytest.approx(engine.box[axis], rel=1e-9)  # once around, each behind the one before


@pytest.mark.parametrize(("restitution", "contact_time"), [(1.0, 0.0), (0.9, 1e-7)])
def test_perfect_crystal_near_close_packing(restitution, contact_time):
    """An area fraction of .9, where disks have .4 % of d to go: nobody leaves its neighbours."""
    scene = Scene(240, 0.9, restitution, contact_time, lattice="triangular")
    engine = Engine(scene, lattice_gas(scene))
    start = engine.state()
    for _ in range(10):
        check(engine, engine.advance(math.inf, 6000, MOST_EVENTS))
    moved = engine.state().position - start.position - engine.time * start.velocity.mean(axis=0)
    moved -= np.array(engine.box) * np.rint(moved / engine.box)
    assert np.abs(moved).max() < 0.3 * scene.diameter
    assert np.all(engine.state().collisions > 100)


# at one and the same time


@pytest.mark.parametrize("angle", [0.0, math.pi / 2, 0.3])
@pytest.mark.parametrize("comes", [1, 2, 3])
def test_newtons_cradle(comes, angle):
    """So many disks come in touch, so many leave, however many rest in touch in between."""
    x = np.concatenate([np.arange(comes) - 6.0, np.arange(4) - 1.0])
    engine = engine_of(*row(x, (x < -2).astype(float), angle), (24.0, 24.0))
    check(engine, engine.advance(4.5 + comes, 1000))
    _, expected = row(x, (np.arange(len(x)) >= 4).astype(float), angle)
    np.testing.assert_allclose(engine.state().velocity, expected, atol=1e-12)


@pytest.mark.parametrize("restitution", [1.0, 0.5])
@pytest.mark.parametrize("angle", [0.0, math.pi / 4, 0.3])
def test_four_disks_meet_at_a_point(angle, restitution):
    """Four collisions at once, each disk in two of them: all turn back, r times as fast."""
    turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    outward = np.array([[1, 0], [0, 1], [-1, 0], [0, -1]]) @ turn
    engine = engine_of(8 + 3 * outward, -outward, (16.0, 16.0), restitution)
    check(engine, engine.advance(5.0, 100))
    assert engine.collisions == 4
    np.testing.assert_allclose(engine.state().velocity, restitution * outward, atol=1e-14)


def checkerboard(n: int, diagonal: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """A square lattice whose neighbours fly against each other, along x or along both axes: positions and velocities."""
    column, line = (index.ravel() for index in np.meshgrid(np.arange(n), np.arange(n)))
    velocity = np.stack([1.0 - 2 * (column % 2), diagonal * (1.0 - 2 * (line % 2))], axis=1)
    return 2.0 * np.stack([column, line], axis=1) + 1.0, velocity


@pytest.mark.parametrize("numbering", ["in order", "shuffled"])
@pytest.mark.parametrize("restitution", [1.0, 0.9])
def test_rows_that_collide_all_at_once(restitution, numbering):
    """64 disks, 32 collisions at one instant, 30 times: nobody leaves its row, and all have the speed r^n at the due time."""
    position, velocity = checkerboard(8)
    if numbering == "shuffled":
        order = np.random.default_rng(1998).permutation(64)
        position, velocity = position[order], velocity[order]
    engine = engine_of(position, velocity, (16.0, 16.0), restitution)
    due = 0.5
    for n in range(1, 31):
        check(engine, engine.advance(due * (1 + 1e-12), 1000))
        v = engine.state().velocity
        assert engine.collisions == 32 * n
        np.testing.assert_allclose(v[:, 0], (-restitution) ** n * velocity[:, 0], rtol=1e-12)
        assert not v[:, 1].any()
        due += restitution**-n


@pytest.mark.parametrize("restitution", [1.0, 0.9])
def test_a_lattice_that_breathes(restitution):
    """Sixteen times four disks meet at a point, and again across the corners: all turn back, r times as fast."""
    position, velocity = checkerboard(8, diagonal=True)
    engine = engine_of(position, velocity, (16.0, 16.0), restitution)
    for n, due in ((1, 0.6), (2, 0.5 + 0.9 / restitution + 0.2)):
        check(engine, engine.advance(due, 1000))
        assert engine.collisions == 64 * n
        np.testing.assert_allclose(engine.state().velocity, (-restitution) ** n * velocity, atol=1e-12)


def test_ties_are_decided_the_same_way_every_time():
    """Simultaneous collisions and what rounding makes of them later, twice: every table is the same to the last bit."""
    twice = [engine_of(*checkerboard(8, diagonal=True), (16.0, 16.0), r=0.99) for _ in range(2)]
    for engine in twice:
        engine.advance(math.inf, 2000)
    for name in twice[0].arrays:
        assert twice[0].arrays[name].tobytes() == twice[1].arrays[name].tobytes()


# hardly touching


@pytest.mark.parametrize("angle", [0.0, 0.3, math.pi / 2])
@pytest.mark.parametrize("inside", [1e-3, 1e-6, 1e-9, 1e-12, 1e-14, -1e-14, -1e-12, -1e-9])
def test_grazing(inside, angle):
    """A disk passes another in rest at b = d (1 - inside): what it hands over is (1 - b^2) of its velocity along the normal."""
    b, along = 1 - inside, np.array([math.cos(angle), math.sin(angle)])
    across = np.array([-along[1], along[0]])
    middle = np.array([20.0, 20.0])
    engine = engine_of([middle - 5 * along - b * across, middle], [along, [0, 0]], (40.0, 40.0))
    check(engine, engine.advance(5.0))
    assert smallest_gap(engine) >= -TOLERATED
    check(engine, engine.advance(10.0))
    if inside < 0:
        assert engine.collisions == 0
    if inside >= 1e-12:
        assert engine.collisions == 1
        depth = inside * (2 - inside)  # 1 - b^2
        normal = math.sqrt(depth) * along + b * across
        handed = engine.state().velocity[1]
        np.testing.assert_allclose(handed, math.sqrt(depth) * normal, rtol=1e-13 / inside, atol=1e-15)
    assert energy(engine) == pytest.approx(0.5, rel=1e-14)


@pytest.mark.parametrize("restitution", [1.0, 0.5])
def test_touching_at_rest(restitution):
    """Disks in touch that rest have nothing to do with each other until somebody comes."""
    position, _ = checkerboard(6)
    still = engine_of(position / 2, np.zeros_like(position), (6.0, 6.0), restitution)
    assert still.advance(1e6) == loop.TIME
    assert (still.collisions, still.time) == (0, 1e6)
    hit = engine_of(
        np.vstack([position / 2 + 10, [[10.5, 4.0]]]), np.vstack([0 * position, [[0.0, 1.0]]]), (30.0, 30.0), restitution
    )
    assert hit.advance(5.0) == loop.TIME and hit.collisions == 0
    why = hit.advance(40.0, 20_000)
    check(hit, why)
    assert hit.collisions >= 6
    np.testing.assert_allclose(hit.state().velocity.sum(axis=0), [0.0, 1.0], atol=1e-13)
    assert energy(hit) <= 0.5 * (1 + 1e-13)


@pytest.mark.parametrize("common", [0.0, 1.0])
@pytest.mark.parametrize("speed", [1e-16, -1e-16, 1e-13, -1e-13])
@pytest.mark.parametrize("gap", [0.0, 2e-15, -2e-15])
def test_a_pair_in_touch_that_hardly_moves(gap, speed, common):
    """Who parts does not collide. Who approaches does, unless the speed is below what the common motion resolves (1e-14)."""
    position, velocity = row([0.0, 1.0 + gap], [-speed / 2 + common, speed / 2 + common])
    engine = engine_of(position, velocity, (16.0, 16.0))
    check(engine, engine.advance(100.0, 1000))
    assert engine.collisions <= 1
    if speed > 0:
        assert engine.collisions == 0
    if speed < 0 and common == 0.0:
        assert engine.collisions == 1
    assert energy(engine) == pytest.approx(np.sum(velocity**2) / 2, rel=1e-12)


@pytest.mark.parametrize("box", [(12.0, 12.0), (13.0, 7.0)])
def test_on_the_borders_of_cells_and_of_the_box(box):
    """Disks that start on borders, and fly along them: the same collisions as anywhere else."""
    probe = engine_of([[0.0, 0.0]], [[0.0, 0.0]], box).arrays["grid"]
    width, cells = probe["width"][0], probe["cells"][0]
    column, line = (index.ravel() for index in np.meshgrid(np.arange(cells[0] // 2), np.arange(cells[1] // 2)))
    position = 2 * np.stack([column, line], axis=1) * width
    rng = np.random.default_rng(1998)
    velocity = rng.uniform(-1, 1, position.shape) * rng.integers(0, 2, position.shape)  # many along one axis, some at rest
    seen = []
    for shift in (0.0, np.array([0.31, 0.17])):
        engine = engine_of(np.mod(position + shift, box), velocity, box, watch=recorder(2 * len(position)))
        check(engine, engine.advance(math.inf, most_collisions=len(position), most_events=MOST_EVENTS))
        seen.append(engine.watch.seen.rows[: len(position)].copy())
    np.testing.assert_array_equal(seen[0]["i"], seen[1]["i"])
    np.testing.assert_array_equal(seen[0]["j"], seen[1]["j"])
    np.testing.assert_allclose(seen[0]["time"], seen[1]["time"], rtol=1e-9)


@pytest.mark.parametrize("at", [(16.0, 4.0), (4.0, 16.0), (16.0, 16.0), (0.0, 0.0), (math.nextafter(16.0, 0.0), 4.0)])
def test_on_the_edge_of_the_box(at):
    """A disk at L is a disk at 0: its neighbour across the edge is hit when it must be."""
    far = np.mod(np.array(at) + 3.0 * np.array([0.6, 0.8]), 16.0)
    engine = engine_of([at, far], [[0.6, 0.8], [0.0, 0.0]], (16.0, 16.0))
    assert engine.advance(math.inf, 1, 1000) == loop.COLLISIONS
    assert engine.time == pytest.approx(2.0, rel=1e-13)
    position = engine.state().position
    assert np.all((position >= 0) & (position < 16.0))


# long and late


@pytest.mark.parametrize("restitution", [0.6, 0.8, 0.9])
def test_long_decay(restitution):
    """K = 1e-30 after some 138/(1 - r^2) collisions of a disk (B Eq. 3: ln K = -(1 - r^2)/2 C/N): time still goes on.

    The clock resolves 1e-12 of the free time all along. What ends is the velocities: rounding gives the gas a momentum, of
    1e-16 of the first speeds, which does not decay.
    """
    scene = Scene(42, 0.2267, restitution, contact_time=1e-12)
    engine = Engine(scene, state_of(equilibrate(scene, seed=1998)))
    start, n = energy(engine), scene.n_particles
    k, before = 1.0, 0.0
    while k > 1e-30:
        check(engine, engine.advance(math.inf, 10 * n, MOST_EVENTS))
        velocity = engine.state().velocity
        k_before, k = k, energy(engine) / start
        assert k <= k_before and engine.time > before
        before = engine.time
        free_time = scene.diameter / math.sqrt(2 * energy(engine) / n)
        assert np.spacing(engine.time) < 1e-12 * free_time
    drift = np.sum(velocity.mean(axis=0) ** 2) * n / 2 / start
    assert drift < 1e-31
    assert engine.collisions * 2 / n > 0.8 * 138 / (1 - restitution**2)


def test_what_is_left_of_a_decay_is_its_drift():
    """Where double precision ends: K stays at the motion of the centre of mass, and time goes on."""
    scene = Scene(42, 0.2267, 0.8, contact_time=1e-12)
    engine = Engine(scene, state_of(equilibrate(scene, seed=1998)))
    start, n = energy(engine), scene.n_particles
    engine.advance(math.inf, 600 * n // 2, 1_000_000)
    velocity, time = engine.state().velocity, engine.time
    drift = np.sum(velocity.mean(axis=0) ** 2) * n / 2
    assert drift / start < 1e-31
    assert energy(engine) == pytest.approx(drift, rel=0.05)
    engine.advance(math.inf, 10 * n, 1_000_000)
    assert engine.time > time
    assert engine.backwards == 0


def test_a_run_that_decays_says_its_energy_down_to_the_end():
    scene = Scene(42, 0.2267, 0.8, contact_time=1e-12)
    asked = {"samples": {"spacing": "log", "count": 60, "first": 1e-3}, "progress": False}
    run = simulate(scene, {"time": 1e12}, **asked)
    k = run["kinetic_energy"].values
    assert run["stop_reason"] == "time"
    assert np.all(np.isfinite(k)) and np.all(np.diff(k) <= 0)
    assert 0 < k[-1] < 1e-26


@pytest.mark.parametrize("since", [0.9e-12, 1.1e-12])
@pytest.mark.parametrize("late", [1e3, 1e4, 1e6])
def test_the_rule_resolves_picoseconds_at_any_time(late, since):
    """A disk is hit, and hits the next one `since` later: elastic or not by t_c = 1e-12 s, at 1e6 s as at 1000 s.

    A clock that is one double steps by 1e-10 s at 1e6 s.
    """
    t_c, r = 1e-12, 0.5
    handed = (1 + r) / 2
    position = np.array([[10.0, 8.0], [11.0 + late, 8.0], [12.0 + late + handed * since, 8.0]])
    engine = engine_of(position, [[1.0, 0.0], [0.0, 0.0], [0.0, 0.0]], (late + 100, 16.0), r, t_c)
    disks, grid = engine.arrays["disks"], engine.arrays["grid"]  # a place at 1e6 d has no digits left for the gap
    apart = grid["width"][0, 0] * (disks["cell"][2, 0] - disks["cell"][1, 0])
    disks["x"][2, 0] = disks["x"][1, 0] + 1 + handed * since - apart
    check(engine, engine.advance(late + 1.0, 2))
    assert engine.time == pytest.approx(late, rel=1e-12)
    assert engine.arrays["calendar"]["base"][0] > 0.9 * late
    state = engine.state()
    assert state.last_collision_interval[1] == pytest.approx(since, rel=0.02)
    np.testing.assert_allclose(state.velocity[2, 0], handed * (1.0 if since <= t_c else handed), rtol=1e-12)


@pytest.mark.parametrize("angle", [0.0, 0.01, 0.1])
@pytest.mark.parametrize("distance", [1e2, 1e3, 1e5])
def test_a_long_flight_costs_no_digits(distance, angle):
    """The place of a disk is known from cell to cell: the gap at the next collision shows it."""
    box = (distance + 100, 64.0)
    along = np.array([math.cos(angle), math.sin(angle)])
    start = np.array([10.0, 8.0])
    target = start + distance * along + 0.3 * np.array([-along[1], along[0]])
    engine = engine_of([start, np.mod(target, box)], [along, [0.0, 0.0]], box)
    assert engine.advance(math.inf, 1, MOST_EVENTS) == loop.COLLISIONS
    assert engine.time == pytest.approx(distance, rel=0.02)
    assert abs(smallest_gap(engine)) <= 1e-13


@pytest.mark.parametrize("slower", [1e-1, 1e-2, 1e-3])
@pytest.mark.parametrize("numbers", range(5))
def test_a_common_motion_costs_no_digits(slower, numbers):
    """Two disks that fly together for 300 to 30 000 d before they meet: 1e-16 of a diameter is lost in each cell at most."""
    rng = np.random.default_rng(numbers)
    angle, aside = rng.uniform(0, 2 * math.pi, 2)
    position, velocity = row([-16.0, 15.0], [slower / 2, -slower / 2], angle, middle=(50.0, 50.0))
    engine = engine_of(position, velocity + np.array([math.cos(aside), math.sin(aside)]), (100.0, 100.0))
    assert engine.advance(math.inf, 1, MOST_EVENTS) == loop.COLLISIONS
    assert engine.time == pytest.approx(30.0 / slower, rel=1e-9)
    assert abs(smallest_gap(engine)) <= TOLERATED


@pytest.mark.parametrize("numbers", range(10))
def test_a_pair_that_sticks_and_flies_on(numbers):
    """r = 0: partners keep touching, and sink into or leave each other by no more than 1e-15 of the distance that they fly."""
    rng = np.random.default_rng(numbers)
    angle, common = rng.uniform(0, 2 * math.pi), rng.uniform(-1, 1, 2)
    position, velocity = row([-1.0, 1.0], [0.5, -0.5], angle, middle=(100.0, 100.0))
    engine = engine_of(position, velocity + common, (200.0, 200.0), r=0.0)
    for time in (10.0, 100.0, 1000.0):
        assert engine.advance(time, 1000) in (loop.TIME, loop.WATCH)
        assert abs(smallest_gap(engine)) <= 1e-15 * (time + 10)

"""The collision models of A section 3, collision by collision: what each does, and what it keeps."""

import math

import numpy as np
import pytest
from gases import lattice_gas
from numba import njit
from plain import python_of

from granugas.combinations import MOST_VISCOUS
from granugas.dynamics.events.collisions import Then, collide
from granugas.dynamics.events.effects import called_by, modules_of
from granugas.dynamics.events.effects.constant import Constant
from granugas.dynamics.events.effects.contact_time_of_velocity import ContactTimeOfVelocity
from granugas.dynamics.events.effects.internal_modes import effect_of as modes_of
from granugas.dynamics.events.effects.kick import Kick
from granugas.dynamics.events.effects.plastic import effect_of as plastic_of
from granugas.dynamics.events.effects.rotation import Rotation, turned
from granugas.dynamics.events.effects.viscoelastic import LARGEST
from granugas.dynamics.events.effects.viscoelastic import effect_of as viscoelastic_of
from granugas.dynamics.events.engine import Engine
from granugas.dynamics.events.randomness import stream, uniform
from granugas.equilibrate import at_rest
from granugas.scene import Scene

MODELS = {
    "viscoelastic": {"material": "viscoelastic", "viscosity": 0.5},
    "plastic": {"material": "plastic", "yield_velocity": 0.1},
    "critical distance": {"critical_distance": 1e-4},
    "rotation": {"rotation_angle": 5.0},
    "kick": {"kick_velocity": 0.01, "kick_energy": 1e-4},
    "internal modes": {"internal_modes": 3},
    "damped modes": {"internal_modes": 2, "mode_damping": 200.0},
    "many": {"internal_modes": 1, "critical_distance": 1e-5, "rotation_angle": 2.0, "kick_velocity": 0.01, "kick_energy": 1e-5},
}
N = 200


def scene_of(name: str, **more) -> Scene:
    return Scene(N, 0.3, **{"restitution": 0.8, "contact_time": 0.0} | MODELS[name] | more)


def energy(state) -> float:
    return 0.5 * float(np.sum(state.velocity**2))


# --- what all of them keep ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", MODELS)
def test_momentum_stays_and_every_loss_is_counted(name):
    scene = scene_of(name)
    start = lattice_gas(scene)
    engine = Engine(scene, start)
    engine.advance(math.inf, 20_000)
    state, tally = engine.state(), engine.take_tally()
    speeds = np.abs(start.velocity).sum()
    np.testing.assert_allclose(state.velocity.sum(axis=0), start.velocity.sum(axis=0), rtol=0, atol=1e-12 * speeds)
    assert energy(state) + tally.loss + tally.stored == pytest.approx(energy(start), rel=1e-12)
    assert energy(state) != pytest.approx(energy(start), rel=1e-3)


@pytest.mark.parametrize("name", MODELS)
def test_a_run_goes_on_bit_for_bit(name):
    """The random numbers and the modes are in the arrays of the engine."""
    scene = scene_of(name)
    straight, resumed = (Engine(scene, lattice_gas(scene)) for _ in range(2))
    straight.advance(math.inf, 700)
    resumed.restore({name: rows.copy() for name, rows in straight.arrays.items()})
    for engine in (straight, resumed):
        engine.advance(math.inf, 700)
    for table, rows in straight.arrays.items():
        assert rows.tobytes() == resumed.arrays[table].tobytes(), table


@pytest.mark.parametrize("name", MODELS)
def test_every_model_that_may_collapse_is_watched(name):
    assert called_by(scene_of(name))["watch"] == "collapse"
    assert called_by(scene_of(name, contact_time=1e-5))["watch"] == "nobody"


def test_a_scene_calls_for_the_files_that_it_names():
    called = called_by(scene_of("many", contact_time=1e-5))
    assert called["rule"] == ("internal_modes", "critical_distance", "contact_time")
    assert called["after"] == ("rotation", "kick")
    assert {name.split(".")[-1] for name in modules_of(scene_of("many"))} >= {"internal_modes", "rotation", "kick", "constant"}


def test_within_the_contact_time_every_model_is_elastic():
    scene = scene_of("internal modes", critical_distance=1e-5, contact_time=1e3, material="plastic", yield_velocity=0.1)
    start = lattice_gas(scene)
    start.last_collision_time[:] = -1e-9
    engine = Engine(scene, start)
    engine.advance(math.inf, 1000)
    assert energy(engine.state()) == pytest.approx(energy(start), rel=1e-12)
    assert engine.take_tally().elastic == [1000]


# --- one collision --------------------------------------------------------------------------------------------------------


@njit(error_model="numpy")
def collided(gas, now):
    return collide(gas, 0, 1, now)


def head_on(gas_of, u, tangential=0.0, **effects):
    """Two disks that touch at time 0 and approach with u along x; the relative velocity after it."""
    gas = gas_of([[3.0, 4.0], [4.0, 4.0]], [[u / 2, tangential], [-u / 2, 0.0]], (9.0, 7.0), **effects)
    collided(gas, 0.0)
    v = gas.disks.rows["v"]
    return gas, v[1] - v[0]


def viscoelastic(u):
    x = 0.5 * u**0.2
    return 1 - 1.15344 * x + 0.6 * 1.15344**2 * x**2


@pytest.mark.parametrize("u", [1e-6, 1e-3, 0.1, 1.0, 1.7])
def test_viscoelastic_spheres_have_the_coefficient_of_the_formula(u, gas_of):
    """u in m/s; the engine has disks of 1 mm."""
    material = viscoelastic_of(Scene(diameter=1e-3, material="viscoelastic", viscosity=0.5), None)
    _, after = head_on(gas_of, u / 1e-3, rule=material)
    assert after[0] == pytest.approx(viscoelastic(u) * u / 1e-3, rel=1e-13)


def test_viscoelastic_spheres_never_bounce_better_the_faster_they_are(gas_of):
    assert pytest.approx(MOST_VISCOUS, rel=1e-15) == LARGEST
    material = viscoelastic_of(Scene(diameter=1.0, velocity_half_width=0.1, material="viscoelastic", viscosity=0.7), None)
    coefficients = [head_on(gas_of, u, rule=material)[1][0] / u for u in np.geomspace(1e-3, 1e3, 40)]
    assert np.all(np.diff(coefficients) < 1e-15)
    assert coefficients[-1] == pytest.approx(7 / 12)


@pytest.mark.parametrize(("u", "r"), [(1e-3, 0.6), (0.2, 0.6), (0.4, 0.6 * 2**-0.25), (3.2, 0.3)])
def test_plastic_contacts_have_the_coefficient_of_the_formula(u, r, gas_of):
    scene = Scene(diameter=1e-3, restitution=0.6, material="plastic", yield_velocity=0.2)
    _, after = head_on(gas_of, u / 1e-3, rule=plastic_of(scene, None))
    assert after[0] == pytest.approx(r * u / 1e-3, rel=1e-13)


THIRD = [(4.0, 5.05, True), (3.0, 2.95, True), (1.95, 4.0, True), (4.0, 5.15, False), (3.5, 5.2, False), (8.0, 1.0, False)]


@pytest.mark.parametrize(("x", "y", "near"), THIRD)
@pytest.mark.parametrize("shift", [(0.0, 0.0), (5.6, 2.3), (4.9, 3.4)], ids=str)
def test_nothing_is_lost_near_a_third_disk(x, y, near, shift):
    """A gap of .05 d is below eps_c = .1 d, one of .15 d is not; across the edges of the box too."""
    position = (np.array([[2.9, 4.0], [4.1, 4.0], [x, y]]) + shift) % (9.0, 7.0)
    velocity = np.array([[1.0, 0.0], [-1.0, 0.0], [0.0, 0.0]])
    scene = Scene(3, 0.03, restitution=0.5, contact_time=0.0, diameter=1.0, critical_distance=0.1)
    engine = Engine(scene, at_rest(position, velocity, (9.0, 7.0)))
    engine.advance(math.inf, 1)
    assert engine.time == pytest.approx(0.1)
    tally = engine.take_tally()
    assert tally.elastic == [near]
    assert tally.loss == pytest.approx(0.0 if near else 0.75, abs=1e-12)


@pytest.mark.parametrize(("area_fraction", "critical_distance"), [(0.3, 2e-4), (0.7, 1e-5)])
def test_what_is_near_is_found_in_a_gas(area_fraction, critical_distance):
    """Against all distances, at every collision; eps_c is wider than the cells of a dense gas would be."""
    scene = Scene(60, area_fraction, restitution=0.9, contact_time=0.0, critical_distance=critical_distance)
    engine, counted = Engine(scene, lattice_gas(scene)), 0
    engine.advance(math.inf, 300)
    for _ in range(200):
        before = engine.state()
        engine.take_tally()
        engine.advance(math.inf, 1)
        state = engine.state()
        i, j = np.flatnonzero(state.collisions > before.collisions)
        r = state.position[[i, j], np.newaxis] - state.position
        gap = np.linalg.norm(r - np.array(state.box) * np.round(r / np.array(state.box)), axis=2) - scene.diameter
        gap[:, [i, j]] = np.inf
        assert engine.take_tally().elastic == [gap.min() < scene.critical_distance]
        counted += gap.min() < scene.critical_distance
    assert 10 < counted < 190


def run_into(u, gap, collisions, **rule):
    """A disk hits one at rest, which flies on to a third at rest that was `gap` (d) away: whether anything was elastic."""
    position = [[2.0, 4.0], [4.0, 4.0], [5.0 + gap, 4.0]]
    scene = Scene(3, 0.03, restitution=0.6, diameter=1.0, **rule)
    engine = Engine(scene, at_rest(np.array(position), np.array([[u, 0.0], [0.0, 0.0], [0.0, 0.0]]), (9.0, 7.0)))
    engine.advance(math.inf, collisions)
    return engine.take_tally().elastic.item() > 0


@pytest.mark.parametrize("u", [1e-3, 1.0, 1e3])
def test_a_contact_time_that_falls_as_one_over_u_is_a_distance(u):
    """alpha = 1, t_c v_0 = .1 d: the gap decides, for the second collision here and with eps_c = .1 d already for the first."""
    of_time = {"contact_time": 0.2, "contact_velocity": 0.5, "contact_time_exponent": 1.0}
    of_distance = {"contact_time": 0.0, "critical_distance": 0.1}
    for gap in (0.01, 0.0999, 0.1001, 0.2):
        assert run_into(u, gap, 2, **of_time) == run_into(u, gap, 1, **of_distance) == (gap < 0.1)
    assert run_into(u, 0.01, 2, contact_time=0.2) == (u >= 0.1)


@pytest.mark.parametrize(("alpha", "alike"), [(1.0, True), (0.5, False)])
def test_only_at_the_exponent_1_a_fast_gas_does_what_a_slow_one_does(alpha, alike):
    values = {"contact_time": 1e-5, "contact_velocity": 3.0, "contact_time_exponent": alpha}
    states, counts = [], []
    for speed in (1.0, 64.0):
        scene = Scene(N, 0.4, restitution=0.7, velocity_half_width=0.5 * speed, **values)
        engine = Engine(scene, lattice_gas(scene))
        engine.advance(math.inf, 1000)
        states.append(engine.state().velocity / speed)
        counts.append(engine.take_tally().elastic.item())
    assert 20 < counts[0] < 900
    assert (counts[0] == counts[1]) == alike
    assert np.allclose(*states, rtol=1e-6, atol=1e-9) == alike


@pytest.mark.parametrize("alpha", [0.5, 1.0, 2.0])
def test_the_contact_time_is_that_of_the_velocity(alpha, gas_of):
    for since, elastic in ((0.999, True), (1.001, False)):
        rule = ContactTimeOfVelocity(Constant(0.5), alpha, 3.0**alpha)  # t_c(3 d/s) = 1 s
        gas = gas_of([[3.0, 4.0], [4.0, 4.0]], [[6.0, 0.0], [-6.0, 0.0]], (9.0, 7.0), rule=rule)
        gas.clocks.rows["last"] = -since * 4.0**-alpha
        collided(gas, 0.0)
        assert gas.tally.elastic == elastic
        assert (gas.tally.loss == 0) == elastic


@pytest.mark.parametrize("u", [1.0, 20.0])
def test_a_rotation_keeps_energy_and_momentum_and_lets_partners_part(u, gas_of):
    seen = []
    for seed in range(200):
        rotation = Rotation(math.tan(math.radians(5) / 2), random(seed))
        gas, after = head_on(gas_of, u, tangential=0.7, rule=Constant(0.02), after=rotation)
        before = np.array([0.02 * u, -0.7])
        assert np.linalg.norm(after) == pytest.approx(np.linalg.norm(before), rel=1e-14)
        assert after[0] >= 0
        np.testing.assert_allclose(gas.disks.rows["v"].sum(axis=0), [0.0, 0.7], atol=1e-14)
        assert gas.tally.loss == pytest.approx(0.25 * (1 - 0.02**2) * u**2, rel=1e-12)
        seen.append(np.degrees(math.atan2(after[1], after[0]) - math.atan2(before[1], before[0])))
        dp = gas.disks.rows["v"][0] - np.array([u / 2, 0.7])
        np.testing.assert_allclose(gas.tally.rows["stress"][0], np.outer(dp, [1.0, 0.0]), atol=1e-13)
    lowest = max(-5.0, -math.degrees(math.atan2(0.02 * u, 0.7)))  # there u would be tangential
    assert min(seen) > lowest - 1e-9 and max(seen) < 5
    assert np.mean(seen) == pytest.approx((lowest + 5) / 2, abs=0.6)
    assert np.std(seen) == pytest.approx((5 - lowest) / math.sqrt(12), rel=0.15)


def random(seed):
    """A stream of random numbers."""
    return stream(at_rest(np.zeros((1, 2)), np.array([[seed, 1.0]]), (1.0, 1.0)), "test")


@njit(error_model="numpy")
def turn(u, rotation):
    return turned(u, rotation)


def test_in_space_a_vector_turns_in_all_directions_by_no_more_than_the_angle():
    rotation, u = Rotation(math.tan(math.radians(5) / 2), random(1)), np.array([1.0, -2.0, 0.5])
    found = np.array([turn(tuple(u), rotation) for _ in range(2000)])
    np.testing.assert_allclose(np.linalg.norm(found, axis=1), np.linalg.norm(u), rtol=1e-14)
    angle = np.degrees(np.arccos(found @ u / (u @ u)))
    assert 4 < angle.max() < 5
    change = found - u
    spread = np.cov(change.T) / change.var()
    across = np.eye(3) - np.outer(u, u) / (u @ u)
    np.testing.assert_allclose(spread / np.trace(spread), across / 2, atol=0.04)


@pytest.mark.parametrize(("r", "kicked"), [(0.3, True), (0.9, False)])
def test_partners_that_part_slowly_are_kicked(r, kicked, gas_of):
    """Critical velocity .5, parting at r: with an energy from 0 to 2, in the motion of a reduced mass 1/2."""
    added = []
    for seed in range(300):
        gas, after = head_on(gas_of, 1.0, tangential=0.4, rule=Constant(r), after=Kick(0.5, 2.0, random(seed)))
        assert after[1] == pytest.approx(-0.4)
        np.testing.assert_allclose(gas.disks.rows["v"].sum(axis=0), [0.0, 0.4], atol=1e-14)
        added.append(0.25 * (after[0] ** 2 - r**2))
        assert gas.tally.loss == pytest.approx(0.25 * (1 - r**2) - added[-1], abs=1e-13)
        assert gas.tally.stress[0][0] == pytest.approx(-0.5 * (1 + after[0]))
    if kicked:
        assert 0 <= min(added) < 0.1 and 1.9 < max(added) < 2
        assert np.mean(added) == pytest.approx(1.0, abs=0.1)
    else:
        np.testing.assert_allclose(added, 0, atol=1e-14)


def test_what_follows_a_collision_is_a_chain_of_any_length(gas_of):
    kick = [Kick(10.0, 2.0, random(seed)) for seed in range(3)]
    together = Then(Then(kick[0], kick[1]), kick[2])
    _, after = head_on(gas_of, 1.0, rule=Constant(0.5), after=together)
    one_by_one = 0.0
    for seed in range(3):
        _, alone = head_on(gas_of, 1.0, rule=Constant(0.5), after=Kick(10.0, 2.0, random(seed)))
        one_by_one += 0.25 * (alone[0] ** 2 - 0.25)
    assert 0.25 * (after[0] ** 2 - 0.25) == pytest.approx(one_by_one)


# --- internal modes -------------------------------------------------------------------------------------------------------


def modes(n, damping=0.0):
    scene = Scene(2, 0.01, internal_modes=n, mode_damping=damping, contact_time=0.0, diameter=1.0)
    return modes_of(scene, at_rest(np.zeros((2, 2)), np.ones((2, 2)), (9.0, 7.0)), Constant(0.6))


@pytest.mark.parametrize("n", [1, 5])
def test_modes_at_rest_take_up_what_the_material_leaves(n, gas_of):
    rule = modes(n)
    _, after = head_on(gas_of, 2.0, rule=rule)
    assert after[0] == pytest.approx(0.6 * 2.0, rel=1e-14)
    np.testing.assert_allclose(rule.energies(0.0), 0.25 * (1 - 0.36) * 4.0 / (2 * n), rtol=1e-13)


def test_modes_give_energy_back_and_nothing_is_lost(gas_of):
    faster = 0
    for seed in range(50):
        rule = modes(2)
        rule.stream.rows[:] = random(seed).rows
        rule.modes.rows["x"] = np.random.default_rng(seed).normal(size=4)
        before = rule.energies(0.0).sum() + 0.25
        gas, after = head_on(gas_of, 1.0, tangential=0.3, rule=rule)
        assert rule.energies(0.0).sum() + 0.25 * after[0] ** 2 == pytest.approx(before, rel=1e-14)
        assert after[0] > 0
        assert after[1] == pytest.approx(-0.3)
        assert gas.tally.stored == pytest.approx(0.25 * (1 - after[0] ** 2), abs=1e-13)
        faster += after[0] > 1
    assert 5 < faster < 50


def test_damped_modes_lose_their_energy_in_time():
    rule = modes(3, damping=2.0)
    rule.modes.rows["y"] = 1.0
    np.testing.assert_allclose(rule.energies(1.5), math.exp(-3.0))


@pytest.mark.compiled
def test_undamped_modes_and_motion_share_the_energy_equally():
    """Conserved to 1e-12; of 2 + 2 n halves of kT a particle two are motion, but for their sum, which is at rest.

    The mean over 400 states 50 collisions apart has a standard error of .4 %.
    """
    scene = scene_of("internal modes")
    start = lattice_gas(scene)
    engine, shares = Engine(scene, start), []
    engine.advance(math.inf, 50 * N)
    for _ in range(400):
        engine.advance(math.inf, 25 * N)
        state = engine.state()
        shares.append(energy(state) / energy(start))
        assert shares[-1] + engine.observe(state)["internal_energy"] == pytest.approx(1.0, abs=1e-12)
    assert np.mean(shares) == pytest.approx((2 * N - 2) / (8 * N - 2), rel=0.02)


def test_damped_modes_lose_what_they_no_longer_hold():
    """Loss and stored energy change places; what has fallen since the last collisions is not counted yet."""
    scene = scene_of("damped modes", mode_damping=50.0)
    engine = Engine(scene, lattice_gas(scene))
    engine.advance(math.inf, 5000)
    tally, rule = engine.take_tally(), engine.rule
    counted = (rule.modes.rows["x"] ** 2 + rule.modes.rows["y"] ** 2).sum() * scene.diameter**2
    assert tally.stored == pytest.approx(counted, rel=1e-10)
    assert 0 < rule.energies(engine.time).sum() * scene.diameter**2 < counted
    assert tally.loss > counted


def test_fast_damping_leaves_the_coefficient_of_the_material():
    ringing = Engine(scene := scene_of("internal modes", mode_damping=1e12), lattice_gas(scene))
    plain = Engine(scene := scene_of("internal modes", internal_modes=0), lattice_gas(scene))
    for engine in (ringing, plain):
        engine.advance(math.inf, 100)
    np.testing.assert_allclose(ringing.state().velocity, plain.state().velocity, atol=1e-9)


# --- random numbers -------------------------------------------------------------------------------------------------------


@njit
def many(stream, n):
    found = np.empty(n)
    for k in range(n):
        found[k] = uniform(stream)
    return found


def test_random_numbers_are_uniform_and_independent():
    x = many(random(3), 100_000)
    assert 0 <= x.min() < 1e-4 and 1 - 1e-4 < x.max() < 1
    counts = np.histogram2d(x[:-1], x[1:], bins=10, range=[[0, 1], [0, 1]])[0]
    chi_2 = np.sum((counts - len(x) / 100) ** 2) / (len(x) / 100)
    assert 50 < chi_2 < 160  # 99 degrees of freedom


def test_streams_follow_from_the_start_state_and_the_name():
    start = lattice_gas(scene_of("kick"))
    same, other, elsewhere = stream(start, "a"), stream(start, "b"), stream(lattice_gas(scene_of("kick"), seed=1), "a")
    assert stream(start, "a").bits == same.bits
    assert len({int(x.bits) for x in (same, other, elsewhere)}) == 3


def test_plain_python_has_the_same_random_numbers():
    compiled, plain = random(5), random(5)
    assert many(compiled, 1000).tolist() == [python_of(uniform)(plain) for _ in range(1000)]
    assert compiled.bits == plain.bits

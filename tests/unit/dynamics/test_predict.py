"""When two disks touch, against the roots of |r + u t|^2 = 1; and that everybody's appointment is in the calendar."""

import math

import numpy as np
import pytest
from gases import lattice_gas
from numba import njit

from granugas.dynamics.events import predict
from granugas.dynamics.events.effects.unequal import PARTICLES, Unequal
from granugas.dynamics.events.engine import Engine
from granugas.dynamics.events.memory import Table, allocate
from granugas.dynamics.events.state import NOBODY
from granugas.equilibrate import at_rest
from granugas.scene import Scene

FOREVER = 1.0e300


@njit(error_model="numpy")
def contact_delay(r, u, reach_2, speed_2, longest):
    return predict.contact_delay(r, u, reach_2, speed_2, longest)


def delay(r, u, longest=FOREVER):
    """With the velocities +-u/2."""
    return contact_delay(tuple(map(float, r)), tuple(map(float, u)), 1.0, float(np.dot(u, u)) / 2, longest)


def by_roots(r, u):
    """The smaller real root of u^2 t^2 + 2 r.u t + r^2 - 1, where it lies ahead."""
    roots = np.roots([np.dot(u, u), 2 * np.dot(r, u), np.dot(r, r) - 1])
    return min(roots) if np.isreal(roots).all() and min(roots) > 0 else math.inf


@pytest.mark.parametrize("distance", [1.001, 1.5, 30.0])
def test_the_first_touch(distance):
    rng = np.random.default_rng(4)
    met = 0
    for _ in range(400):
        direction, toward = rng.normal(size=2), rng.normal(size=2)
        r = distance * direction / np.hypot(*direction)
        u = -r / distance + toward * 1.5 / distance * rng.random()
        wanted = by_roots(r, u)
        if abs(np.cross([*r, 0], [*u, 0])[2] / np.hypot(*u)) < 1 - 1e-6 or wanted == math.inf:
            assert delay(r, u) == pytest.approx(wanted, rel=1e-9)
        met += wanted < math.inf
    assert met > 100


def test_no_cancellation_at_a_tiny_gap():
    """The gap is known to 1e-16 of d^2, and the delay as exactly as the gap."""
    for gap in (1e-4, 1e-8, 1e-12):
        r = 1.0 + gap
        exact = (r - 1.0) / 2.0
        assert delay((r, 0.0), (-2.0, 0.0)) == pytest.approx(exact, rel=1e-15 / gap + 1e-14)


def test_grazing():
    assert delay((5.0, 1.0), (-1.0, 0.0)) == 5.0
    assert delay((5.0, 1.0 - 1e-9), (-1.0, 0.0)) == pytest.approx(5.0, abs=1e-4)
    assert delay((5.0, 1.0 + 1e-9), (-1.0, 0.0)) == math.inf


@pytest.mark.parametrize("distance", [1.0, 0.999, 1.5])
@pytest.mark.parametrize("u", [(1.0, 0.0), (1e-3, 1.0), (0.0, 1.0), (0.0, 0.0)])
def test_receding_or_sliding_disks_do_not_meet(distance, u):
    assert delay((distance, 0.0), u) == math.inf


@pytest.mark.parametrize("distance", [1.0, 1.0 - 1e-15, 0.9])
def test_in_touch_and_approaching_they_meet_now(distance):
    assert delay((distance, 0.0), (-1.0, 0.5)) == 0.0


@pytest.mark.parametrize("distance", [1.0, 1.0 - 1e-15])
def test_in_touch_and_approaching_by_rounding_they_do_not(distance):
    """A collision at r = 0 leaves a few 1e-15 of the speeds."""
    for noise in (1e-17, 1e-16, 5e-15):
        assert delay((distance, 0.0), (-noise, 1.0)) == math.inf


@pytest.mark.parametrize("reach", [1.0, 0.5])
@pytest.mark.parametrize("speed", [1.0, 100.0])
def test_rounding_ends_at_1e_14_of_the_speeds(speed, reach):
    """Of the root of the sum of their squares, whatever the size of the disks."""
    for approach, wanted in ((1.1e-14, 0.0), (0.9e-14, math.inf)):
        u = (-approach * speed, 0.0)
        assert contact_delay((reach, 0.0), u, reach**2, speed**2, FOREVER) == wanted


def test_a_delay_beyond_what_counts_may_be_left_out_but_no_other():
    rng = np.random.default_rng(5)
    for _ in range(300):
        r, u = rng.uniform(1.0, 3.0, 2), -rng.random(2)
        wanted, longest = delay(r, u), rng.exponential(3.0)
        found = delay(r, u, longest)
        assert found == wanted if wanted <= longest else found in (wanted, math.inf)


def test_a_delay_is_left_out_where_its_bound_says_so():
    """Without a root: no disk has come nearer before -c / 2b."""
    for r, u in (((2.0, 0.5), (-1.0, 0.0)), ((1.5, 0.1), (-3.0, 0.2)), ((1.1, 0.0), (-0.1, 0.01))):
        bound = (np.dot(r, r) - 1) / (-2 * np.dot(r, u))
        assert delay(r, u, 1.01 * bound) == pytest.approx(by_roots(r, u)) or by_roots(r, u) > 1.01 * bound
        assert delay(r, u, 0.99 * bound) == math.inf


def test_disks_that_move_alike_never_meet():
    scene = Scene(8, 0.2, 1.0, 0.0)
    start = lattice_gas(scene)
    start.velocity[:] = start.velocity[0]
    engine = Engine(scene, start)
    assert np.all(engine.arrays["disks"]["partner"] == NOBODY)
    assert np.all(engine.arrays["schedule"]["time"] < math.inf)


@pytest.mark.parametrize(("approach", "meet"), [(2e-14, True), (0.7e-14, False)])
def test_rounding_is_that_of_both_velocities(approach, meet):
    """Two in touch with the velocities 1 and 1 - approach along the pair: 1e-14 of sqrt(2) is noise."""
    scene = Scene(2, 0.02, 1.0, 0.0, diameter=1.0)
    position, velocity = np.array([[4.0, 4.0], [5.0, 4.0]]), np.array([[1.0, 0.0], [1.0 - approach, 0.0]])
    engine = Engine(scene, at_rest(position, velocity, (9.0, 9.0)))
    assert np.all((engine.arrays["disks"]["t_coll"] == 0.0) == meet)


@pytest.mark.parametrize("radii", [(0.5, 0.5), (0.5, 0.2), (0.1, 0.3)])
def test_they_meet_where_their_radii_say(radii, gas_of):
    rows = allocate(2, PARTICLES)
    rows["radius"], rows["mass"] = radii, 1.0
    gas = gas_of([[2.0, 3.0], [4.0, 3.0]], [[0.5, 0.0], [-0.5, 0.0]], (9.0, 7.0), sizes=Unequal(Table(rows), 1.0))
    np.testing.assert_allclose(gas.disks.rows["t_coll"], 2.0 - sum(radii), rtol=1e-14)


@pytest.mark.parametrize(
    "scene",
    [
        Scene(300, 0.7, 0.9, 1e-4),
        Scene(300, 0.02, 0.9, 1e-4),
        Scene(64, 0.3, 0.0, 1e-6),
        Scene(5, 0.3, 0.9, 1e-4),
        Scene(2, 0.5, 0.9, 1e-4),
        Scene(64, 0.5, 0.9, 1e-4, aspect_ratio=12.0),
    ],
    ids=lambda scene: f"{scene.n_particles}-{scene.area_fraction}",
)
def test_everybody_has_an_appointment(scene):
    """Partners agree, and who waits for nobody and is waited for by nobody is in the calendar itself."""
    engine = Engine(scene, lattice_gas(scene))
    for _ in range(30):
        disks, time = engine.arrays["disks"], engine.arrays["schedule"]["time"]
        (met,) = np.nonzero(disks["partner"] != NOBODY)
        partner = disks["partner"][met]
        np.testing.assert_array_equal(disks["partner"][partner], met)
        np.testing.assert_array_equal(disks["t_coll"][partner], disks["t_coll"][met])
        keeps = np.ones(len(disks), bool)
        keeps[met[partner < met]] = False
        assert np.all(time[keeps] < math.inf)
        assert np.all(time[keeps] <= disks["t_coll"][keeps])
        assert np.all((time[~keeps] < disks["t_coll"][~keeps]) | (time[~keeps] == math.inf))
        assert np.all(time >= engine.arrays["calendar"]["now"][0])
        engine.advance(math.inf, most_events=97)

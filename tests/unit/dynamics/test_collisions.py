"""One collision: A Eqs. 2, 3, 4, 14 and 15, term by term."""

import math

import numpy as np
import pytest
from numba import njit

from granugas.dynamics.events.cells import separation
from granugas.dynamics.events.collisions import collide, lose, store
from granugas.dynamics.events.effects.constant import Constant, Elastic
from granugas.dynamics.events.effects.contact_time import ContactTime
from granugas.dynamics.events.effects.unequal import PARTICLES, Unequal
from granugas.dynamics.events.memory import Table, allocate
from granugas.dynamics.events.vectors import divided, dot, minus

NOW = 0.25


@njit(error_model="numpy")
def collided(gas, now):
    return collide(gas, 0, 1, now)


@njit(error_model="numpy")
def normal_velocity(gas):
    """Of the second relative to the first, along the line of centres as the engine knows it."""
    n = separation(gas, 0, 1)
    return dot(minus(gas.disks.v[1], gas.disks.v[0]), divided(n, math.sqrt(dot(n, n))))


@njit(error_model="numpy")
def count(tally, lost, stored, now):
    lose(tally, lost, now)
    store(tally, stored, now)


def pair(gas_of, seed, rule, box=(9.0, 7.0)):
    """Two approaching disks that touch at NOW, anywhere in the box, and the unit vector from the first to the second."""
    rng = np.random.default_rng(seed)
    angle = rng.uniform(0, 2 * math.pi)
    normal = np.array([math.cos(angle), math.sin(angle)])
    velocity = rng.normal(size=(2, 2))
    if (velocity[1] - velocity[0]) @ normal > 0:
        velocity = velocity[::-1]
    first = rng.uniform(0, box)
    touching = np.array([first, first + normal]) - NOW * velocity
    gas = gas_of(np.mod(touching, box), velocity, box, rule=rule)
    return gas, velocity, normal


def velocities(gas):
    return gas.disks.rows["v"].copy()


@pytest.mark.parametrize("box", [(9.0, 7.0), (2.3, 2.6), (4.4, 3.2)])
@pytest.mark.parametrize("r", [1.0, 0.8, 0.4, 0.0])
def test_velocities(r, box, gas_of):
    """Across the edges of the box too: some of the pairs lie there."""
    for seed in range(40):
        gas, before, n = pair(gas_of, seed, Constant(r), box)
        since, u_n = collided(gas, NOW)
        after = velocities(gas)
        u, u_after = before[1] - before[0], after[1] - after[0]
        assert u_n == pytest.approx(u @ n, rel=1e-12)
        assert since == math.inf
        np.testing.assert_allclose(after[0], before[0] + (1 + r) / 2 * (u @ n) * n, rtol=0, atol=1e-13)  # A Eq. 2
        np.testing.assert_allclose(after[1], before[1] - (1 + r) / 2 * (u @ n) * n, rtol=0, atol=1e-13)
        np.testing.assert_allclose(after.sum(axis=0), before.sum(axis=0), rtol=0, atol=1e-14)  # momentum
        assert u_after @ n == pytest.approx(-r * (u @ n), abs=1e-13)  # A Eq. 3
        tangent = np.array([-n[1], n[0]])
        assert u_after @ tangent == pytest.approx(u @ tangent, abs=1e-13)
        loss = 0.5 * (np.sum(before**2) - np.sum(after**2))
        assert loss == pytest.approx((1 - r**2) / 4 * (u @ n) ** 2, abs=1e-13)
        assert gas.tally.loss == pytest.approx(loss, abs=1e-13)
        assert gas.tally.loss_time == pytest.approx(loss * NOW, abs=1e-13)


@pytest.mark.parametrize("r", [1.0, 0.8, 0.4])
def test_partners_part_to_the_last_digit(r, gas_of):
    """What is missing of A Eq. 3 is 5e-17 of the speeds on average; after a single push it would be 14e-17."""
    missing = []
    for seed in range(200):
        gas, before, _ = pair(gas_of, seed, Constant(r))
        _, u_n = collided(gas, NOW)
        missing.append(abs(normal_velocity(gas) + r * u_n) / np.abs(before).max())
    assert np.mean(missing) < 9e-17


def test_energy_is_counted_with_its_times(gas_of):
    gas, *_ = pair(gas_of, 1, Elastic())
    count(gas.tally, 3.0, 5.0, 0.25)
    count(gas.tally, 0.5, -1.0, 4.0)
    assert (gas.tally.loss, gas.tally.loss_time) == (3.5, 2.75)
    assert (gas.tally.stored, gas.tally.stored_time) == (4.0, -2.75)


def test_momentum_that_is_passed_on(gas_of):
    """dp_a l_b of both partners (A Eq. 15): l points from the centre of each to the contact."""
    for seed in range(20):
        gas, before, n = pair(gas_of, seed, Constant(0.7))
        gas.tally.rows["stress"][0] = already = np.random.default_rng(seed).normal(size=(2, 2))
        collided(gas, NOW)
        dp = velocities(gas) - before
        l = np.array([0.5 * n, -0.5 * n])  # noqa: E741
        stress = dp.T @ l
        tally = gas.tally
        np.testing.assert_allclose(tally.rows["stress"][0], already + stress, rtol=0, atol=1e-13)


@pytest.mark.parametrize("dimensions", [1, 2, 3])
def test_unequal_particles_in_every_dimension(dimensions, gas_of):
    """Each changes by its share; losses by the reduced mass; what is passed on by both radii, at the time of the collision."""
    rng, r, rows = np.random.default_rng(7), 0.6, allocate(2, PARTICLES)
    rows["radius"], rows["mass"] = [0.35, 0.45], [0.8, 1.7]
    m, m_12 = rows["mass"][:, None], 0.8 * 1.7 / 2.5
    n = rng.normal(size=dimensions)
    n /= np.linalg.norm(n)
    before = rng.normal(size=(2, dimensions))
    before -= np.outer([0, 1], ((before[1] - before[0]) @ n + 1.3) * n)  # they approach at 1.3
    position = 3.0 + np.array([0 * n, 0.8 * n])
    sizes = Unequal(Table(rows), 0.9)
    gas = gas_of(position - NOW * before, before, (6.0, 7.0, 8.0)[:dimensions], rule=Constant(r), sizes=sizes)
    gas.tally.rows["stress"][0] = already = rng.normal(size=(dimensions, dimensions))
    collided(gas, NOW)
    dv = velocities(gas) - before
    np.testing.assert_allclose(m * dv, m_12 * (1 + r) * -1.3 * np.array([n, -n]), rtol=0, atol=1e-14)
    stress = np.outer(m[0] * dv[0], 0.8 * n)  # the partner's has both signs changed, and its radius is in the sum
    np.testing.assert_allclose(gas.tally.rows["stress"][0], already + stress, rtol=0, atol=1e-14)
    assert gas.tally.loss == pytest.approx(0.5 * m_12 * (1 - r**2) * 1.3**2, rel=1e-13)
    assert gas.tally.loss_time == pytest.approx(gas.tally.loss * NOW, rel=1e-13)


def test_counters_and_clocks(gas_of):
    gas, *_ = pair(gas_of, 1, Elastic())
    gas.clocks.rows["last"] = [-0.5, 0.125]
    since, _ = collided(gas, NOW)
    assert since == 0.125
    assert gas.clocks.rows["last"].tolist() == [NOW, NOW]
    assert gas.clocks.rows["interval"].tolist() == [0.75, 0.125]
    assert gas.disks.rows["t"].tolist() == [NOW, NOW]
    assert gas.disks.rows["collisions"].tolist() == [1, 1]
    assert gas.tally.collisions == 1


@pytest.mark.parametrize(
    ("last", "elastic"),
    [
        ((-1.0, -1.0), False),
        ((0.125, -1.0), True),  # one partner is enough, whichever
        ((-1.0, 0.125), True),
        ((0.0, -1.0), True),  # "no longer than t_c"
        ((np.nextafter(0.0, -1.0) - 1e-16, -1.0), False),
        ((-math.inf, -math.inf), False),
        ((-math.inf, 0.2), True),
    ],
)
def test_a_collision_within_t_c_is_elastic(last, elastic, gas_of):
    """A Eq. 4."""
    gas, _, n = pair(gas_of, 2, ContactTime(Constant(0.4), 0.25))
    gas.clocks.rows["last"] = last
    _, u_n = collided(gas, NOW)
    after = velocities(gas)
    assert (after[1] - after[0]) @ n == pytest.approx(-(1.0 if elastic else 0.4) * u_n, rel=1e-12)
    assert gas.tally.elastic == elastic
    assert (gas.tally.loss == 0) == elastic

"""Rough particles: what two surfaces do to each other, and what the engine counts of it."""

import math
from dataclasses import replace

import numpy as np
import pytest
from gases import lattice_gas
from numba import njit

from granugas.dynamics.events.collisions import collide
from granugas.dynamics.events.effects import called_by
from granugas.dynamics.events.effects.constant import Constant
from granugas.dynamics.events.effects.contact_time import ContactTime
from granugas.dynamics.events.effects.rough import Rough, effect_of
from granugas.dynamics.events.engine import Engine
from granugas.dynamics.events.memory import Table
from granugas.geometry import INERTIA, ROTATIONS
from granugas.scene import Scene

NOW = 0.25
GAS = Scene(100, 0.4, restitution=0.9, contact_time=0.0, tangential_restitution=0.5, friction=0.4)


@njit(error_model="numpy")
def collided(gas, i, j, now):
    return collide(gas, i, j, now)


class Pair:
    """Two particles (d = m = 1) that touch at NOW, with spins, before and after their collision."""

    def __init__(self, gas_of, seed, beta, mu, dimensions=2, rule=None):
        rng = np.random.default_rng(seed)
        self.rule, self.q = rule or Constant(0.7), INERTIA[dimensions]
        n = rng.normal(size=dimensions)
        self.n = n / np.linalg.norm(n)
        velocity = rng.normal(size=(2, dimensions))
        if (velocity[1] - velocity[0]) @ self.n > 0:
            velocity = velocity[::-1]
        box = np.array([9.0, 7.0, 8.0])[:dimensions]
        first = rng.uniform(0, box)
        position = np.mod(np.array([first, first + self.n]) - NOW * velocity, box)
        spins = np.zeros(2, np.dtype([("w", "f8", (ROTATIONS[dimensions],))]))
        spins["w"] = 3 * rng.normal(size=spins["w"].shape)
        surface = Rough(Table(spins), self.q * (1 + beta) / (1 + self.q), self.q, mu, 1.0)
        self.gas = gas_of(position, velocity, tuple(box), rule=self.rule, surface=surface)
        self.v, self.w = in_space(velocity), in_space(spins["w"])
        _, self.u_n = collided(self.gas, 0, 1, NOW)
        self.n = in_space(self.n)
        self.v_after, self.w_after = in_space(self.gas.disks.rows["v"]), in_space(spins["w"])

    def slip(self, v, w):
        """Velocity of the second surface relative to the first where they touch, along it."""
        g = v[1] - np.cross(w[1], self.n / 2) - v[0] - np.cross(w[0], self.n / 2)
        return g - (g @ self.n) * self.n

    def energies(self, v, w):
        return np.array([0.5 * np.sum(v**2), 0.5 * self.q / 4 * np.sum(w**2)])

    def angular_momenta(self, v, w):
        """Of each particle, about the point of contact."""
        from_contact = np.array([-self.n / 2, self.n / 2])
        return self.q / 4 * w + np.cross(from_contact, v)


def in_space(vectors):
    """Velocities of a plane are in it, spins (one component) out of it."""
    short = 3 - vectors.shape[-1]
    return np.pad(vectors, [(0, 0)] * (vectors.ndim - 1) + [(short, 0) if short == 2 else (0, short)]).copy()


@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize("beta", [-1.0, -0.5, 0.0, 0.5, 1.0])
def test_surfaces_that_stick(beta, dimensions, gas_of):
    for seed in range(20):
        pair = Pair(gas_of, seed, beta, math.inf, dimensions)
        np.testing.assert_allclose(pair.slip(pair.v_after, pair.w_after), -beta * pair.slip(pair.v, pair.w), atol=1e-13)
        check_what_is_conserved(pair)


@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize("beta", [0.0, 0.9])
def test_surfaces_slide_beyond_the_limit_of_coulomb(beta, dimensions, gas_of):
    """Beta of the contact is the smaller one of beta_0 = beta and -1 + mu (1 + r) (1 + 1/q) |u_n| / |g_t|."""
    mu, stuck = 0.6, 0
    for seed in range(60):
        pair = Pair(gas_of, seed, beta, mu, dimensions)
        before, after = pair.slip(pair.v, pair.w), pair.slip(pair.v_after, pair.w_after)
        sliding = -1 + mu * 1.7 * (1 + 1 / pair.q) * abs(pair.u_n) / np.linalg.norm(before)
        np.testing.assert_allclose(after, -min(beta, sliding) * before, atol=1e-13)
        dp = pair.v_after[0] - pair.v[0]
        along = abs(dp @ pair.n)
        across = np.linalg.norm(dp - (dp @ pair.n) * pair.n)
        assert across <= mu * along * (1 + 1e-12)
        assert (across < mu * along * (1 - 1e-12)) == (beta < sliding)
        stuck += beta < sliding
        check_what_is_conserved(pair)
    assert 5 < stuck < 55


def check_what_is_conserved(pair):
    dp = pair.v_after - pair.v
    np.testing.assert_allclose(dp.sum(axis=0), 0, atol=1e-14)
    assert (pair.v_after[1] - pair.v_after[0]) @ pair.n == pytest.approx(-0.7 * pair.u_n, rel=1e-12)  # A Eq. 3 holds
    before, after = pair.angular_momenta(pair.v, pair.w), pair.angular_momenta(pair.v_after, pair.w_after)
    np.testing.assert_allclose(after, before, atol=1e-13)
    gained, tally = pair.energies(pair.v_after, pair.w_after) - pair.energies(pair.v, pair.w), pair.gas.tally
    assert tally.loss == pytest.approx(-gained.sum(), abs=1e-13)
    assert tally.loss >= 0.51 / 4 * pair.u_n**2 - 1e-13
    assert tally.stored == pytest.approx(gained[1], abs=1e-13)
    assert tally.stored_time == pytest.approx(gained[1] * NOW, abs=1e-13)
    dimensions = tally.rows["stress"].shape[-1]
    stress = dp.T @ np.array([pair.n / 2, -pair.n / 2])  # dp_a l_b (A Eq. 15): no longer symmetric
    np.testing.assert_allclose(tally.rows["stress"][0], stress[:dimensions, :dimensions], atol=1e-13)


@pytest.mark.parametrize(("last", "rubs"), [(-1.0, True), (0.0, False), (0.125, False)])
def test_an_elastic_contact_of_the_tc_model_does_not_rub(last, rubs, gas_of):
    """Here t_c = .3 s: a collision within it dissipates nothing."""
    pair = Pair(gas_of, 3, 0.0, math.inf, rule=ContactTime(Constant(0.7), 0.3))
    assert np.any(pair.w != pair.w_after)  # nobody had collided before
    fresh = Pair.__new__(Pair)
    Pair.__init__(fresh, with_clocks(gas_of, last), 3, 0.0, math.inf, rule=ContactTime(Constant(0.7), 0.3))
    assert np.any(fresh.w != fresh.w_after) == rubs
    assert (fresh.gas.tally.loss == 0) == (not rubs)


def with_clocks(gas_of, last):
    """The same gases, whose first particle collided last at that time."""

    def make(*arguments, **effects):
        gas = gas_of(*arguments, **effects)
        gas.clocks.rows["last"][0] = last
        return gas

    return make


def ran(scene, collisions=3000, **instead) -> Engine:
    engine = Engine(scene, lattice_gas(scene), **instead)
    engine.advance(math.inf, collisions)
    return engine


def test_smooth_is_the_limit_bit_for_bit():
    smooth = replace(GAS, tangential_restitution=-1.0)
    start = lattice_gas(smooth)
    called, other = ran(smooth, surface=effect_of(smooth, start)), ran(smooth)
    assert called.arrays["disks"].tobytes() == other.arrays["disks"].tobytes()
    assert called.arrays["tally"].tobytes() == other.arrays["tally"].tobytes()
    assert ran(GAS).arrays["disks"].tobytes() != other.arrays["disks"].tobytes()


def test_the_file_is_called_for_by_rough_surfaces_alone():
    assert called_by(GAS)["surface"] == "rough"
    for smooth in ({"tangential_restitution": -1.0}, {"friction": 0.0}):
        assert "surface" not in called_by(replace(GAS, **smooth))


def test_rubbing_is_dissipation_at_restitution_1_too():
    rubbing = replace(GAS, restitution=1.0)
    assert called_by(rubbing)["watch"] == "collapse"
    assert called_by(replace(rubbing, contact_time=1e-5))["rule"] == ("contact_time",)
    assert called_by(replace(rubbing, contact_time=1e-5, friction=0.0))["rule"] == "elastic_share"
    assert ran(rubbing).take_tally().loss > 0


@pytest.mark.parametrize(
    "scene",
    [
        GAS,
        replace(GAS, friction=math.inf),
        replace(GAS, restitution=0.4, contact_time=1e-5),
        replace(GAS, restitution=1.0, tangential_restitution=1.0, friction=math.inf),
    ],
)
def test_energy_of_both_kinds_and_losses_add_up(scene):
    """And what the tally stores is the energy of rotation."""
    start = lattice_gas(scene)
    engine = Engine(scene, start)
    energy, losses, stored, begun = 0.5 * np.sum(start.velocity**2), 0.0, 0.0, 0.0
    for _ in range(20):
        engine.advance(math.inf, 500)
        state, tally = engine.state(), engine.take_tally()
        losses, stored = losses + tally.loss, stored + tally.stored
        rotation = 0.5 * 0.5 * (scene.diameter / 2) ** 2 * np.sum(state.more["spin"] ** 2)
        translation = 0.5 * np.sum(state.velocity**2)
        assert translation + rotation + losses == pytest.approx(energy, rel=1e-12)
        assert stored == pytest.approx(rotation, abs=1e-12 * energy)
        seen = engine.observe(state)
        assert seen["rotational_energy"] == pytest.approx(rotation / energy, rel=1e-12)
        assert seen["temperature_ratio"] == pytest.approx(2 * rotation / translation, rel=1e-12)
        begun = begun or rotation
    assert begun > 0
    if scene.restitution == 1:
        assert abs(losses) < 1e-12 * energy


def test_the_mean_energy_of_translation_in_an_interval_is_exact():
    """End + losses + stored, less what each took part in: A Eq. 16 is taken by it."""
    engine, step = Engine(GAS, lattice_gas(GAS)), Engine(GAS, lattice_gas(GAS))
    engine.advance(math.inf, 300)
    tally, state = engine.take_tally(), engine.state()
    total = 0.0
    for _ in range(300):
        before, energy = step.time, 0.5 * np.sum(step.state().velocity ** 2)
        step.advance(math.inf, 1)
        total += energy * (step.time - before)
    mean = 0.5 * np.sum(state.velocity**2) + tally.loss + tally.stored - (tally.loss_time + tally.stored_time) / state.time
    assert mean == pytest.approx(total / state.time, rel=1e-9)
    assert tally.stored > 0.05 * total / state.time


def test_spins_go_on_from_a_state():
    engine = ran(GAS)
    state = engine.state()
    assert state.more["spin"].shape == (100,)
    other = Engine(GAS, state)
    np.testing.assert_array_equal(other.state().more["spin"], state.more["spin"])
    assert not np.any(Engine(GAS, lattice_gas(GAS)).state().more["spin"])

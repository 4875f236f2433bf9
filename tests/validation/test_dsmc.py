"""Direct simulation Monte Carlo against kinetic theory."""

import math
from dataclasses import replace

import numpy as np
import pytest

from granugas.analysis.enskog import enskog_rate, reduced_pressure
from granugas.analysis.theory import (
    elastic_collision_fraction,
    elastic_particle_fraction,
    homogeneous_cooling,
    sonine_coefficient,
)
from granugas.dynamics import engine_of
from granugas.equilibrate import at_rest
from granugas.scene import Scene

GAS = Scene(4000, 0.25, restitution=1.0, contact_time=0.0, dynamics="dsmc")
ONE_CELL = 1.0e4
"""Particles per cell where all are in one: a homogeneous gas, whatever r is."""


def gas(scene, seed):
    rng, n, dimensions = np.random.default_rng(seed), scene.n_particles, scene.dimensions
    velocity = rng.normal(size=(n, dimensions))
    velocity -= velocity.mean(axis=0)
    velocity *= math.sqrt(2 * scene.energy_per_mass * n / np.sum(velocity**2))
    box = (scene.volume ** (1 / dimensions),) * dimensions
    return engine_of(scene, replace(at_rest(rng.uniform(0, box, (n, dimensions)), velocity, box), seed=(seed,)))


def rate_of(scene):
    return float(enskog_rate(scene.area_fraction, scene.energy_per_mass, scene.diameter, scene.dimensions))


def energy(engine):
    """By that at t = 0."""
    return float(np.sum(engine.state().velocity ** 2)) / (2 * engine.scene.n_particles * engine.scene.energy_per_mass)


def sonine(velocity):
    square, dimensions = np.sum(velocity**2, axis=1), velocity.shape[1]
    return float(np.mean(square**2) / np.mean(square) ** 2 * dimensions / (dimensions + 2) - 1)


@pytest.mark.parametrize(
    ("values", "allowed"),
    [
        ({}, 0.003),
        ({"particles_per_cell": 10.0}, 0.003),
        ({"particles_per_cell": 200.0}, 0.003),
        ({"n_particles": 4000, "particles_per_cell": ONE_CELL}, 0.003),
        ({"area_fraction": 1e-4}, 0.003),
        ({"area_fraction": 0.5}, 0.01),
        ({"area_fraction": 0.7}, 0.06),
        ({"n_particles": 4000, "area_fraction": 0.7, "particles_per_cell": ONE_CELL}, 0.003),
        ({"area_fraction": 0.3, "dimensions": 3}, 0.01),
        ({"n_particles": 4000, "area_fraction": 0.3, "dimensions": 3, "particles_per_cell": ONE_CELL}, 0.003),
    ],
    ids=str,
)
def test_rate_and_pressure_are_those_of_enskog(values, allowed):
    """A Eqs. 16, 17 and 19. The numbers in cells fluctuate, the more slowly and strongly the denser: so does the rate."""
    scene = replace(GAS, **{"n_particles": 20_000} | values)
    n, rates, pressures = scene.n_particles, [], []
    for seed in range(4):
        engine = gas(scene, seed)
        engine.advance(math.inf, 5 * n)
        engine.take_tally()
        begin = engine.time
        engine.advance(math.inf, 40 * n)
        tally, span = engine.take_tally(), engine.time - begin
        rates.append(2 * tally.collisions / (n * span))
        pressures.append(-np.trace(tally.stress) / (2 * n * scene.energy_per_mass * span))
    assert np.mean(rates) == pytest.approx(rate_of(scene), rel=allowed)
    excess = float(reduced_pressure(scene.area_fraction, dimensions=scene.dimensions)) - 1
    assert np.mean(pressures) == pytest.approx(excess, rel=2 * allowed)
    assert energy(engine) == pytest.approx(1, abs=1e-13)
    assert abs(engine.state().velocity.sum(axis=0)).max() / n < 1e-12 * scene.velocity_half_width


@pytest.mark.parametrize("n", [2, 10])
def test_few_particles(n):
    """The pressure is Enskog's for any number of particles without momentum, the rate that of n - 1 degrees of freedom."""
    scene = replace(GAS, n_particles=n)
    engine = gas(scene, 1)
    engine.advance(math.inf, 200_000)
    tally = engine.take_tally()
    pressure = -np.trace(tally.stress) / (2 * n * scene.energy_per_mass * engine.time)
    assert pressure == pytest.approx(float(reduced_pressure(0.25)) - 1, rel=0.008)
    assert 2 * tally.collisions / (n * engine.time) == pytest.approx(rate_of(scene) * {2: 0.798, 10: 0.9619}[n], rel=0.005)


def test_a_homogeneous_gas_knows_no_error_of_the_step(monkeypatch):
    """A hundred disks that begin with velocities of +-w along x, in one step: the largest relative speed grows with them."""
    monkeypatch.setattr("granugas.dynamics.dsmc.STEP", 4000.0)
    scene = replace(GAS, n_particles=100, particles_per_cell=ONE_CELL)
    start = gas(scene, 1).state()
    start.velocity[:] = np.outer(np.resize([1, -1], 100), [1, 0]) * math.sqrt(2 * scene.energy_per_mass)
    engine = engine_of(scene, replace(start, seed=(1,)))
    engine.advance(math.inf, most_events=1)
    pressure = -np.trace(engine.take_tally().stress) / (2 * 100 * scene.energy_per_mass * engine.time)
    assert engine.collisions > 1e5
    assert pressure == pytest.approx(float(reduced_pressure(0.25)) - 1, rel=0.01)


@pytest.mark.parametrize("r", [0.95, 0.9, 0.6])
def test_homogeneous_cooling(r):
    """A Eq. 23 with the a_2 of the homogeneous state (Montanero & Santos), which the first collisions bring about."""
    scene, tau = replace(GAS, n_particles=10_000, restitution=r, particles_per_cell=ONE_CELL), 10.0
    kept, found = [], []
    for seed in range(4):
        engine = gas(scene, seed)
        engine.advance(tau / rate_of(scene))
        kept.append(energy(engine))
        for _ in range(6):
            engine.advance(math.inf, scene.n_particles)
            found.append(sonine(engine.state().velocity))
    a_2 = float(sonine_coefficient(r))
    assert np.mean(found) == pytest.approx(a_2, abs=0.006)
    assert np.mean(kept) == pytest.approx(float(homogeneous_cooling(tau * (1 + 3 * a_2 / 16), r)), rel=0.012)


def test_how_cooling_depends_on_the_cells():
    """The common velocity of a cell does not cool: fewer particles in it keep more energy. None collapses at r = .4."""
    kept = {}
    for count in (10.0, 40.0, 400.0):
        scene = replace(GAS, restitution=0.4, particles_per_cell=count)
        engine = gas(scene, 1)
        engine.advance(20 / rate_of(scene))
        kept[count] = energy(engine)
    assert kept[10.0] > 1.1 * kept[40.0] > 1.1 * 1.05 * kept[400.0] > float(homogeneous_cooling(20, 0.4))


def rate_by_speed():
    """<w(v)^2> / <w(v)>^2 over Maxwellian velocities in two dimensions, w(v): rate at which one of velocity v collides."""
    velocity, other = np.random.default_rng(0).normal(size=(2, 4000, 2))
    rate = np.array([np.mean(np.hypot(*(v - other).T)) for v in velocity])
    return float(np.mean(rate**2) / np.mean(rate) ** 2)


@pytest.mark.parametrize("r", [1.0, 0.9999])
@pytest.mark.parametrize("contact_time", [1e-5, 2e-4])
def test_elastic_fractions(contact_time, r):
    """A Eqs. 20 and 21. Fast particles collide more often before and after: for t_c -> 0 c_e is larger by <w^2>/<w>^2."""
    scene = replace(GAS, restitution=r, contact_time=contact_time, particles_per_cell=ONE_CELL)
    engine, shares = gas(scene, 2), []
    engine.advance(math.inf, 5 * scene.n_particles)
    engine.take_tally()
    for _ in range(100):
        engine.advance(math.inf, 5 * scene.n_particles)
        state = engine.state()
        shares.append(np.mean(state.time - state.last_collision_time <= contact_time))
    tally, w = engine.take_tally(), rate_of(scene)
    assert np.mean(shares) == pytest.approx(float(elastic_particle_fraction(contact_time, w)), rel=0.05)
    share, mean_field = tally.elastic[0] / tally.collisions, float(elastic_collision_fraction(contact_time, w))
    if contact_time == 1e-5:
        assert share == pytest.approx(rate_by_speed() * mean_field, rel=0.025)
    else:
        assert mean_field < share < 1.07 * mean_field


def test_the_step_does_not_matter(monkeypatch):
    """A shear wave decays alike in steps of a half and of an eighth of the mean free time."""
    found = {}
    for step in (0.5, 0.125):
        monkeypatch.setattr("granugas.dynamics.dsmc.STEP", step)
        left = []
        for seed in range(6):
            scene = replace(GAS, particles_per_cell=10.0)
            start = gas(scene, seed)
            state = start.state()
            wave = np.sin(2 * np.pi * state.position[:, 0] / state.box[0])
            state.velocity[:, 1] += scene.velocity_half_width * wave
            state.velocity -= state.velocity.mean(axis=0)
            engine = engine_of(scene, replace(state, seed=(seed, 1)))
            engine.advance(40 / rate_of(scene))
            after = engine.state()
            left.append(2 * np.mean(after.velocity[:, 1] * np.sin(2 * np.pi * after.position[:, 0] / after.box[0])))
        found[step] = np.mean(left) / scene.velocity_half_width
    assert 0.2 < found[0.125] < 0.95
    assert found[0.5] == pytest.approx(found[0.125], abs=0.03)

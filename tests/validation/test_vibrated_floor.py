"""A floor that shakes particles: when they leave it, what it feeds them, and where the model without a contact time ends."""

import math

import numpy as np
import pytest
from gases import lattice_gas

from granugas.checks import findings
from granugas.dynamics.events import loop
from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import at_rest
from granugas.scene import Scene
from granugas.simulate import simulate
from granugas.storage.pooling import pool

G, D, F = 9.81, 1.0e-3, 50.0
OMEGA = 2 * math.pi * F


def shaken(n: int, fraction: float, gamma: float, contact_time: float = 1e-5, **keys) -> Scene:
    """Disks on a harmonic floor with Gamma = A omega^2 / g."""
    keys = {"restitution": 0.9, "wall_restitution": 0.9, "velocity_half_width": 0.2} | keys
    return Scene(n, fraction, contact_time=contact_time, boundary="periodic wall", wall_contact_time=contact_time, gravity=G,
                 floor="harmonic", floor_amplitude=gamma * G / OMEGA**2, floor_frequency=F, **keys)  # fmt: skip


def heights_above(scene: Scene, periods: float, looks: int = 500) -> np.ndarray:
    """Of a ball that begins at rest on the floor, which for a contact time t_c means with hops shorter than t_c."""
    side = math.sqrt(scene.volume)
    hop = G * scene.wall_contact_time / 3
    engine = Engine(scene, at_rest(np.array([[side / 2, D / 2]]), np.array([[0.0, hop]]), (side, side)))
    heights = []
    for time in np.linspace(0, periods / F, looks)[1:]:
        engine.advance(time)
        floor = scene.floor_amplitude * (1 - math.cos(OMEGA * time))
        heights.append(engine.state().position[0, 1] - D / 2 - floor)
    return np.array(heights) / scene.floor_amplitude


@pytest.mark.parametrize("gamma", [0.9, 0.98])
def test_a_ball_at_rest_stays_on_a_floor_that_is_too_gentle(gamma):
    heights = heights_above(shaken(1, 0.001, gamma, wall_restitution=0.3), 4)
    assert np.all(heights > -1e-10)
    assert heights.max() < 1e-6


@pytest.mark.parametrize("gamma", [1.05, 1.5])
def test_a_ball_at_rest_leaves_a_floor_that_accelerates_down_faster_than_it_falls(gamma):
    """As high as free flight from the take-off at sin(phase) = 1 / Gamma takes it above the floor."""
    heights = heights_above(shaken(1, 0.001, gamma, wall_restitution=0.3), 1.45, 2000)
    phase = math.asin(1 / gamma)
    t = np.linspace(0, 0.45 / F, 100_001)
    floor = np.sin(phase + OMEGA * t) - math.sin(phase)
    flight = OMEGA * math.cos(phase) * t - t * t * OMEGA**2 / (2 * gamma) - floor
    assert heights.max() == pytest.approx(flight.max(), rel=0.02)


def test_in_the_steady_state_the_floor_feeds_what_collisions_dissipate():
    scene = shaken(30, 0.1, 5.0, aspect_ratio=0.3)
    engine = Engine(scene, lattice_gas(scene))
    energies, observed = [], []
    for _ in range(21):
        engine.advance(engine.time + 0.3)
        state, tally = engine.state(), engine.take_tally()
        energies.append(
            (np.sum(state.velocity**2) / 2 + G * np.sum(state.position[:, 1])) / (scene.n_particles * scene.energy_per_mass)
        )
        observed.append(engine.observe(state, tally, 0.3))
    fed, lost = (np.diff([now[name] for now in observed]) for name in ("floor_energy", "dissipated_energy"))
    np.testing.assert_allclose(fed - lost, np.diff(energies), atol=1e-10)
    assert fed.sum() == pytest.approx(lost.sum(), rel=0.03)
    assert fed.sum() > 5 * energies[-1]
    assert np.mean([now["floor_force"] for now in observed[1:]]) == pytest.approx(1.0, abs=0.02)


def test_the_filling_that_stops_the_model_without_a_contact_time():
    """A shallow layer is fluidised; a deep one collapses, and runs through with a contact time."""

    def layer(n: int, contact_time: float) -> int:
        scene = shaken(n, n * 0.003, 5.0, contact_time, restitution=0.6, wall_restitution=1.0, aspect_ratio=0.4)
        return Engine(scene, lattice_gas(scene)).advance(0.5)

    assert layer(15, 0.0) == loop.TIME
    assert layer(60, 0.0) == loop.WATCH
    assert layer(120, 0.0) == loop.WATCH
    assert layer(60, 1e-5) == loop.TIME


def test_a_run_says_what_its_floor_and_its_walls_did():
    scene = shaken(30, 0.1, 5.0, aspect_ratio=0.3)
    run = simulate(scene, until=0.2, samples={"count": 5, "spacing": "linear"}, snapshots=[0.2], progress=False)
    names = ("floor_energy", "dissipated_energy", "potential_energy", "floor_force", "wall_collisions_per_particle")
    assert all(np.isfinite(run[name].values[1:]).all() for name in names)
    total = run["kinetic_energy"] + run["potential_energy"] - run["floor_energy"] + run["dissipated_energy"]
    np.testing.assert_allclose(total, total[0], rtol=1e-10)
    assert run["kinetic_energy"][0] == pytest.approx(1.0, rel=1e-12)
    assert np.abs(run["velocity"].mean("particle")).max() > 0
    assert "wall_pressure" not in run
    pooled = pool([run], ["restitution"])
    assert findings(pooled) == []

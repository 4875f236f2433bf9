"""Gases heated by random kicks: the steady temperature, energy and momentum."""

import numpy as np
import pytest

from granugas.analysis import theory
from granugas.analysis.observables import kinetic_energy
from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import equilibrate, state_of
from granugas.scene import Scene
from granugas.simulate import simulate

AREA_FRACTION = 0.2
TEMPERATURE = Scene().velocity_half_width ** 2 / 3
RATE = float(theory.enskog_rate(AREA_FRACTION, TEMPERATURE, Scene().diameter))
"""1/t_E in 1/s at the TEMPERATURE kT/m of the start."""


def heated(restitution: float, heating: float, n_particles: int = 500) -> Scene:
    return Scene(n_particles, AREA_FRACTION, restitution, contact_time=0.0, heating=heating)


def steady_heating(restitution: float) -> float:
    """What keeps a Gaussian gas at the temperature of the start."""
    return (1 - restitution**2) / 2 * RATE * TEMPERATURE


@pytest.mark.parametrize(("restitution", "times"), [(0.95, 4.0), (0.99, 1.0)])
def test_steady_temperature(restitution, times):
    """Within 3 % of the balance of heating and dissipation; standard error .5 to .8 %."""
    heating = times * steady_heating(restitution)
    expected = theory.steady_temperature(heating, restitution, RATE / np.sqrt(TEMPERATURE))
    relaxed, until = 10 / (1 - restitution**2) / RATE, 1000 / RATE
    spaced = {"spacing": "linear", "count": 400}
    run = simulate(heated(restitution, heating), relaxed + until, seed=3, samples=spaced, keep_positions=False, progress=False)
    steady = run.sel(time=slice(relaxed, None))
    assert float(steady["kinetic_energy"].mean()) * TEMPERATURE == pytest.approx(expected, rel=0.03)
    assert float(steady["heating_power"].mean()) == pytest.approx(heating, rel=0.04)


@pytest.mark.parametrize("restitution", [1.0, 0.9])
@pytest.mark.parametrize("sizes", ["equal", "bidisperse"])
def test_energy_and_momentum(restitution, sizes):
    """What is put in and what is dissipated is what the energy changes by; the centre of mass stays."""
    scene = Scene(200, 0.1, restitution, contact_time=0.0, heating=2 * steady_heating(0.9), sizes=sizes)
    engine = Engine(scene, state_of(equilibrate(scene, seed=1), 1, 0))
    mass = engine.state().more.get("mass", np.ones(200))
    before, put_in = kinetic_energy(engine.state().velocity, mass).sum(), 0.0
    for _ in range(50):
        engine.advance(engine.time + 1 / RATE)
        tally, state = engine.take_tally(), engine.state()
        energy = kinetic_energy(state.velocity, mass).sum()
        assert tally.loss == pytest.approx(before - energy, abs=1e-12 * before)
        if restitution == 1:
            assert tally.more["energy_input"] == pytest.approx(-tally.loss, rel=1e-9)
        assert tally.more["energy_input"] + tally.loss >= -1e-12 * before
        before, put_in = energy, put_in + tally.more["energy_input"]
        assert np.abs(mass @ state.velocity).max() <= 1e-12 * np.sqrt(2 * energy * 200)
    assert engine.backwards == 0
    given = 200 * scene.heating * engine.time
    scatter = np.sqrt(2 * before / 200 / given)  # of the sum of v dv over independent kicks, at the temperature of the end
    assert put_in == pytest.approx(given, rel=3 * scatter)

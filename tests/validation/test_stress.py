"""The stress of test volumes in equilibrium: that of the box, and that of theory (A Eqs. 14 to 17)."""

import numpy as np
import pytest

from granugas.analysis import theory
from granugas.analysis.observables import kinetic_energy
from granugas.analysis.stress import Volumes
from granugas.dynamics.events.effects.contacts import contacts
from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import equilibrate, state_of
from granugas.experiments.volumes import follow, pressures
from granugas.scene import Scene

STEP, STEPS, CUTS = 0.02, 200, (5, 4)


@pytest.fixture(scope="module")
def elastic():
    """A dense gas for 4 s, some 10^4 collisions of each disk: reduced pressures (3, STEPS, 20), and the engine's own."""
    scene = Scene(400, 0.4, restitution=1.0, contact_time=0.0)
    engine = Engine(scene, state_of(equilibrate(scene, seed=1998)), watch=contacts(50_000))
    volumes = Volumes(engine.box, *CUTS)
    found = np.empty((3, STEPS, volumes.count))
    for k in range(STEPS):
        seen = follow(engine, (k + 1) * STEP)
        found[:, k] = pressures(volumes, engine.state(), seen, scene.diameter, STEP)
    to_reduced = scene.volume / kinetic_energy(engine.state().velocity).sum()
    own = -np.trace(engine.take_tally().stress) / 2 / (STEP * STEPS * scene.volume)
    return found * to_reduced, own * to_reduced


def test_every_volume_has_the_pressure_of_the_box(elastic):
    """P_0 of each volume, streaming (one particle in 20, as the box is at rest) put back; standard error of one 1 %."""
    (kinetic, streaming, collisional), own = elastic
    each = (kinetic + streaming + collisional).mean(axis=0)
    assert each.mean() == pytest.approx(1 + own, rel=1e-12)
    np.testing.assert_allclose(each, 1 + own, rtol=0.05)
    expected = theory.reduced_pressure(0.4, theory.contact_value_dense(0.4))
    assert each.mean() == pytest.approx(expected, rel=5e-3)


def test_streaming_in_equilibrium_is_one_particle_in_each_volume(elastic):
    """(20 - 1)/N of the energy, each component alike; standard error 2 %."""
    (kinetic, streaming, _), _ = elastic
    assert streaming.mean() == pytest.approx(19 / 400, rel=0.1)
    assert kinetic.mean() == pytest.approx(1 - 19 / 400, rel=5e-3)

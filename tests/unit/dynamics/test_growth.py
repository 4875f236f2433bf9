"""Particles that are too large for the start lattice grow in a moving gas."""

import math
from dataclasses import replace

import numpy as np
import pytest
from gaps import TOLERATED, smallest_gap

from granugas.analysis.observables import kinetic_energy
from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import engine_at_start, equilibrate, on_lattice, state_of
from granugas.initial import random_stream, start_lattice
from granugas.scene import Scene

DENSE = Scene(200, 0.6, sizes="bidisperse", size_ratio=3.0, size_share=0.2)


def growing(scene: Scene) -> tuple[Engine, np.ndarray]:
    """The engine that makes a start, and the diameters that are wanted."""
    lattice = start_lattice(scene)
    start = on_lattice(scene, lattice, random_stream(scene, 0, 0))
    return engine_at_start(scene, start, lattice), start.more["diameter"]


def test_they_grow_step_by_step_and_never_overlap():
    engine, wanted = growing(DENSE)
    mass = engine.state().more["mass"]
    before, energy = engine.state().more["diameter"], kinetic_energy(engine.state().velocity, mass).sum()
    assert np.any(before < 0.8 * wanted)
    steps = 0
    while engine.effects["drive"].due(math.inf) is not None:
        engine.advance(engine.time + engine.effects["drive"].interval)
        now = engine.state().more["diameter"]
        assert np.all((now >= before) & (now <= wanted * (1 + 1e-15)))
        assert smallest_gap(engine) > -TOLERATED
        before, steps = now, steps + 1
    assert 3 < steps < 1000
    np.testing.assert_allclose(before, wanted, rtol=1e-15)
    assert kinetic_energy(engine.state().velocity, mass).sum() == pytest.approx(energy, rel=1e-12)
    assert engine.backwards == 0


def test_where_all_fit_nobody_has_to_grow():
    engine, wanted = growing(replace(DENSE, area_fraction=0.02))
    np.testing.assert_allclose(engine.state().more["diameter"], wanted, rtol=1e-15)


@pytest.mark.parametrize("spread", [0.3, 0.5])
def test_a_dense_start_has_its_area_fraction(spread):
    scene = Scene(300, 0.65, sizes="log_normal", size_spread=spread)
    start = equilibrate(scene, seed=1)
    state = state_of(start)
    covered = np.sum(np.pi / 4 * state.more["diameter"] ** 2)
    assert covered / math.prod(state.box) == pytest.approx(0.65)
    assert start.attrs["equilibration_reached"] == 1
    assert smallest_gap(Engine(scene, state)) > -TOLERATED

"""Gravity: a ball on a plate, beads that collapse on a wall, a bed at rest, and an atmosphere of elastic disks."""

import math

import numpy as np
import pytest
from gases import lattice_gas

from granugas.analysis import theory
from granugas.analysis.enskog import contact_value
from granugas.dynamics.events import loop
from granugas.dynamics.events.effects.constant import Constant
from granugas.dynamics.events.effects.contact_time import ContactTime
from granugas.dynamics.events.effects.nobody import Nobody
from granugas.dynamics.events.engine import Engine
from granugas.dynamics.plate import Ball, bounce, state_at
from granugas.equilibrate import at_rest
from granugas.scene import Scene

G, D = 9.81, 1.0e-3
BED = {"boundary": "periodic wall", "gravity": G, "restitution": 0.8, "wall_restitution": 0.8}


def dropped(speed: float, contact_time: float) -> Engine:
    """One disk that hits the floor with this speed at t = 0 (A Eq. 5)."""
    scene = Scene(1, 0.001, contact_time=contact_time, wall_contact_time=contact_time, **BED)
    side = math.sqrt(scene.volume)
    return Engine(scene, at_rest(np.array([[side / 2, D / 2]]), np.array([[0.0, -speed]]), (side, side)))


def energy(engine: Engine) -> float:
    """Kinetic and potential, per mass."""
    state = engine.state()
    return float(np.sum(state.velocity**2) / 2 + engine.scene.gravity * np.sum(state.position[:, 1] - D / 2))


def test_one_ball_on_a_plate():
    """A Eqs. 5 to 10, and after them the ball that stays at rest, as dynamics/plate.py has them."""
    r, v, t_c = 0.8, 0.2, 2e-3
    engine, alone = dropped(v, t_c), bounce(ContactTime(Constant(r), t_c), Ball(0.0, -v), G, 100)
    hits = theory.whole_hits_to_rest(r, t_c / (2 * v / G))
    assert np.count_nonzero(~alone.elastic) == hits
    end = alone.time[60]
    for time in np.linspace(0.0, end, 200)[1:]:
        engine.advance(time)
        state, (height, velocity) = engine.state(), state_at(alone, time)
        assert state.position[0, 1] - D / 2 == pytest.approx(height, abs=1e-14)
        assert state.velocity[0, 1] == pytest.approx(velocity, abs=1e-12)
    tally = engine.take_tally()
    assert tally.more["wall_hits"] == np.count_nonzero(alone.time <= end)
    assert tally.loss == pytest.approx(v * v / 2 * (1 - r ** (2 * hits)), rel=1e-12)


def test_one_ball_without_a_contact_time_collapses_when_it_should():
    """A Eq. 8: t_s = r t_1 / (1 - r) after the first hit."""
    v = 0.2
    engine = dropped(v, 0.0)
    assert engine.advance(1.0) == loop.WATCH
    assert engine.time == pytest.approx(theory.rest_time_hard(0.8) * 2 * v / G, rel=1e-5)
    assert engine.involved().tolist() == [0]


@pytest.mark.parametrize(("r", "collapses"), [(0.16, True), (0.165, True), (0.18, False), (0.3, False)])
def test_two_beads_on_a_wall_collapse_below_the_exact_bound(r, collapses):
    """r < tan^2(pi/8) = 3 - 2 sqrt(2) = .1716 (A section 2.1), hardly disturbed by a gravity that is all but zero."""
    scene = Scene(2, 0.02, restitution=r, contact_time=0.0, boundary="wall", wall_restitution=r, gravity=1e-12, diameter=1.0)
    side = math.sqrt(scene.volume)
    start = at_rest(np.array([[side / 2, 1.5], [side / 2, 3.0]]), np.array([[0.0, -1.0]] * 2), (side, side))
    engine = Engine(scene, start)
    why = engine.advance(1000.0)
    assert why == (loop.WATCH if collapses else loop.TIME)
    assert engine.involved().tolist() == ([0, 1] if collapses else [])


def test_a_bed_at_rest_weighs_what_its_particles_weigh():
    """A section 4.2 for many: what is left of the motion is elastic, and the floor feels the weight."""
    t_c = 1e-4
    scene = Scene(50, 0.3, contact_time=t_c, wall_contact_time=t_c, aspect_ratio=0.4, velocity_half_width=0.1, **BED)
    engine = Engine(scene, lattice_gas(scene))
    engine.advance(0.3)
    engine.take_tally()
    engine.advance(0.4)
    state, tally = engine.state(), engine.take_tally()
    assert engine.observe(state, tally, 0.1)["floor_force"] == pytest.approx(1.0, rel=0.005)
    assert 1 - tally.elastic[0] / tally.collisions < 0.01
    elastic = state.time - state.last_collision_time <= t_c
    squares = np.sum(state.velocity**2, axis=1)
    assert np.mean(squares) < 2 * (G * t_c) ** 2  # as fast as a fall of t_c makes them, and no slower
    assert np.mean(squares) > 0.1 * (G * t_c) ** 2
    assert squares[elastic].sum() / squares.sum() > 0.7
    assert np.all(state.position[:, 1] < 9 * D)


def test_an_elastic_atmosphere_has_its_profile_and_keeps_its_energy():
    """Hydrostatic balance d(nu Z)/dz = -nu m g / (k T), with Z of A Eqs. 16 and 17: all but the barometric formula."""
    scene = Scene(100, 0.01, restitution=1.0, contact_time=0.0, boundary="periodic wall", gravity=G, velocity_half_width=0.3,
                  aspect_ratio=0.5)  # fmt: skip
    engine = Engine(scene, lattice_gas(scene), rule=ContactTime(Constant(1.0), 0.0), watch=Nobody())
    before = energy(engine)
    engine.advance(5.0)
    engine.take_tally()
    heights, squares, looks = [], [], 1500
    for _ in range(looks):
        engine.advance(engine.time + 0.04)
        state = engine.state()
        heights.append(state.position[:, 1] - D / 2)
        squares.append(np.mean(state.velocity**2))
    assert energy(engine) == pytest.approx(before, rel=1e-10)
    top, h = state.box[1] - D, np.mean(squares) / G
    measured, edges = np.histogram(heights, bins=6, range=(0.0, top))
    expected = _hydrostatic(edges, h, scene.area_fraction * state.box[1] / top)
    np.testing.assert_allclose(measured / np.size(heights), expected, rtol=0.05)
    down, up = engine.take_tally().more["wall_momentum"][1] / (0.04 * looks)
    assert -down - up == pytest.approx(100 * G, rel=0.01)


def _hydrostatic(edges: np.ndarray, h: float, mean: float) -> np.ndarray:
    """Shares of the particles between heights, from the profile of which the mean density is given."""
    z = np.linspace(edges[0], edges[-1], 6001)

    def profile(floor: float) -> np.ndarray:
        density = [floor]
        for _ in z[1:]:
            nu = density[-1]
            slope = 1 + 4 * nu * contact_value(nu) + 2 * nu**2 * (contact_value(nu + 1e-6) - contact_value(nu)) / 1e-6
            density.append(nu - nu / h / slope * (z[1] - z[0]))
        return np.array(density)

    low, high = mean, 0.5
    for _ in range(30):
        middle = (low + high) / 2
        low, high = (middle, high) if profile(middle).mean() < mean else (low, middle)
    density = profile(low)
    cumulated = np.concatenate([[0.0], np.cumsum((density[1:] + density[:-1]) / 2)])
    return np.diff(np.interp(edges, z, cumulated / cumulated[-1]))

"""What must never change or only so much: no overlap, time, momentum, energy; over ten million collisions and more."""

import numpy as np
import pytest
from gaps import TOLERATED, smallest_gap

from granugas.analysis.observables import kinetic_energy
from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import at_rest, equilibrate, state_of
from granugas.scene import Scene

MANY = 10_000_000
LOOKS = 100
FULL = [pytest.mark.full, pytest.mark.timeout(3600)]


def started(scene: Scene) -> Engine:
    return Engine(scene, state_of(equilibrate(scene, seed=1998)))


def energy(engine: Engine) -> float:
    return float(kinetic_energy(engine.state().velocity).sum())


def momentum(engine: Engine) -> float:
    return float(np.abs(engine.state().velocity.sum(axis=0)).max())


@pytest.mark.parametrize("collisions", [MANY, pytest.param(10 * MANY, marks=FULL)])
@pytest.mark.parametrize("area_fraction", [0.25, 0.7])
def test_elastic_disks_never_overlap_and_keep_energy_and_momentum(area_fraction, collisions):
    engine = started(Scene(1435, area_fraction, restitution=1.0, contact_time=0.0))
    n, start, time = engine.scene.n_particles, energy(engine), engine.time
    v_bar = np.sqrt(2 * start / n)
    for _ in range(LOOKS):
        engine.advance(np.inf, collisions // LOOKS)
        assert smallest_gap(engine) >= -TOLERATED
        assert engine.time > time
        time = engine.time
    assert engine.collisions == collisions
    assert engine.backwards == 0
    assert abs(energy(engine) / start - 1) <= 1e-11
    assert momentum(engine) <= 1e-12 * n * v_bar


@pytest.mark.parametrize(
    ("area_fraction", "restitution", "contact_time", "collisions"),
    [
        (0.25, 0.8, 1e-5, MANY),  # cools by many orders of magnitude
        (0.25, 0.4, 1e-12, MANY),  # clusters, in which collisions follow each other within picoseconds
        (0.7, 0.4, 1e-12, MANY),
        pytest.param(0.25, 0.4, 1e-12, 10 * MANY, marks=FULL),
        pytest.param(0.7, 0.4, 1e-12, 10 * MANY, marks=FULL),
    ],
)
def test_dissipated_energy_is_what_is_missing(area_fraction, restitution, contact_time, collisions):
    """At every look the loss since the one before, and at the end all losses; nothing overlaps meanwhile."""
    engine = started(Scene(5740, area_fraction, restitution, contact_time))
    n, start, time = engine.scene.n_particles, energy(engine), engine.time
    left, lost = start, 0.0
    for _ in range(LOOKS):
        engine.advance(np.inf, collisions // LOOKS)
        assert smallest_gap(engine) >= -TOLERATED
        assert engine.time > time
        time = engine.time
        loss, before, left = engine.take_tally().loss, left, energy(engine)
        assert loss == pytest.approx(before - left, abs=1e-10 * before)
        lost += loss
    assert engine.backwards == 0
    assert left < 0.02 * start
    assert lost == pytest.approx(start - left, abs=1e-10 * start)
    assert momentum(engine) <= 1e-12 * n * np.sqrt(2 * start / n)


@pytest.mark.parametrize("restitution", [0.99, 0.9, 0.0])
def test_losses_of_many_samples_add_up(restitution):
    """Thousands of samples; between two of them the mean energy of the tally lies between that of their ends."""
    engine = started(Scene(n_particles=378, restitution=restitution, contact_time=1e-6))
    start = left = energy(engine)
    lost = 0.0
    for stop in np.linspace(0.0, 2.0, 4001)[1:]:
        before, dt = left, stop - engine.time
        engine.advance(stop)
        tally, left = engine.take_tally(), energy(engine)
        lost += tally.loss
        mean = left + tally.loss - tally.loss_time / dt
        assert left * (1 - 1e-9) <= mean <= before * (1 + 1e-9)
    assert lost == pytest.approx(start - left, abs=1e-10 * start)


@pytest.mark.parametrize("restitution", [1.0, 0.4, 0.0])
@pytest.mark.parametrize("normal", [(1.0, 0.0), (0.0, 1.0), (0.6, 0.8), (0.8, -0.6)], ids=str)
def test_the_momentum_of_one_collision_flows_along_its_normal(normal, restitution):
    """The tally holds dp_a l_b of both partners (A Eq. 15): -(1+r)/2 u n_a n_b d for two disks head on with u."""
    scene = Scene(2, 0.01, restitution, contact_time=0.0, diameter=0.5)
    box, normal, u = (8.0, 8.0), np.array(normal), 2.0
    position, velocity = 4.0 + np.outer([-1.0, 1.0], normal), np.outer([u / 2, -u / 2], normal) + np.array([0.3, 0.1])
    engine = Engine(scene, at_rest(position, velocity, box))
    engine.advance(np.inf, most_collisions=1)
    tally = engine.take_tally()
    assert engine.time == pytest.approx((2.0 - 0.5) / u)
    np.testing.assert_allclose(tally.stress, -(1 + restitution) / 2 * u * 0.5 * np.outer(normal, normal), atol=1e-13)
    assert tally.loss == pytest.approx((1 - restitution**2) / 4 * u**2, abs=1e-13)


def test_looking_changes_nothing():
    """A run that is looked at ten thousand times ends as one that is not, bit for bit."""
    scene = Scene(1435, 0.25, restitution=0.8, contact_time=1e-5)
    watched, alone = started(scene), started(scene)
    for stop in np.linspace(0.0, 0.5, 10_001)[1:]:
        watched.advance(stop)
        watched.take_tally()
    alone.advance(0.5)
    np.testing.assert_array_equal(watched.state().position, alone.state().position)
    np.testing.assert_array_equal(watched.state().velocity, alone.state().velocity)
    assert watched.collisions == alone.collisions


@pytest.mark.parametrize("gap", [1e-3, 3e-13, -3e-13, -1e-3])
@pytest.mark.parametrize("place", [(0.5, 0.5), (0.0, 0.5), (0.5, 0.0), (0.0, 0.0)], ids=str)
def test_the_gap_is_seen_across_every_edge(gap, place):
    """Two disks in a box of 1000 diameters, in its middle and across its edges; they lie along (3, 4)/5."""
    scene = Scene(n_particles=2, diameter=1.0, restitution=1.0, contact_time=0.0)
    box = (1024.0, 1024.0)
    engine = Engine(scene, at_rest(np.array(place) * box + np.zeros((2, 2)), np.zeros((2, 2)), box))
    disks, grid = engine.arrays["disks"], engine.arrays["grid"]
    cells, width = grid["cells"][0, 0], grid["width"][0, 0]
    middle = np.array(place) * cells
    for k, side in enumerate((-1, 1)):
        from_edge = side * (1 + gap) / 2 * np.array([0.6, 0.8])
        inside = np.floor(middle + side * 0.25).astype(int)
        disks["x"][k] = from_edge + (middle - inside - 0.5) * width
        disks["cell"][k] = inside % cells
    assert smallest_gap(engine) == pytest.approx(gap, abs=1e-14)

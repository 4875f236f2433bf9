"""Random scenes: whatever is allowed neither hangs nor crashes, and breaks no law; what is not allowed is refused in words."""

import math
from collections import Counter
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import pytest
from gaps import TOLERATED, smallest_gap
from hypothesis import HealthCheck, given, seed, settings
from hypothesis import strategies as st

from granugas.analysis.observables import kinetic_energy
from granugas.dynamics.events import loop
from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import at_rest
from granugas.initial import Lattice, sites, start_lattice
from granugas.scene import Scene, SceneError

pytestmark = pytest.mark.timeout(600, method="thread")  # a signal would wait for the compiled code to return

SEED = 1998
LOOKS = 4
MOST_EVENTS = 500
"""Events of a disk between two looks; a dilute one crosses a hundred cells from collision to collision."""

STANDSTILL = 50
"""Collisions, by the number of disks, in which time must go on where a collapse is possible, or the collapse be named."""

ROUNDING = 1.0e-12
"""Of momentum and energy, by their sums of magnitudes."""


@dataclass(frozen=True)
class Case:
    """A scene, and what its start state is drawn from.

    Attributes:
        speeds: the fastest in m/s, and how many orders of magnitude below it the slowest is.
        shaken: how far disks leave their sites, in parts of the room that they have.
        drift: velocity of all, in parts of the fastest.
        collisions: of a disk.
    """

    scene: Scene
    speeds: tuple[float, float]
    shaken: float
    drift: float
    collisions: int
    numbers: int


def power(low: float, high: float) -> st.SearchStrategy[float]:
    """Powers of ten, uniform in the exponent."""
    return st.floats(low, high).map(lambda k: 10.0**k)


@st.composite
def cases(draw: st.DrawFn) -> Case:
    values = {
        "n_particles": draw(st.integers(2, 300)),
        "area_fraction": draw(st.floats(0.001, 0.88) | power(-3, math.log10(0.88))),
        "restitution": draw(st.sampled_from([0.0, 1.0]) | st.floats(0, 1) | power(-6, 0) | power(-6, 0).map(lambda x: 1 - x)),
        "contact_time": draw(st.just(0.0) | power(-14, -1)),
        "aspect_ratio": draw(power(0, math.log10(20)) | power(-math.log10(20), 0)),
        "lattice": draw(st.sampled_from(["auto", "auto", "auto", "triangular", "square"])),
    }
    return Case(
        scene=Scene(**values),
        speeds=(draw(power(-12, 0)), draw(st.floats(0, 12))),
        shaken=draw(st.floats(0, 1)),
        drift=draw(st.just(0.0) | st.floats(-1, 1)),
        collisions=draw(st.integers(3, 10)),
        numbers=draw(st.integers(0, 2**32 - 1)),
    )


def started(case: Case, lattice: Lattice) -> Engine:
    rng, n = np.random.default_rng(case.numbers), case.scene.n_particles
    position = sites(lattice, n, rng)
    room = (lattice.spacing - case.scene.diameter) / math.sqrt(8)  # of one disk along an axis: half of it along any line
    position += case.shaken * (1 - 1e-6) * room * rng.uniform(-1, 1, (n, 2))
    fastest, orders = case.speeds
    speed, angle = fastest * 10.0 ** -rng.uniform(0, orders, n), rng.uniform(0, 2 * np.pi, n)
    velocity = speed[:, np.newaxis] * np.stack([np.cos(angle), np.sin(angle)], axis=1) + case.drift * fastest
    return Engine(case.scene, at_rest(np.mod(position, lattice.box), velocity, lattice.box))


def clock(engine: Engine) -> Fraction:
    """The time as the engine knows it: the sum of its three parts, without rounding."""
    calendar = engine.arrays["calendar"]
    return sum(Fraction(float(calendar[part][0])) for part in ("base", "base_low", "now"))


def energy(velocity: np.ndarray) -> float:
    return float(kinetic_energy(velocity).sum())


def outcome(case: Case) -> tuple[str, int, float]:
    """How it ended, after how many collisions, and the smallest gap that was seen (d).

    Every look finds a gas without overlap whose time went on, that has the momentum of the start, and has lost as much
    energy as its tally says. A collapse is named within STANDSTILL collisions of a disk, or time goes on.
    """
    try:
        lattice = start_lattice(case.scene)
    except SceneError as error:
        assert error.key in ("area_fraction", "n_particles")
        assert "fit on a lattice" in error.allowed or "holds" in error.allowed
        return "refused", 0, math.inf
    engine, n = started(case, lattice), case.scene.n_particles
    velocity = engine.state().velocity
    momentum, at_first, before = velocity.sum(axis=0), energy(velocity), energy(velocity)
    magnitude, now, gap = np.abs(velocity).sum(), clock(engine), smallest_gap(engine)
    looks = [math.ceil(case.collisions * n / 2 / LOOKS)] * LOOKS
    if case.scene.restitution < 1 and case.scene.contact_time == 0:
        looks += [STANDSTILL * n] * 2
    for collisions in looks:
        why = engine.advance(math.inf, collisions, MOST_EVENTS * n)
        velocity, tally = engine.state().velocity, engine.take_tally()
        gap = min(gap, smallest_gap(engine))
        assert gap >= -TOLERATED
        assert engine.backwards == 0
        must_go_on = why == loop.EVENTS or (why == loop.COLLISIONS and collisions == STANDSTILL * n)
        assert clock(engine) > now if must_go_on else clock(engine) >= now
        assert np.abs(velocity.sum(axis=0) - momentum).max() <= ROUNDING * magnitude
        after = energy(velocity)
        assert abs(before - after - tally.loss) <= ROUNDING * before
        assert after <= before * (1 + ROUNDING)
        now, before = clock(engine), after
        if why != loop.COLLISIONS:
            break
    if case.scene.restitution == 1:
        assert after == pytest.approx(at_first, rel=ROUNDING)
    if why == loop.WATCH:
        assert case.scene.restitution < 1 and case.scene.contact_time == 0
        assert len(engine.involved()) >= 2
        return "collapse named", engine.collisions, gap
    if why == loop.EVENTS:
        return "hardly any collisions left", engine.collisions, gap
    return ("all collisions" if why == loop.COLLISIONS else "no event left"), engine.collisions, gap


@pytest.mark.parametrize(
    "examples",
    [500, pytest.param(10_000, marks=[pytest.mark.full, pytest.mark.timeout(3600, method="thread")])],
)
def test_random_scenes(examples, record_property):
    ends, collisions, gaps = Counter(), [], []

    @seed(SEED)
    @settings(max_examples=examples, deadline=None, database=None, suppress_health_check=list(HealthCheck), print_blob=True)
    @given(cases())
    def check(case: Case) -> None:
        end, done, gap = outcome(case)
        ends[end] += 1
        collisions.append(done)
        gaps.append(gap)

    check()
    found = {"scenes": len(gaps), "seed": SEED, **ends, "collisions": sum(collisions), "smallest gap (d)": min(gaps)}
    for name, value in found.items():
        record_property(name, value)
    print(*(f"{name}: {value}" for name, value in found.items()), sep=", ")
    assert sum(ends.values()) >= examples
    assert ends["all collisions"] > 0.3 * examples
    assert min(ends["collapse named"], ends["refused"]) > 0.05 * examples

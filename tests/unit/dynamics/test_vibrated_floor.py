"""A floor in motion: where it is, and when it is met."""

import math
from fractions import Fraction

import numpy as np
import pytest
from numba import njit

from granugas.dynamics.events.boundary import climb, lands_after
from granugas.dynamics.events.effects.gravity import Gravity
from granugas.dynamics.events.effects.vibrated_floor import SUMS, Harmonic, Sawtooth
from granugas.dynamics.events.flight import Straight
from granugas.dynamics.events.memory import Record
from granugas.dynamics.events.state import EFFECTS, Gas, bundle
from granugas.dynamics.events.tables import tables_of
from granugas.equilibrate import at_rest

KINDS = {"harmonic": Harmonic, "sawtooth": Sawtooth}
NEVER = math.inf


@njit
def lands(gas, y, v, now, longest):
    """From Python."""
    return lands_after(gas.floor, gas, y, v, now, longest)


@njit
def climbs(gas, now):
    """From Python."""
    return climb(gas.floor, gas, now)


KEPT = []


def on_a_floor(kind: str, amplitude: float, frequency: float, g: float, base: float = 0.0) -> Gas:
    """A gas of which only the floor, the force and the clock count."""
    tables = tables_of(at_rest(np.ones((1, 2)), np.ones((1, 2)), (3.0, 3.0)), 1.0)
    tables["calendar"]["base"] = base
    KEPT.append(tables)
    effects = dict.fromkeys(EFFECTS, Straight())
    effects |= {
        "floor": KINDS[kind](amplitude, frequency, Record(np.zeros(1, SUMS))),
        "force": Gravity((0.0, -g)) if g else Straight(),
    }
    return bundle(tables, effects)


def floor_at(kind, amplitude, turns):
    """Its height."""
    return amplitude * (1 - np.cos(2 * np.pi * turns)) if kind == "harmonic" else 2 * amplitude * (turns % 1.0)


def first_look_below(kind, amplitude, f, g, y, v, now):
    """By looking often, from a little later than now on."""
    t = np.concatenate([np.geomspace(1e-7, 1e-3, 2000), np.linspace(1e-3, 5.0, 250_001)])
    below = y + v * t - g * t * t / 2 < floor_at(kind, amplitude, f * (now + t))
    k = int(np.argmax(below))
    return t[k] if below[k] else NEVER


@pytest.mark.parametrize("g", [0.0, 10.0])
@pytest.mark.parametrize("kind", KINDS)
def test_the_floor_is_met_where_one_sees_it_met(kind, g):
    rng = np.random.default_rng(1)
    met = 0
    for gamma in (0.3, 0.99, 1.01, 3.0, 30.0):
        f = rng.uniform(0.5, 3.0)
        amplitude = gamma * 10.0 / (2 * np.pi * f) ** 2
        gas = on_a_floor(kind, amplitude, f, g)
        for _ in range(8):
            now = rng.uniform(0.0, 1 / f)
            y = floor_at(kind, amplitude, f * now) + rng.choice([1e-3, 0.1, 1.0, 5.0]) * rng.uniform() * amplitude
            v = rng.normal(0.0, 3.0) * max(amplitude * f, 0.1)
            seen, found = first_look_below(kind, amplitude, f, g, y, v, now), lands(gas, y, v, now, 5.0)
            assert found == NEVER or found <= 5.0 + 1e-12
            if seen < 5.0 - 1e-4:
                assert found == pytest.approx(seen, abs=3e-5)
                met += 1
            elif seen == NEVER:
                assert found == NEVER
    assert met > 16


@pytest.mark.parametrize("hop", [1e-9, 1e-6, 1e-3])
def test_a_hop_from_the_harmonic_floor_ends_on_it(hop):
    """Short flights are parabolas over a floor that is accelerated itself: t = 2 u / (g + floor's acceleration)."""
    f, amplitude, g, now = 2.0, 0.05, 10.0, 0.03
    omega = 2 * np.pi * f
    y, speed = amplitude * (1 - math.cos(omega * now)), amplitude * omega * math.sin(omega * now)
    expected = 2 * hop / (g + amplitude * omega**2 * math.cos(omega * now))
    found = lands(on_a_floor("harmonic", amplitude, f, g), y, speed + hop, now, 1.0)
    assert found == pytest.approx(expected, rel=max(hop, 1e-15 / hop))


@pytest.mark.parametrize("kind", KINDS)
def test_who_is_in_touch_and_comes_nearer_is_there(kind):
    gas = on_a_floor(kind, 0.1, 1.0, 10.0)
    assert lands(gas, floor_at(kind, 0.1, 0.3), -1.0, 0.3, 1.0) == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize("base", [0.1, 12345.678, 1e6 / 3])
def test_the_phase_is_exact_however_long_the_run(base):
    """cos and sin of the exact number of turns, by rational arithmetic."""
    f, amplitude, now = 61.7, 0.01, 0.0123
    gas = on_a_floor("harmonic", amplitude, f, 10.0, base)
    turns = (Fraction(f) * (Fraction(base) + Fraction(now))) % 1
    expected = amplitude * 2 * math.pi * f * math.sin(2 * math.pi * float(turns))
    assert climbs(gas, now) == pytest.approx(expected, abs=1e-13)


def test_the_sawtooth_climbs_steadily():
    assert climbs(on_a_floor("sawtooth", 0.25, 4.0, 10.0), 0.3) == 2.0

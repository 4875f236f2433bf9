"""A floor that moves up and down, and is met at the exact time.

Harmonic: A - A cos(2 pi f t). Sawtooth: a steady rise from 0 to 2 A, then a drop in no time, f times a second. Both begin at
their lowest place, where a floor without motion is.
Between two inflections of the distance from a particle to a harmonic floor, which are known in closed form, the distance has at
most one minimum; so the first time at which it is zero is bracketed, and found without any step in time. The phase of the floor
is known to its last digits however long the run.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from granugas.dynamics.events.boundary import climb, lands_after, peak, raised
from granugas.dynamics.events.composition import implements, inline
from granugas.dynamics.events.flight import leaves_interval, pull
from granugas.dynamics.events.memory import Record
from granugas.dynamics.state import State
from granugas.scene import Scene

SUMS = np.dtype([("work", "f8"), ("lost", "f8")])
"""Energy (m d^2/s^2) that the floor has given to the particles, and energy that they have dissipated, since t = 0."""

FAR = 1.0e300
"""Higher than anything (d)."""

TURN = 2.0 * math.pi

SPLIT = 2.0**27 + 1.0
"""Cuts a double into halves whose products are exact (Dekker)."""

ENOUGH = 200
"""Steps of a bracketed root: halving alone would need a quarter of them."""


class Harmonic(NamedTuple):
    """A (d), f (1/s) and the SUMS."""

    amplitude: float
    frequency: float
    sums: Record

    def observe(self, scene: Scene, state: State, tally: Any, interval: float) -> dict[str, float]:
        """Energy that has come and gone since t = 0."""
        return _energies(self.sums.rows, scene, tally)


class Sawtooth(NamedTuple):
    """A (d), f (1/s) and the SUMS."""

    amplitude: float
    frequency: float
    sums: Record

    def observe(self, scene: Scene, state: State, tally: Any, interval: float) -> dict[str, float]:
        """Energy that has come and gone since t = 0."""
        return _energies(self.sums.rows, scene, tally)


def effect_of(scene: Scene, state: State) -> Harmonic | Sawtooth:
    """The floor of a scene."""
    kind = {"harmonic": Harmonic, "sawtooth": Sawtooth}[scene.floor]
    return kind(scene.floor_amplitude / scene.diameter, float(scene.floor_frequency), Record(np.zeros(1, SUMS)))


def _energies(sums: np.ndarray, scene: Scene, tally: Any) -> dict[str, float]:
    unit = scene.n_particles * scene.energy_per_mass / scene.diameter**2
    if tally is not None:  # kicks count as a negative loss
        sums["lost"] += (tally.loss + tally.more.get("energy_input", 0.0)) / scene.diameter**2
    return {"floor_energy": float(sums["work"][0] / unit), "dissipated_energy": float(sums["lost"][0] / unit)}


@implements(peak, Harmonic)
@implements(peak, Sawtooth)
def _peak(floor):
    return 2.0 * floor.amplitude


@implements(raised, Harmonic)
@implements(raised, Sawtooth)
def _raised(floor, work):
    floor.sums.work += work


@inline
def _turns(floor, gas, now):
    """Periods since t = 0, without the whole ones: the product with the origin of times, which may be large, is exact."""
    f, base = floor.frequency, gas.calendar.base
    whole = f * base
    f_high, base_high = SPLIT * f - (SPLIT * f - f), SPLIT * base - (SPLIT * base - base)
    f_low, base_low = f - f_high, base - base_high
    missing = ((f_high * base_high - whole) + f_high * base_low + f_low * base_high) + f_low * base_low
    turns = (whole - math.floor(whole)) + (missing + f * (gas.calendar.base_low + now))
    return turns - math.floor(turns)


@inline
def _descends_after(floor, gas, y, v):
    """How long until what is y above the floor's lowest place is no higher than the floor ever is."""
    if y <= 2.0 * floor.amplitude:
        return 0.0
    return leaves_interval(gas.force, len(gas.grid.half) - 1, y, v, 2.0 * floor.amplitude, FAR)[0]


# --- harmonic -------------------------------------------------------------------------------------------------------------


@inline
def _phase(floor, gas, now):
    """The floor is at A + A sin(phase)."""
    return TURN * (_turns(floor, gas, now) - 0.25)


@implements(climb, Harmonic)
def _climb(floor, gas, now):
    return TURN * floor.frequency * floor.amplitude * math.cos(_phase(floor, gas, now))


@implements(lands_after, Harmonic)
def _lands_after(floor, gas, y, v, now, longest):
    start = _descends_after(floor, gas, y, v)
    if start >= longest:
        return math.inf
    a, amplitude, omega = pull(gas.force, len(gas.grid.half) - 1), floor.amplitude, TURN * floor.frequency
    phase = _phase(floor, gas, now + start)
    gap = y + start * (v + 0.5 * a * start) - amplitude - amplitude * math.sin(phase)
    u = v + a * start - amplitude * omega * math.cos(phase)
    if gap <= 0.0 and u <= 0.0:
        return start
    gap = max(gap, 0.0)
    return start + _first_zero((gap, u, a, amplitude, omega, phase), longest - start)


@inline
def _first_zero(m, longest):
    """The first time > 0 at which the distance of a meeting m is zero; infinite if there is none up to `longest`."""
    gap, u, a, amplitude, omega, phase = m
    sharpest = amplitude * omega * omega
    inflection = math.asin(min(-a / sharpest, 1.0))
    bent_up = math.pi - 2.0 * inflection  # phases of which the distance is convex; none for Gamma <= 1
    beyond = (phase - inflection) % TURN
    convex = beyond < bent_up
    begin = 0.0
    end = (bent_up - beyond if convex else TURN - beyond) / omega
    while begin < longest:
        if bent_up <= 0.0:
            end = longest
        end = min(end, longest)
        low, high = begin, end
        if convex and _parting(m, end) > 0.0:
            high = _turning_point(m, begin, end) if _parting(m, begin) < 0.0 else begin
        if high > begin and _distance(m, high) < 0.0:
            if begin == 0.0 and gap == 0.0:
                low = min(2.0 * u / (sharpest - a), high)  # it cannot be back before
            return _zero(m, low, high)
        begin, convex = end, not convex
        end = begin + (bent_up if convex else TURN - bent_up) / omega
    return math.inf


@inline
def _distance(m, t):
    """From the floor after the time t, with the motion of the floor expanded around its tangent at t = 0."""
    gap, u, a, amplitude, omega, phase = m
    half, angle = math.sin(0.5 * omega * t), omega * t
    curved = math.cos(phase) * _sine_from_its_tangent(angle) - 2.0 * math.sin(phase) * half * half
    return gap + t * (u + 0.5 * a * t) - amplitude * curved


@inline
def _sine_from_its_tangent(x):
    """sin(x) - x."""
    if abs(x) > 0.3:
        return math.sin(x) - x
    y = x * x
    return -x * y / 6.0 * (1.0 - y / 20.0 * (1.0 - y / 42.0 * (1.0 - y / 72.0 * (1.0 - y / 110.0))))


@inline
def _parting(m, t):
    """How fast the distance grows then."""
    _, u, a, amplitude, omega, phase = m
    half = 0.5 * omega * t
    return u + a * t + 2.0 * amplitude * omega * math.sin(half) * math.sin(phase + half)


@inline
def _turning_point(m, low, high):
    """Where the distance is least: it falls at `low`, grows at `high`, and is convex in between."""
    for _ in range(ENOUGH):
        middle = 0.5 * (low + high)
        if middle <= low or middle >= high:
            break
        if _parting(m, middle) < 0.0:
            low = middle
        else:
            high = middle
    return high


@inline
def _zero(m, low, high):
    """The one zero between a distance that is not negative at `low` and negative at `high`: Newton's steps, in the bracket."""
    t = high
    for _ in range(ENOUGH):
        value, slope = _distance(m, t), _parting(m, t)
        if value >= 0.0:
            low = t
        else:
            high = t
        middle = 0.5 * (low + high)
        step = value / slope if slope < 0.0 else math.inf
        if abs(step) <= 1.0e-16 * t or middle <= low or middle >= high:
            break
        t = t - step if low < t - step < high else middle
    return t


# --- sawtooth -------------------------------------------------------------------------------------------------------------


@implements(climb, Sawtooth)
def _climb_steadily(floor, gas, now):
    return 2.0 * floor.amplitude * floor.frequency


@implements(lands_after, Sawtooth)
def _lands_on_a_ramp(floor, gas, y, v, now, longest):
    last = len(gas.grid.half) - 1
    t, a, amplitude, f = _descends_after(floor, gas, y, v), pull(gas.force, last), floor.amplitude, floor.frequency
    if t >= longest:
        return math.inf
    risen = _turns(floor, gas, now + t)
    while t < longest:
        gap, u = y + t * (v + 0.5 * a * t) - 2.0 * amplitude * risen, v + a * t - 2.0 * amplitude * f
        if gap <= 0.0 and u <= 0.0:
            return t
        delay, away = leaves_interval(gas.force, last, max(gap, 0.0), u, 0.0, FAR)
        left = (1.0 - risen) / f
        if delay <= left and not away:
            return t + delay
        t, risen = t + left, 0.0
    return math.inf

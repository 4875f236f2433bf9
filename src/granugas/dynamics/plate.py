"""One ball on a plate under gravity, event by event (A section 4.2): exact parabolas, and hits by the rules of the engine.

Height h of the ball above the plate, velocity v upwards, all energies and forces per mass m. The ball carries the time
since its last hit along, as the disks of a gas do; A Eq. 4 asks for nothing else.
"""

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from granugas.dynamics.events.collisions import restitution
from granugas.dynamics.events.memory import Record
from granugas.dynamics.events.state import layouts

Numbers = NDArray[np.float64]

HITS, COLLAPSE, ESCAPE = "hits", "collapse", "escape"
"""Why a run ended: so many hits were asked for; flights got too short for the clock; the ball never comes down."""


class Ball(NamedTuple):
    """Height h (m), velocity v (m/s), and the time since the last hit (s); infinite before the first one."""

    h: float
    v: float
    since: float = math.inf


class Plate(NamedTuple):
    """Gravity g (m/s^2), and the sums that the rules of a gas write to."""

    g: float
    tally: Record


class Hit(NamedTuple):
    """Length of the flight before (s), speeds before and after (m/s), time since the last hit (s), whether A Eq. 4 made it
    elastic."""

    flight: float
    before: float
    after: float
    since: float
    elastic: bool


@dataclass(frozen=True)
class Bounces:
    """The hits of a run, and the flight that follows each of them.

    Attributes:
        g: gravity (m/s^2).
        time: (n,) of the hits since the run began (s).
        before, after: (n,) speeds before and after them (m/s).
        since: (n,) time since the hit before (s).
        elastic: (n,) whether A Eq. 4 made them elastic.
        stop: HITS, COLLAPSE or ESCAPE.
    """

    g: float
    time: Numbers
    before: Numbers
    after: Numbers
    since: Numbers
    elastic: NDArray[np.bool_]
    stop: str


class Averages(NamedTuple):
    """Averages over a window (A Eq. 11): <v>, <v^2>, <v^2> of the time within t_c of a hit, <h>, momentum to the plate."""

    v: float
    v2: float
    v2_elastic: float
    h: float
    force: float


def plate(g: float) -> Plate:
    """A plate that nothing has hit yet."""
    return Plate(g, Record(np.zeros(1, layouts(1)["tally"])))


def time_to_hit(ball: Ball, g: float) -> float:
    """Time until the ball touches the plate (s), infinite if it never does; a ball on the plate that moves up leaves it."""
    speed = math.sqrt(ball.v**2 + 2 * g * ball.h)
    if ball.v < 0:
        return 2 * ball.h / (speed - ball.v)
    return (speed + ball.v) / g if g > 0 else math.inf


def next_hit(rule: Any, ball: Ball, plate: Plate) -> Hit | None:
    """The next hit, with the coefficient that the rule gives (A Eq. 4); None if there is none."""
    flight = time_to_hit(ball, plate.g)
    if flight == math.inf:
        return None
    before, since = math.sqrt(ball.v**2 + 2 * plate.g * ball.h), ball.since + flight
    counted = plate.tally.elastic
    r = restitution(rule, plate, 0, 0, -before, since)
    return Hit(flight, before, r * before, since, bool(plate.tally.elastic > counted))


def bounce(rule: Any, ball: Ball, g: float, most_hits: int) -> Bounces:
    """Follow a ball from hit to hit.

    In the convention of A Eq. 5, v_1 is the speed before the first hit: `Ball(0.0, -v_1)` begins with it at time 0.

    Args:
        rule: an effect of the engine that answers `restitution`.
        ball: at time 0.
        g: gravity (m/s^2), >= 0.
        most_hits: after which the run ends. It ends before, with COLLAPSE, when a flight no longer advances the clock.
    """
    here, time, times, hits, stop = plate(g), 0.0, [], [], HITS
    while len(hits) < most_hits:
        hit = next_hit(rule, ball, here)
        if hit is None or (hits and time + hit.flight == time):
            stop = ESCAPE if hit is None else COLLAPSE
            break
        time, ball = time + hit.flight, Ball(0.0, hit.after, 0.0)
        times.append(time)
        hits.append(hit)
    columns = np.array(hits, dtype=float).reshape(-1, len(Hit._fields)).T
    _, before, after, since, elastic = columns
    return Bounces(g, np.array(times), before, after, since, elastic.astype(bool), stop)


def state_at(bounces: Bounces, time: ArrayLike) -> tuple[Numbers, Numbers]:
    """Height (m) and velocity (m/s) at any times (s); NaN before the first hit and after the last flight.

    The flight after the last hit of a collapse is none: the model has no state from there on.
    """
    time = np.asarray(time, dtype=float)
    begin, end = bounces.time, _ends(bounces)
    k = np.clip(np.searchsorted(begin, time, side="right") - 1, 0, None)
    s = np.where((time >= begin[k]) & (time <= end[k]), time - begin[k], np.nan)
    v = bounces.after[k] - bounces.g * s
    return (bounces.after[k] + v) / 2 * s, v


def averages(bounces: Bounces, end: float, length: float, contact_time: float) -> Averages:
    """Averages over the window from `end - length` to `end` (A Eq. 11), the parabolas integrated exactly.

    Args:
        bounces: of a run with gravity.
        end: of the window (s).
        length: of the window (s).
        contact_time: t_c (s); energy within that time of a hit is elastic (A section 4.1).

    Raises:
        ValueError: a window that reaches beyond the flights of the run.
    """
    begin, ends = bounces.time, _ends(bounces)
    if not (length > 0 and begin[0] <= end - length and end <= ends[-1]):
        raise ValueError(f"window of {length} s up to {end} s: the run has no state in all of it")
    first, last = (np.clip(t, begin, ends) - begin for t in (end - length, end))
    v2, v2_elastic, h = (
        np.sum(integral(bounces.after, bounces.g, np.minimum(last, most)) - integral(bounces.after, bounces.g, first))
        for integral, most in ((_square, np.inf), (_square, np.maximum(contact_time, first)), (_height, np.inf))
    )
    way = np.sum(_way(bounces.after, bounces.g, last) - _way(bounces.after, bounces.g, first))
    hit = (begin > end - length) & (begin <= end)
    momentum = np.sum(bounces.before[hit] + bounces.after[hit])
    return Averages(*(float(total / length) for total in (way, v2, v2_elastic, h, momentum)))


def _ends(bounces: Bounces) -> Numbers:
    """End of the flight after each hit (s)."""
    last = 0.0 if bounces.stop == COLLAPSE else time_to_hit(Ball(0.0, float(bounces.after[-1])), bounces.g)
    return np.append(bounces.time[1:], bounces.time[-1] + last)


def _way(v: Numbers, g: float, s: Numbers) -> Numbers:
    """Integral of the velocity over the first s seconds of flights that begin with v."""
    return s * (v - g * s / 2)


def _square(v: Numbers, g: float, s: Numbers) -> Numbers:
    """The same of its square."""
    return s * (v**2 - g * s * (v - g * s / 3))


def _height(v: Numbers, g: float, s: Numbers) -> Numbers:
    """The same of the height."""
    return s**2 * (v / 2 - g * s / 6)

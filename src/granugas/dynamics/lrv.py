"""The LRV model of beads in one dimension (A section 3.i): slow contacts merge, and an impact runs through a cluster.

Beads that touch with no relative velocity are a cluster. An impact on it is passed on at one instant, contact by contact, in
the order of the largest relative velocity (LRV): the contact at which beads approach fastest is next. If it is as fast as the
threshold, its two beads collide (A Eq. 2), which may open contacts beside it; if it is slower, all that hangs together on
either side goes on with the common velocity. No energy is ever gained, a collision takes a finite part of a finite energy, and
there are finitely many contacts to merge: an impact comes to an end, and no collapse is possible. At threshold 0 beads collide
as hard ones do.

The gaps are what is followed, not the positions: a gap of 0 is exactly 0, and stays. Walls are beads of infinite mass at rest.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from granugas.dynamics.events.engine import Tally
from granugas.dynamics.events.loop import COLLISIONS, EVENTS, TIME
from granugas.dynamics.state import State
from granugas.scene import Scene

PERIODIC, WALLS, FREE = "periodic", "wall", "free"
"""How a row of beads ends: in itself, at walls, or nowhere."""

TOUCH = 1.0e-12
"""Beads of exactly one velocity with a gap below it, by the box, are a cluster of which a state has the positions."""

CHANGING = ("now", "first", "v", "gap", "last", "interval", "counts", "collisions", "merged", "loss", "loss_time")
"""What of a row changes: see _Row."""


@dataclass(frozen=True)
class Contact:
    """What happens at a contact.

    Attributes:
        restitution: r of fast contacts, in [0, 1]; walls have the same.
        threshold: velocity below which contacts merge (m/s); 0: hard beads, which may collapse.
        boundary: PERIODIC, WALLS or FREE.
    """

    restitution: float
    threshold: float
    boundary: str = PERIODIC


@dataclass(frozen=True)
class Passage:
    """What happened between two states.

    Attributes:
        state: at the end.
        collisions: fast contacts, of pairs, walls among them.
        merged: slow contacts.
        loss: dissipated energy per mass (m^2/s^2).
    """

    state: State
    collisions: int
    merged: int
    loss: float


def advance(state: State, until: float, diameter: float, contact: Contact, most_impacts: float = math.inf) -> Passage:
    """Follow beads up to a time, or for so many impacts, each of which may be many contacts at one instant.

    Args:
        state: beads in one dimension, which neither overlap nor overtake; with FREE ends the box bounds nothing.
        until: in s; infinite: until nobody meets anybody any more.
        diameter: of the beads (m).
        contact: the model.
        most_impacts: after which it ends, if that comes first.
    """
    row, impacts = _Row(state, diameter, contact), 0
    while impacts < most_impacts and row.meets(until):
        impacts += 1
    if impacts < most_impacts and until < math.inf:
        row.move(until - row.now)
    return Passage(row.state(row.now), row.collisions, row.merged, row.loss)


class Beads:
    """The model as the dynamics of a scene (granugas.dynamics.Dynamics): beads on a ring.

    Slow contacts count as collisions. An impact is carried out as a whole, so that a number of collisions may be exceeded.
    """

    def __init__(self, scene: Scene, state: State) -> None:
        """Begin with a state."""
        self.scene, self.time = scene, state.time
        self._row = _Row(state, scene.diameter, Contact(scene.restitution, scene.lrv_velocity))
        self._taken = 0

    @property
    def collisions(self) -> int:
        """Contacts since it was made, fast and slow."""
        return int(self._row.collisions + self._row.merged)

    @property
    def cells(self) -> tuple[int]:
        """As many as contacts: a bead meets the two beside it."""
        return (self.scene.n_particles,)

    @property
    def arrays(self) -> dict[str, np.ndarray]:
        """A copy of the whole state."""
        kept = {name: np.array(getattr(self._row, name)) for name in CHANGING}
        return kept | {"time": np.array(self.time), "taken": np.array(self._taken)}

    @property
    def bytes_per_particle(self) -> float:
        """Memory of the state."""
        return sum(rows.nbytes for rows in self.arrays.values()) / self.scene.n_particles

    def restore(self, arrays: Mapping[str, np.ndarray]) -> None:
        """Continue from the `arrays` of the same scene as if nothing had happened in between."""
        for name in CHANGING:
            setattr(self._row, name, arrays[name].copy()[()])  # numbers are arrays without a dimension
        self.time, self._taken = float(arrays["time"]), int(arrays["taken"])

    def advance(self, until: float, most_collisions: int = 2**62, most_events: int = 2**62) -> int:
        """Carry out all impacts up to the time `until` (s), or the first so many; returns why it stopped (events/loop.py).

        An impact costs about what an event of every bead does, as all gaps are looked at.
        """
        last = self.collisions + most_collisions
        while self.collisions < last:
            if most_events <= 0:
                return EVENTS
            if not self._row.meets(until):
                self.time = max(self.time, until) if until < math.inf else self.time
                return TIME
            self.time = self._row.now
            most_events -= self.scene.n_particles
        return COLLISIONS

    def state(self) -> State:
        """Every bead at the present time."""
        return self._row.state(self.time)

    def take_tally(self) -> Tally:
        """The sums over all collisions since the tally was last taken. In impacts through clusters stress is not defined."""
        row, done = self._row, self.collisions
        taken = Tally(
            collisions=done - self._taken,
            elastic=np.zeros(len(self.scene.contact_times), np.int64),
            loss=float(row.loss),
            loss_time=float(row.loss * self.time - row.loss_time),
            stress=np.full((1, 1), np.nan),
        )
        self._taken, row.loss, row.loss_time = done, 0.0, 0.0
        return taken

    def observe(self, state: State, tally: Tally | None = None, interval: float = 0.0) -> dict[str, float]:
        """Nothing beside what every scene is asked."""
        return {}

    def involved(self) -> np.ndarray:
        """Nobody: there is no collapse."""
        return np.empty(0, np.int64)


class _Row:
    """Beads from left to right, between walls if there are any; contact k is that of bead k with the next one.

    Attributes:
        now: time of the last impact, or up to which all have been let fly (s).
        first: position of the first bead (m), not taken back into the box.
        v, gap: velocity of each bead (m/s), and the gap at each contact (m).
        last, interval, counts: as State has them, for each bead.
        collisions, merged, loss: as Passage has them; loss_time: sum of the losses times when they were (m^2/s).
    """

    def __init__(self, state: State, diameter: float, contact: Contact) -> None:
        self.now, self.collisions, self.merged, self.loss, self.loss_time = state.time, 0, 0, 0.0, 0.0
        self._start, self._diameter, self._contact = state, diameter, contact
        self._ring, walled = contact.boundary == PERIODIC, contact.boundary == WALLS
        self._order, (box,) = np.argsort(state.position[:, 0], kind="stable"), state.box
        self._beads = slice(1, -1) if walled else slice(None)

        def in_a_row(values: np.ndarray, left: float, right: float) -> np.ndarray:
            return np.concatenate([[left], values[self._order], [right]]) if walled else values[self._order]

        place = in_a_row(state.position[:, 0], -diameter / 2, box + diameter / 2)
        self.v, self._mass = in_a_row(state.velocity[:, 0], 0.0, 0.0), in_a_row(np.ones(len(self._order)), math.inf, math.inf)
        self.last = in_a_row(state.last_collision_time, self.now, self.now)
        self.interval = in_a_row(state.last_collision_interval, 0.0, 0.0)
        self.counts = in_a_row(state.collisions, 0, 0)
        self.first = place[0]
        self.gap = np.maximum(np.diff(place, append=[place[0] + box] if self._ring else []) - diameter, 0.0)
        self.gap[(self.gap < TOUCH * box) & (self._approach() == 0)] = 0.0

    def state(self, time: float) -> State:
        """The beads, by their numbers, at a time (s) up to which nobody meets anybody any more."""
        right = np.cumsum(self._gap_after(time - self.now) + self._diameter)
        place = self.first + self.v[0] * (time - self.now) + np.concatenate([[0.0], right[:-1] if self._ring else right])
        if self._ring:
            place = np.mod(place, self._start.box[0])
            place[place >= self._start.box[0]] = 0.0  # what is left of a tiny negative number
        rows = (place, self.v, self.last, self.interval, self.counts)
        place, velocity, last, interval, counts = (values[self._beads][np.argsort(self._order)] for values in rows)
        position, velocity = place[:, np.newaxis], velocity[:, np.newaxis]
        return replace(
            self._start,
            time=time,
            position=position,
            velocity=velocity,
            last_collision_time=last,
            last_collision_interval=interval,
            collisions=counts,
        )

    def meets(self, until: float) -> bool:
        """Carry out the next impact, if there is one up to a time (s)."""
        k, delay = self._next_impact()
        if delay == math.inf or self.now + delay > until:
            return False
        self.move(delay)
        self._run_through(k)
        return True

    def _next_impact(self) -> tuple[int, float]:
        """The contact that closes first, and how long until then (s); infinite if none does."""
        approach = self._approach()
        closing = approach > 0
        delay = np.full(len(approach), math.inf)
        delay[closing] = self.gap[closing] / approach[closing]
        k = int(np.argmin(delay)) if len(delay) else 0
        return k, float(delay[k]) if len(delay) else math.inf

    def move(self, time: float) -> None:
        """Let all fly."""
        self.gap = self._gap_after(time)
        self.first += self.v[0] * time
        self.now += time

    def _run_through(self, k: int) -> None:
        """The impact at contact k is passed on in the order of the largest relative velocity."""
        self.gap[k] = 0.0
        touching = self._around(k, self.gap == 0.0)
        while True:
            approach = self._approach()
            k = touching[int(np.argmax(approach[touching]))]
            if approach[k] <= 0:
                return
            if approach[k] >= self._contact.threshold:
                self._collide(k, float(approach[k]))
            else:
                self._merge(k, float(approach[k]))

    def _collide(self, k: int, u: float) -> None:
        """Two beads alone (A Eq. 2)."""
        i, j = self._partners(k)
        r = self._contact.restitution
        self._pass_on([i], [j], (1 + r) * u, 0.5 * (1 - r * r) * u * u)
        self.collisions += 1

    def _merge(self, k: int, u: float) -> None:
        """All that hangs together on either side goes on with one velocity."""
        together = self._around(k, (self.gap == 0.0) & (self._approach() == 0.0))
        at = together.index(k)
        left = [self._partners(c)[0] for c in together[: at + 1]]
        right = [self._partners(c)[1] for c in together[at:]]
        self._pass_on(left, right, u, 0.5 * u * u)
        self.v[right] = self.v[left[-1]]  # to the last bit
        self.merged += 1

    def _pass_on(self, left: list[int], right: list[int], change: float, loss: float) -> None:
        """Change the relative velocity of two groups of beads; `loss` of energy by their reduced mass."""
        m_left, m_right = self._mass[left].sum(), self._mass[right].sum()
        inverse = 1 / m_left + 1 / m_right
        self.v[left] -= change / m_left / inverse
        self.v[right] += change / m_right / inverse
        self.loss += loss / inverse
        self.loss_time += loss / inverse * self.now
        for bead in (left[-1], right[0]):
            self.interval[bead], self.last[bead] = self.now - self.last[bead], self.now
            self.counts[bead] += 1

    def _gap_after(self, time: float) -> np.ndarray:
        return np.maximum(self.gap - self._approach() * time, 0.0)

    def _approach(self) -> np.ndarray:
        """How fast each gap closes (m/s)."""
        return self.v - np.roll(self.v, -1) if self._ring else -np.diff(self.v)

    def _partners(self, k: int) -> tuple[int, int]:
        return k, (k + 1) % len(self.v)

    def _around(self, k: int, holds: np.ndarray) -> list[int]:
        """Contact k, and on either side those next to it as far as they hold, from left to right."""
        n, found = len(holds), [k]
        for side in (-1, 1):
            other = k + side
            while len(found) < n and (self._ring or 0 <= other < n) and holds[other % n]:
                found.insert(0 if side < 0 else len(found), other % n)
                other += side
        return found

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
from dataclasses import dataclass, replace

import numpy as np

from granugas.dynamics.state import State

PERIODIC, WALLS, FREE = "periodic", "wall", "free"
"""How a row of beads ends: in itself, at walls, or nowhere."""

TOUCH = 1.0e-12
"""Beads of exactly one velocity with a gap below it, by the box, are a cluster of which a state has the positions."""


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
    k, delay = row.next_impact()
    while impacts < most_impacts and row.now + delay <= until and delay < math.inf:
        row.move(delay)
        row.run_through(k)
        impacts += 1
        k, delay = row.next_impact()
    if impacts < most_impacts and until < math.inf:
        row.move(until - row.now)
    return Passage(row.state(), row.collisions, row.merged, row.loss)


class _Row:
    """Beads from left to right, between walls if there are any; contact k is that of bead k with the next one."""

    def __init__(self, state: State, diameter: float, contact: Contact) -> None:
        self.now, self.collisions, self.merged, self.loss = state.time, 0, 0, 0.0
        self._start, self._diameter, self._contact = state, diameter, contact
        self._ring, walled = contact.boundary == PERIODIC, contact.boundary == WALLS
        self._order, (box,) = np.argsort(state.position[:, 0], kind="stable"), state.box
        self._beads = slice(1, -1) if walled else slice(None)

        def in_a_row(values: np.ndarray, left: float, right: float) -> np.ndarray:
            return np.concatenate([[left], values[self._order], [right]]) if walled else values[self._order]

        place = in_a_row(state.position[:, 0], -diameter / 2, box + diameter / 2)
        self._v, self._mass = in_a_row(state.velocity[:, 0], 0.0, 0.0), in_a_row(np.ones(len(self._order)), math.inf, math.inf)
        self._last = in_a_row(state.last_collision_time, self.now, self.now)
        self._interval = in_a_row(state.last_collision_interval, 0.0, 0.0)
        self._counts = in_a_row(state.collisions, 0, 0)
        self._first = place[0]
        self._gap = np.maximum(np.diff(place, append=[place[0] + box] if self._ring else []) - diameter, 0.0)
        self._gap[(self._gap < TOUCH * box) & (self._approach() == 0)] = 0.0

    def state(self) -> State:
        """The beads, by their numbers."""
        right = np.cumsum(self._gap + self._diameter)
        place = self._first + np.concatenate([[0.0], right[:-1] if self._ring else right])
        place = np.mod(place, self._start.box[0]) if self._ring else place
        rows = (place, self._v, self._last, self._interval, self._counts)
        place, velocity, last, interval, counts = (values[self._beads][np.argsort(self._order)] for values in rows)
        position, velocity = place[:, np.newaxis], velocity[:, np.newaxis]
        return replace(
            self._start,
            time=self.now,
            position=position,
            velocity=velocity,
            last_collision_time=last,
            last_collision_interval=interval,
            collisions=counts,
        )

    def next_impact(self) -> tuple[int, float]:
        """The contact that closes first, and how long until then (s); infinite if none does."""
        approach = self._approach()
        closing = approach > 0
        delay = np.full(len(approach), math.inf)
        delay[closing] = self._gap[closing] / approach[closing]
        k = int(np.argmin(delay)) if len(delay) else 0
        return k, float(delay[k]) if len(delay) else math.inf

    def move(self, time: float) -> None:
        """Let all fly."""
        self._gap = np.maximum(self._gap - self._approach() * time, 0.0)
        self._first += self._v[0] * time
        self.now += time

    def run_through(self, k: int) -> None:
        """The impact at contact k is passed on in the order of the largest relative velocity."""
        self._gap[k] = 0.0
        touching = self._around(k, self._gap == 0.0)
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
        together = self._around(k, (self._gap == 0.0) & (self._approach() == 0.0))
        at = together.index(k)
        left = [self._partners(c)[0] for c in together[: at + 1]]
        right = [self._partners(c)[1] for c in together[at:]]
        self._pass_on(left, right, u, 0.5 * u * u)
        self._v[right] = self._v[left[-1]]  # to the last bit
        self.merged += 1

    def _pass_on(self, left: list[int], right: list[int], change: float, loss: float) -> None:
        """Change the relative velocity of two groups of beads; `loss` of energy by their reduced mass."""
        m_left, m_right = self._mass[left].sum(), self._mass[right].sum()
        inverse = 1 / m_left + 1 / m_right
        self._v[left] -= change / m_left / inverse
        self._v[right] += change / m_right / inverse
        self.loss += loss / inverse
        for bead in (left[-1], right[0]):
            self._interval[bead], self._last[bead] = self.now - self._last[bead], self.now
            self._counts[bead] += 1

    def _approach(self) -> np.ndarray:
        """How fast each gap closes (m/s)."""
        return self._v - np.roll(self._v, -1) if self._ring else -np.diff(self._v)

    def _partners(self, k: int) -> tuple[int, int]:
        return k, (k + 1) % len(self._v)

    def _around(self, k: int, holds: np.ndarray) -> list[int]:
        """Contact k, and on either side those next to it as far as they hold, from left to right."""
        n, found = len(holds), [k]
        for side in (-1, 1):
            other = k + side
            while len(found) < n and (self._ring or 0 <= other < n) and holds[other % n]:
                found.insert(0 if side < 0 else len(found), other % n)
                other += side
        return found

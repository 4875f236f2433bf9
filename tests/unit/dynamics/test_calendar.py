"""The calendar hands out events in order of time, whatever is put into it.

The oracle is the plain list of everybody's next time, of which the smallest is next.
"""

import math

import numpy as np
import pytest
from numba import njit

from granugas.dynamics.events.calendar import HEADROOM, next_event, refresh_if_full, schedule
from granugas.dynamics.events.state import NOBODY

N = 50
EVENTS = 4000

DELAYS = {
    "steady": lambda rng: rng.exponential(1.0, EVENTS),
    "crowded bins": lambda rng: np.where(rng.random(EVENTS) < 0.9, rng.exponential(1e-3, EVENTS), 10.0),
    "far apart": lambda rng: 10.0 ** rng.uniform(-6, 4, EVENTS),
    "slowing down": lambda rng: rng.exponential(1.0, EVENTS) * np.geomspace(1, 1e6, EVENTS),
    "quickening": lambda rng: rng.exponential(1.0, EVENTS) * np.geomspace(1, 1e-6, EVENTS),
    "in step": lambda rng: np.full(EVENTS, 0.7) + 1e-3 * rng.random(EVENTS),
    "dying out": lambda rng: np.where(rng.random(EVENTS) < 0.02, math.inf, rng.exponential(1.0, EVENTS)),
}
"""How long after its event a disk has the next one."""


@njit(error_model="numpy")
def play(gas, start, delays, moved, shifts, times, disks):
    """Schedule all; then take event after event, give its disk the next one and move another disk's; how many there were."""
    for i in range(len(start)):
        schedule(gas, i, start[i])
    for k in range(len(delays)):
        refresh_if_full(gas)
        now, i = next_event(gas)
        if i == NOBODY:
            return k
        origin = gas.calendar.base + gas.calendar.base_low
        times[k], disks[k] = origin + now, i
        schedule(gas, i, now + delays[k])
        schedule(gas, moved[k], now + shifts[k])
    return len(delays)


def expected(start, delays, moved, shifts):
    """The same with the plain list."""
    pending, times, disks = start.copy(), [], []
    for delay, other, shift in zip(delays, moved, shifts, strict=True):
        i = int(np.argmin(pending))
        now = pending[i]
        if now == math.inf:
            break
        times.append(now)
        disks.append(i)
        pending[i] = now + delay
        pending[other] = now + shift
    return np.array(times), np.array(disks)


@pytest.fixture
def idle(gas_of):
    """The function that makes a gas at rest, whose calendar is empty."""

    def make(n=N, bin_width=0.01):
        position = [[2.0 * i + 1, 1.0] for i in range(n)]
        gas = gas_of(position, np.zeros((n, 2)), (2.0 * n, 2.0))
        calendar = gas.calendar
        calendar.width, calendar.rate, calendar.until = bin_width, 1 / bin_width, math.inf
        calendar.start = -(calendar.n_bins + 1) * bin_width
        return gas

    return make


def played(gas, start, delays, moved, shifts):
    times, disks = np.zeros(len(delays)), np.zeros(len(delays), np.int64)
    n = play(gas, start, delays, moved, shifts, times, disks)
    return times[:n], disks[:n]


def game(name, seed):
    """Start, delays, and whom else to move where: sooner and later than it was, mostly."""
    rng = np.random.default_rng(seed)
    delays = DELAYS[name](rng)
    finite = np.where(np.isfinite(delays), delays, 1.0)
    return rng.permutation(delays)[:N], delays, rng.integers(0, N, EVENTS), finite * rng.uniform(0.1, 3.0, EVENTS)


@pytest.mark.parametrize("bin_width", [1e-6, 0.01, 100.0])
@pytest.mark.parametrize("name", DELAYS)
def test_events_come_in_order(name, bin_width, idle):
    """The width of the first bins is nothing but a guess."""
    gas, plan = idle(bin_width=bin_width), game(name, 1)
    times, disks = played(gas, *plan)
    wanted_times, wanted_disks = expected(*plan)
    np.testing.assert_array_equal(times, wanted_times)
    np.testing.assert_array_equal(disks, wanted_disks)
    assert gas.calendar.backwards == 0


def test_the_origin_of_times_moves_on(idle):
    gas, plan = idle(), game("steady", 2)
    gas.calendar.rebase_after = 5.0
    times, disks = played(gas, *plan)
    wanted_times, wanted_disks = expected(*plan)
    assert gas.calendar.base > 20.0
    assert gas.calendar.now < 10.0
    np.testing.assert_allclose(times, wanted_times, rtol=1e-14)
    np.testing.assert_array_equal(disks, wanted_disks)


def test_two_events_with_nothing_in_between(idle):
    """Whole windows are empty; a calendar that walked through them would take for ever."""
    gas = idle(n=2, bin_width=1e-9)
    nobody_moves = np.full(6, 1)
    times, disks = played(gas, np.array([1.0, math.inf]), np.full(6, 1e6), nobody_moves, np.full(6, math.inf))
    np.testing.assert_array_equal(times, 1.0 + 1e6 * np.arange(6))
    assert set(disks) == {0}


def test_an_empty_calendar_says_so(idle):
    times, _ = played(idle(), np.full(N, math.inf), np.ones(10), np.zeros(10, np.int64), np.ones(10))
    assert len(times) == 0


def test_events_at_one_instant(idle):
    """Time stands still, then goes on; who comes first of those at one time is open."""
    gas, rng = idle(), np.random.default_rng(3)
    delays = np.where(np.arange(EVENTS) < EVENTS // 2, 0.0, rng.exponential(1.0, EVENTS))
    plan = np.ones(N), delays, np.zeros(EVENTS, np.int64), np.full(EVENTS, math.inf)
    times, _ = played(gas, *plan)
    np.testing.assert_array_equal(times, expected(*plan)[0])
    assert gas.calendar.backwards == 0


@njit(error_model="numpy")
def flood(gas, start, entries, times, disks):
    """Disk 0 is put off a little again and again, within the current bin; then all events come."""
    for i in range(len(start)):
        schedule(gas, i, start[i])
    now, first = next_event(gas)
    fullest = 0
    for k in range(entries):
        refresh_if_full(gas)
        schedule(gas, 0, now + 1e-9 * (k + 1))
        fullest = max(fullest, gas.calendar.heap_size)
    for k in range(len(start)):
        times[k], disks[k] = next_event(gas)
    return first, fullest


def test_a_flood_of_stale_entries_does_not_overflow_the_heap(idle):
    gas, entries = idle(bin_width=1.0), 5000
    start = np.linspace(1.0, 1.5, N)
    times, disks = np.zeros(N), np.zeros(N, np.int64)
    first, fullest = flood(gas, start, entries, times, disks)
    assert first == 0
    assert N + HEADROOM < fullest <= gas.calendar.heap_limit - HEADROOM + 1
    assert times[0] == 1.0 + 1e-9 * entries
    np.testing.assert_array_equal(disks, np.arange(N))
    np.testing.assert_array_equal(times[1:], start[1:])


@njit(error_model="numpy")
def next_until(gas, until):
    gas.calendar.until = until
    return next_event(gas)


def test_no_event_after_the_time_that_is_asked_for(idle):
    gas = idle()
    played(gas, np.arange(1.0, N + 1), np.empty(0), np.empty(0, np.int64), np.empty(0))
    assert next_until(gas, 0.5) == (0.5, NOBODY)
    assert next_until(gas, 2.0) == (1.0, 0)
    assert next_until(gas, 2.0) == (2.0, 1)
    assert next_until(gas, 2.0) == (2.0, NOBODY)
    assert next_until(gas, 2.999) == (2.999, NOBODY)
    assert next_until(gas, 3.0) == (3.0, 2)

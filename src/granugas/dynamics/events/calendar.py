"""The calendar: which event is next.

Every disk has at most one event, at `schedule.time`. A window of time is cut into bins of SLOTS - 1 disks; the events of the
current bin stand in a small heap. Nothing is ever deleted: an entry is stale when the disk's time is no longer the entry's.
Events beyond the window need no place at all, for the next window is filled from `schedule.time`. An event that finds its
bin full goes to the heap, which is always right and only slower.
"""

import math

from granugas.dynamics.events.composition import inline, outline
from granugas.dynamics.events.look_ahead import look_ahead
from granugas.dynamics.events.state import NOBODY, SLOTS

EVENTS_PER_BIN = 2.0
"""Wanted mean; the width of the bins follows the measured rate of events."""

SHORTEST = 1.0e-30
"""A window's least duration (s): its bins have a finite rate even where time stands still."""

HEADROOM = 64
"""Places of the heap that one event can never use up."""


@inline
def schedule(gas, i, time):
    """The next event of disk i is at `time`."""
    calendar = gas.calendar
    gas.schedule.time[i] = time
    place = (time - calendar.start) * calendar.rate
    if place >= calendar.n_bins:
        return
    target = int(place)
    if target > calendar.bin:
        count = gas.bins.entry[target * SLOTS]
        if count < SLOTS - 1:
            gas.bins.entry[target * SLOTS] = count + 1
            gas.bins.entry[target * SLOTS + count + 1] = i
            return
    _push(gas, time, i)


@inline
def cancel(gas, i):
    """Disk i has no event of its own."""
    gas.schedule.time[i] = math.inf


@inline
def clear(gas):
    """Nobody has an event."""
    gas.calendar.heap_size = 0
    for k in range(gas.calendar.n_bins):
        gas.bins.entry[k * SLOTS] = 0
    for i in range(gas.calendar.n_disks):
        cancel(gas, i)


@inline
def next_event(gas):
    """Take out the earliest event: its time and disk; NOBODY where none is left up to `calendar.until`."""
    calendar, heap = gas.calendar, gas.heap
    while True:
        while calendar.heap_size == 0 or int((heap.time[0] - calendar.start) * calendar.rate) > calendar.bin:
            if calendar.bin + 1 >= calendar.n_bins:
                end = calendar.start + calendar.n_bins * calendar.width
                if end > calendar.until or not open_window(gas, end):
                    return calendar.until, NOBODY
            calendar.bin += 1
            _open_bin(gas, calendar.bin)
        time, i = heap.time[0], heap.disk[0]
        if gas.schedule.time[i] != time:
            _pop(gas)
        elif time > calendar.until:
            return calendar.until, NOBODY
        else:
            _pop(gas)
            gas.schedule.time[i] = math.inf
            calendar.events += 1
            calendar.backwards += time < calendar.now
            calendar.now = time
            return time, i


@inline
def refresh_if_full(gas):
    """Rid the heap of stale entries before it overflows (time may stand still while they flood in)."""
    if gas.calendar.heap_size > gas.calendar.heap_limit - HEADROOM:
        open_window(gas, gas.calendar.now)


@outline
def open_window(gas, start):
    """Begin a window at the first event at or after `start`, filled from the disks' own times; False: no event at all."""
    calendar, time = gas.calendar, gas.schedule.time
    n = calendar.n_disks
    first = math.inf
    for i in range(n):
        first = min(first, time[i])
    if first == math.inf:
        return False
    if calendar.events > 0:
        measured = max(calendar.now - calendar.start, SHORTEST) / calendar.events * EVENTS_PER_BIN
        calendar.width = min(max(measured, calendar.width / 8), calendar.width * 8)
        calendar.rate = 1.0 / calendar.width
    calendar.start = max(start, first)
    calendar.bin = -1
    calendar.heap_size = 0
    calendar.events = 0
    if calendar.start > calendar.rebase_after:
        _rebase(gas, calendar.start)
    for k in range(calendar.n_bins):
        gas.bins.entry[k * SLOTS] = 0
    for i in range(n):
        if time[i] < math.inf:
            schedule(gas, i, time[i])
    return True


@inline
def _rebase(gas, shift):
    """Move the origin of all times by `shift`, so that differences stay exact however long the run."""
    calendar, disks, clocks = gas.calendar, gas.disks, gas.clocks
    total = calendar.base + shift
    calendar.base_low += shift - (total - calendar.base)
    calendar.base = total
    calendar.start -= shift
    calendar.now -= shift
    calendar.until -= shift
    calendar.reached -= shift
    gas.tally.loss_time -= gas.tally.loss * shift
    gas.tally.stored_time -= gas.tally.stored * shift
    for i in range(calendar.n_disks):
        disks.t[i] -= shift
        disks.t_coll[i] -= shift
        clocks.last[i] -= shift
        gas.schedule.time[i] -= shift


@inline
def _open_bin(gas, current):
    """Move the live entries of a bin to the heap."""
    start, rate = gas.calendar.start, gas.calendar.rate
    if gas.calendar.look_ahead > 0:
        look_ahead(gas, current)
    for slot in range(current * SLOTS + 1, current * SLOTS + 1 + gas.bins.entry[current * SLOTS]):
        i = gas.bins.entry[slot]
        time = gas.schedule.time[i]
        if time < math.inf and int((time - start) * rate) == current:
            _push(gas, time, i)


@inline
def _push(gas, time, i):
    heap = gas.heap
    k = gas.calendar.heap_size
    gas.calendar.heap_size = k + 1
    while k > 0:
        parent = (k - 1) // 2
        if heap.time[parent] <= time:
            break
        heap.time[k], heap.disk[k] = heap.time[parent], heap.disk[parent]
        k = parent
    heap.time[k], heap.disk[k] = time, i


@inline
def _pop(gas):
    heap = gas.heap
    size = gas.calendar.heap_size - 1
    gas.calendar.heap_size = size
    time, i = heap.time[size], heap.disk[size]
    k = 0
    while True:
        child = 2 * k + 1
        if child >= size:
            break
        if child + 1 < size and heap.time[child + 1] < heap.time[child]:
            child += 1
        if time <= heap.time[child]:
            break
        heap.time[k], heap.disk[k] = heap.time[child], heap.disk[child]
        k = child
    heap.time[k], heap.disk[k] = time, i

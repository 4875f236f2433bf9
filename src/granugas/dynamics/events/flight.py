"""Free flight between collisions, and when it leaves a cell. Without a force: straight lines."""

import math
from typing import NamedTuple

from granugas.dynamics.events.composition import generic, implements, inline
from granugas.dynamics.events.vectors import along, mapped, mapped_three


class Straight(NamedTuple):
    """No force."""


@generic
def moved(force, x, v, flown):
    """Where a disk is that was at x with velocity v, after the time `flown` (d)."""


@generic
def hastened(force, v, flown):
    """Its velocity then (d/s)."""


@generic
def settle(force, gas, i, time):
    """Let the flight of disk i begin at `time`, where it is then."""


@generic
def leaves_after(force, x, v, half):
    """How long until a disk at x leaves its cell, of half widths `half`; infinite for a disk at rest."""


@generic
def next_step(force, x, v, half):
    """The step, +-1 along one axis, to the cell that it enters then."""


@generic
def pull(force, axis):
    """The acceleration along an axis (d/s^2)."""


@generic
def leaves_interval(force, axis, x, v, low, high):
    """How long until a coordinate along an axis that is x, and changes at v, is at the end of an interval, and whether at its
    upper one; infinite if it stays inside.

    low, high: of the interval (d), x inside; outside by rounding counts as at the end.
    """


@inline
def position(gas, i, time):
    """Where disk i is at `time`, from the centre of its cell (d)."""
    return moved(gas.force, gas.disks.x[i], gas.disks.v[i], time - gas.disks.t[i])


@inline
def velocity(gas, i, time):
    """Its velocity then (d/s)."""
    return hastened(gas.force, gas.disks.v[i], time - gas.disks.t[i])


# --- straight lines -------------------------------------------------------------------------------------------------------


@implements(moved, Straight)
def _moved_straight(force, x, v, flown):
    return along(x, flown, v)


@implements(hastened, Straight)
def _not_hastened(force, v, flown):
    return v


@implements(settle, Straight)
def _settle_straight(force, gas, i, time):
    gas.disks.x[i] = position(gas, i, time)
    gas.disks.t[i] = time


@implements(pull, Straight)
def _no_pull(force, axis):
    return 0.0


@implements(leaves_interval, Straight)
def _leaves_interval_straight(force, axis, x, v, low, high):
    return delay(max(high - x if v > 0.0 else x - low, 0.0), v), v > 0.0


@implements(leaves_after, Straight)
def _leaves_straight(force, x, v, half):
    return first_exit(mapped_three(x, v, half, way_ahead), v)


@implements(next_step, Straight)
def _next_step_straight(force, x, v, half):
    return step_along(v, axis_of_exit(mapped_three(x, v, half, way_ahead), v))


@inline
def way_ahead(x, v, half):
    """How far it is along an axis to the edge of the cell that a disk flies towards (d)."""
    return max(half - x if v > 0.0 else half + x, 0.0)


@inline
def delay(way, v):
    """How long a way takes at the speed |v|; infinite at rest."""
    speed = abs(v)
    return way / speed if speed > 0.0 else math.inf


@generic
def axis_of_exit(ways, v):
    """Along which axis a disk first comes to the end of its way there."""


@generic
def first_exit(ways, v):
    """When that is."""


@generic
def step_along(v, axis):
    """The step along an axis in the direction of v."""


@inline
def _sign(v):
    return 1 if v > 0.0 else -1


@implements(axis_of_exit, 1)
def _axis_on_a_line(ways, v):
    return 0


@implements(axis_of_exit, 2)
def _axis_in_a_plane(ways, v):
    return 0 if ways[0] * abs(v[1]) < ways[1] * abs(v[0]) else 1


@implements(axis_of_exit, 3)
def _axis_in_space(ways, v):
    first = mapped(ways, v, delay)
    if first[0] <= first[1] and first[0] <= first[2]:
        return 0
    return 1 if first[1] <= first[2] else 2


@implements(first_exit, 1)
def _exit_on_a_line(ways, v):
    return delay(ways[0], v[0])


@implements(first_exit, 2)
def _exit_in_a_plane(ways, v):
    """One division."""
    if axis_of_exit(ways, v) == 0:
        return ways[0] / abs(v[0])
    speed = abs(v[1])
    if speed > 0.0:
        return ways[1] / speed
    return math.inf if v[0] == 0.0 else ways[0] / abs(v[0])


@implements(first_exit, 3)
def _exit_in_space(ways, v):
    x, y, z = mapped(ways, v, delay)
    return min(x, min(y, z))


@implements(step_along, 1)
def _step_on_a_line(v, axis):
    return (_sign(v[0]),)


@implements(step_along, 2)
def _step_in_a_plane(v, axis):
    return _sign(v[0]) * (axis == 0), _sign(v[1]) * (axis == 1)


@implements(step_along, 3)
def _step_in_space(v, axis):
    return _sign(v[0]) * (axis == 0), _sign(v[1]) * (axis == 1), _sign(v[2]) * (axis == 2)

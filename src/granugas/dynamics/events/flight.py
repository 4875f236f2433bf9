"""Free flight: straight lines between collisions, and when they leave a cell."""

import math

from granugas.dynamics.events.composition import inline


@inline
def position(gas, i, time):
    """Where disk i is at `time`, from the centre of its cell (d)."""
    disks = gas.disks
    flown = time - disks.t[i]
    return disks.x[i] + disks.vx[i] * flown, disks.y[i] + disks.vy[i] * flown


@inline
def exit_distances(gas, i, x, y):
    """How far disk i at (x, y) is from the two edges of its cell that it flies towards (d)."""
    grid, disks = gas.grid, gas.disks
    to_x = grid.half_x - x if disks.vx[i] > 0.0 else grid.half_x + x
    to_y = grid.half_y - y if disks.vy[i] > 0.0 else grid.half_y + y
    return max(to_x, 0.0), max(to_y, 0.0)


@inline
def leaves_through_x(gas, i, to_x, to_y):
    """Does disk i reach the edge in x before the one in y?"""
    return to_x * abs(gas.disks.vy[i]) < to_y * abs(gas.disks.vx[i])


@inline
def next_step(gas, i, x, y):
    """The step, (+-1, 0) or (0, +-1), to the cell that disk i at (x, y) enters next."""
    to_x, to_y = exit_distances(gas, i, x, y)
    through_x = leaves_through_x(gas, i, to_x, to_y)
    return (1 if gas.disks.vx[i] > 0.0 else -1) * through_x, (1 if gas.disks.vy[i] > 0.0 else -1) * (not through_x)


@inline
def exit_time(gas, i, x, y, now):
    """When disk i, at (x, y) now, leaves its cell; infinite for a disk at rest."""
    to_x, to_y = exit_distances(gas, i, x, y)
    if leaves_through_x(gas, i, to_x, to_y):
        return now + to_x / abs(gas.disks.vx[i])
    speed = abs(gas.disks.vy[i])
    if speed > 0.0:
        return now + to_y / speed
    return math.inf if gas.disks.vx[i] == 0.0 else now + to_x / abs(gas.disks.vx[i])

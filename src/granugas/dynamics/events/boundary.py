"""What lies at the edge of the box: the other side of it, or a wall."""

from typing import NamedTuple

from granugas.dynamics.events.composition import generic, implements
from granugas.dynamics.events.flight import leaves_after

NO_WALL, WALL, WALL_AND_CALL = 0, 1, 2
"""What `bounce` finds: no wall, a wall, a wall and a watch that wants the loop to end."""


class Periodic(NamedTuple):
    """No wall anywhere."""


@generic
def goes_on_after(walls, gas, i, x, v, now):
    """How long until disk i, at x with velocity v now, leaves its cell or touches a wall; infinite for a disk at rest."""


@generic
def bounce(walls, gas, i, now):
    """If disk i touches a wall now, turn it round, and release whom it was to meet; what it found."""


@implements(goes_on_after, Periodic)
def _to_the_next_cell(walls, gas, i, x, v, now):
    return leaves_after(gas.force, x, v, gas.grid.half)


@implements(bounce, Periodic)
def _no_wall(walls, gas, i, now):
    return NO_WALL

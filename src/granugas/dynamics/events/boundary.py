"""What lies at the edge of the box: its other side, or a wall; and how the floor, the lower wall along the last axis, moves."""

import math
from typing import NamedTuple

from granugas.dynamics.events.composition import generic, implements
from granugas.dynamics.events.flight import leaves_after, next_step

NO_WALL, WALL, WALL_AND_CALL = 0, 1, 2
"""What `bounce` finds: no wall, a wall, a wall and a watch that wants the loop to end."""


class Periodic(NamedTuple):
    """No wall anywhere."""


class Still(NamedTuple):
    """A floor that does not move."""


@generic
def goes_on_after(walls, gas, i, x, v, now):
    """How long until disk i, at x with velocity v now, leaves its cell or touches a wall; infinite for a disk at rest."""


@generic
def step_ahead(walls, gas, i, x, v):
    """The step to the cell that disk i, at x with velocity v, enters."""


@generic
def bounce(walls, gas, i, now):
    """If disk i touches a wall now, turn it round, and release whom it was to meet; what it found."""


@generic
def clearance(walls, gas, i, x):
    """How far disk i, at x, is from the nearest wall; infinite without any (d)."""


@generic
def peak(floor):
    """How high the floor comes, above its lowest place and that of a floor without motion (d); 0 if it does not move."""


@generic
def climb(floor, gas, now):
    """The velocity of the floor, upwards (d/s)."""


@generic
def lands_after(floor, gas, y, v, now, longest):
    """How long until the floor, which moves, is met by what is y above its lowest place, with the velocity v upwards now.

    It is infinite if that takes longer than `longest` (s).
    """


@generic
def raised(floor, work):
    """Count the work that the floor does on a disk (m d^2/s^2)."""


@implements(goes_on_after, Periodic)
def _to_the_next_cell(walls, gas, i, x, v, now):
    return leaves_after(gas.force, x, v, gas.grid.half)


@implements(step_ahead, Periodic)
def _over_the_edge_ahead(walls, gas, i, x, v):
    return next_step(gas.force, x, v, gas.grid.half)


@implements(bounce, Periodic)
def _no_wall(walls, gas, i, now):
    return NO_WALL


@implements(clearance, Periodic)
def _nothing_near(walls, gas, i, x):
    return math.inf


@implements(peak, Still)
def _no_peak(floor):
    return 0.0


@implements(climb, Still)
def _no_climb(floor, gas, now):
    return 0.0


@implements(lands_after, Still)
def _like_any_wall(floor, gas, y, v, now, longest):
    return math.inf


@implements(raised, Still)
def _no_work(floor, work):
    return

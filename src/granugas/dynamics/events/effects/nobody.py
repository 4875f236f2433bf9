"""Nobody watches the collisions: no code in the kernel."""

from typing import NamedTuple

from granugas.dynamics.events.composition import implements
from granugas.dynamics.events.loop import witness


class Nobody(NamedTuple):
    """The watch of a run that nothing is asked of."""


@implements(witness, Nobody)
def _nobody(watch, gas, i, j, now, since, u_n):
    return False

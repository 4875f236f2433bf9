"""Nobody watches the collisions: no code in the kernel."""

from typing import NamedTuple

from granugas.dynamics.events.composition import implements
from granugas.dynamics.events.loop import witness
from granugas.dynamics.state import State
from granugas.scene import Scene


class Nobody(NamedTuple):
    """The watch of a run that nothing is asked of."""


def effect_of(scene: Scene, state: State) -> Nobody:
    """For scenes in which there is nothing to watch."""
    return Nobody()


@implements(witness, Nobody)
def _nobody(watch, gas, i, j, now, since, u_n):
    return False

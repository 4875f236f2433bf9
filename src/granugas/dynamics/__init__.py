"""Ways to move the particles: a state in, the state at a later time out."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:  # what chooses effects for a scene loads none of them, and no numpy
    import numpy as np

    from granugas.dynamics.events.engine import Tally
    from granugas.dynamics.state import State
    from granugas.scene import Scene


class Dynamics(Protocol):
    """What a run asks of the dynamics of its scene; events/engine.py says more.

    Attributes:
        time: up to which everything has happened (s).
        collisions: of pairs, since the beginning.
        cells: along each axis, in which neighbours are looked for.
        arrays: the whole state, from a copy of which `restore` goes on bit for bit.
    """

    time: float
    collisions: int
    cells: tuple[int, ...]
    arrays: "Mapping[str, np.ndarray]"

    def restore(self, arrays: "Mapping[str, np.ndarray]") -> None:
        """Go on from there."""

    def advance(self, until: float, most_collisions: int = 2**62, most_events: int = 2**62) -> int:
        """Go up to a time (s) or by a number of collisions or events; returns which (see events/loop.py)."""

    def state(self) -> "State":
        """All particles now."""

    def take_tally(self) -> "Tally":
        """Sums since it was last taken."""

    def observe(self, state: "State", tally: "Tally | None" = None, interval: float = 0.0) -> dict[str, float]:
        """What a sample has beside what every scene is asked."""

    def involved(self) -> "np.ndarray":
        """Numbers of the particles in an inelastic collapse."""


def engine_of(scene: "Scene", state: "State", **instead: Any) -> Dynamics:
    """The dynamics of a scene, from a state on; `instead`: effects that replace those it calls for (Engine)."""
    if scene.lrv_velocity > 0:
        from granugas.dynamics.lrv import Beads

        return Beads(scene, state, **instead)
    if scene.soft:
        from granugas.dynamics.softspheres import SoftSpheres

        return SoftSpheres(scene, state, **instead)
    if scene.dynamics == "dsmc":
        from granugas.dynamics.dsmc import Dsmc

        return Dsmc(scene, state, **instead)
    from granugas.dynamics.events.engine import Engine

    return Engine(scene, state, **instead)

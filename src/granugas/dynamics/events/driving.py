"""What acts on all particles at once, between two pieces of the loop. Without an effect that says otherwise: nothing."""

from typing import NamedTuple


class Undriven(NamedTuple):
    """Nothing acts on the particles but collisions and the force."""

    def due(self, until: float) -> float | None:
        """When it acts next, if that is not after `until` (s)."""
        return None

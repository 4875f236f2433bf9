"""Long runs show how far they are: a bar on a terminal, a line in the log every half minute."""

import logging
import math
import time
from collections.abc import Callable

from tqdm import tqdm

from granugas.dynamics import Dynamics
from granugas.dynamics.events.loop import EVENTS

SLICE = 200_000
"""Events between two looks at the clock, a fraction of a second."""

LOG_EVERY = 30.0
"""Seconds between two lines in the log."""

logger = logging.getLogger("granugas")


class Progress:
    """Drives an engine in slices and tells where it is."""

    def __init__(self, what: str, until: float = math.inf, shown: bool = True) -> None:
        """`until`: simulated time of the end (s), from which the time of arrival is estimated; `shown`: with a bar."""
        self._what, self._until = what, until
        self._bar = tqdm(total=1.0, desc=what, disable=None if shown else True, bar_format="{l_bar}{bar}|{postfix}")
        self._started = self._logged = time.monotonic()

    def follow(
        self,
        engine: Dynamics,
        until: float = math.inf,
        collisions: int = 2**62,
        enough: Callable[[Dynamics], bool] = lambda engine: False,
    ) -> int:
        """Advance the engine up to a time (s) or by a number of collisions; why it stopped (see loop).

        `enough` is asked after each slice that did not bring it there; where it says so the engine stays there (EVENTS).
        """
        begin = engine.collisions
        why = EVENTS
        while why == EVENTS:
            why = engine.advance(until, collisions - (engine.collisions - begin), SLICE)
            self._tell(engine)
            if why == EVENTS and enough(engine):
                break
        return why

    def close(self) -> None:
        """Leave the bar as it is."""
        self._bar.close()

    def _tell(self, engine: Dynamics) -> None:
        now = time.monotonic()
        if not self._bar.disable:
            self._bar.n = min(engine.time / self._until, 1.0)
            self._bar.set_postfix_str(self._words(engine, now))
        if now - self._logged >= LOG_EVERY:
            self._logged = now
            logger.info("%s: %s", self._what, self._words(engine, now))

    def _words(self, engine: Dynamics, now: float) -> str:
        text = f"t = {engine.time:.4g} s, {engine.collisions} collisions"
        if math.isfinite(self._until) and engine.time > 0:
            left = (now - self._started) * (self._until / engine.time - 1)
            text += f" ({engine.time / self._until:.0%}), {left:.0f} s to go"
        return text

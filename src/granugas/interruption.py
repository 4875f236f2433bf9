"""What interrupts a run from outside: signals, a limit of wall time; and the checkpoint that is kept then."""

import signal
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Protocol

import numpy as np

from granugas.dynamics import Dynamics

ASKED = (signal.SIGTERM, signal.SIGINT)
"""Signals upon which a run with a checkpoint writes it and ends."""


class Keeper(Protocol):
    """Where a run keeps its state: see storage/checkpoint.py."""

    @property
    def is_due(self) -> bool:
        """Whether it is time to save."""

    def load(self) -> dict[str, np.ndarray] | None:
        """What was saved last."""

    def save(self, arrays: Mapping[str, np.ndarray]) -> None:
        """Replace it."""


class Interrupted(SystemExit):
    """A signal ended the run; its checkpoint is written."""


@contextmanager
def watched(
    checkpoint: Keeper | None, state: Callable[[], Mapping[str, np.ndarray]], max_seconds: float
) -> Iterator[Callable[[Dynamics], bool]]:
    """Yields what is to be called between two pieces of a run: it saves when that is due, and is True when time is over.

    Args:
        checkpoint: where to; None: signals do what they always do.
        state: all that is to be saved.
        max_seconds: of wall time, from now on.

    Raises:
        Interrupted: in the run, where a signal came.
    """
    end, came = time.monotonic() + max_seconds, []
    catch = checkpoint is not None and threading.current_thread() is threading.main_thread()
    before = {number: signal.signal(number, lambda number, _: came.append(number)) for number in ASKED if catch}

    def look(engine: Dynamics) -> bool:
        over = time.monotonic() >= end
        if checkpoint is not None and (came or over or checkpoint.is_due):
            checkpoint.save(state())
        if came:
            name = signal.Signals(came[0]).name
            raise Interrupted(f"{name} at t = {engine.time:.6g} s; the same command goes on from the checkpoint")
        return over

    try:
        yield look
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)

"""Checkpoints: the state of a run in a file, from which another process goes on bit for bit."""

import logging
import time
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from granugas.runs import Run
from granugas.storage.files import replacing

SHARE = 0.05
"""Of its time, at most, that a run spends on writing checkpoints."""

logger = logging.getLogger("granugas")


class Checkpoint:
    """Where one run keeps its state, and when it does so again."""

    def __init__(self, path: str | Path, key: str, every: float = 60.0) -> None:
        """Nothing is read or written yet.

        Args:
            path: the file; whole or not there, whatever happens.
            key: what the state depends on beside the run (a digest of the physics): one of another key is not taken.
            every: s between two of them; more where writing takes long.
        """
        self._path, self._key, self._every = Path(path), key, every
        self._next = time.monotonic() + every

    @property
    def is_due(self) -> bool:
        """Whether it is time for the next one."""
        return time.monotonic() >= self._next

    def load(self) -> dict[str, np.ndarray] | None:
        """What was saved last; None where there is nothing, or nothing that can be trusted: then the log says why."""
        try:
            with np.load(self._path, allow_pickle=False) as file:
                if str(file["key"]) == self._key:
                    return {name: file[name] for name in file["names"].tolist()}
            reason = "it belongs to another version of the program"
        except FileNotFoundError:
            return None
        except Exception as error:  # a garbled archive fails in a dozen ways
            reason = f"it is damaged ({type(error).__name__}: {error})"
        logger.warning("checkpoint %s: %s; the run begins again", self._path.name, reason)
        return None

    def save(self, arrays: Mapping[str, np.ndarray]) -> None:
        """Replace what was saved before. A full disk costs the checkpoint, not the run: the log says so."""
        begin = time.monotonic()
        try:
            with replacing(self._path) as temporary, open(temporary, "wb") as file:
                np.savez(file, key=np.array(self._key), names=np.array(list(arrays), dtype=str), **arrays)  # type: ignore[arg-type]  # none is named as an option
        except OSError as error:
            logger.warning("no checkpoint: %s", error)
        took = time.monotonic() - begin
        self._next = time.monotonic() + max(self._every, took / SHARE)

    def remove(self) -> None:
        """The run has its result."""
        self._path.unlink(missing_ok=True)


def checkpoints_of(run: Run, folder: str | Path, key: str, every: float) -> dict[int, Checkpoint]:
    """The checkpoints of a run's realizations, in files named after its address."""
    return {k: Checkpoint(Path(folder) / f"{run.address}_{k}.npz", key, every) for k in run.realizations}

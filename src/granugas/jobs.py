"""What a job of the workflow runs in: all that it says goes to its log, it ends with its workflow, it starts lightly."""

import ctypes
import gc
import logging
import os
import re
import signal
import sys
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TextIO

from granugas.cost import Cost, metered
from granugas.storage.damage import DamagedFile

PR_SET_PDEATHSIG = 1

RARELY = 500_000
"""Objects between two searches for cycles among them, in a job: else a third of a small job's time goes into them."""


class Terminal(logging.StreamHandler[TextIO]):
    """What the terminal shows of a job's warnings: the first of each kind at once, at the end how many more the log has.

    Warnings with the same words are of one kind, whatever the numbers in them: realizations of a job warn alike.
    """

    def __init__(self) -> None:
        super().__init__(os.fdopen(os.dup(2), "w"))
        self.setLevel(logging.WARNING)
        self.addFilter(logging.Filter("granugas"))
        self._kinds: Counter[tuple[str, ...]] = Counter()

    def emit(self, record: logging.LogRecord) -> None:
        """Show it if it is the first of its kind."""
        kind = tuple(re.findall(r"[^\W\d]{2,}", record.getMessage()))
        self._kinds[kind] += 1
        if self._kinds[kind] == 1:
            super().emit(record)

    def finish(self, log: str | Path) -> None:
        """Say what was not shown, where it is, and nothing where there is nothing."""
        if more := self._kinds.total() - len(self._kinds):
            super().emit(logging.makeLogRecord({"msg": f"{more} more warnings like that: {log}"}))


@contextmanager
def logged(path: str | Path) -> Iterator[Cost]:
    """Let everything that a job says go to its log, and the job die with the workflow that started it.

    Standard output, standard error and logging are sent to the file, so an error ends the log with its traceback, the
    reason in the last line. The package's warnings go to the terminal as well (`Terminal`). A damaged file that it meets is
    marked, for the next build to look at (`damaged`). What the job takes is written beside the log; it gets the record to say
    its collisions.
    """
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    end_at_once_on_ctrl_c()
    start_lightly()
    terminal = Terminal()
    try:
        Path(path).parent.mkdir(parents=True, exist_ok=True)
        with open(path, "w") as log:
            os.dup2(log.fileno(), 1)
            os.dup2(log.fileno(), 2)
    except OSError as error:
        sys.exit(f"{path}: cannot be written ({error.strerror})")
    form = f"%(asctime)s {Path(path).stem}: %(message)s"
    logging.basicConfig(format=form, datefmt="%H:%M:%S", handlers=[logging.StreamHandler(sys.stderr), terminal])
    logging.getLogger("granugas").setLevel(logging.INFO)
    try:
        with metered(Path(path)) as spent:
            yield spent
    except DamagedFile as error:
        mark_of(error.path).touch()
        raise
    finally:
        terminal.finish(path)
    logging.getLogger("granugas").info("done")
    gc.freeze()


def end_at_once_on_ctrl_c() -> None:
    """Let Ctrl-C end this process, a job, as SIGTERM does, and not by an exception, unless it ignores it.

    An exception may come anywhere: where xarray has taken a lock and not noted it yet, the job would wait for itself for
    ever. What is half written has another name. A run that keeps checkpoints answers by itself (`interruption`).
    """
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)


def start_lightly() -> None:
    """Spare this process, a job, what would be half of a small one: searches for cycles of objects, and SciPy.

    Numba looks for SciPy's linear algebra when it first loads a kernel: .2 s where SciPy is installed. No kernel needs it, so
    numba looks while it is hidden; whoever asks for it later gets it.
    """
    gc.set_threshold(RARELY)
    if "scipy" not in sys.modules:
        sys.modules["scipy"] = None  # type: ignore[assignment]  # an import of it fails, as the language says
        import numba.np.arraymath  # noqa: F401 - it looks

        del sys.modules["scipy"]


def mark_of(path: Path) -> Path:
    """The empty file beside a dataset that says: a job could not read it."""
    return path.with_name(f".{path.name}.suspect")

"""What jobs take: each writes it down beside its log, a table of all of them is made from that.

Light, as every job and the main process of the workflow load it.
"""

import csv
import functools
import json
import os
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import ParamSpec, TypeVar

MADE = {
    "equilibrate": "states/{}.nc",
    "simulate": "runs/{}.nc",
    "clusters": "clusters/{}.nc",
    "pool": "studies/{}.nc",
    "experiments": "experiments/{}.nc",
    "figures": "figures/{}.png",
    "animations": "figures/{}.mp4",
    "tables": "{}.csv",
    "claims": "claims.csv",
    "explorer": "explorer.html",
    "report": "report/{}.html",
    "check": "checks.txt",
    "warm_up": "",
}
"""For each folder of logs (or log) what its jobs make, in the folder of the results; "" for nothing: kernels are elsewhere."""

COLUMNS = (
    *("study", "rule", "name", "cpu_seconds", "wall_seconds", "compile_seconds", "io_seconds"),
    *("collisions", "ns_per_collision"),
)

P = ParamSpec("P")
R = TypeVar("R")


@dataclass
class Cost:
    """What one job took.

    Attributes:
        cpu_seconds: processor time of its process, its threads and the processes that it started.
        wall_seconds: from its beginning to its end.
        compile_seconds: processor time of it for compiling kernels; none where they come from the cache.
        io_seconds: processor time of it for reading and writing datasets; not what is read step by step (positions).
        collisions: of pairs, that it carried out.
        done: whether it came to its end; what an attempt took that did not is part of what the next one takes.
    """

    cpu_seconds: float = 0.0
    wall_seconds: float = 0.0
    compile_seconds: float = 0.0
    io_seconds: float = 0.0
    collisions: int = 0
    done: bool = False

    def __add__(self, other: "Cost") -> "Cost":
        names = [one.name for one in fields(Cost)[:-1]]
        return Cost(**{name: getattr(self, name) + getattr(other, name) for name in names}, done=other.done)

    @property
    def ns_per_collision(self) -> float | None:
        """Processor time by collision without compilation, input and output; None where nothing collided."""
        return (self.cpu_seconds - self.compile_seconds - self.io_seconds) / self.collisions * 1e9 if self.collisions else None


@dataclass(frozen=True)
class Entry:
    """The cost of a job whose product is there.

    Attributes:
        rule, name: the folder of its log and the name of its product.
        when: time of its end, s since the epoch.
    """

    rule: str
    name: str
    when: float
    cost: Cost = field(compare=False)


_METERED: ContextVar[Cost | None] = ContextVar("cost of the job", default=None)
"""What `input_output` adds to: storage does not know which job it works for, and most of its callers are no job."""


@contextmanager
def metered(log: Path) -> Iterator[Cost]:
    """Take down what a block takes, all of this process before it included, in a file beside its log.

    The block says how many collisions it carried out.
    """
    spent, begun = Cost(), time.perf_counter()
    token = _METERED.set(spent)
    try:
        with _compiling(spent):
            yield spent
        spent.done = True
    finally:
        _METERED.reset(token)
        spent.cpu_seconds, spent.wall_seconds = processor_time(), time.perf_counter() - begun
        record(log, spent)


@contextmanager
def _compiling(spent: Cost) -> Iterator[None]:
    """Count what is compiled in a block."""
    from numba.core import event  # what a block compiles is told from its beginning or not at all

    class Clock(event.Listener):
        """One function's compilation leads to that of those it calls: the outermost counts."""

        depth, begun = 0, 0.0

        def on_start(self, _: event.Event) -> None:
            self.begun = self.begun if self.depth else time.process_time()
            self.depth += 1

        def on_end(self, _: event.Event) -> None:
            self.depth -= 1
            spent.compile_seconds += 0.0 if self.depth else time.process_time() - self.begun

    with event.install_listener("numba:compile", Clock()):
        yield


def input_output(function: Callable[P, R]) -> Callable[P, R]:
    """Count the time of a function as input and output of the job that calls it."""

    @functools.wraps(function)
    def timed(*arguments: P.args, **values: P.kwargs) -> R:
        begun = time.process_time()
        try:
            return function(*arguments, **values)
        finally:
            if (spent := _METERED.get()) is not None:
                spent.io_seconds += time.process_time() - begun

    return timed


def processor_time() -> float:
    """Of this process and of those that it started and waited for, in s."""
    return sum(os.times()[:4])


def record(log: Path, cost: Cost) -> None:
    """Write it beside the log, with what an attempt took that did not come to its end."""
    from granugas.storage.files import replacing  # which loads more than the start of a job should wait for

    path = log.with_suffix(".json")
    before = _read(path)
    whole = before + cost if before is not None and not before.done else cost
    with replacing(path) as temporary:
        temporary.write_text(json.dumps(asdict(whole)))


def entries(output: str | Path) -> list[Entry]:
    """What is known of the jobs that made what there is in a folder of results; of what is gone, nothing."""
    output, found = Path(output), []
    for path in sorted([*output.glob("logs/*/*.json"), *output.glob("logs/*.json")]):
        rule, name = (path.stem, "") if path.parent.name == "logs" else (path.parent.name, path.stem)
        if rule in MADE and (output / MADE[rule].format(name)).exists() and (cost := _read(path)) is not None:
            found.append(Entry(rule, name, path.stat().st_mtime, cost))
    return found


def write_table(path: str | Path, found: Iterable[Entry], studies: Mapping[tuple[str, str], str]) -> None:
    """Write a row for each job, COLUMNS: seconds, and the study that first asked for it ("" for none)."""
    from granugas.storage.files import replacing

    rows = [
        {"study": studies.get((one.rule, one.name), ""), "rule": one.rule, "name": one.name, **_numbers(one.cost)}
        for one in found
    ]
    with replacing(path) as temporary, open(temporary, "w", newline="") as file:
        table = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        table.writeheader()
        table.writerows(sorted(rows, key=lambda row: (row["study"], row["rule"], row["name"])))


def renew_table(output: str | Path, studies: Mapping[tuple[str, str], str]) -> Path:
    """Bring `<output>/cost.csv` up to date at the end of a build, whatever was built; its date stays.

    The rule that makes it and the figures that draw on it are thus not out of date for it. One that was not there gets a
    date before all others: a build that needs it makes it anew.
    """
    path = Path(output) / "cost.csv"
    date = path.stat().st_mtime if path.exists() else 0.0
    write_table(path, entries(output), studies)
    os.utime(path, (date, date))
    return path


def summary(found: Iterable[Entry], since: float, table: str | Path) -> str:
    """One line: what the build that began at a time (s since the epoch) took, and what all that is there has taken."""
    found = list(found)
    now = [one for one in found if one.when >= since]
    this, whole = (sum((one.cost for one in some), Cost()) for some in (now, found))
    runs = [one.cost for one in now if one.rule == "simulate"]
    of_runs = sum(runs, Cost())
    each = f", {of_runs.ns_per_collision:.0f} ns each" if of_runs.collisions else ""
    parts = f"{of_runs.collisions:.3g} collisions{each}; compile {this.compile_seconds:.0f} s, I/O {this.io_seconds:.0f} s"
    said = f"This build took {_minutes(this.cpu_seconds)} for {len(runs)} runs ({parts})"
    return f"{said}; all that is there cost {_minutes(whole.cpu_seconds)}: {table}"


def _numbers(cost: Cost) -> dict[str, object]:
    seconds = {one.name: f"{getattr(cost, one.name):.3f}" for one in fields(cost) if one.name.endswith("seconds")}
    each = cost.ns_per_collision
    return {**seconds, "collisions": cost.collisions or "", "ns_per_collision": "" if each is None else f"{each:.1f}"}


def _read(path: Path) -> Cost | None:
    """The record of a file; None where there is none that makes sense."""
    try:
        return Cost(**json.loads(path.read_text()))
    except (OSError, ValueError, TypeError):
        return None


def _minutes(seconds: float) -> str:
    return f"{seconds / 60:.1f} CPU min" if seconds >= 60 else f"{seconds:.0f} CPU s"

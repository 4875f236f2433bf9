"""What the main process of a build does around its jobs: one build at a time, kernels ahead, progress, why something failed."""

import fcntl
import os
import re
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Hashable, Iterable, Mapping, Sequence
from pathlib import Path
from types import FrameType
from typing import NamedTuple, TextIO

from granugas.cost import Cost, processor_time, record
from granugas.digest import forget_kernels
from granugas.dynamics.events.effects import modules_of
from granugas.jobs import mark_of
from granugas.scene import Scene
from granugas.storage.damage import DamagedFile, check, is_complete

SKEW = 2.0
"""s by which the clocks of a file server and of this machine may differ."""


class Job(NamedTuple):
    """A job of the workflow: its rule, the files that it makes and its log."""

    rule: str
    outputs: tuple[Path, ...]
    log: Path | None

    def is_built(self, since: float) -> bool:
        """Whether all its files are there, none older than a time in s since the epoch."""
        return all(_is_there(path, since) for path in self.outputs)

    def has_started(self, since: float) -> bool:
        """Whether it wrote into its log after that time."""
        return self.log is not None and _is_there(self.log, since)

    def last_words(self) -> str:
        """The last line of its log, "" where there is none."""
        text = self.log.read_text(errors="replace") if self.log else ""
        lines = [line for line in text.splitlines() if line.strip()]
        return lines[-1].strip() if lines else ""

    def reason(self) -> str:
        """Why it failed: an error is the last line of its log; where there is none, it had no time to say why."""
        said = self.last_words()
        if said and not re.match(r"\d\d:\d\d:\d\d ", said):
            return said
        return f"killed, perhaps for lack of memory; its last words: {said or 'none'}"


def claim(output: str | Path) -> None:
    """Take the folder of the results for this process until it ends, and remove what killed jobs left half written.

    Raises:
        BlockingIOError: another process has it.
        OSError: nothing can be written there.
    """
    output = Path(output)
    output.mkdir(parents=True, exist_ok=True)
    lock = os.open(output / ".lock", os.O_CREAT | os.O_RDWR, 0o644)  # held until the process ends
    fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    for path in output.glob("*/.*.*"):
        if re.fullmatch(r"\..+\.\d+", path.name):
            path.unlink()


def damaged(paths: Iterable[Path]) -> list[Path]:
    """Those of the netCDF files that are there and cannot be trusted; marked ones are read in full, others seen at a glance."""
    return [path for path in paths if path.exists() and not (is_complete(path) and _is_as_written(path))]


def date_now(output: str | Path) -> int:
    """Give files of the results that are dated in the future a date that does not mislead: how many there were.

    Datasets are dated now: what is made from them is made again where it is older, and not at every call. What nothing
    is made from (figures, tables) gets a date before all others, and is made again.
    """
    now = time.time()
    paths = [path for pattern in ("*", "*/*.*") for path in Path(output).glob(pattern) if path.is_file()]
    ahead = [path for path in paths if path.suffix != ".log" and path.stat().st_mtime > now + SKEW]
    for path in ahead:
        date = now if path.suffix == ".nc" else 0.0
        os.utime(path, (date, date))
    return len(ahead)


def pass_on_termination() -> None:
    """Let a SIGTERM that this process gets reach its jobs too: they write their checkpoints and end, nobody waits days."""
    before = signal.getsignal(signal.SIGTERM)

    def pass_on(number: int, frame: FrameType | None) -> None:
        for children in Path("/proc/self/task").glob("*/children"):
            for child in children.read_text().split():
                os.kill(int(child), number)
        if callable(before):
            before(number, frame)

    if sys.platform == "linux":
        signal.signal(signal.SIGTERM, pass_on)


def warm_up(log: str | Path, scenes: Iterable[Scene], processes: int = 1) -> None:
    """Compile the kernels of these scenes in processes of their own, so that jobs that start together find them compiled.

    Kinds of scenes with the same equilibration go to one process, as they share its kernel and much of theirs. No rule does
    this: compiled kernels belong to the machine, not to the results. Where it fails it tries once more without the kernels
    that are there, which may be damaged; where that fails the jobs fail too, and say so in their logs. Where it was killed the
    kernels are not to blame.
    """
    Path(log).parent.mkdir(parents=True, exist_ok=True)
    begun, before = time.perf_counter(), processor_time()
    kinds = [*{_kernels_of(scene): scene for scene in scenes}.values()]
    with open(log, "w") as file:
        _compile_or_begin_anew(kinds, processes, file)
    cpu, wall = processor_time() - before, time.perf_counter() - begun
    record(Path(log), Cost(cpu_seconds=cpu, wall_seconds=wall, compile_seconds=cpu))  # never done: of all builds together


def _kernels_of(scene: Scene) -> Hashable:
    """Equal for scenes that have the same kernels."""
    return scene.dimensions, modules_of(scene)


def _compile_or_begin_anew(kinds: Sequence[Scene], processes: int, log: TextIO) -> None:
    """Compile one scene of each kind; where that fails, forget the kernels that are there and compile all of them."""
    codes = _compile(_dealt(kinds, processes), log)
    if any(-code in (signal.SIGTERM, signal.SIGINT, signal.SIGKILL) for code in codes):
        return
    if any(codes):
        forget_kernels()
        _compile([kinds], log)


def _dealt(kinds: Iterable[Scene], processes: int) -> list[list[Scene]]:
    """Kinds of scenes for each process, those with the same equilibration together, about as many kernels for each."""
    alike: dict[Hashable, list[Scene]] = {}
    for scene in kinds:
        alike.setdefault(_kernels_of(scene.at_start()), []).append(scene)
    shares: list[list[Scene]] = [[] for _ in range(min(processes, len(alike)))]
    kernels = [0] * len(shares)
    for group in sorted(alike.values(), key=len, reverse=True):
        least = kernels.index(min(kernels))
        shares[least] += group
        kernels[least] += len(group) + 2  # the first of a group compiles what they share
    return shares


def _compile(shares: Iterable[Sequence[Scene]], log: TextIO) -> list[int]:
    """Compile the kernels of each share in a process, all at the same time; returns their exit codes."""
    program = (
        "from granugas.jobs import start_lightly; start_lightly()\n"
        "from math import inf; from granugas import Scene, warm_up; warm_up({})"
    )
    told = [f"[Scene(**v) for v in {[scene.as_dict() for scene in share]!r}]" for share in shares]
    commands = [[sys.executable, "-c", program.format(scenes)] for scenes in told]
    started = [subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT) for command in commands]
    return [process.wait() for process in started]


def tell_progress(costs: Mapping[Job, float], since: float, every: float = 30.0) -> None:
    """Say from time to time, from a thread of its own, which share of the expected work is done and how long it takes.

    Args:
        costs: the jobs that count and the work that each is expected to be, in any unit.
        since: start of the build, s since the epoch.
        every: s between two lines.
    """
    threading.Thread(target=_tell, args=(costs, since, every), daemon=True).start()


def wake(waiting: threading.Semaphore, every: float = 1.0) -> None:
    """Let a main thread that waits for jobs look around from time to time (s): a signal may have come just before it slept."""
    threading.Thread(target=_wake, args=(waiting, every), daemon=True).start()


def progress(costs: Mapping[Job, float], since: float, now: float) -> str:
    """One line: jobs done, share of the expected work, time so far and to go."""
    shares = {job: _share(job, since) for job in costs}
    done = sum(costs[job] * share for job, share in shares.items()) / (sum(costs.values()) or 1.0)
    runs = sum(job.is_built(since) for job in costs)
    to_go = f", about {_duration((now - since) * (1 - done) / done)} to go" if done > 0 else ""
    return f"{runs} of {len(costs)} runs, {done:.0%} of the expected work, {_duration(now - since)} so far{to_go}"


def failures(jobs: Iterable[Job], since: float, finals: Sequence[str]) -> str:
    """What a failed build lacks and why, for people.

    Args:
        jobs: all that were to run.
        since: start of the build, s since the epoch.
        finals: beginnings of the names of the rules that make what people want.
    """
    missing = [job for job in jobs if job.outputs and not job.is_built(since)]
    wanted = [f"  {job.outputs[0]}" for job in missing if job.rule.startswith(tuple(finals))]
    failed = [job for job in missing if job.has_started(since)]
    reasons = [f"  {job.rule} {job.outputs[0].stem}: {job.reason()} (log: {job.log})" for job in failed]
    return "\n".join(["Missing or out of date:", *wanted, "Because of:", *reasons])


def _tell(costs: Mapping[Job, float], since: float, every: float) -> None:
    while True:
        time.sleep(every)
        print(progress(costs, since, time.time()), file=sys.stderr, flush=True)


def _wake(waiting: threading.Semaphore, every: float) -> None:
    while True:
        time.sleep(every)
        waiting.release()


def _share(job: Job, since: float) -> float:
    """Of a job that is done, from its files; of one that runs, from the last percentage in its log."""
    if job.is_built(since):
        return 1.0
    percent = re.findall(r"(\d+(?:\.\d+)?) ?%", job.last_words()) if job.has_started(since) else []
    return min(float(percent[-1]) / 100, 1.0) if percent else 0.0


def _is_as_written(path: Path) -> bool:
    """Whether a file has no mark, or has it without reason (a job without memory cannot read either)."""
    mark = mark_of(path)
    if not mark.exists():
        return True
    try:
        check(path)
    except DamagedFile:
        return False
    mark.unlink(missing_ok=True)
    return True


def _is_there(path: Path, since: float) -> bool:
    try:
        return path.stat().st_mtime >= since
    except FileNotFoundError:
        return False


def _duration(seconds: float) -> str:
    for size, unit in ((3600.0, "h"), (60.0, "min")):
        if seconds >= size:
            return f"{seconds / size:.1f} {unit}"
    return f"{seconds:.0f} s"

"""The one door to a simulation: a scene in, a dataset out."""

import logging
import math
import time
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from numbers import Real
from typing import Any

import numpy as np
import xarray as xr

from granugas.arguments import need_integer, need_scene
from granugas.doubts import doubts_after, doubts_before, tell
from granugas.dynamics import Dynamics, engine_of
from granugas.dynamics.events import loop
from granugas.equilibrate import equilibrate, need_start, state_of
from granugas.interruption import Keeper, watched
from granugas.progress import Progress
from granugas.record import FREQUENCY_WINDOW, Record
from granugas.sampling import Limits, Samples, sampling_points, snapshot_times
from granugas.scene import Scene
from granugas.storage.variables import describe

ENDLESS = 2**62
"""In place of a number of collisions that limits nothing."""

logger = logging.getLogger("granugas")


def simulate(
    scene: Scene,
    until: float | Mapping[str, float],
    *,
    seed: int = 0,
    realization: int = 0,
    samples: Mapping[str, Any] | None = None,
    snapshots: Sequence[float] = (),
    state: xr.Dataset | None = None,
    keep_positions: bool = True,
    keep_motion: bool = False,
    max_seconds: float = math.inf,
    max_collisions: int = ENDLESS,
    checkpoint: Keeper | None = None,
    progress: bool = True,
) -> xr.Dataset:
    """Simulate a scene from equilibrium at t = 0.

    Args:
        scene: what is simulated.
        until: the end in s, or {"time": s, "collisions_per_particle": c} with either or both: whichever comes first.
        seed, realization: of the start state; runs that share them start identically, whatever r and t_c are.
        samples: {"spacing": "log" or "linear", "count", "first", "axis": "time" or "collisions"}.
        snapshots: times in s at which all particles are kept.
        state: a start state of `equilibrate`; made if it is not given.
        keep_positions: keep the positions at all sampling times, as `trajectory`, for the clusters.
        keep_motion: keep velocities and numbers of collisions with them, for an animation.
        max_seconds: of wall time, after which the run stops with what it has.
        max_collisions: of pairs, likewise.
        checkpoint: where the run keeps its state from time to time, and goes on if it finds one there, bit for bit as if
            nothing had happened.
        progress: show a bar on a terminal.

    Returns:
        The dataset of the run; storage/variables.py is the table of its variables. Where the run stopped early (inelastic
        collapse, one of several limits), values after `stop_time` are NaN and `stop_reason` says why.

    Raises:
        ValueError: limits, samples or numbers that make no sense, a start state of other disks.
        TypeError: a scene or a start state that is none.
        SceneError: the disks do not fit.
        Interrupted: SIGTERM or Ctrl-C came; the checkpoint is written.
    """
    clock = Clock()
    need_scene(scene)
    for key, value, low in (("seed", seed, 0), ("realization", realization, 0), ("max_collisions", max_collisions, 1)):
        need_integer(key, value, low)
    if not isinstance(max_seconds, Real) or not max_seconds >= 0:
        raise ValueError(f"max_seconds = {max_seconds!r}: allowed is a number >= 0 s")
    limits, times = Limits.of(until), snapshot_times(snapshots)
    points = sampling_points(limits, samples)
    if scene.n_particles == 1 and limits.time is None:
        raise ValueError("until: a single particle never collides; name a time")
    if state is None:
        state = equilibrate(scene, seed=seed, realization=realization, progress=progress)
    need_start(scene, state)
    engine = engine_of(scene, state_of(state, seed, realization))
    tell(doubts := doubts_before(scene, state.attrs, engine.cells, keep_positions))
    first = engine.state()
    record = Record(scene, first, points, times, keep_positions, keep_motion, engine.observe(first))
    stops = _stops(scene.n_particles, limits, points, record, max_collisions)
    saved = checkpoint.load() if checkpoint is not None else None
    if saved is not None:
        engine.restore(_part(saved, "engine"))
        record.go_on(_part(saved, "record"))
        for stop, left in zip(stops, saved["stops_left"], strict=True):
            while len(stop) > left:
                stop.popleft()
        clock.add(saved["spent"])
        logger.info("goes on from a checkpoint at t = %g s", engine.time)

    def kept() -> dict[str, np.ndarray]:
        counts = {"stops_left": np.array([len(stop) for stop in stops]), "spent": clock.spent}
        return _named("engine", engine.arrays) | _named("record", record.kept()) | counts

    bar = Progress(f"N = {scene.n_particles}, r = {scene.restitution:g}", limits.time or math.inf, shown=progress)
    with watched(checkpoint, kept, max_seconds) as enough:
        reason = _run(engine, bar, *stops, enough)
    bar.close()
    if reason in ("max_seconds", "max_collisions"):
        logger.warning("%s reached at t = %g s: the run stops there, NaN after it", reason, engine.time)
    if reason == "inelastic_collapse":
        logger.warning(_collapse_message(engine))
    data = record.dataset()
    data.attrs |= {**state.attrs, **{k: list(v) if isinstance(v, tuple) else v for k, v in scene.as_dict().items()}}
    data["seed"], data["realization"] = seed, realization
    data["events"], data["stop_reason"], data["stop_time"] = engine.collisions, reason, engine.time
    data["wall_time"], data["cpu_time"] = clock.spent
    told = reason in ("max_seconds", "max_collisions", "inelastic_collapse")
    tell(late := doubts_after(data), logging.INFO if told else logging.WARNING)
    data.attrs["warnings"] = "\n".join([*doubts, *late])
    return describe(data)


class Clock:
    """Wall time and processor time since it was made, and of earlier attempts."""

    def __init__(self) -> None:
        self._before = np.zeros(2)
        self._begun = self._now()

    @property
    def spent(self) -> np.ndarray:
        """(2,) in s."""
        return self._before + self._now() - self._begun

    def add(self, spent: np.ndarray) -> None:
        """What an earlier attempt took."""
        self._before = self._before + spent

    @staticmethod
    def _now() -> np.ndarray:
        return np.array([time.perf_counter(), time.process_time()])


def _named(prefix: str, arrays: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    return {f"{prefix}/{name}": values for name, values in arrays.items()}


def _part(saved: Mapping[str, np.ndarray], prefix: str) -> dict[str, np.ndarray]:
    return {name.removeprefix(f"{prefix}/"): values for name, values in saved.items() if name.startswith(f"{prefix}/")}


def _stops(n: int, limits: Limits, points: Samples, record: Record, max_collisions: int) -> tuple[deque, deque]:
    """The stops by time (s) and by number of collisions, each in order: where, and what is done there (text: the end)."""
    times, counts = [], []
    for k, snapshot in enumerate(record.snapshots):
        times.append((FREQUENCY_WINDOW * snapshot, lambda engine, k=k: record.open_window(k, engine.state())))
        times.append((snapshot, lambda engine, k=k: record.take_snapshot(k, engine.state())))

    def sample(engine: Dynamics) -> None:
        state, tally = engine.state(), engine.take_tally()
        record.sample(state, tally, engine.observe(state, tally, state.time - record.time))

    if points.axis == "time":
        times += [(t, sample) for t in points.points]
    else:
        counts += [(math.ceil(c * n / 2), sample) for c in points.points]
    if limits.time is not None:
        times.append((limits.time, "time"))
    if limits.collisions_per_particle is not None:
        counts.append((math.ceil(limits.collisions_per_particle * n / 2), "collisions_per_particle"))
    counts.append((max_collisions, "max_collisions"))
    return tuple(deque(sorted(stops, key=lambda stop: stop[0])) for stops in (times, counts))


def _run(engine: Dynamics, bar: Progress, times: deque, counts: deque, enough: Callable[[Dynamics], bool]) -> str:
    """Go from stop to stop until one of them is the end; returns the reason."""
    while True:
        until = float(times[0][0]) if times else math.inf
        why = bar.follow(engine, until, counts[0][0] - engine.collisions, enough)
        if why == loop.WATCH:
            return "inelastic_collapse"
        if why == loop.EVENTS:
            return "max_seconds"
        if why == loop.TIME and not times:
            return "no_more_events"
        act = (times if why == loop.TIME else counts).popleft()[1]
        if isinstance(act, str):
            return act
        act(engine)
        if enough(engine):
            return "max_seconds"


def _collapse_message(engine: Dynamics) -> str:
    who = engine.involved()
    names = ", ".join(map(str, who[:12])) + (" ..." if len(who) > 12 else "")
    return (
        f"inelastic collapse at t = {engine.time:.9g} s: the time between the collisions of {len(who)} disks ({names}) has "
        "fallen below what numbers resolve, with infinitely many collisions ahead in finite time; the run stops here, NaN "
        "after it. A contact_time > 0 (the TC model) avoids it."
    )

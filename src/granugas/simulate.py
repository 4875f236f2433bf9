"""The one door to a simulation: a scene in, a dataset out."""

import logging
import math
import time
from collections import deque
from collections.abc import Mapping, Sequence
from typing import Any

import xarray as xr

from granugas.dynamics.events import loop
from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import equilibrate, state_of
from granugas.progress import Progress
from granugas.record import FREQUENCY_WINDOW, Record
from granugas.sampling import Limits, Samples, sampling_points
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
        progress: show a bar on a terminal.

    Returns:
        The dataset of the run; storage/variables.py is the table of its variables. Where the run stopped early (inelastic
        collapse, one of two limits), values after `stop_time` are NaN and `stop_reason` says why.

    Raises:
        ValueError: limits or samples that make no sense.
        SceneError: the disks do not fit.
    """
    begun = (time.perf_counter(), time.process_time())
    limits = Limits.of(until)
    points = sampling_points(limits, samples)
    if scene.n_particles == 1 and limits.time is None:
        raise ValueError("until: a single particle never collides; name a time")
    if state is None:
        state = equilibrate(scene, seed=seed, realization=realization, progress=progress)
    engine = Engine(scene, state_of(state))
    record = Record(scene, engine.state(), points, snapshots, keep_positions, keep_motion)
    bar = Progress(f"N = {scene.n_particles}, r = {scene.restitution:g}", limits.time or math.inf, shown=progress)
    reason = _run(engine, bar, *_stops(scene.n_particles, limits, points, record))
    bar.close()
    if reason == "inelastic_collapse":
        logger.warning(_collapse_message(engine))
    data = record.dataset()
    data.attrs |= {**state.attrs, **{k: list(v) if isinstance(v, tuple) else v for k, v in scene.as_dict().items()}}
    data["seed"], data["realization"] = seed, realization
    data["events"], data["stop_reason"], data["stop_time"] = engine.collisions, reason, engine.time
    data["wall_time"], data["cpu_time"] = time.perf_counter() - begun[0], time.process_time() - begun[1]
    return describe(data)


def _stops(n: int, limits: Limits, points: Samples, record: Record) -> tuple[deque, deque]:
    """The stops by time (s) and by number of collisions, each in order: where, and what is done there (None: the end)."""
    times, counts = [], []
    for k, snapshot in enumerate(record.snapshots):
        times.append((FREQUENCY_WINDOW * snapshot, lambda engine, k=k: record.open_window(k, engine.state())))
        times.append((snapshot, lambda engine, k=k: record.take_snapshot(k, engine.state())))
    sample = lambda engine: record.sample(engine.state(), engine.take_tally())  # noqa: E731
    if points.axis == "time":
        times += [(t, sample) for t in points.points]
    else:
        counts += [(math.ceil(c * n / 2), sample) for c in points.points]
    if limits.time is not None:
        times.append((limits.time, None))
    if limits.collisions_per_particle is not None:
        counts.append((math.ceil(limits.collisions_per_particle * n / 2), None))
    return deque(sorted(times, key=lambda stop: stop[0])), deque(counts)


def _run(engine: Engine, bar: Progress, times: deque, counts: deque) -> str:
    """Go from stop to stop until one of them is the end; returns the reason."""
    while True:
        until = float(times[0][0]) if times else math.inf
        most = counts[0][0] if counts else ENDLESS
        why = bar.follow(engine, until, most - engine.collisions)
        if why == loop.WATCH:
            return "inelastic_collapse"
        if why == loop.TIME and not times:
            return "no_more_events"
        act = (times if why == loop.TIME else counts).popleft()[1]
        if act is None:
            return "time" if why == loop.TIME else "collisions_per_particle"
        act(engine)


def _collapse_message(engine: Engine) -> str:
    who = engine.involved()
    names = ", ".join(map(str, who[:12])) + (" ..." if len(who) > 12 else "")
    return (
        f"inelastic collapse at t = {engine.time:.9g} s: the time between the collisions of {len(who)} disks ({names}) has "
        "fallen below what numbers resolve, with infinitely many collisions ahead in finite time; the run stops here. "
        "A contact_time > 0 (the TC model) avoids it."
    )

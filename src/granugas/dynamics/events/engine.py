"""The event-driven engine as Python sees it: a state in, the state at a later time out."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from granugas.dynamics.events import loop
from granugas.dynamics.events import state as layout
from granugas.dynamics.events.calendar import EVENTS_PER_BIN, HEADROOM
from granugas.dynamics.events.effects.collapse import CollapseWatch, collapse_watch
from granugas.dynamics.events.effects.constant import Constant, Elastic
from granugas.dynamics.events.effects.contact_time import ContactTime
from granugas.dynamics.events.effects.elastic_share import SHARES, ElasticShare
from granugas.dynamics.events.effects.elastic_time import TIMES, ElasticTime
from granugas.dynamics.events.effects.nobody import Nobody
from granugas.dynamics.events.memory import Record, Table, allocate
from granugas.dynamics.state import State
from granugas.scene import Scene

CELL_WIDTH = 0.62
"""Wanted width of a cell in units of the mean distance of disks (measured)."""

NARROWEST, WIDEST = 1.002, 3.0
"""Bounds of the wanted width (d): disks in cells that are not neighbours never touch."""

MOST_CELLS = 32_000
"""In one direction: columns and rows are counted in two bytes."""

LARGE = 30_000
"""Above this number of disks the tables outgrow the cache, and looking ahead pays (measured)."""

LOOK_AHEAD = 1
"""Bins between two of its steps (measured)."""

REBASE_AFTER = 100.0
"""The origin of times moves on when a disk has flown so many diameters: its place is still known to 1e-14 d."""


@dataclass(frozen=True)
class Tally:
    """Sums over the collisions of an interval.

    Attributes:
        collisions: number of collisions (each has two partners).
        elastic: those that the TC rule made elastic; one number for each t_c of the scene.
        elastic_time: time that particles were elastic between two collisions, the second one in the interval (s), for each
            t_c of a scene with r = 1; None where nobody adds it up.
        loss: dissipated energy per mass (m^2/s^2).
        loss_time: sum of the losses times the time that was left of the interval (m^2/s).
        stress: (2, 2), sum of dp_a l_b over both partners per mass (m^2/s; A Eq. 15).
    """

    collisions: int
    elastic: np.ndarray
    elastic_time: np.ndarray | None
    loss: float
    loss_time: float
    stress: np.ndarray


class Engine:
    """Event-driven dynamics of one scene.

    `arrays` is the whole state, calendar included: `resume` continues from a copy of it bit for bit. The dynamics do not
    depend on when or how often they are looked at: `advance` stops between two events, and `state` only reads.
    """

    def __init__(self, scene: Scene, state: State, rule: Any = None, watch: Any = None) -> None:
        """Predict all events of a state; `rule` and `watch` replace the effects that the scene calls for."""
        self.scene = scene
        self.box = state.box
        self.rule = rule_of(scene) if rule is None else rule
        self.watch = watch_of(scene) if watch is None else watch
        tables = _arrays(state, scene.diameter)
        self.arrays = tables | _rows_of("rule", self.rule) | _rows_of("watch", self.watch)
        self._gas = layout.bundle(tables, self.rule, self.watch)
        loop.start(self._gas)

    @classmethod
    def resume(cls, scene: Scene, box: tuple[float, float], arrays: dict[str, np.ndarray]) -> "Engine":
        """Continue from a copy of `arrays` as if nothing had happened in between."""
        engine = cls.__new__(cls)
        engine.scene, engine.box = scene, box
        engine.rule, engine.watch = rule_of(scene), watch_of(scene)
        tables = {name: allocate(len(arrays[name]), rows) for name, rows in layout.LAYOUTS.items()}
        engine.arrays = tables | _rows_of("rule", engine.rule) | _rows_of("watch", engine.watch)
        for name, rows in engine.arrays.items():
            rows[:] = arrays[name]
        engine._gas = layout.bundle(tables, engine.rule, engine.watch)
        return engine

    @property
    def time(self) -> float:
        """Time up to which everything has happened, in s."""
        calendar = self._gas.calendar
        return float(calendar.base + (calendar.base_low + calendar.reached))

    @property
    def collisions(self) -> int:
        """Collisions since the engine was made, of pairs."""
        return int(self._gas.tally.taken + self._gas.tally.collisions)

    @property
    def backwards(self) -> int:
        """Events that came out of order of time: always 0."""
        return int(self._gas.calendar.backwards)

    @property
    def bytes_per_particle(self) -> float:
        """Memory of all tables."""
        return sum(rows.nbytes for rows in self.arrays.values()) / self.scene.n_particles

    def advance(self, until: float, most_collisions: int = 2**62, most_events: int = 2**62) -> int:
        """Process all events up to the time `until` (s), or the first so many; returns why it stopped (see loop)."""
        calendar = self._gas.calendar
        calendar.until = (until - calendar.base) - calendar.base_low
        why = loop.run(self._gas, most_collisions, most_events)
        calendar.reached = max(calendar.now, calendar.until) if why == loop.TIME else calendar.now
        return why

    def state(self) -> State:
        """Every disk at the present time."""
        disks, clocks, calendar, grid = (self.arrays[k] for k in ("disks", "clocks", "calendar", "grid"))
        d, base = self.scene.diameter, calendar["base"][0] + calendar["base_low"][0]
        flown = calendar["reached"][0] - disks["t"]
        position = np.empty((len(disks), 2))
        for axis, (x, v, c) in enumerate((("x", "vx", "cx"), ("y", "vy", "cy"))):
            width = grid[f"width_{x}"][0]
            here = disks[x] + disks[v] * flown + (disks[c] + 0.5) * width
            position[:, axis] = np.mod(here * d, self.box[axis])
        position[position >= self.box] = 0.0
        return State(
            time=self.time,
            box=self.box,
            position=position,
            velocity=np.stack([disks["vx"], disks["vy"]], axis=1) * d,
            last_collision_time=clocks["last"] + base,
            last_collision_interval=clocks["interval"].copy(),
            collisions=disks["collisions"].astype(np.int64),
        )

    def take_tally(self) -> Tally:
        """The sums over all collisions since the tally was last taken."""
        t, d2 = self._gas.tally, self.scene.diameter**2
        shares = self.rule.shares.rows["elastic"] if isinstance(self.rule, ElasticShare) else None
        held = self.watch.times.rows["held"] if isinstance(self.watch, ElasticTime) else None
        taken = Tally(
            collisions=int(t.collisions),
            elastic=np.array([t.elastic]) if shares is None else shares.copy(),
            elastic_time=None if held is None else held.copy(),
            loss=float(t.loss) * d2,
            loss_time=float(t.loss * self._gas.calendar.reached - t.loss_time) * d2,
            stress=np.array([[t.xx, t.xy], [t.yx, t.yy]]) * d2,
        )
        done = self.collisions
        self.arrays["tally"][:] = 0
        self.arrays["tally"]["taken"] = done
        for sums in (shares, held):
            if sums is not None:
                sums[:] = 0
        return taken

    def involved(self) -> np.ndarray:
        """Numbers of the disks that took part in a collapse; empty where none was noticed."""
        if not isinstance(self.watch, CollapseWatch):
            return np.empty(0, np.int64)
        seen = self.watch.involved.rows[: self.watch.count.n]
        return np.unique(np.concatenate([seen["i"], seen["j"]])).astype(np.int64)


def rule_of(scene: Scene) -> Any:
    """The collision rule that a scene calls for."""
    times = tuple(sorted(t for t in scene.contact_times if t > 0))
    if scene.restitution == 1 and (isinstance(scene.contact_time, tuple) or times):
        shares = np.zeros(len(scene.contact_times), SHARES)
        shares["t_c"] = sorted(scene.contact_times)
        return ElasticShare(Table(shares), len(shares))
    if scene.restitution == 1:
        return Elastic()
    return ContactTime(float(scene.restitution), times[0]) if times else Constant(float(scene.restitution))


def watch_of(scene: Scene) -> Any:
    """Only disks that dissipate without a contact duration can collapse; elastic ones with one have times to add up."""
    if not any(scene.contact_times):
        return collapse_watch() if scene.restitution < 1 else Nobody()
    if scene.restitution < 1:
        return Nobody()
    times = np.zeros(len(scene.contact_times), TIMES)
    times["t_c"] = sorted(scene.contact_times)
    return ElasticTime(Table(times), len(times))


def _rows_of(role: str, effect: Any) -> dict[str, np.ndarray]:
    """The arrays behind the tables of an effect, which belong to the state of the engine."""
    return {f"{role}.{name}": part.rows for name, part in effect._asdict().items() if isinstance(part, Table | Record)}


def _arrays(state: State, diameter: float) -> dict[str, np.ndarray]:
    """Tables of a state in which nothing is predicted yet."""
    n = len(state.position)
    box = tuple(length / diameter for length in state.box)
    grid = _grid(n, box)
    disks, clocks = allocate(n, layout.DISKS), allocate(n, layout.CLOCKS)
    for axis, (x, v, c) in enumerate((("x", "vx", "cx"), ("y", "vy", "cy"))):
        width, count = grid[f"width_{x}"][0], grid[f"n{x}"][0]
        place = state.position[:, axis] / diameter
        disks[c] = np.clip((place / width).astype(np.int64), 0, count - 1)
        disks[x] = place - (disks[c] + 0.5) * width
        disks[v] = state.velocity[:, axis] / diameter
    disks["collisions"] = state.collisions
    clocks["last"] = state.last_collision_time - state.time
    clocks["interval"] = state.last_collision_interval
    speed = math.sqrt(np.mean(np.sum(state.velocity**2, axis=1))) / diameter
    calendar = _calendar(n, state.time, speed)
    tables = {
        "disks": disks,
        "clocks": clocks,
        "cells": allocate(int(grid["nx"][0] * grid["ny"][0]), layout.CELLS),
        "near": allocate(_most_near(grid), layout.NEAR),
        "grid": grid,
        "schedule": allocate(n, layout.SCHEDULE),
        "bins": allocate(int(calendar["n_bins"][0]) * layout.SLOTS, layout.BINS),
        "heap": allocate(int(calendar["heap_limit"][0]), layout.HEAP),
        "calendar": calendar,
        "tally": allocate(1, layout.TALLY),
    }
    tables["cells"]["head"] = layout.NOBODY
    tables["schedule"]["time"] = math.inf
    return tables


def _grid(n: int, box: tuple[float, float]) -> np.ndarray:
    """Cells wide enough for one disk, and wider in a dilute gas, where leaving a cell costs more than a neighbour."""
    wanted = min(max(CELL_WIDTH * math.sqrt(box[0] * box[1] / n), NARROWEST), WIDEST)
    grid = allocate(1, layout.GRID)
    for x, length in zip("xy", box, strict=True):
        count = min(max(1, int(length / wanted)), MOST_CELLS)
        grid[f"n{x}"] = count
        grid[f"width_{x}"] = length / count
        grid[f"half_{x}"] = length / count / 2
        grid[f"box_{x}"] = length
    return grid


def _most_near(grid: np.ndarray) -> int:
    """More disks than a block of nine cells can hold: the densest packing, with a layer around each cell."""
    cell = (grid["width_x"][0] + 2) * (grid["width_y"][0] + 2)
    return 9 * (int(cell * 2 / math.sqrt(3)) + 2) + 1


def _calendar(n: int, time: float, speed: float) -> np.ndarray:
    """A calendar whose window has just ended, so that the first event opens one; `speed` in d/s."""
    calendar = allocate(1, layout.CALENDAR)
    n_bins = max(64, n // 2)
    width = EVENTS_PER_BIN / (3 * n * speed) if speed > 0 else 1.0  # some three events per diameter flown
    calendar["base"] = time
    calendar["start"] = -(n_bins + 1) * width
    calendar["width"], calendar["rate"] = width, 1 / width
    calendar["bin"] = n_bins - 1
    calendar["n_disks"], calendar["n_bins"] = n, n_bins
    calendar["heap_limit"] = n + n // 4 + 4 * HEADROOM
    calendar["look_ahead"] = LOOK_AHEAD if n > LARGE else 0
    calendar["rebase_after"] = REBASE_AFTER / speed if speed > 0 else math.inf
    return calendar

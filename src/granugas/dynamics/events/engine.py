"""The event-driven engine as Python sees it: a state in, the state at a later time out."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from granugas.dynamics.events import loop
from granugas.dynamics.events import state as layout
from granugas.dynamics.events.cast import effects_of
from granugas.dynamics.events.flight import hastened, moved
from granugas.dynamics.events.memory import Record, Table
from granugas.dynamics.events.tables import tables_of
from granugas.dynamics.state import State
from granugas.scene import Scene


@dataclass(frozen=True)
class Tally:
    """Sums over the collisions of an interval.

    Attributes:
        collisions: number of collisions (each has two partners).
        elastic: those that the TC rule made elastic; one number for each t_c of the scene.
        loss: dissipated energy per mass (m^2/s^2), less what was put in.
        loss_time: sum of the losses times the time that was left of the interval (m^2/s).
        stress: (D, D), sum of dp_a l_b over both partners per mass (m^2/s; A Eq. 15).
        more: sums that effects keep, by name.
        stored, stored_time: as the losses, of translational energy that went over into another kind, such as rotation.
    """

    collisions: int
    elastic: np.ndarray
    loss: float
    loss_time: float
    stress: np.ndarray
    more: dict[str, Any] = field(default_factory=dict)
    stored: float = 0.0
    stored_time: float = 0.0


class Engine:
    """Event-driven dynamics of one scene.

    `arrays` is the whole state, calendar included: `restore` continues from a copy of it bit for bit. The dynamics do not
    depend on when or how often they are looked at: `advance` stops between two events, and `state` only reads.
    """

    def __init__(self, scene: Scene, state: State, **instead: Any) -> None:
        """Predict all events of a state; `rule`, `watch` ... replace effects that the scene calls for, if they are not None.

        An effect that looks at particles beyond those that touch says by `sight` how far (d): the cells are as much wider.
        """
        self.scene = scene
        self.box = state.box
        self.effects = effects_of(scene, state) | {place: effect for place, effect in instead.items() if effect is not None}
        sight = max(getattr(effect, "sight", 0.0) for effect in self._all_effects())
        largest, gained = self.effects["sizes"].largest + sight, scene.speed_gained_2(state.box[-1])
        tables = tables_of(state, scene.diameter, scene.walled, largest, gained)
        self.arrays = tables | {name: rows for place, effect in self.effects.items() for name, rows in _rows_of(place, effect)}
        self._gas = layout.bundle(tables, self.effects)
        loop.start(self._gas)

    def restore(self, arrays: dict[str, np.ndarray]) -> None:
        """Continue from a copy of the `arrays` of an engine of the same scene as if nothing had happened in between."""
        for name, rows in self.arrays.items():
            rows[:] = arrays[name]

    @property
    def rule(self) -> Any:
        """The effect that decides the coefficient of restitution."""
        return self.effects["rule"]

    @property
    def watch(self) -> Any:
        """The effect that looks at every collision."""
        return self.effects["watch"]

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
    def cells(self) -> tuple[int, ...]:
        """Cells along each axis, without the one between two walls in which nobody ever is."""
        return tuple(int(count) - wall for count, wall in zip(self._gas.grid.cells, self.scene.walled, strict=True))

    @property
    def bytes_per_particle(self) -> float:
        """Memory of all tables."""
        return sum(rows.nbytes for rows in self.arrays.values()) / self.scene.n_particles

    def advance(self, until: float, most_collisions: int = 2**62, most_events: int = 2**62) -> int:
        """Process all events up to the time `until` (s), or the first so many; returns why it stopped (see loop)."""
        last, drive = self.collisions + most_collisions, self.effects["drive"]
        while (stop := drive.due(until)) is not None:
            why = self._run(stop, last - self.collisions, most_events)
            if why != loop.TIME:
                return why
            drive.act(self._gas)
            most_events -= self.scene.n_particles  # which is about what it has cost
            if most_events <= 0:
                return loop.EVENTS
        return self._run(until, last - self.collisions, most_events)

    def _run(self, until: float, most_collisions: int, most_events: int) -> int:
        calendar = self._gas.calendar
        calendar.until = self._since_base(until)
        why = loop.run(self._gas, most_collisions, most_events)
        # Not calendar.until: the origin of times may have moved, and a run that stopped in between would have rounded once.
        calendar.reached = max(calendar.now, self._since_base(until)) if why == loop.TIME else calendar.now
        return why

    def _since_base(self, time: float) -> float:
        """A time (s) as the calendar counts it."""
        calendar = self._gas.calendar
        return float((time - calendar.base) - calendar.base_low)

    def state(self) -> State:
        """Every disk at the present time."""
        disks, clocks, calendar, grid = (self.arrays[k] for k in ("disks", "clocks", "calendar", "grid"))
        d, base = self.scene.diameter, calendar["base"][0] + calendar["base_low"][0]
        flown, force = calendar["reached"][0] - disks["t"], self.effects["force"]
        x, v = (tuple(disks[name].T) for name in ("x", "v"))
        here = np.stack(moved(force, x, v, flown), axis=1) + (disks["cell"] + 0.5) * grid["width"][0]
        position = np.where(self.scene.walled, here * d, np.mod(here * d, self.box))
        position[position >= self.box] = 0.0
        more: dict[str, np.ndarray] = {}
        for effect in self._all_effects():
            more |= effect.of_particles(self.scene) if hasattr(effect, "of_particles") else {}
        return State(
            time=self.time,
            box=self.box,
            position=position,
            velocity=np.stack(hastened(force, v, flown), axis=1) * d,
            last_collision_time=clocks["last"] + base,
            last_collision_interval=clocks["interval"].copy(),
            collisions=disks["collisions"].astype(np.int64),
            more=more,
        )

    def take_tally(self) -> Tally:
        """The sums over all collisions since the tally was last taken."""
        t, d2, reached = self.arrays["tally"][0], self.scene.diameter**2, self._gas.calendar.reached
        done, more = self.collisions, {}
        for effect in self._all_effects():
            more |= effect.take(self.scene) if hasattr(effect, "take") else {}
        taken = Tally(
            collisions=int(t["collisions"]),
            elastic=more.pop("elastic", np.array([t["elastic"]])),
            loss=float(t["loss"]) * d2,
            loss_time=float(t["loss"] * reached - t["loss_time"]) * d2,
            stored=float(t["stored"]) * d2,
            stored_time=float(t["stored"] * reached - t["stored_time"]) * d2,
            stress=t["stress"] * d2,
            more=more,
        )
        self.arrays["tally"][:] = np.zeros(1, self.arrays["tally"].dtype)
        self.arrays["tally"]["taken"] = done
        return taken

    def observe(self, state: State, tally: Tally | None = None, interval: float = 0.0) -> dict[str, float]:
        """What effects have to say at a sample, by the names of variables, beside what every scene is asked.

        Args:
            state: now.
            tally: since the sample before; None at the first one.
            interval: between the two samples (s).
        """
        found: dict[str, float] = {}
        for effect in self._all_effects():
            found |= effect.observe(self.scene, state, tally, interval) if hasattr(effect, "observe") else {}
        return found

    def _all_effects(self) -> list[Any]:
        """The effects of all places, and those that they hold."""
        return [part for effect in self.effects.values() for part in _with_held(effect)]

    def involved(self) -> np.ndarray:
        """Numbers of the disks that took part in a collapse; empty where none was noticed."""
        return self.watch.members() if hasattr(self.watch, "members") else np.empty(0, np.int64)


def _with_held(effect: Any) -> list[Any]:
    """An effect and those that it holds."""
    return [effect, *(part for held in effect if hasattr(type(held), "_asdict") for part in _with_held(held))]


def _rows_of(place: str, effect: Any) -> list[tuple[str, np.ndarray]]:
    """The arrays behind the tables of an effect (and of one that it holds), which belong to the state of the engine."""
    found = []
    for name, part in effect._asdict().items():
        if isinstance(part, Table | Record):
            found.append((f"{place}.{name}", part.rows))
        elif hasattr(part, "_asdict"):
            found += _rows_of(f"{place}.{name}", part)
    return found

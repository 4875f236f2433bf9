"""Soft spheres: molecular dynamics of springs with dashpots, the approximate peer of the event-driven engine.

Two particles that overlap by delta push each other apart with f = k delta + gamma d(delta)/dt, matched to the scene: two that
are alone part after t_c with r of their velocity (soft_contact.spring). Nothing is instantaneous, so a particle may be in
several contacts, which the TC model of hard particles mimics (A sections 2 and 3). The step is t_c / `steps_per_contact`.

What hard particles call a collision is a contact that begins. It counts as elastic if one of the partners is in another contact
at that time: where the TC model makes it elastic, although soft contacts dissipate then, too.
"""

import math
from collections.abc import Mapping

import numpy as np

from granugas.dynamics.events.engine import Tally
from granugas.dynamics.events.loop import COLLISIONS, EVENTS, TIME
from granugas.dynamics.events.memory import Record, Table, allocate
from granugas.dynamics.neighbours import PAIRS, grid_of, list_pairs
from granugas.dynamics.on_walls import wall_pressure
from granugas.dynamics.soft_contact import spring, step_of, wall_contact_time
from granugas.dynamics.soft_steps import ENOUGH, LIST, Contact, Gas, layouts, listed, run, start
from granugas.dynamics.state import State
from granugas.scene import Scene

ENDLESS = 2**62

STEPS_PER_EVENT = 30
"""Steps of a particle that cost about what an event of the engine does."""

FAST = 2.5
"""Speed of the fastest particle by the root mean square, about."""

THINNEST, THICKEST = 0.1, 1.0
"""Bounds of the skin of the list of pairs (d)."""


LOOKED = np.dtype([("time", "f8"), ("since", "f8"), ("energy", "f8"), ("collisions", "i8"), ("elastic", "i8"), ("hits", "i8")])
"""The present time; when the tally was last taken, with the elastic energy and the numbers of contacts until then."""


class SoftSpheres:
    """Soft particles as the dynamics of a scene (granugas.dynamics.Dynamics).

    Steps lie on a fixed grid of times, and what is asked between two of them follows from the last one: the dynamics do not
    depend on when or how often they are looked at. A number of collisions may be exceeded by those of one step.
    """

    def __init__(self, scene: Scene, state: State) -> None:
        """Begin with a state; where particles overlap in it, contacts begin."""
        self.scene, self.box, self._begin = scene, state.box, state.time
        n, rows = scene.n_particles, layouts(scene.dimensions)
        self._rows = {name: allocate(n, rows[name]) for name in ("motion", "clocks")}
        self._rows |= {name: allocate(1, rows[name]) for name in ("sums", "now")}
        self._rows |= {"pairs": allocate(2 * n, PAIRS), "looked": allocate(1, LOOKED)}
        motion, clocks, self._looked = self._rows["motion"], self._rows["clocks"], self._rows["looked"][0]
        motion["x"], motion["v"], motion["h"] = state.position, state.velocity, state.velocity
        clocks["last"], clocks["interval"] = state.last_collision_time, state.last_collision_interval
        clocks["collisions"] = state.collisions
        self._looked["time"] = self._looked["since"] = state.time
        self._gas = self._bundle()
        self._gas.sums.pairs = self._list_pairs()
        start(self._gas)
        self._forget_sums()
        self._looked["energy"] = self._elastic_energy(state.position)

    @property
    def time(self) -> float:
        """Up to which everything has happened, in s."""
        return float(self._looked["time"])

    @property
    def collisions(self) -> int:
        """Contacts of pairs that began since it was made."""
        return int(self._gas.sums.collisions)

    @property
    def cells(self) -> tuple[int, ...]:
        """Along each axis."""
        return self._gas.grid.count

    @property
    def arrays(self) -> dict[str, np.ndarray]:
        """The whole state."""
        return self._rows | {"pairs": self._rows["pairs"][: self._gas.sums.pairs]}

    @property
    def bytes_per_particle(self) -> float:
        """Memory of all tables."""
        grid = self._gas.grid
        tables = (*self._rows.values(), *(table.rows for table in (grid.cells, grid.beside, grid.links)))
        return sum(rows.nbytes for rows in tables) / self.scene.n_particles

    def restore(self, arrays: Mapping[str, np.ndarray]) -> None:
        """Continue from a copy of the `arrays` of the same scene as if nothing had happened in between."""
        self._have_room(len(arrays["pairs"]))
        for name, rows in arrays.items():
            self._rows[name][: len(rows)] = rows

    def advance(self, until: float, most_collisions: int = ENDLESS, most_events: int = ENDLESS) -> int:
        """Make all steps up to the time `until` (s), or so many that the given number of collisions or events is reached.

        Returns why it stopped (events/loop.py); STEPS_PER_EVENT steps of a particle count as an event.
        """
        gas = self._gas
        last = math.floor(min((until - self._begin) / gas.dt, ENDLESS))
        some = int(gas.sums.step) + max(1, most_events * STEPS_PER_EVENT // gas.n)
        enough = self.collisions + most_collisions
        while (why := run(gas, min(last, some), enough)) == LIST:
            count = self._list_pairs()  # which may give the gas another table
            gas = self._gas
            listed(gas, count)
        there = why != ENOUGH and gas.sums.step >= last
        self._looked["time"] = max(self.time, until if there and until < math.inf else self._grid_time)
        return TIME if there else COLLISIONS if why == ENOUGH else EVENTS

    def state(self) -> State:
        """Every particle at the present time, by a shortened step on a copy."""
        motion, clocks, dt, since = self._rows["motion"], self._rows["clocks"], self._gas.dt, self._since_step
        velocity = motion["h"] - motion["a"] * (dt / 2)
        position = motion["x"] + velocity * since + motion["a"] * (since**2 / 2)
        inside = np.where(self.scene.walled, position, np.mod(position, self.box))
        inside[inside >= self.box] = 0.0
        return State(
            time=self.time,
            box=self.box,
            position=inside,
            velocity=velocity + motion["a"] * since,
            last_collision_time=clocks["last"].copy(),
            last_collision_interval=clocks["interval"].copy(),
            collisions=clocks["collisions"].copy(),
        )

    def take_tally(self) -> Tally:
        """The sums since the tally was last taken: of forces over time, of contacts that began; `stored`: elastic energy."""
        looked, sums, now = self._looked, self._rows["sums"][0], self._rows["now"][0]
        interval, before = self.time - float(looked["since"]), float(looked["energy"])
        acted = self._acted
        loss = float(sums["loss"] + now["power"] * acted)
        loss_moment = float(sums["loss_time"] + now["power"] * acted * (self.time - acted / 2))
        energy = self._elastic_energy(self.state().position)
        taken = Tally(
            collisions=int(sums["collisions"] - looked["collisions"]),
            elastic=np.array([sums["elastic"] - looked["elastic"]]),
            loss=loss,
            loss_time=loss * self.time - loss_moment,
            stored=energy - before,
            stored_time=float(sums["energy_time"] + now["energy"] * acted) - before * interval,
            stress=sums["stress"] + now["stress"] * acted,
            more={"wall_momentum": sums["momentum"] + now["momentum"] * acted},
        )
        self._forget_sums()
        looked["since"], looked["energy"] = self.time, energy
        looked["collisions"], looked["elastic"] = sums["collisions"], sums["elastic"]
        return taken

    def observe(self, state: State, tally: Tally | None = None, interval: float = 0.0) -> dict[str, float]:
        """Elastic energy, and with walls what these feel, at a sample.

        Args:
            state: now.
            tally: since the sample before; None at the first one.
            interval: between the two samples (s).
        """
        n, unit = self.scene.n_particles, self.scene.n_particles * self.scene.energy_per_mass
        found = {"elastic_energy": self._elastic_energy(state.position) / unit}
        if any(self.scene.walled):
            found["wall_collisions_per_particle"] = float(self._gas.sums.hits / n)
            found["wall_pressure"] = wall_pressure(self.scene, state, tally, interval)
        return found

    def involved(self) -> np.ndarray:
        """Nobody: there is no collapse."""
        return np.empty(0, np.int64)

    @property
    def _grid_time(self) -> float:
        return self._begin + self._gas.sums.step * self._gas.dt

    @property
    def _since_step(self) -> float:
        """Time since the last step (s)."""
        return self.time - self._grid_time

    @property
    def _acted(self) -> float:
        """How long the present forces have acted already: since half a step before the last one (s)."""
        return self._gas.dt / 2 + self._since_step

    def _forget_sums(self) -> None:
        """Let the sums begin now: what they get for the present step is less by what it has done already."""
        sums, now, acted = self._rows["sums"][0], self._rows["now"][0], self._acted
        for name in ("stress", "momentum"):
            sums[name] = -now[name] * acted
        sums["loss"], sums["energy_time"] = -now["power"] * acted, -now["energy"] * acted
        sums["loss_time"] = sums["loss"] * (self.time - acted / 2)

    def _elastic_energy(self, position: np.ndarray) -> float:
        """Of all overlaps, per mass (m^2/s^2)."""
        gas, pairs = self._gas, self._rows["pairs"][: self._gas.sums.pairs]
        apart = position[pairs["j"]] - position[pairs["i"]]
        image = np.array(gas.grid.image)
        apart -= np.where(self.scene.walled, 0.0, np.array(self.box) * np.round(apart / image))
        overlap = np.maximum(gas.d - np.sqrt(np.sum(apart**2, axis=1)), 0.0)
        energy = gas.pair.mass * gas.pair.stiffness * np.sum(overlap**2) / 2
        if gas.any_wall:
            room = np.minimum(position, np.array(self.box) - position)[:, np.array(self.scene.walled)]
            energy += gas.wall.stiffness * np.sum(np.maximum(gas.d / 2 - room, 0.0) ** 2) / 2
        return float(energy)

    def _list_pairs(self) -> int:
        """Make the list anew, with room for all; how many pairs there are."""
        while True:
            gas, room = self._gas, len(self._rows["pairs"])
            if (count := list_pairs(gas.grid, gas.motion, gas.pairs, room)) <= room:
                return count
            self._have_room(count)

    def _have_room(self, count: int) -> None:
        """Let the list have room for so many pairs, and some more."""
        if count > len(self._rows["pairs"]):
            self._rows["pairs"] = allocate(count + count // 4, PAIRS)
            self._gas = self._gas._replace(pairs=Table(self._rows["pairs"]))

    def _bundle(self) -> Gas:
        """What the steps work on."""
        scene, d, n = self.scene, self.scene.diameter, self.scene.n_particles
        dt, skin = step_of(scene), skin_of(scene, self.box)
        tables = {name: Table(self._rows[name]) for name in ("motion", "clocks", "pairs")}
        records = {name: Record(self._rows[name]) for name in ("sums", "now")}
        grid = grid_of(self.box, scene.walled, d + skin, n)
        pair = Contact(*spring(scene.contact_time, scene.restitution), 0.5)
        wall = Contact(*spring(wall_contact_time(scene), scene.wall_restitution), 1.0)
        law = {"n": n, "d": d, "dt": dt, "skin": skin, "begin": self._begin, "pair": pair, "wall": wall}
        return Gas(**law, walled=scene.walled, any_wall=any(scene.walled), grid=grid, **tables, **records)


def skin_of(scene: Scene, box: tuple[float, ...]) -> float:
    """By how much pairs of the list are farther than d (m): where that costs least, in a gas of the first energy.

    A wide skin lets a list last, and puts more pairs into it, about 4 nu of a particle for each d. A list costs about as much
    as the forces of 30 pairs of a particle. No pair may be twice in it, by two images.
    """
    way = 2 * FAST * math.sqrt(2 * scene.energy_per_mass) * step_of(scene) / scene.diameter
    skin = min(max(math.sqrt(30 * way / (4 * scene.area_fraction)), THINNEST), THICKEST) * scene.diameter
    return min([skin, *(side / 2 - scene.diameter for side, wall in zip(box, scene.walled, strict=True) if not wall)])

"""Direct simulation Monte Carlo of dissipative hard disks and spheres (Bird 1994; with Enskog's rate Montanero & Santos 1996).

Time goes in steps, a part of the mean free time. In a step particles collide in cells, whatever their positions inside of
them: each pair at the rate sigma u g / V_c, sigma u being what they sweep over (2 d u in 2D, pi d^2 u in 3D), V_c the volume
of the cell; the line of centres is drawn. Then all fly. A collision is what it is in the engine (A Eqs. 2-4), of partners at
contact: it passes on momentum over d, which is the collisional stress (A Eq. 15) that Enskog's pressure belongs to.

What this knows of the correlations of the particles is g(2a) (A Eq. 17) at the area fraction in the cell. The number n of
particles in a cell fluctuates as that of points does, and g is convex: g(n v/V_c) is too large on average, 3 % at nu = .25 and
41 % at .6 with 40 in a cell. For the powers nu^k in g stand instead

    nu^k (n-2)(n-3)...(n-1-k) / [(N-2)(N-3)...(N-1-k) p^k],    p = 1 / number of cells,

whose mean over points, weighted by the pairs n(n-1), is nu^k for any number of cells and particles. Nothing diverges at close
packing; a cell that holds more than fits counts as full, or as the fullest of a homogeneous gas where that is more.

Nothing excludes a volume: there is neither collapse (who has just collided is no nearer to each other than others in the cell,
whatever r is, so t_c is not needed) nor structure within a cell, and nothing keeps particles from gathering beyond close
packing. In a cell the common velocity does not cool: K depends on the size of the cells as soon as velocities are correlated
(r = .6, nu = .25, tau = 10: K is 25, 9, 3 % above homogeneous cooling with 10, 40, 160 in a cell, that of hard disks 18 %).
A start state of hard particles fills cells more evenly than points do: until they have crossed a cell the rate is some per
cent lower than Enskog's (nu = .25, 40 in a cell: 4 % on average over the first collisions of each).
"""

import math
import os
from collections.abc import Mapping, Sequence

import numpy as np
from numba import config, set_num_threads

from granugas.analysis.enskog import contact_value, enskog_rate
from granugas.dynamics import dsmc_steps as steps
from granugas.dynamics.events.engine import Tally
from granugas.dynamics.events.loop import COLLISIONS, EVENTS, TIME
from granugas.dynamics.events.memory import Record, Table, allocate
from granugas.dynamics.state import State
from granugas.scene import Scene

STEP = 0.5
"""Length of a step, by the mean free time of a homogeneous gas of the present energy."""

SIGMAS = 5
"""A cell may hold the mean number and so many standard deviations, if that is more than fits in."""

SWEPT = {2: 2.0, 3: math.pi}
"""Cross section of a pair, in d^(D-1)."""

COEFFICIENTS = {2: lambda k: 1 + 9 * k / 16, 3: lambda k: (k + 1) * (k + 4) / 4}
"""Of nu^k in g(2a) (A Eq. 17; 3D: Carnahan & Starling)."""

MIXED = {2: ((0, 1),), 3: ((1, 2), (2, 0), (0, 1))}
"""Components of the stress in the table of sums, see steps.mixed."""

RECORDS = ("space", "model", "clock")
"""Tables of one row."""

CHANGING = ("disks", "clocks", "clock", "sums", "lasting")
"""Tables that are not made anew for each step."""

KEY = 0xD5C
"""Tells its random numbers from those of others that follow from the same seed."""


class Dsmc:
    """The method as the dynamics of a scene (granugas.dynamics.Dynamics).

    Steps follow from the start alone. Where somebody looks within one, its collisions up to then are carried out on copies, by
    the same random numbers.
    """

    def __init__(self, scene: Scene, state: State) -> None:
        """Begin with a state."""
        self.scene, self.box = scene, state.box
        self._tables = tables_of(scene, state)
        self._gas = _gas_of(self._tables)
        self._reached = np.array([state.time, 0.0])  # s, and what of it is beyond the last step
        self._taken = _summed(self._tables)  # of the step that is begun, what a tally has already
        self._seen: dict[float, dict[str, np.ndarray]] = {}
        self._go(-math.inf)

    @property
    def arrays(self) -> dict[str, np.ndarray]:
        """The whole state."""
        taken = {f"taken.{name}": rows for name, rows in self._taken.items()}
        return {name: self._tables[name] for name in CHANGING} | {"reached": self._reached} | taken

    def restore(self, arrays: Mapping[str, np.ndarray]) -> None:
        """Continue from a copy of the `arrays` of the same scene as if nothing had happened in between."""
        for name, rows in self.arrays.items():
            rows[:] = arrays[name]
        self._go(-math.inf)

    @property
    def time(self) -> float:
        """Time up to which everything has happened, in s."""
        return float(self._reached[0])

    @property
    def collisions(self) -> int:
        """Collisions since it was made, of pairs."""
        return self._collisions_up_to(self._reached[1])

    @property
    def cells(self) -> tuple[int, ...]:
        """Cells along each axis."""
        return tuple(map(int, self._gas.space.cells))

    @property
    def bytes_per_particle(self) -> float:
        """Memory of all tables."""
        return sum(rows.nbytes for rows in self._tables.values()) / self.scene.n_particles

    def advance(self, until: float, most_collisions: int = 2**62, most_events: int = 2**62) -> int:
        """Go up to the time `until` (s), or by so many collisions or events; returns why it stopped (events/loop.py).

        A step is as long as its collisions and some events for the flight of all. It stops after exactly so many collisions;
        after more only where a step has more of them than particles.
        """
        last, clock = self.collisions + most_collisions, self._gas.clock
        if self.collisions >= last:
            return COLLISIONS
        if until <= self.time:
            return TIME
        while True:
            why = self._go(until, last - self.scene.n_particles - int(clock.collisions), most_events)
            if why == EVENTS:
                return EVENTS
            end = float(min(clock.step, until - clock.time))
            if self._collisions_up_to(end) >= last:
                end = self._when(last, end)
                self._reach(end, float(clock.time + end))
                return COLLISIONS
            if why == TIME:
                if until < math.inf:
                    self._reach(end, until)
                return TIME
            self._go(until, most_events=1)
            most_events -= self.scene.n_particles // steps.COST + 1

    def state(self) -> State:
        """All particles at the present time."""
        now, d = self._look(self._reached[1]), self.scene.diameter
        disks, clocks = (now[name][np.argsort(now["clocks"]["who"])] for name in ("disks", "clocks"))
        position = np.mod((disks["x"] + disks["v"] * self._reached[1]) * d, self.box)
        position[position >= self.box] = 0.0  # what is left of a tiny negative number
        return State(
            time=self.time,
            box=self.box,
            position=position,
            velocity=disks["v"] * d,
            last_collision_time=clocks["last"].copy(),
            last_collision_interval=clocks["interval"].copy(),
            collisions=clocks["collisions"].astype(np.int64),
        )

    def take_tally(self) -> Tally:
        """The sums over all collisions since the tally was last taken."""
        begun, done, taken = _summed(self._look(self._reached[1])), _summed(self._tables), self._taken
        new = {name: done[name] + begun[name] - taken[name] for name in done}
        self._tables["sums"][:], self._tables["lasting"][:] = _zeros(self._tables["sums"]), _zeros(self._tables["lasting"])
        self._gas.clock.taken = self._gas.clock.collisions
        self._taken = begun
        d_2, stress = self.scene.diameter**2, np.diag(new["squares"][0])
        for (a, b), product in zip(MIXED[self.scene.dimensions], new["mixed"][0], strict=True):
            stress[a, b] = stress[b, a] = product
        return Tally(
            collisions=int(new["collisions"][0]),
            elastic=new["elastic"],
            loss=float(new["loss"][0]) * d_2,
            loss_time=float(new["loss"][0] * self.time - new["loss_time"][0]) * d_2,
            stress=stress * d_2,
            more={} if self.scene.dissipates else {"elastic_time": new["held"]},
        )

    def observe(self, state: State, tally: Tally | None = None, interval: float = 0.0) -> dict[str, float]:
        """Nothing beside what every scene is asked."""
        return {}

    def involved(self) -> np.ndarray:
        """Nobody: there is no collapse."""
        return np.empty(0, np.int64)

    def _go(self, until: float, most_collisions: int = 2**62, most_events: int = 2**62) -> int:
        """Whole steps, see steps.go; they end what was looked into."""
        before = int(self._gas.clock.steps)
        with np.errstate(over="ignore"):  # of random numbers, in plain Python
            why = _kernels().go(self._gas, until, most_collisions, most_events)
        if self._gas.clock.steps > before:
            self._reach(0.0, float(self._gas.clock.time))
            self._seen.clear()
        return why

    def _look(self, cut: float) -> dict[str, np.ndarray]:
        """Particles and sums after the collisions of the next step, up to `cut` (s) after its begin; nobody has flown yet."""
        if cut not in self._seen:
            seen = {name: self._tables[name].copy() for name in ("disks", "clocks")}
            seen |= {name: _zeros(self._tables[name]) for name in ("sums", "lasting")}
            if cut > 0:
                with np.errstate(over="ignore"):
                    _kernels().look(self._gas._replace(**{name: Table(rows) for name, rows in seen.items()}), float(cut))
            self._seen = {cut: seen}
        return self._seen[cut]

    def _reach(self, cut: float, time: float) -> None:
        self._reached[:] = time, cut

    def _collisions_up_to(self, cut: float) -> int:
        return int(self._gas.clock.collisions + _summed(self._look(cut))["collisions"][0])

    def _when(self, last: int, end: float) -> float:
        """When (s) in the next step, at the latest at its end, there are so many collisions, or the fewest above it."""
        low, high = self._reached[1], end
        below, above = self._collisions_up_to(low), self._collisions_up_to(high)
        while above > last:
            middle = low + (high - low) * (last - below + 0.5) / (above - below + 1)  # they come evenly
            if not low < middle < high:
                return high
            met = self._collisions_up_to(middle)
            if met < last:
                low, below = middle, met
            else:
                high, above = middle, met
        return high


def threads() -> int:
    """Of a run: OMP_NUM_THREADS, which Snakemake sets to the threads of a job, but no more than there are cores; else 1."""
    asked = os.environ.get("OMP_NUM_THREADS", "1")
    return max(1, min(int(asked), config.NUMBA_NUM_THREADS)) if asked.isdecimal() else 1


def _kernels() -> steps.Kernels:
    if (number := threads()) == 1:
        return steps.ALONE
    set_num_threads(number)
    return steps.SEVERAL


def cells_of(scene: Scene, box: Sequence[float]) -> tuple[int, ...]:
    """Cells along each axis: nearly cubes, with about `particles_per_cell` in each."""
    width = (math.prod(box) * scene.particles_per_cell / scene.n_particles) ** (1 / scene.dimensions)
    return tuple(max(1, round(side / width)) for side in box)


def contact_values(scene: Scene, n_cells: int) -> np.ndarray:
    """What stands for g(2a) in a cell of n particles, for n = 0, 1 ... up to the most that count (see above)."""
    n_all, nu, mean = scene.n_particles, scene.area_fraction, scene.n_particles / n_cells
    if n_cells == 1:
        return np.full(n_all + 1, float(contact_value(nu, scene.dimensions)))
    n = np.arange(min(math.ceil(max(mean / nu, mean + SIGMAS * math.sqrt(mean))), n_all) + 1)
    total, power = np.zeros(len(n)), np.ones(len(n))
    for k in range(len(n)):
        total += COEFFICIENTS[scene.dimensions](k) * power
        power *= nu * np.maximum(n - 2 - k, 0) / (max(n_all - 2 - k, 1) / n_cells)
    return total


def tables_of(scene: Scene, state: State) -> dict[str, np.ndarray]:
    """All tables of a gas, laid out as steps.layouts says."""
    n, dimensions, d = scene.n_particles, scene.dimensions, scene.diameter
    cells = cells_of(scene, state.box)
    n_cells = math.prod(cells)
    groups, several, values = -(-n_cells // steps.TOGETHER), len(scene.contact_times), contact_values(scene, n_cells)
    counts = {"begin": n_cells + 1, "counted": steps.PARTS * n_cells, "energy": steps.PARTS, "rates": len(values)}
    counts |= {"times": several, "sums": groups, "lasting": groups * several, "space": 1, "model": 1, "clock": 1}
    tables = {name: allocate(counts.get(name, n), layout) for name, layout in steps.layouts(dimensions).items()}
    tables["disks"]["x"], tables["disks"]["v"] = state.position / d, state.velocity / d
    clocks, space, model, clock = (tables[name] for name in ("clocks", "space", "model", "clock"))
    clocks["last"], clocks["interval"] = state.last_collision_time, state.last_collision_interval
    clocks["collisions"], clocks["who"] = state.collisions, np.arange(n)
    box = np.array(state.box) / d
    space["box"], space["by_box"], space["by_width"], space["cells"] = box, 1 / box, cells / box, cells
    tables["rates"]["value"] = SWEPT[dimensions] * values * n_cells / np.prod(box)
    tables["times"]["t_c"] = sorted(scene.contact_times)
    for key, value in {"n": n, "n_cells": n_cells, "several": several, "most": len(values) - 1}.items():
        model[key] = value
    model["restitution"] = scene.restitution
    rate = float(enskog_rate(scene.area_fraction, 1.0, 1.0, dimensions))  # at an energy per mass of 1 d^2/s^2
    model["flight"] = STEP / rate * math.sqrt(2 * n)  # by sqrt(sum of v^2)
    clock["time"] = state.time
    clock["key"] = np.random.SeedSequence([*state.seed, KEY]).generate_state(1, np.uint64)
    return tables


def _gas_of(tables: Mapping[str, np.ndarray]) -> steps.Gas:
    return steps.Gas(**{name: (Record if name in RECORDS else Table)(rows) for name, rows in tables.items()})


def _zeros(rows: np.ndarray) -> np.ndarray:
    return np.zeros_like(rows)


def _summed(tables: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Each sum over all cells; those of t_c have a row for each."""
    sums, lasting = tables["sums"], tables["lasting"]
    total = {name: sums[name].sum(axis=0, keepdims=True) for name in sums.dtype.names}
    return total | {name: lasting[name].reshape(len(sums), -1).sum(axis=0) for name in lasting.dtype.names}

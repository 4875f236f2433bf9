"""What a run writes down on its way: one row a sample, all particles at the snapshots."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np
import xarray as xr

from granugas.analysis.enskog import enskog_rate
from granugas.analysis.mixtures import mixture_rate
from granugas.analysis.observables import (
    elastic_energy_fraction,
    elastic_particle_fraction,
    kinetic_energy,
    species_temperature_ratio,
)
from granugas.dynamics.events.engine import Tally
from granugas.dynamics.state import State
from granugas.sampling import Samples
from granugas.scene import Scene

NOTHING: Mapping[str, float] = MappingProxyType({})

FREQUENCY_WINDOW = 0.9
"""collision_frequency counts a particle's collisions from this part of the time of a snapshot to the snapshot."""

VARYING = ("spin",)
"""What effects know of each particle that changes with time: kept at snapshots."""

AXES = "xyz"

SERIES = ("tau", "kinetic_energy", "collisions_per_particle", "collision_rate", "reduced_pressure")
"""Beside the energies along the axes and the components of the stress."""

ELASTIC = (
    "elastic_collisions_per_particle",
    "elastic_collision_fraction",
    "elastic_particle_fraction",
    "elastic_energy_fraction",
)
ELASTIC_ON_AVERAGE = "elastic_particle_time_fraction"
"""Where the engine adds it up: for elastic disks with contact times."""


class Record:
    """Arrays that fill as the run goes on; what it does not reach stays NaN."""

    def __init__(
        self,
        scene: Scene,
        start: State,
        points: Samples,
        snapshots: Sequence[float],
        keep_positions: bool,
        keep_motion: bool = False,
        observed: Mapping[str, float] = NOTHING,
    ) -> None:
        """Take the sample at t = 0. `snapshots` in s; every sample keeps the positions, and the motion, if told so."""
        self._scene, self._points = scene, points
        self._contact_times = np.array(sorted(scene.contact_times))
        self.snapshots = np.array(sorted(snapshots), dtype=float)
        count, n, dimensions = len(points.points) + 1, scene.n_particles, scene.dimensions
        self._axes = AXES[:dimensions]
        on_average = (ELASTIC_ON_AVERAGE,) if scene.one_trajectory and self._contact_times.any() else ()
        self._time = np.full(count, np.nan)
        along = (f"kinetic_energy_{axis}" for axis in self._axes)
        self._pairs = {f"collisional_stress_{a}{b}": (i, j) for i, a in enumerate(self._axes) for j, b in enumerate(self._axes)}
        self._series = {name: np.full(count, np.nan) for name in (*SERIES, *along, *self._pairs)}
        self._elastic = {name: np.full((count, len(self._contact_times)), np.nan) for name in (*ELASTIC, *on_average)}
        self._trajectory = {"trajectory": np.full((count, n, dimensions), np.nan)} if keep_positions else {}
        if keep_motion:
            self._trajectory["trajectory_velocity"] = np.full((count, n, dimensions), np.nan, np.float32)
            self._trajectory["trajectory_collisions"] = np.full((count, n), -1, np.int32)
        several = len(self.snapshots)
        self._particles = {
            "position": np.full((several, n, dimensions), np.nan),
            "velocity": np.full((several, n, dimensions), np.nan),
            "last_collision_time": np.full((several, n), np.nan),
            "last_collision_interval": np.full((several, n), np.nan),
            "collision_frequency": np.full((several, n), np.nan),
            **{name: np.full((several, *start.more[name].shape), np.nan) for name in VARYING if name in start.more},
        }
        self._windows = {"time": np.full(several, np.nan), "collisions": np.zeros((several, n), np.int64)}
        self._start, self._mass = start, start.more.get("mass")
        self._energy = float(kinetic_energy(start.velocity, self._mass).sum())
        self._rate = _rate_of(scene, start, self._energy / n)
        self._done = 0
        self._sums = {
            "collisions": np.zeros((), np.int64),
            "elastic_collisions": np.zeros(len(self._contact_times), np.int64),
            "elastic_so_far": np.zeros(len(self._contact_times)),
        }
        self._write(start, observed)

    def kept(self) -> dict[str, np.ndarray]:
        """All that is written so far: what `go_on` takes."""
        rows = {name: values[: self._done] for name, values in self._rows().items()}
        return rows | self._of_snapshots() | {"done": np.array(self._done)} | self._sums

    def go_on(self, kept: Mapping[str, np.ndarray]) -> None:
        """Take over what another record had written; both must be of the same run."""
        self._done = int(kept["done"])
        for name in kept.keys() - self._rows().keys() - self._of_snapshots().keys() - self._sums.keys() - {"done"}:
            self._series[name] = np.full(len(self._time), np.nan)  # what effects observe
        for name, values in self._rows().items():
            values[: self._done] = kept[name]
        for name, values in (self._of_snapshots() | self._sums).items():
            values[...] = kept[name]

    def _rows(self) -> dict[str, np.ndarray]:
        """What has a row a sample."""
        return {"time": self._time} | self._series | self._elastic | self._trajectory

    def _of_snapshots(self) -> dict[str, np.ndarray]:
        windows = {f"window_{name}": values for name, values in self._windows.items()}
        return windows | {f"snapshot_{name}": values for name, values in self._particles.items()}

    @property
    def time(self) -> float:
        """Of the last sample (s)."""
        return float(self._time[self._done - 1])

    def sample(self, state: State, tally: Tally, observed: Mapping[str, float] = NOTHING) -> None:
        """Write one row: the state at a sampling point, what happened since the one before, and what effects observe."""
        k, n = self._done, self._scene.n_particles
        dt = state.time - self.time
        self._sums["collisions"] += tally.collisions
        self._sums["elastic_collisions"] += tally.elastic
        so_far = self._sums["elastic_so_far"].copy()
        self._write(state, observed)
        if dt > 0:
            gone, gone_time = tally.loss + tally.stored, tally.loss_time + tally.stored_time
            energy = kinetic_energy(state.velocity, self._mass).sum() + gone - gone_time / dt  # mean over the interval
            if self._scene.fed:  # as if what was gained came evenly over the interval
                before = self._series["kinetic_energy"][k - 1] * self._energy
                energy -= (kinetic_energy(state.velocity, self._mass).sum() + gone - before) / 2
            stress = -tally.stress / (energy * dt)  # A Eq. 15, times V/E
            self._series["collision_rate"][k] = 2 * tally.collisions / (n * dt)
            self._series["reduced_pressure"][k] = 1 + np.trace(stress) / 2
            for name, pair in self._pairs.items():
                self._series[name][k] = stress[pair]
            if "elastic_time" in tally.more:
                since_before = tally.more["elastic_time"] + self._sums["elastic_so_far"] - so_far
                self._elastic[ELASTIC_ON_AVERAGE][k] = since_before / (n * dt)
        if tally.collisions > 0:
            self._elastic["elastic_collision_fraction"][k] = tally.elastic / tally.collisions

    def open_window(self, k: int, state: State) -> None:
        """Begin to count the collisions for the collision frequency of snapshot k."""
        self._windows["time"][k], self._windows["collisions"][k] = state.time, state.collisions

    def take_snapshot(self, k: int, state: State) -> None:
        """Keep all particles for snapshot k."""
        began, counted, keep = self._windows["time"][k], self._windows["collisions"][k], self._particles
        keep["position"][k], keep["velocity"][k] = state.position, state.velocity
        keep["last_collision_time"][k] = state.last_collision_time
        keep["last_collision_interval"][k] = state.last_collision_interval
        for name in VARYING:
            if name in keep:
                keep[name][k] = state.more[name]
        if state.time > began:  # at t = 0 there is none
            keep["collision_frequency"][k] = (state.collisions - counted) / (state.time - began)

    def dataset(self) -> xr.Dataset:
        """All that was written, without the attributes of the variables."""
        several = isinstance(self._scene.contact_time, tuple)
        by_time = self._points.axis == "time"
        data = xr.Dataset(
            {name: ("time", values) for name, values in self._series.items()},
            coords={
                "time": np.concatenate([[0.0], self._points.points]) if by_time else np.arange(len(self._time)),
                "snapshot": self.snapshots,
                "axis": list(self._axes),
            },
            attrs={
                **{f"box_{axis}": side for axis, side in zip(self._axes, self._start.box, strict=True)},
                "frequency_window": f"from {FREQUENCY_WINDOW} of the time of the snapshot to the snapshot",
            },
        )
        if not by_time:
            data["sampling_time"] = ("time", self._time)
        if several:
            data = data.assign_coords(contact_time=self._contact_times)
        for name, values in self._elastic.items():
            data[name] = (("time", "contact_time"), values) if several else ("time", values[:, 0])
        for name, values in self._particles.items():
            data[name] = (("snapshot", "particle", "axis")[: values.ndim], values)
        if "y" in self._axes:
            data["initial_y"] = ("particle", self._start.position[:, 1])
        data["enskog_rate"] = self._rate
        for name in ("diameter", "mass"):
            if name in self._start.more:
                data[f"particle_{name}"] = ("particle", self._start.more[name])
        for name, values in self._trajectory.items():
            data[name] = (("time", "particle", "axis")[: values.ndim], values)
        return data

    def _write(self, state: State, observed: Mapping[str, float]) -> None:
        """Write what the state alone says, and what effects observe, into the next row."""
        k, n = self._done, self._scene.n_particles
        along = kinetic_energy(state.velocity, self._mass) / self._energy
        self._time[k] = state.time
        self._series["tau"][k] = state.time * self._rate
        self._series["kinetic_energy"][k] = sum(along)
        for axis, share in zip(self._axes, along, strict=True):
            self._series[f"kinetic_energy_{axis}"][k] = share
        if self._mass is not None:
            observed = {**observed, "species_temperature_ratio": species_temperature_ratio(state.velocity, self._mass)}
        for name, value in observed.items():
            self._series.setdefault(name, np.full(len(self._time), np.nan))[k] = value
        self._series["collisions_per_particle"][k] = 2 * self._sums["collisions"] / n
        self._elastic["elastic_collisions_per_particle"][k] = 2 * self._sums["elastic_collisions"] / n
        instant = (state.last_collision_time, state.time, self._contact_times)
        self._elastic["elastic_particle_fraction"][k] = elastic_particle_fraction(*instant)
        self._elastic["elastic_energy_fraction"][k] = elastic_energy_fraction(state.velocity, *instant, self._mass)
        if ELASTIC_ON_AVERAGE in self._elastic:  # how long the particles were elastic since their last collisions
            since = state.time - state.last_collision_time
            self._sums["elastic_so_far"][:] = np.minimum(since, self._contact_times[:, np.newaxis]).sum(axis=1)
        now = {"trajectory": state.position, "trajectory_velocity": state.velocity, "trajectory_collisions": state.collisions}
        for name, values in self._trajectory.items():
            values[k] = now[name]
        self._done += 1


def _rate_of(scene: Scene, start: State, energy_per_mass: float) -> float:
    """Enskog's collision rate of a particle in 1/s."""
    if "diameter" in start.more:
        return mixture_rate(scene.area_fraction, energy_per_mass, start.more["diameter"], scene.dimensions)
    return float(enskog_rate(scene.area_fraction, energy_per_mass, scene.diameter, scene.dimensions))

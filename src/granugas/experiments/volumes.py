"""Pressure in test volumes of several sizes, averaged over several times, in equilibrium and among clusters (A section 5.1)."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import xarray as xr

from granugas.analysis.observables import kinetic_energy
from granugas.analysis.stress import Volumes, collisional_stress, kinetic_stress, pressure
from granugas.benchmark import always_contact_time
from granugas.dynamics.events import loop
from granugas.dynamics.events.effects.contacts import Contacts, contacts, take
from granugas.dynamics.events.engine import Engine, Tally
from granugas.dynamics.state import State
from granugas.equilibrate import equilibrate, state_of
from granugas.scene import Scene

CLUSTERS = Scene(5740, 0.226725, restitution=0.4, contact_time=1e-5, lattice="triangular")
ELASTIC = replace(CLUSTERS, restitution=1.0, contact_time=0.0)
SEED = 1998

RECORDS = {ELASTIC: (0.0, 0.1), CLUSTERS: (0.5, 0.4)}
"""When the record of a gas begins and how long it is (s): some forty collisions a particle; clusters at tau = 220."""

SIDES = (1, 2, 4, 8, 16)
"""Test volumes along each side of the box."""

STEPS, AVERAGED = 64, (1, 4, 16, 64)
"""Of a record, and of one average."""

MAP_SIDE, MAP_STEPS = 16, 4
"""Volumes along a side and steps of the map of the pressure."""

MAPPED = slice(STEPS // 2, STEPS // 2 + MAP_STEPS)
"""Its steps."""

SERIES_SIDE = 8
"""Volumes along a side for the series in time."""

ROOM = 50_000
"""Collisions that are kept before they are taken."""


FULL, SMALL = 4, 2
"""Realizations of each gas."""


def measure(realizations: int = FULL) -> xr.Dataset:
    """Pressures by those of an ideal gas of the whole box, P V/E, E without the motion as a whole, averaged over the record.

    Returns:
        Dataset over restitution (1: equilibrium), realization, and test_volumes = V/V_c: kinetic_pressure,
        streaming_pressure and collisional_pressure, means of the volumes; with averaging_interval (by the record's length)
        too: pressure_spread, the standard deviation of the kinetic and collisional pressure over the volumes by their mean,
        root mean square over time; interval_collisions of a particle. tally_pressure is the engine's own collisional
        pressure of the box. pressure_map (map_row, map_column) with the positions in its middle, and pressure_series
        (series_step) of the volume with the highest pressure. record_begin and record_length in s.
    """
    gases = [xr.concat([_summary(scene, _record(scene, k)) for k in range(realizations)], "realization") for scene in RECORDS]
    return xr.concat(gases, "restitution", combine_attrs="override")


def follow(engine: Engine, until: float) -> np.ndarray:
    """Let an engine that watches contacts run to `until` (s); the contacts (n,) on the way, as `contacts.SEEN`."""
    watch: Contacts = engine.watch
    taken = []
    while engine.advance(until) == loop.WATCH:
        taken.append(take(watch))
    return np.concatenate([*taken, take(watch)])


def pressures(volumes: Volumes, state: State, seen: np.ndarray, d: float, interval: float) -> np.ndarray:
    """Kinetic and streaming pressure of a state, and collisional of the contacts `seen` in an interval (s): (3, m) in s^-2."""
    contact, normal = np.stack([seen["x"], seen["y"]], axis=1) * d, np.stack([seen["nx"], seen["ny"]], axis=1)
    kinetic, streaming = kinetic_stress(volumes, state.position, state.velocity)
    return pressure([kinetic, streaming, collisional_stress(volumes, contact, normal, seen["dp"] * d, d, interval)])


def spread(values: np.ndarray, steps: int) -> float:
    """Standard deviation over the volumes by their mean, of averages over so many steps; root mean square over time.

    Args:
        values: (STEPS, m).
        steps: of an average, a divisor of STEPS.
    """
    averages = values.reshape(-1, steps, values.shape[1]).mean(axis=1)
    return float(np.sqrt(np.mean((averages.std(axis=1) / averages.mean(axis=1)) ** 2)))


class Record(NamedTuple):
    """What is kept of one gas.

    Attributes:
        box: (Lx, Ly) in m.
        parts: for each of SIDES the kinetic, streaming and collisional pressure in each step, (3, STEPS, m), in s^-2.
        energy: kinetic energy by mass, mean of the steps, in m^2/s^2.
        position: (n, 2) in m, in the middle of the map's time.
        tally: of the engine, over the whole record.
    """

    box: tuple[float, float]
    parts: list[np.ndarray]
    energy: float
    position: np.ndarray
    tally: Tally


def _record(scene: Scene, realization: int) -> Record:
    """One realization; the elastic gas and the clusters begin alike, and have one kernel."""
    begin, duration = RECORDS[scene]
    start = state_of(equilibrate(CLUSTERS, seed=SEED, realization=realization))
    engine = Engine(scene, start, rule=always_contact_time(scene), watch=contacts(ROOM))
    follow(engine, begin)
    engine.take_tally()
    cuts = [Volumes(engine.box, side, side) for side in SIDES]
    parts, energy = [np.empty((3, STEPS, cut.count)) for cut in cuts], np.empty(STEPS)
    for k in range(STEPS):
        seen, state = follow(engine, begin + duration * (k + 1) / STEPS), engine.state()
        energy[k] = kinetic_energy(state.velocity).sum()
        for cut, part in zip(cuts, parts, strict=True):
            part[:, k] = pressures(cut, state, seen, scene.diameter, duration / STEPS)
        if k + 1 == MAPPED.start + MAP_STEPS // 2:
            position = state.position
    return Record(engine.box, parts, energy.mean(), position, engine.take_tally())


def _summary(scene: Scene, record: Record) -> xr.Dataset:
    """What `measure` tells of one gas."""
    begin, duration = RECORDS[scene]
    area, steps = record.box[0] * record.box[1], np.array(AVERAGED)
    reduced = [part * area / record.energy for part in record.parts]  # pressure is linear in the stress, so averages are too
    kinetic, streaming, collisional = np.array([part.mean(axis=(1, 2)) for part in reduced]).T
    total = {side: part[0] + part[2] for side, part in zip(SIDES, reduced, strict=True)}
    spreads = [[spread(values, k) if side > 1 else np.nan for k in AVERAGED] for side, values in total.items()]
    series = total[SERIES_SIDE]
    return xr.Dataset(
        {
            "kinetic_pressure": ("test_volumes", kinetic),
            "streaming_pressure": ("test_volumes", streaming),
            "collisional_pressure": ("test_volumes", collisional),
            "tally_pressure": -np.trace(record.tally.stress) / 2 / duration / record.energy,
            "pressure_spread": (("test_volumes", "averaging_interval"), spreads),
            "interval_collisions": ("averaging_interval", 2 * record.tally.collisions / scene.n_particles * steps / STEPS),
            "pressure_map": (("map_row", "map_column"), total[MAP_SIDE][MAPPED].mean(axis=0).reshape(MAP_SIDE, MAP_SIDE)),
            "pressure_series": ("series_step", series[:, series.mean(axis=0).argmax()]),
            "position": (("particle", "axis"), record.position),
            "record_begin": begin,
            "record_length": duration,
        },
        {
            "restitution": scene.restitution,
            "test_volumes": np.array(SIDES) ** 2,
            "averaging_interval": steps / STEPS,
            "axis": ["x", "y"],
        },
        {"box_x": record.box[0], "box_y": record.box[1], "diameter": scene.diameter, "n_particles": scene.n_particles},
    )

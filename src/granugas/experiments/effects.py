"""Each effect and model in a short run: what it conserves, one number against theory, and how long its code is."""

import ast
import io
import math
import tokenize
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import xarray as xr

from granugas.analysis import theory
from granugas.digest import SOURCES
from granugas.dynamics import Dynamics
from granugas.dynamics.state import State
from granugas.experiments.effects_checks import (
    HOT,
    PLAIN,
    G,
    Measured,
    begun,
    bouncing_ball,
    company,
    contact_distance,
    contact_time,
    cooling,
    elastic_particles,
    energy,
    equipartition,
    fed_and_lost,
    for_each_particle,
    heating,
    impact_on_a_cluster,
    internal_modes,
    kick,
    plastic_cooling,
    pressure,
    pressure_of_spheres,
    rough_temperatures,
    rubbing,
    viscoelastic_cooling,
    walls,
)
from granugas.scene import Scene

LOSSY = {"restitution": 0.95}
_KICKED = {"restitution": 0.99, "kick_velocity": 0.3}


class Plan(NamedTuple):
    """How much is measured.

    Attributes:
        collisions: of a particle, in the runs whose conserved quantities are measured.
        length: of the checks against theory, by their full length.
        names: of the rows that are measured, None: all; each has a kernel of its own to compile.
    """

    collisions: float
    length: float
    names: tuple[str, ...] | None = None


FEW = ("elastic disks", "constant restitution", "contact duration", "walls", "log-normal disks", "spheres (three dimensions)")
"""Rows for a preview, of kernels that its runs have anyway."""

FULL, SMALL = Plan(30.0, 1.0), Plan(5.0, 0.05, FEW)


# --- what is conserved ----------------------------------------------------------------------------------------------------


def conservation(scene: Scene, collisions: float) -> Measured:
    """Drift of the momentum by N v_rms, along axes without walls, and of all energy that is there, was lost or put in."""
    engine = begun(scene)
    before = engine.state()
    energy_before = _all_energy(engine, before, engine.observe(before))
    for_each_particle(engine, collisions)
    after, tally = engine.state(), engine.take_tally()
    observed = engine.observe(after, tally, after.time)
    given = observed.get("floor_energy", 0.0) * scene.n_particles * scene.energy_per_mass
    balance = _all_energy(engine, after, observed) + tally.loss - given - energy_before
    return drift(before, after, ~np.array(scene.walled)), abs(balance) / energy(before)


def drift(before: State, after: State, along: np.ndarray) -> float:
    """Of the momentum along axes, by N v_rms at the beginning; NaN where there is no such axis."""
    mass = before.more.get("mass", np.ones(len(before.position)))
    change = abs(mass @ (after.velocity - before.velocity))[along]
    return float(change.max() / math.sqrt(2 * energy(before) * mass.sum())) if len(change) else math.nan


def _all_energy(engine: Dynamics, state: State, observed: dict[str, float]) -> float:
    kept = sum(observed.get(name, 0.0) for name in ("rotational_energy", "internal_energy", "potential_energy"))
    return energy(state) + kept * engine.scene.n_particles * engine.scene.energy_per_mass


# --- the table ------------------------------------------------------------------------------------------------------------


class Row(NamedTuple):
    """One effect.

    Attributes:
        name: in words.
        scene: that has it.
        check: measures one number and says what theory expects.
        theory: how far off theory itself may be, by its value.
        error: three standard errors of a check of full length, by its value.
        files: modules that are this effect and nothing else, below granugas; effects by their name.
    """

    name: str
    scene: Scene
    check: Callable[[Scene, float], Measured]
    theory: float
    error: float
    files: tuple[str, ...]


def _balanced_kick() -> float:
    """Largest energy of a kick with which K stays 1: slow partners get half of it on average, a collision takes
    (1 - r^2) kT, and u_n^2 / 4kT is distributed exponentially."""
    r, v = _KICKED["restitution"], _KICKED["kick_velocity"]
    return 2 * (1 - r**2) * HOT / -math.expm1(-((v / r) ** 2) / (4 * HOT))


def _balanced_heating() -> float:
    """Heating with which Maxwellian velocities would keep K = 1."""
    rate = float(theory.enskog_rate(PLAIN.area_fraction, PLAIN.energy_per_mass, PLAIN.diameter))
    return (1 - LOSSY["restitution"] ** 2) / 2 * rate * HOT


def _plain(**keys: object) -> Scene:
    return replace(PLAIN, **keys)


_TC = {**LOSSY, "contact_time": 2e-5}
_TIMES = (1e-6, 1e-5, 1e-4)
_ALPHA = {"contact_time_exponent": 1.0, "contact_velocity": 0.5}
_VISCOELASTIC = {"material": "viscoelastic", "viscosity": 0.1}
_PLASTIC = {"material": "plastic", "yield_velocity": 0.4}
_WALL = {"boundary": "periodic wall", "gravity": G}
_FALL = {**_WALL, "restitution": 0.95, "wall_restitution": 0.95}
_FLOOR = {"floor": "harmonic", "floor_amplitude": 5e-4, "floor_frequency": 50.0}
_SHAKEN = {**_WALL, **_FLOOR, "restitution": 0.9, "wall_restitution": 0.9, "contact_time": 1e-5, "wall_contact_time": 1e-5}

ROWS = (
    Row("elastic disks", PLAIN, pressure, 0.001, 0.001, ("constant",)),
    Row("constant restitution", _plain(**LOSSY), cooling, 0.01, 0.005, ("hard", "collapse")),
    Row("contact duration", _plain(**_TC), contact_time, 0.01, 0.03, ("contact_time",)),
    Row("elastic shares", _plain(contact_time=_TIMES), elastic_particles, 0.005, 0.005, ("elastic_share", "elastic_time")),
    Row("critical distance", _plain(**LOSSY, critical_distance=1e-5), company, 0.02, 0.02, ("critical_distance",)),
    Row("contact duration of velocity", _plain(**_TC, **_ALPHA), contact_distance, 0.02, 0.03, ("contact_time_of_velocity",)),
    Row("viscoelastic", _plain(**LOSSY, **_VISCOELASTIC), viscoelastic_cooling, 0.015, 0.01, ("viscoelastic",)),
    Row("plastic", _plain(**LOSSY, **_PLASTIC), plastic_cooling, 0.04, 0.01, ("plastic",)),
    Row("random rotation", _plain(**LOSSY, rotation_angle=5.0), cooling, 0.01, 0.01, ("rotation",)),
    Row("energy kicks of slow partners", _plain(**_KICKED, kick_energy=_balanced_kick()), kick, 0.03, 0.01, ("kick",)),
    Row("internal modes", _plain(restitution=0.5, internal_modes=2), internal_modes, 0.005, 0.01, ("internal_modes",)),
    Row("LRV beads", _plain(**LOSSY, dimensions=1, lrv_velocity=0.05), impact_on_a_cluster, 1e-12, 0.0, ("dynamics.lrv",)),
    Row("walls", _plain(boundary="periodic wall"), walls, 0.01, 0.015, ("walls",)),
    Row("walls, gravity", _plain(**_FALL), bouncing_ball, 1e-5, 0.0, ("gravity",)),
    Row("walls, gravity, vibrated floor", _plain(**_SHAKEN), fed_and_lost, 0.0, 0.015, ("vibrated_floor",)),
    Row("bidisperse disks", _plain(sizes="bidisperse", size_share=0.3), equipartition, 0.005, 0.01, ("unequal",)),
    Row("log-normal disks", _plain(sizes="log_normal"), pressure, 0.005, 0.002, ("unequal",)),
    Row("rough disks", _plain(**LOSSY, tangential_restitution=0.5), rough_temperatures, 0.08, 0.01, ("rough",)),
    Row("rough disks, friction", _plain(**LOSSY, tangential_restitution=0.5, friction=0.2), rubbing, 0.01, 0.03, ("rough",)),
    Row("random kicks (driving)", _plain(**LOSSY, heating=_balanced_heating()), heating, 0.03, 0.02, ("kicks",)),
    Row("beads (one dimension)", _plain(dimensions=1), pressure, 1e-4, 5e-4, ("lattices.line",)),
    Row("spheres (three dimensions)", _plain(dimensions=3), pressure_of_spheres, 0.002, 0.002, ("lattices.space",)),
)


def measure(plan: Plan = FULL) -> xr.Dataset:
    """All rows of the plan.

    Returns:
        Dataset over effect: scene_keys and check in words, momentum_drift and energy_balance; measured, expected and allowed
        of the check, where allowed is the largest difference of the two; code_lines.
    """
    wanted = [row for row in ROWS if plan.names is None or row.name in plan.names]
    rows = [measure_row(row, plan) for row in wanted]
    names = {"effect": [row.name for row in wanted]}
    return xr.Dataset({name: ("effect", [row[name] for row in rows]) for name in rows[0]}, names)


def measure_row(row: Row, plan: Plan) -> dict[str, object]:
    """One row, by the names of the variables."""
    momentum, balance = conservation(row.scene, plan.collisions)
    measured, expected = row.check(row.scene, plan.length)
    return {
        "scene_keys": keys_of(row.scene),
        "check": " ".join(row.check.__doc__.split()).removesuffix("."),
        "momentum_drift": momentum,
        "energy_balance": balance,
        "measured": float(measured),
        "expected": float(expected),
        "allowed": abs(expected) * (row.theory + row.error / math.sqrt(plan.length)),
        "code_lines": sum(map(code_lines, row.files)),
    }


def keys_of(scene: Scene) -> str:
    """What a scene names beyond elastic disks."""
    plain = PLAIN.as_dict()
    named = {key: value for key, value in scene.as_dict().items() if value != plain[key]}
    return ", ".join(f"{key}: {value:.6g}" if isinstance(value, float) else f"{key}: {value}" for key, value in named.items())


def code_lines(name: str) -> int:
    """Lines of a module that hold code: no blank ones, no comments, no docstrings."""
    file = SOURCES.joinpath(*(name.split(".") if "." in name else ("dynamics", "events", "effects", name)))
    text = file.with_suffix(".py").read_text()
    without = (tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT, tokenize.ENDMARKER)
    tokens = [token for token in tokenize.generate_tokens(io.StringIO(text).readline) if token.type not in without]
    code = {line for token in tokens for line in range(token.start[0], token.end[0] + 1)}
    return len(code - _docstrings(ast.parse(text)))


def _docstrings(tree: ast.Module) -> set[int]:
    """Lines of all texts that stand alone: docstrings, also those of names."""
    alone = [node for node in ast.walk(tree) if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)]
    return {line for node in alone if isinstance(node.value.value, str) for line in range(node.lineno, node.end_lineno + 1)}

"""Every collision model from one start state, and where each ends in a collapse (A section 3)."""

from dataclasses import replace
from functools import cache
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from granugas.analysis.clusters import find_clusters
from granugas.equilibrate import equilibrate
from granugas.scene import Scene
from granugas.simulate import simulate
from granugas.warm_up import warm_up

GAS = Scene(1435, 0.226725, restitution=0.4, contact_time=0.0, lattice="triangular")
"""r = .4 is far below the critical one: the plain model collapses."""

MODELS: dict[str, dict[str, Any]] = {
    "IHS": {},
    "TC": {"contact_time": 1e-5},
    "TC of velocity": {"contact_time": 1e-5, "contact_time_exponent": 1.0, "contact_velocity": 0.5},
    "critical distance": {"critical_distance": 1e-5},
    "viscoelastic": {"material": "viscoelastic", "viscosity": 0.5},
    "plastic": {"material": "plastic", "restitution": 0.95, "yield_velocity": 0.0155},
    "rotation": {"rotation_angle": 5.0},
    "energy kick": {"kick_velocity": 1e-3, "kick_energy": 1e-6},
    "internal modes": {"internal_modes": 2, "mode_damping": 1e4},
}
"""What each names beside GAS. A r(v) of viscoelastic and plastic contacts is near .4 at the first velocities, and rises to
(nearly) 1; the critical distance is a hundredth of a diameter, t_c that of the papers."""

BED = {"n_particles": 200, "area_fraction": 0.3, "lattice": "auto", "boundary": "periodic wall", "gravity": 9.81}
PLACES: dict[str, dict[str, Any]] = {
    "free cooling": {"n_particles": 378},
    "walls": {"n_particles": 378, "lattice": "auto", "boundary": "wall"},
    "bed": BED,
    "vibrated column": BED
    | {"n_particles": 40, "aspect_ratio": 0.1, "floor": "harmonic", "floor_amplitude": 5e-4, "floor_frequency": 50.0},
}
"""Scenes that ask whether the collapse is avoided "under all conditions"; walls and floors are elastic."""

SEED = 1998
DISTANCE_FACTOR = 1.1
SAMPLES = {"spacing": "log", "count": 80, "first": 1e-3}


class Plan(NamedTuple):
    """How much is measured.

    Attributes:
        realizations: of each run.
        until: end of the cooling in s.
        stay: end of the runs in PLACES in s.
        collisions: of a particle, after which a run that has not collapsed is left alone.
        models, places: names of those that are asked; each pair of them is a kernel of its own to compile.
    """

    realizations: int
    until: float
    stay: float
    collisions: float
    models: tuple[str, ...] = tuple(MODELS)
    places: tuple[str, ...] = tuple(PLACES)


FULL = Plan(4, 5.0, 2.0, 3000.0)
SMALL = Plan(1, 0.5, 0.1, 200.0, models=("IHS", "TC"), places=("free cooling",))


def measure(plan: Plan = FULL) -> xr.Dataset:
    """Each model from the same start states, and in each of PLACES.

    Returns:
        Dataset over model and realization: with time (s) kinetic_energy and collisions_per_particle, NaN after the end;
        stop_reason, stop_time, events, cpu_time; mean_cluster_size and largest_cluster_size at the end. Over model, place and
        realization: collapse_time (s), infinite where nothing collapsed, and place_collisions of a particle until the end.
    """
    cooling = xr.concat([_cooling(scene_of(model), plan) for model in plan.models], "model")
    stays = [xr.concat([_stay(scene_of(m, p), plan) for p in plan.places], "place") for m in plan.models]
    places = xr.concat(stays, "model")
    labels = {"model": list(plan.models), "place": list(plan.places)}
    data = xr.merge([cooling, places]).assign_coords(labels)
    return data.assign_attrs({key: getattr(GAS, key) for key in ("n_particles", "area_fraction", "restitution", "diameter")})


def scene_of(model: str, place: str | None = None) -> Scene:
    """The scene of a model, in one of PLACES or as GAS has it."""
    return replace(GAS, **((PLACES[place] if place else {}) | MODELS[model]))


def _cooling(scene: Scene, plan: Plan) -> xr.Dataset:
    warm_up([scene])  # no compilation in its processor time
    return xr.concat([_run(scene, k, plan) for k in range(plan.realizations)], "realization")


@cache
def _start(scene: Scene, realization: int) -> xr.Dataset:
    """The start state that all models share; `scene` is that of its equilibration."""
    return equilibrate(scene, seed=SEED, realization=realization)


def _run(scene: Scene, realization: int, plan: Plan) -> xr.Dataset:
    """One gas until the end of its time, and its clusters then."""
    start = _start(scene.at_start(), realization)
    limits = {"time": plan.until, "collisions_per_particle": 10 * plan.collisions}
    run = simulate(scene, limits, state=start, samples=SAMPLES, keep_positions=True, progress=False)
    last = int(run["kinetic_energy"].notnull().sum()) - 1
    sides = [run.attrs["box_x"], run.attrs["box_y"]]
    found = find_clusters(run["trajectory"].isel(time=last).values, sides, scene.diameter, [DISTANCE_FACTOR])
    kept = run[["kinetic_energy", "collisions_per_particle", "stop_reason", "stop_time", "events", "cpu_time"]]
    sizes = {"mean_cluster_size": float(found.mean_sizes[0]), "largest_cluster_size": float(found.largest_sizes[0])}
    return kept.drop_attrs().assign(sizes)


def _stay(scene: Scene, plan: Plan) -> xr.Dataset:
    """Gases of one place, until they collapse or have collided often enough."""
    ends = []
    for k in range(plan.realizations):
        limits = {"time": plan.stay, "collisions_per_particle": plan.collisions}
        start = _start(scene.at_start(), k)
        run = simulate(scene, limits, state=start, samples={"count": 2}, keep_positions=False, progress=False)
        collapsed = run["stop_reason"].item() == "inelastic_collapse"
        ends.append((float(run["stop_time"]) if collapsed else np.inf, 2 * float(run["events"]) / scene.n_particles))
    times, collisions = np.transpose(ends)
    return xr.Dataset({"collapse_time": ("realization", times), "place_collisions": ("realization", collisions)})

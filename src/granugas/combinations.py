"""Which keys of a scene go together: a function for each family, which refuses what does not and says why."""

import math
from dataclasses import fields
from typing import TYPE_CHECKING, Any

from granugas.geometry import CLOSE_PACKING
from granugas.keys import EXTREME, SceneError, number

if TYPE_CHECKING:
    from granugas.scene import Scene

LATTICES_IN = {1: ("auto",), 2: ("auto", "triangular", "square"), 3: ("auto", "cubic", "fcc")}
"""Start lattices that there are in so many dimensions."""

MOST_VISCOUS = 5 / (6 * 1.15344)
"""A u^(1/5) = .7225, where the coefficient of restitution of viscoelastic spheres is least, 7/12 (physics: A section 3.iv)."""

FASTEST = 2 * math.sqrt(3)
"""A normal relative velocity at t = 0, by w: three times the root mean square; one of 8000 collisions is faster."""

LRV_KEYS = (
    *("n_particles", "area_fraction", "restitution", "contact_time", "diameter", "velocity_half_width", "dynamics"),
    *("lattice", "dimensions", "lrv_velocity"),
)
"""Keys that scenes with an lrv_velocity may name."""

SOFT_KEYS = (
    *("n_particles", "area_fraction", "restitution", "contact_time", "diameter", "velocity_half_width", "dynamics"),
    *("lattice", "dimensions", "boundary", "aspect_ratio", "wall_restitution", "wall_contact_time", "steps_per_contact"),
)
"""Keys that scenes of soft spheres may name."""

MOST_DAMPED = 0.2
"""2 eta dt, what the dashpot of a pair takes of its velocity in a step: in dense packings up to four times as much, and the
steps are stable below 1."""


DSMC_KEYS = (
    *("n_particles", "area_fraction", "restitution", "contact_time", "diameter", "velocity_half_width", "dynamics"),
    *("lattice", "dimensions", "aspect_ratio", "particles_per_cell"),
)
"""Keys that scenes with dynamics = dsmc may name."""


def refuse_what_does_not_go_together(scene: "Scene") -> None:
    """See whether the keys of a scene, each of which may hold what it does, do so together.

    Raises:
        SceneError: they do not.
    """
    for family in (_space, _contact_times, _driving, _walls, _materials, _models, _merging_beads, _soft_spheres, _dsmc):
        family(scene)


def default_of(scene: "Scene", name: str) -> Any:
    """What a key holds that nobody names."""
    return next(key.default for key in fields(scene) if key.name == name)


def named_beside(scene: "Scene", allowed: tuple[str, ...]) -> list[str]:
    """Keys that hold something else than their defaults, beside the allowed ones."""
    return [key.name for key in fields(scene) if key.name not in allowed and getattr(scene, key.name) != key.default]


def _space(scene: "Scene") -> None:
    packed = number(0.0, above=0.0, at_most=CLOSE_PACKING[scene.dimensions], unit="(close packing)", within=EXTREME)
    packed.metadata["check"]("area_fraction", scene.area_fraction)
    if scene.lattice not in LATTICES_IN[scene.dimensions]:
        allowed = f"in {scene.dimensions} dimensions allowed are {', '.join(LATTICES_IN[scene.dimensions])}"
        raise SceneError("lattice", scene.lattice, allowed)
    if scene.dimensions == 1 and scene.aspect_ratio != 1:
        raise SceneError("aspect_ratio", scene.aspect_ratio, "allowed is 1 in one dimension: a line has one side")
    if scene.dimensions == 1 and scene.tangential_restitution > -1:
        allowed = "beads on a line touch head on, nothing rubs: allowed is -1 at dimensions = 1"
        raise SceneError("tangential_restitution", scene.tangential_restitution, allowed)


def _contact_times(scene: "Scene") -> None:
    if isinstance(scene.contact_time, tuple) and not (scene.one_trajectory and scene.contact_time):
        allowed = "a list (not empty) is allowed at restitution = 1 only, and for smooth surfaces of hard particles"
        raise SceneError("contact_time", scene.contact_time, allowed)


def _driving(scene: "Scene") -> None:
    if scene.heating > 0 and scene.n_particles == 1:
        allowed = "allowed at n_particles = 1 is 0, as kicks leave the centre of mass alone"
        raise SceneError("heating", scene.heating, allowed)


def _walls(scene: "Scene") -> None:
    words = scene.boundary.split()
    if len(words) not in (1, scene.dimensions):
        allowed = f"allowed is one word for all axes, or one for each of the {scene.dimensions}"
        raise SceneError("boundary", scene.boundary, allowed)
    wall, floor, moving = any(scene.walled), scene.walled[-1], scene.floor != "still"
    needs = {"wall_restitution": wall, "wall_contact_time": wall, "gravity": floor, "floor": floor}
    for key, there in needs.items():
        value = getattr(scene, key)
        if not there and value != default_of(scene, key):
            where = "along the last axis" if key in ("gravity", "floor") else "of the box"
            raise SceneError(
                key, value, f"allowed is {default_of(scene, key)} without a wall {where} (boundary = {scene.boundary})"
            )
    for key in ("floor_amplitude", "floor_frequency"):
        value = getattr(scene, key)
        if moving != (value > 0):
            raise SceneError(key, value, "allowed is a number > 0 where the floor moves (floor), and 0 where it does not")
    if scene.wall_restitution == 0 and (scene.gravity > 0 or moving):
        allowed = (
            "allowed is a number > 0 with gravity or a floor in motion: a particle that sticks to it has no next collision"
        )
        raise SceneError("wall_restitution", scene.wall_restitution, allowed)


def _materials(scene: "Scene") -> None:
    for key, material in (("viscosity", "viscoelastic"), ("yield_velocity", "plastic")):
        value, named = getattr(scene, key), scene.material == material
        if named != (value > 0):
            raise SceneError(key, value, f"allowed is a number > 0 with material = {material}, and 0 without")
    if scene.material != "constant" and scene.restitution == 1:
        raise SceneError("restitution", scene.restitution, f"allowed is less than 1: material = {scene.material} dissipates")
    fastest = FASTEST * scene.velocity_half_width
    if scene.viscosity * fastest**0.2 > MOST_VISCOUS:
        allowed = f"allowed is at most {MOST_VISCOUS / fastest**0.2:.4g}, where r of collisions at {fastest:g} m/s is least"
        raise SceneError("viscosity", scene.viscosity, allowed)


def _models(scene: "Scene") -> None:
    exponent, lasts = scene.contact_time_exponent, scene.dissipates and any(scene.contact_times)
    if exponent and not lasts:
        allowed = "allowed is 0 without a contact_time > 0 and a restitution < 1"
        raise SceneError("contact_time_exponent", exponent, allowed)
    if (scene.contact_velocity > 0) != (exponent > 0):
        allowed = "allowed is a number > 0 with a contact_time_exponent > 0, and 0 without"
        raise SceneError("contact_velocity", scene.contact_velocity, allowed)
    if scene.critical_distance > scene.diameter:
        allowed = f"allowed is at most the diameter, {scene.diameter:g} m"
        raise SceneError("critical_distance", scene.critical_distance, allowed)
    if scene.rotation_angle and scene.dimensions == 1:
        raise SceneError("rotation_angle", scene.rotation_angle, "allowed is 0 in one dimension, where nothing can turn")
    if (scene.kick_velocity > 0) != (scene.kick_energy > 0):
        raise SceneError("kick_energy", scene.kick_energy, "allowed is a number > 0 with a kick_velocity > 0, and 0 without")
    if scene.kick_energy and scene.restitution == 1:
        raise SceneError("kick_energy", scene.kick_energy, "allowed is 0 at restitution = 1, where no energy is lost")
    if scene.mode_damping and not scene.internal_modes:
        raise SceneError("mode_damping", scene.mode_damping, "allowed is 0 without internal_modes")
    longest = max(scene.contact_times)
    if scene.mode_damping * longest >= 1:
        allowed = f"allowed is less than {1 / longest:g} 1/s: modes ring longer than a contact_time of {longest:g} s"
        raise SceneError("mode_damping", scene.mode_damping, allowed)


def _merging_beads(scene: "Scene") -> None:
    if scene.lrv_velocity == 0:
        return
    others = named_beside(scene, LRV_KEYS)
    reasons = {
        "unless dimensions = 1: only beads on a line pass impacts on one by one": scene.dimensions != 1,
        "at restitution = 1, where no energy is lost": scene.restitution == 1,
        f"with contact_time = {scene.contact_time!r}: slow contacts merge, none of them lasts": scene.contact_time != 0,
        f"with {', '.join(others)}: the model knows equal beads on a ring and nothing else": bool(others),
    }
    for reason, holds in reasons.items():
        if holds:
            raise SceneError("lrv_velocity", scene.lrv_velocity, f"allowed is 0 {reason}")


def _soft_spheres(scene: "Scene") -> None:
    steps = scene.steps_per_contact
    if not scene.soft:
        if steps != default_of(scene, "steps_per_contact"):
            allowed = (
                f"allowed is {default_of(scene, 'steps_per_contact')} unless dynamics = soft_spheres: nothing else makes steps"
            )
            raise SceneError("steps_per_contact", steps, allowed)
        return
    if others := named_beside(scene, SOFT_KEYS):
        allowed = f"allowed is events with {', '.join(others)}: soft spheres are equal, smooth and free between contacts"
        raise SceneError("dynamics", scene.dynamics, allowed)
    longest = math.pi * scene.diameter / (FASTEST * scene.velocity_half_width)
    contacts: dict[str, Any] = {"": scene.contact_time, "wall_": scene.wall_contact_time or scene.contact_time}
    for kind, contact_time in contacts.items():
        r = getattr(scene, f"{kind}restitution")
        if not 0 < contact_time < longest:
            allowed = (
                f"allowed is > 0 and < {longest:.4g} s with dynamics = soft_spheres: in longer ones particles pass through"
            )
            raise SceneError(f"{kind}contact_time", contact_time, allowed)
        if r == 0:
            allowed = "allowed is a number > 0 with dynamics = soft_spheres: no dashpot takes all of a velocity"
            raise SceneError(f"{kind}restitution", r, allowed)
        if steps < (fewest := math.ceil(-2 * math.log(r) / MOST_DAMPED)):
            allowed = f"allowed is at least {fewest} at {kind}restitution = {r:g}, where the dashpot is as strong"
            raise SceneError("steps_per_contact", steps, allowed)


def _dsmc(scene: "Scene") -> None:
    if scene.dynamics != "dsmc":
        if (value := scene.particles_per_cell) != (default := default_of(scene, "particles_per_cell")):
            raise SceneError(
                "particles_per_cell", value, f"allowed is {default:g} unless dynamics = dsmc: it draws partners in cells"
            )
        return
    if scene.dimensions == 1:
        allowed = "allowed is events in one dimension: beads on a line meet their neighbours only, never random partners"
        raise SceneError("dynamics", scene.dynamics, allowed)
    if others := named_beside(scene, DSMC_KEYS):
        allowed = (
            f"allowed is events with {', '.join(others)}: dsmc knows smooth equal particles in a periodic box and nothing else"
        )
        raise SceneError("dynamics", scene.dynamics, allowed)

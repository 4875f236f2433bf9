"""Effects: one file each, none imports another, none is named by the loop (see ../composition.py).

Nothing is imported here: which files a scene calls for is known without compiling or even loading any of them.
"""

from granugas.scene import Scene

SOFT = ("neighbours", "soft_contact", "soft_steps", "softspheres")
"""Files of the dynamics of soft spheres."""

DSMC = ("dsmc", "dsmc_collisions", "dsmc_steps")
"""Files of direct simulation Monte Carlo."""


def called_by(scene: Scene) -> dict[str, str | tuple[str, ...]]:
    """The effect files that a scene calls for, by the place that each takes (cast.effects_of).

    A place that is not named holds what scenes without such an effect do. `material` answers for the coefficient of
    restitution where the rule leaves it to it. Several files in one place: each rule asks the next one where it does not
    decide, the last one the material; what follows a collision happens in this order.
    """
    if scene.lrv_velocity > 0 or scene.soft or scene.dynamics == "dsmc":
        return {}  # of another dynamics
    dissipates, lasting = scene.dissipates, any(scene.contact_times)
    called = {"material": scene.material, "rule": "hard", "watch": "nobody"}
    if dissipates:
        rules = {
            "internal_modes": scene.internal_modes,
            "critical_distance": scene.critical_distance,
            "contact_time_of_velocity": scene.contact_time_exponent,
            "contact_time": lasting and not scene.contact_time_exponent,
        }
        called["rule"] = tuple(name for name, wanted in rules.items() if wanted) or "hard"
    elif lasting:
        called["rule"] = "elastic_share"
    if dissipates != lasting:  # without a contact duration they can collapse; elastic ones with one have times to add up
        called["watch"] = "collapse" if dissipates else "elastic_time"
    after = {"rotation": scene.rotation_angle, "kick": scene.kick_energy}
    if any(after.values()):
        called["after"] = tuple(name for name, wanted in after.items() if wanted)
    if scene.rough:
        called["surface"] = "rough"
    if scene.sizes != "equal":
        called["sizes"] = "unequal"
    if scene.heating > 0:
        called["drive"] = "kicks"
    if scene.wall_restitution < 1 and scene.wall_contact_time == 0:
        called["watch"] = "collapse"
    if any(scene.walled):
        called["walls"] = "walls"
    if scene.gravity > 0:
        called["force"] = "gravity"
    if scene.floor != "still":
        called["floor"] = "vibrated_floor"
    return called


def modules_of(*scenes: Scene) -> tuple[str, ...]:
    """Full names of the files that scenes call for: effects, and dynamics other than the engine's."""
    names = {f"{__name__}.{name}" for scene in scenes for held in called_by(scene).values() for name in several(held)}
    names |= {"granugas.dynamics.lrv" for scene in scenes if scene.lrv_velocity > 0}
    names |= {f"granugas.dynamics.{name}" for scene in scenes if scene.soft for name in SOFT}
    names |= {f"granugas.dynamics.{name}" for scene in scenes if scene.dynamics == "dsmc" for name in DSMC}
    return tuple(sorted(names))


def several(names: str | tuple[str, ...]) -> tuple[str, ...]:
    """The files of a place."""
    return (names,) if isinstance(names, str) else names

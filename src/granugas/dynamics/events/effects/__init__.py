"""Effects: one file each, none imports another, none is named by the loop (see ../composition.py).

Nothing is imported here: which files a scene calls for is known without compiling or even loading any of them.
"""

from granugas.scene import Scene


def called_by(scene: Scene) -> dict[str, str]:
    """The effect files that a scene calls for, by the place that each takes (cast.effects_of).

    A place that is not named holds what scenes without such an effect do. `material` answers for the coefficient of
    restitution where the rule leaves it to it.
    """
    dissipates, lasting = scene.dissipates, any(scene.contact_times)
    called = {"material": "constant", "rule": "hard", "watch": "nobody"}
    if lasting:
        called["rule"] = "contact_time" if dissipates else "elastic_share"
    if dissipates != lasting:  # without a contact duration they can collapse; elastic ones with one have times to add up
        called["watch"] = "collapse" if dissipates else "elastic_time"
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
    """Full names of the files that scenes call for."""
    names = {name for scene in scenes for name in called_by(scene).values()}
    return tuple(f"{__name__}.{name}" for name in sorted(names))

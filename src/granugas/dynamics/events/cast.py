"""The effects of a scene: the files that it calls for, and what the places hold that it does not name."""

from functools import reduce
from importlib import import_module
from typing import Any

from granugas.dynamics.events.boundary import Periodic, Still
from granugas.dynamics.events.collisions import Nothing, Smooth, Then
from granugas.dynamics.events.driving import Undriven
from granugas.dynamics.events.effects import called_by, several
from granugas.dynamics.events.flight import Straight
from granugas.dynamics.events.sizes import Equal
from granugas.dynamics.state import State
from granugas.scene import Scene

OTHERWISE = {
    "force": Straight,
    "walls": Periodic,
    "floor": Still,
    "sizes": Equal,
    "surface": Smooth,
    "after": Nothing,
    "drive": Undriven,
}
"""The effect of a place that a scene does not name."""


def effects_of(scene: Scene, state: State) -> dict[str, Any]:
    """The effect of each place: state.EFFECTS, and `drive`, of which kernels know nothing.

    `state` has what they know of each particle.
    """
    files = {place: [_file(name) for name in several(names)] for place, names in called_by(scene).items()}
    effects = {place: effect() for place, effect in OTHERWISE.items()}
    (material,), rules = files.pop("material"), files.pop("rule")
    effects["rule"] = material.effect_of(scene, state)
    for rule in reversed(rules):
        effects["rule"] = rule.effect_of(scene, state, effects["rule"])
    return effects | {place: reduce(Then, [file.effect_of(scene, state) for file in held]) for place, held in files.items()}


def _file(name: str) -> Any:
    return import_module(f"granugas.dynamics.events.effects.{name}")

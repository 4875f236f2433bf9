"""Grids: from the values that a study gives its keys to the scenes at all points."""

import itertools
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from granugas.configuration import ConfigError
from granugas.scene import DEFAULTS, SCENE_KEYS, Scene, SceneError, check_value

FLOAT_KEYS = {key for key, value in DEFAULTS.items() if isinstance(value, float)}


def scenes(where: str, grid: Mapping[str, Any], settings: Mapping[str, Any]) -> Iterator[Scene]:
    """Every point of the grid; at r = 1 one scene holds all contact times.

    Args:
        where: place of the study in the configuration, for messages.
        grid: a value or a list of values for each of its keys.
        settings: values that hold at all points.

    Raises:
        ConfigError: a value, or a combination of values, that no scene can have.
    """
    from granugas.initial import check_lattice

    places = {key: f"{where}.grid.{key}" for key in SCENE_KEYS} | {key: f"{where}.scene.{key}" for key in settings}
    axes = {key: _axis(places, key, value) for key, value in {**grid, **settings}.items()}
    times = axes.get("contact_time", (DEFAULTS["contact_time"],))
    for point in itertools.product(*axes.values()):
        values = DEFAULTS | dict(zip(axes, point, strict=True))
        scene = _said_here(places, Scene, **values)
        if len(times) > 1 and scene.one_trajectory:
            if values["contact_time"] != times[0]:
                continue
            scene = replace(scene, contact_time=tuple(sorted(times)))
        _said_here(places, check_lattice, scene)
        yield scene


def number_of_runs(block: Mapping[str, Any]) -> int:
    """Realizations at all points of a study's grid, counted without a scene being made."""
    axes = {key: value if isinstance(value, list) else [value] for key, value in block["grid"].items()}
    times, restitutions = len(axes.pop("contact_time", [0.0])), axes.pop("restitution", [0.0])
    methods = axes.pop("dynamics", [DEFAULTS["dynamics"]])
    pairs = sum(1 if r == 1 and method == DEFAULTS["dynamics"] else times for r in restitutions for method in methods)
    return block["realizations"] * pairs * math.prod(map(len, axes.values()))


def ascending(where: str, values: Iterable[float]) -> tuple[float, ...]:
    """The values, rounded, in order.

    Raises:
        ConfigError: a value stands twice.
    """
    return tuple(sorted(distinct(where, [rounded(value) for value in values])))


def distinct(where: str, values: Sequence[Any]) -> tuple[Any, ...]:
    """The values as they stand.

    Raises:
        ConfigError: a value stands twice.
    """
    for position, value in enumerate(values):
        if value in values[:position]:
            raise ConfigError(where, value, "this value stands twice; allowed is once")
    return tuple(values)


def rounded(value: float) -> float:
    """To 12 significant digits, so that runs of one address are equal in every bit."""
    try:
        return float(f"{float(value):.12g}")
    except OverflowError:
        return math.inf


def _axis(places: Mapping[str, str], key: str, value: Any) -> tuple[Any, ...]:
    """The values of a key of the grid, each one that a scene can have."""
    given = value if isinstance(value, list) else [value]
    values = [rounded(item) if key in FLOAT_KEYS and type(item) in (int, float) else item for item in given]
    for item in values:
        _said_here(places, check_value, key, item)
    return distinct(places[key], values)


def _said_here(places: Mapping[str, str], build: Callable[..., Any], *arguments: Any, **values: Any) -> Any:
    """Call, and let a scene's error name the place in the configuration."""
    try:
        return build(*arguments, **values)
    except SceneError as error:
        raise ConfigError(places.get(error.key, error.key), error.value, error.allowed) from error

"""What the keys of a scene may hold: fields of a dataclass with a check each."""

import math
from collections.abc import Callable
from dataclasses import field
from numbers import Integral, Real
from typing import Any

EXTREME = 1.0e50
"""Beyond it and its inverse lengths, velocities and fractions overflow where they are squared and divided."""


class SceneError(ValueError):
    """A value that a scene cannot have; says key, value and what is allowed."""

    def __init__(self, key: str, value: Any, allowed: str) -> None:
        super().__init__(f"{key} = {value!r}: {allowed}")
        self.key, self.value, self.allowed = key, value, allowed


def _key(default: Any, check: Callable[[str, Any], None], *, start: bool = False) -> Any:
    """A key of a scene: its default, what it may hold, and whether the start state depends on it."""
    return field(default=default, metadata={"check": check, "start": start})


def integer(default: int, low: int, high: int, **how: bool) -> Any:
    """A key that holds an integer from `low` to `high`."""

    def check(key: str, value: Any) -> None:
        if isinstance(value, bool) or not isinstance(value, Integral) or not low <= int(value) <= high:
            raise SceneError(key, value, f"allowed is an integer from {low} to {high}")

    return _key(default, check, **how)


def number(
    default: float,
    *,
    at_least: float | None = None,
    above: float | None = None,
    at_most: float = math.inf,
    within: float = math.inf,
    endless: bool = False,
    unit: str = "",
    **how: bool,
) -> Any:
    """A key that holds a number of this range, a finite one unless `endless`; `within`: a factor, up to which it and its
    inverse may go."""
    low = f">= {at_least:g}" if at_least is not None else f"> {above:g}"
    high = f" and <= {at_most:.6g}" if at_most < math.inf else ""
    allowed = f"allowed is a number {low}{high}{', or .inf' if endless else ''}{' ' if unit else ''}{unit}"

    def check(key: str, value: Any) -> None:
        limited = isinstance(value, Real) and (math.isfinite(value) or (endless and value == math.inf))
        if isinstance(value, bool) or not limited:
            raise SceneError(key, value, allowed)
        if (at_least is not None and value < at_least) or (above is not None and value <= above) or value > at_most:
            raise SceneError(key, value, allowed)
        if within < math.inf and not 1 / within <= value <= within:
            raise SceneError(key, value, f"allowed is a number from {1 / within:g} to {within:g}")

    return _key(default, check, **how)


def choice(default: Any, *others: Any, **how: bool) -> Any:
    """A key that holds one of a few words or integers."""

    def check(key: str, value: Any) -> None:
        if isinstance(value, bool) or not isinstance(value, (str, int)) or value not in (default, *others):
            raise SceneError(key, value, f"allowed are {', '.join(map(str, (default, *others)))}")

    return _key(default, check, **how)


def area_fraction_key(default: float) -> Any:
    """The key of nu, which close packing bounds: how, depends on the dimensions."""
    return _key(default, lambda key, value: None, start=True)


def contact_time_key(default: float) -> Any:
    """The key of t_c: a number, or several."""
    check_number = number(default, at_least=0.0, unit="s").metadata["check"]

    def check(key: str, value: Any) -> None:
        for time in value if isinstance(value, tuple) else (value,):
            check_number(key, time)

    return _key(default, check)


def boundary_key(default: str) -> Any:
    """The key of what lies at the edge of the box: a word for all axes, or one for each."""

    def check(key: str, value: Any) -> None:
        if not isinstance(value, str) or not value.split() or not set(value.split()) <= {"periodic", "wall"}:
            allowed = "allowed are periodic, wall, or one of the two for each axis of space, separated by a blank"
            raise SceneError(key, value, allowed)

    return _key(default, check, start=True)

"""What the functions of the package accept: one line that names argument, value and what is allowed."""

import math
from numbers import Integral, Real
from typing import Any

from granugas.scene import Scene

LARGEST = 2**63 - 1
"""Whole numbers of a dataset have eight bytes."""


def need_scene(scene: Any) -> None:
    """Refuse what is no scene.

    Raises:
        TypeError: for instance a dict, which `granugas.scene.scene_from` turns into one.
    """
    if not isinstance(scene, Scene):
        raise TypeError(f"scene = {scene!r}: allowed is a granugas.Scene")


def need_integer(key: str, value: Any, low: int = 0) -> None:
    """Refuse what is no whole number from `low` on.

    Raises:
        ValueError: names key, value and what is allowed.
    """
    if isinstance(value, bool) or not isinstance(value, Integral) or not low <= value <= LARGEST:
        raise ValueError(f"{key} = {value!r}: allowed is an integer >= {low}")


def is_number(value: Any) -> bool:
    """Whether it is a finite number; True and False are none."""
    return isinstance(value, Real) and not isinstance(value, bool) and math.isfinite(value)

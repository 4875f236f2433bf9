"""When a run ends, and where it is sampled on the way."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from granugas.arguments import is_number

COUNT = 200
FIRST = 1.0e-3
"""Defaults of `samples`: how many, and the first of them (s, or collisions per particle)."""


@dataclass(frozen=True)
class Limits:
    """The end of a run: whichever comes first; None: no such limit.

    Attributes:
        time: s.
        collisions_per_particle: counted for both partners of a collision.
    """

    time: float | None
    collisions_per_particle: float | None

    @classmethod
    def of(cls, until: float | Mapping[str, float]) -> "Limits":
        """Limits from a time in s or from a mapping with `time` and `collisions_per_particle`.

        Raises:
            ValueError: no limit, an unknown one, or one that is not a positive number.
        """
        given = dict(until) if isinstance(until, Mapping) else {"time": until}
        unknown = set(given) - {"time", "collisions_per_particle"}
        if unknown or not given:
            raise ValueError(f"until = {until!r}: allowed are time (s) and collisions_per_particle")
        for key, value in given.items():
            if isinstance(value, bool) or not isinstance(value, (int, float, np.number)) or not 0 < value < math.inf:
                raise ValueError(f"until.{key} = {value!r}: allowed is a positive number")
        return cls(given.get("time"), given.get("collisions_per_particle"))


@dataclass(frozen=True)
class Samples:
    """Sampling points after t = 0, the last one on the limit.

    Attributes:
        axis: "time" (s) or "collisions" (per particle): what is spaced.
        points: (count,), ascending.
    """

    axis: str
    points: np.ndarray


def sampling_points(limits: Limits, samples: Mapping[str, Any] | None = None) -> Samples:
    """The sampling points of a run.

    Raises:
        ValueError: an unknown key or value, or samples that do not fit the limits.
    """
    if not isinstance(samples, Mapping | None):
        raise ValueError(f"samples = {samples!r}: allowed is a mapping with spacing, count, first, axis")
    given = dict(samples or {})
    axis = given.pop("axis", "collisions" if limits.time is None else "time")
    spacing = given.pop("spacing", "log")
    count = given.pop("count", COUNT)
    end = limits.time if axis == "time" else limits.collisions_per_particle
    if axis not in ("time", "collisions") or end is None:
        raise ValueError(f"samples.axis = {axis!r}: allowed is one of time, collisions that `until` limits")
    first = given.pop("first", min(FIRST, end / 100))
    if given:
        raise ValueError(f"samples.{next(iter(given))}: allowed are spacing, count, first, axis")
    if spacing not in ("log", "linear"):
        raise ValueError(f"samples.spacing = {spacing!r}: allowed are log, linear")
    if not is_number(count) or count != int(count) or count < 1:
        raise ValueError(f"samples.count = {count!r}: allowed is an integer >= 1")
    if not is_number(first) or not 0 < first <= end:
        raise ValueError(f"samples.first = {first!r}: allowed is a number > 0 and <= {end:g}, the end of the run")
    if count == 1:
        return Samples(axis, np.array([float(end)]))
    points = np.geomspace(first, end, int(count)) if spacing == "log" else np.linspace(first, end, int(count))
    return Samples(axis, points)


def snapshot_times(snapshots: Sequence[float]) -> list[float]:
    """The times of the snapshots in s, ascending.

    Raises:
        ValueError: no sequence of times >= 0, or one of them twice.
    """
    if isinstance(snapshots, str) or not isinstance(snapshots, Sequence | np.ndarray):
        raise ValueError(f"snapshots = {snapshots!r}: allowed is a list of times in s")
    for time in snapshots:
        if not is_number(time) or time < 0:
            raise ValueError(f"snapshots = {time!r}: allowed are times >= 0 s")
    if len(set(snapshots)) < len(snapshots):
        raise ValueError(f"snapshots = {list(snapshots)!r}: allowed is each time once")
    return sorted(float(time) for time in snapshots)

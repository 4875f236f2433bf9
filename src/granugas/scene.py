"""A scene: what is simulated, as pure data that is checked when it is made."""

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from numbers import Integral, Real
from typing import Any

CLOSE_PACKING = math.pi / (2 * math.sqrt(3))
"""Area fraction of the densest packing of equal disks, .9069."""

MAX_PARTICLES = 10_000_000
EXTREME = 1.0e50
"""Beyond it and its inverse lengths, velocities and fractions overflow where they are squared and divided."""

MOST_SLENDER = 1.0e4
"""Ratio of the sides of a box, either way."""

LATTICES = ("auto", "triangular", "square")
DYNAMICS = ("events",)
BOUNDARIES = ("periodic",)
DIMENSIONS = (2,)


class SceneError(ValueError):
    """A value that a scene cannot have; says key, value and what is allowed."""

    def __init__(self, key: str, value: Any, allowed: str) -> None:
        super().__init__(f"{key} = {value!r}: {allowed}")
        self.key, self.value, self.allowed = key, value, allowed


@dataclass(frozen=True)
class Scene:
    """Freely cooling hard disks; the defaults are paper A's units and its central case.

    Attributes:
        n_particles: number of disks N.
        area_fraction: nu = N pi d^2 / (4 V).
        restitution: r of A Eq. 3, in [0, 1].
        contact_time: t_c of A Eq. 4 in s; a tuple of them at restitution 1, where one trajectory serves all.
        diameter: d in m.
        velocity_half_width: w in m/s; components start uniform in +-w, so that E(0) = N m w^2 / 3.
        dynamics: the method that moves the particles.
        lattice: start lattice; "auto" holds any N.
        dimensions: of space.
        boundary: of the box.
        aspect_ratio: Lx / Ly of the box; an explicit lattice takes the nearest that it can.

    Raises:
        SceneError: a value outside of what is allowed.
    """

    n_particles: int = 5740
    area_fraction: float = 0.2267
    restitution: float = 0.4
    contact_time: float | tuple[float, ...] = 1.0e-5
    diameter: float = 1.0e-3
    velocity_half_width: float = 0.5
    dynamics: str = "events"
    lattice: str = "auto"
    dimensions: int = 2
    boundary: str = "periodic"
    aspect_ratio: float = 1.0

    def __post_init__(self) -> None:
        _integer("n_particles", self.n_particles, 1, MAX_PARTICLES)
        _number("area_fraction", self.area_fraction, above=0.0, at_most=CLOSE_PACKING, note=" (close packing)")
        _number("restitution", self.restitution, at_least=0.0, at_most=1.0)
        if isinstance(self.contact_time, (tuple, list)):
            times = tuple(float(_number("contact_time", t, at_least=0.0, note=" s")) for t in self.contact_time)
            if self.restitution != 1 or not times:
                raise SceneError("contact_time", self.contact_time, "a list (not empty) is allowed at restitution = 1 only")
            object.__setattr__(self, "contact_time", times)
        else:
            _number("contact_time", self.contact_time, at_least=0.0, note=" s")
        _number("diameter", self.diameter, above=0.0, note=" m")
        _number("velocity_half_width", self.velocity_half_width, above=0.0, note=" m/s")
        _number("aspect_ratio", self.aspect_ratio, above=0.0)
        for key in ("area_fraction", "diameter", "velocity_half_width"):
            _within(key, getattr(self, key), EXTREME)
        _within("aspect_ratio", self.aspect_ratio, MOST_SLENDER)
        _choice("dynamics", self.dynamics, DYNAMICS)
        _choice("lattice", self.lattice, LATTICES)
        _choice("dimensions", self.dimensions, DIMENSIONS)
        _choice("boundary", self.boundary, BOUNDARIES)

    @property
    def area(self) -> float:
        """V = N pi d^2 / (4 nu) in m^2."""
        return self.n_particles * math.pi * self.diameter**2 / (4 * self.area_fraction)

    @property
    def contact_times(self) -> tuple[float, ...]:
        """Every t_c of the scene, in s."""
        return self.contact_time if isinstance(self.contact_time, tuple) else (self.contact_time,)

    def as_dict(self) -> dict[str, Any]:
        """All keys and values, as they were given."""
        return asdict(self)


SCENE_KEYS = tuple(f.name for f in fields(Scene))


def scene_from(values: Mapping[str, Any]) -> Scene:
    """A scene from keys and values.

    Raises:
        SceneError: an unknown key or a value that is not allowed.
    """
    for key in values:
        if key not in SCENE_KEYS:
            raise SceneError(key, values[key], f"unknown key; allowed are {', '.join(SCENE_KEYS)}")
    return Scene(**values)


def _integer(key: str, value: Any, low: int, high: int) -> int:
    if isinstance(value, bool) or not isinstance(value, Integral) or not low <= value <= high:
        raise SceneError(key, value, f"allowed is an integer from {low} to {high}")
    return int(value)


def _number(
    key: str,
    value: Any,
    *,
    at_least: float | None = None,
    above: float | None = None,
    at_most: float = math.inf,
    note: str = "",
) -> float:
    low = f">= {at_least:g}" if at_least is not None else f"> {above:g}"
    allowed = f"allowed is a number {low}" + (f" and <= {at_most:.6g}" if at_most < math.inf else "") + note
    if isinstance(value, bool) or not isinstance(value, Real) or not math.isfinite(value):
        raise SceneError(key, value, allowed)
    if (at_least is not None and value < at_least) or (above is not None and value <= above) or value > at_most:
        raise SceneError(key, value, allowed)
    return float(value)


def _within(key: str, value: float, factor: float) -> None:
    if not 1 / factor <= value <= factor:
        raise SceneError(key, value, f"allowed is a number from {1 / factor:g} to {factor:g}")


def _choice(key: str, value: Any, allowed: tuple[Any, ...]) -> None:
    if isinstance(value, bool) or not isinstance(value, (str, int)) or value not in allowed:
        raise SceneError(key, value, f"allowed are {', '.join(map(str, allowed))}")

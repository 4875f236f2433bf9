"""A scene: what is simulated, as pure data that is checked when it is made."""

import math
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, field, fields
from numbers import Integral, Real
from typing import Any

from granugas.geometry import CLOSE_PACKING, box_volume

MAX_PARTICLES = 10_000_000
EXTREME = 1.0e50
"""Beyond it and its inverse lengths, velocities and fractions overflow where they are squared and divided."""

MOST_SLENDER = 1.0e4
"""Ratio of the sides of a box, either way."""

LATTICES = ("auto", "triangular", "square", "cubic", "fcc")
LATTICES_IN = {1: ("auto",), 2: ("auto", "triangular", "square"), 3: ("auto", "cubic", "fcc")}
"""Start lattices, and those that there are in so many dimensions."""

MOST_MODES = 100
"""Of a particle."""

MOST_VISCOUS = 5 / (6 * 1.15344)
"""A u^(1/5) = .7225, where the coefficient of restitution of viscoelastic spheres is least, 7/12 (physics: A section 3.iv)."""

FASTEST = 2 * math.sqrt(3)
"""A normal relative velocity at t = 0, by w: three times the root mean square; one of 8000 collisions is faster."""


class SceneError(ValueError):
    """A value that a scene cannot have; says key, value and what is allowed."""

    def __init__(self, key: str, value: Any, allowed: str) -> None:
        super().__init__(f"{key} = {value!r}: {allowed}")
        self.key, self.value, self.allowed = key, value, allowed


# --- what a key may hold --------------------------------------------------------------------------------------------------


def _key(default: Any, check: Callable[[str, Any], None], *, start: bool = False) -> Any:
    """A key of a scene: its default, what it may hold, and whether the start state depends on it."""
    return field(default=default, metadata={"check": check, "start": start})


def integer(default: int, low: int, high: int, **how: bool) -> Any:
    """A key that holds an integer from `low` to `high`."""

    def check(key: str, value: Any) -> None:
        if isinstance(value, bool) or not isinstance(value, Integral) or not low <= value <= high:
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


def _area_fraction(default: float) -> Any:
    """The key of nu, which close packing bounds: how, depends on the dimensions."""
    return _key(default, lambda key, value: None, start=True)


def _contact_time(default: float) -> Any:
    """The key of t_c: a number, or several."""
    check_number = number(default, at_least=0.0, unit="s").metadata["check"]

    def check(key: str, value: Any) -> None:
        for time in value if isinstance(value, tuple) else (value,):
            check_number(key, time)

    return _key(default, check)


def _boundary(default: str) -> Any:
    """The key of what lies at the edge of the box: a word for all axes, or one for each."""

    def check(key: str, value: Any) -> None:
        if not isinstance(value, str) or not value.split() or not set(value.split()) <= {"periodic", "wall"}:
            allowed = "allowed are periodic, wall, or one of the two for each axis of space, separated by a blank"
            raise SceneError(key, value, allowed)

    return _key(default, check, start=True)


# --- the scene ------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Scene:
    """Freely cooling hard disks; the defaults are paper A's units and its central case. Effects are off unless named.

    Attributes:
        n_particles: number of particles N.
        area_fraction: nu = N pi d^2 / (4 V); in 3D the volume fraction N pi d^3 / (6 V), in 1D the line fraction N d / V.
        restitution: r of A Eq. 3, in [0, 1].
        contact_time: t_c of A Eq. 4 in s; a tuple of them at restitution 1, where one trajectory serves all.
        diameter: d in m.
        velocity_half_width: w in m/s; components start uniform in +-w, so that E(0) = D N m w^2 / 6 in D dimensions.
        dynamics: the method that moves the particles.
        lattice: start lattice; "auto" holds any N.
        dimensions: D of space: beads on a ring, disks in a plane, spheres.
        boundary: of the box: "periodic", "wall", or one of them for each axis ("periodic wall": walls along y alone).
        aspect_ratio: Lx / Ly of the box, in 3D with Lz = sqrt(Lx Ly); an explicit lattice takes the nearest that it can.
        tangential_restitution: beta in [-1, 1], by which a contact reverses the surfaces' tangential velocity; -1: smooth.
        friction: mu; a contact passes on no more tangential momentum than mu times the normal one; infinite: no such limit.
        sizes: how the diameters are distributed; d is their mean, masses go like their D-th power.
        size_ratio: of bidisperse particles, diameter of a large by that of a small one.
        size_share: of bidisperse particles, how many of all are large.
        size_spread: by the mean diameter: half width of uniform, standard deviation of log-normal diameters.
        heating: energy by mass and time that random kicks put in (m^2/s^3); 0: none.
        wall_restitution: r of a particle at a wall, in [0, 1].
        wall_contact_time: t_c of A Eq. 4 at a wall, in s.
        gravity: g in m/s^2, down along the last axis.
        floor: motion of the lower wall along the last axis: none, A - A cos(2 pi f t), or f times a second a steady rise from
            0 to 2 A and a drop in no time.
        floor_amplitude: A of its motion in m.
        floor_frequency: f of its motion in 1/s.
        material: what decides the coefficient of restitution of two particles alone; "viscoelastic" does without `restitution`.
        viscosity: A of viscoelastic spheres in (s/m)^(1/5): r = 1 - C1 A u^(1/5) + C2 A^2 u^(2/5).
        yield_velocity: of plastic contacts in m/s: r = `restitution` up to it, and falls as u^(-1/4) above.
        contact_time_exponent: alpha of a contact duration that depends on the normal relative velocity, t_c (u / v_0)^(-alpha).
        contact_velocity: v_0 in m/s, at which it is `contact_time`.
        critical_distance: eps_c in m: collisions with a third particle nearer than that to a partner are elastic.
        rotation_angle: in degrees; after each collision the relative velocity turns by a random angle up to it.
        kick_velocity: in m/s; partners that part more slowly get a random energy, ...
        kick_energy: ... in m^2/s^2 per mass of a particle, up to this.
        internal_modes: number of oscillators in each particle that take up what `restitution` leaves, and give it back.
        mode_damping: gamma in 1/s: their energy falls as exp(-gamma t).
        lrv_velocity: in m/s; contacts of beads that are slower merge into clusters (LRV model, A section 3.i); 0: none do.

    Raises:
        SceneError: a value outside of what is allowed.
    """

    n_particles: int = integer(5740, 1, MAX_PARTICLES, start=True)
    area_fraction: float = _area_fraction(0.2267)
    restitution: float = number(0.4, at_least=0.0, at_most=1.0)
    contact_time: float | tuple[float, ...] = _contact_time(1.0e-5)
    diameter: float = number(1.0e-3, above=0.0, within=EXTREME, unit="m", start=True)
    velocity_half_width: float = number(0.5, above=0.0, within=EXTREME, unit="m/s", start=True)
    dynamics: str = choice("events")
    lattice: str = choice(*LATTICES, start=True)
    dimensions: int = choice(2, 1, 3, start=True)
    boundary: str = _boundary("periodic")
    aspect_ratio: float = number(1.0, above=0.0, within=MOST_SLENDER, start=True)
    tangential_restitution: float = number(-1.0, at_least=-1.0, at_most=1.0)
    friction: float = number(math.inf, at_least=0.0, endless=True)
    sizes: str = choice("equal", "bidisperse", "uniform", "log_normal", start=True)
    size_ratio: float = number(2.0, at_least=1.0, at_most=10.0, start=True)
    size_share: float = number(0.5, at_least=0.0, at_most=1.0, start=True)
    size_spread: float = number(0.2, at_least=0.0, at_most=0.9, start=True)
    heating: float = number(0.0, at_least=0.0, at_most=EXTREME, unit="m^2/s^3")
    wall_restitution: float = number(1.0, at_least=0.0, at_most=1.0)
    wall_contact_time: float = number(0.0, at_least=0.0, unit="s")
    gravity: float = number(0.0, at_least=0.0, unit="m/s^2")
    floor: str = choice("still", "harmonic", "sawtooth")
    floor_amplitude: float = number(0.0, at_least=0.0, unit="m")
    floor_frequency: float = number(0.0, at_least=0.0, unit="1/s")
    material: str = choice("constant", "viscoelastic", "plastic")
    viscosity: float = number(0.0, at_least=0.0, unit="(s/m)^(1/5)")
    yield_velocity: float = number(0.0, at_least=0.0, unit="m/s")
    contact_time_exponent: float = number(0.0, at_least=0.0, at_most=10.0)
    contact_velocity: float = number(0.0, at_least=0.0, unit="m/s")
    critical_distance: float = number(0.0, at_least=0.0, unit="m")
    rotation_angle: float = number(0.0, at_least=0.0, at_most=5.0, unit="degrees")
    kick_velocity: float = number(0.0, at_least=0.0, unit="m/s")
    kick_energy: float = number(0.0, at_least=0.0, unit="m^2/s^2")
    internal_modes: int = integer(0, 0, MOST_MODES)
    mode_damping: float = number(0.0, at_least=0.0, unit="1/s")
    lrv_velocity: float = number(0.0, at_least=0.0, at_most=EXTREME, unit="m/s")

    def __post_init__(self) -> None:
        if isinstance(self.contact_time, (tuple, list)):
            object.__setattr__(self, "contact_time", tuple(self.contact_time))
        for key in SCENE_KEYS:
            check_value(key, getattr(self, key))
        self._refuse_what_does_not_go_together()

    def _refuse_what_does_not_go_together(self) -> None:
        packed = number(0.0, above=0.0, at_most=CLOSE_PACKING[self.dimensions], unit="(close packing)", within=EXTREME)
        packed.metadata["check"]("area_fraction", self.area_fraction)
        if self.lattice not in LATTICES_IN[self.dimensions]:
            allowed = f"in {self.dimensions} dimensions allowed are {', '.join(LATTICES_IN[self.dimensions])}"
            raise SceneError("lattice", self.lattice, allowed)
        if self.dimensions == 1 and self.aspect_ratio != 1:
            raise SceneError("aspect_ratio", self.aspect_ratio, "allowed is 1 in one dimension: a line has one side")
        if self.dimensions == 1 and self.tangential_restitution > -1:
            allowed = "beads on a line touch head on, nothing rubs: allowed is -1 at dimensions = 1"
            raise SceneError("tangential_restitution", self.tangential_restitution, allowed)
        if isinstance(self.contact_time, tuple):
            if self.dissipates or not self.contact_time:
                allowed = "a list (not empty) is allowed at restitution = 1 only, and for smooth surfaces"
                raise SceneError("contact_time", self.contact_time, allowed)
            object.__setattr__(self, "contact_time", tuple(map(float, self.contact_time)))
        if self.heating > 0 and self.n_particles == 1:
            raise SceneError(
                "heating", self.heating, "allowed at n_particles = 1 is 0, as kicks leave the centre of mass alone"
            )
        self._refuse_walls_that_are_none()
        self._refuse_materials_that_are_none()
        self._refuse_models_that_are_none()
        self._refuse_clusters_of_anything_but_beads()

    def _refuse_walls_that_are_none(self) -> None:
        words = self.boundary.split()
        if len(words) not in (1, self.dimensions):
            allowed = f"allowed is one word for all axes, or one for each of the {self.dimensions}"
            raise SceneError("boundary", self.boundary, allowed)
        object.__setattr__(self, "boundary", words[0] if len(set(words)) == 1 else " ".join(words))
        wall, floor, moving = any(self.walled), self.walled[-1], self.floor != "still"
        needs = {"wall_restitution": wall, "wall_contact_time": wall, "gravity": floor, "floor": floor}
        for key, there in needs.items():
            value = getattr(self, key)
            if not there and value != DEFAULTS[key]:
                where = "along the last axis" if key in ("gravity", "floor") else "of the box"
                raise SceneError(key, value, f"allowed is {DEFAULTS[key]} without a wall {where} (boundary = {self.boundary})")
        for key in ("floor_amplitude", "floor_frequency"):
            value = getattr(self, key)
            if moving != (value > 0):
                raise SceneError(key, value, "allowed is a number > 0 where the floor moves (floor), and 0 where it does not")
        if self.wall_restitution == 0 and (self.gravity > 0 or moving):
            allowed = (
                "allowed is a number > 0 with gravity or a floor in motion: a particle that sticks to it has no next collision"
            )
            raise SceneError("wall_restitution", self.wall_restitution, allowed)

    def _refuse_materials_that_are_none(self) -> None:
        for key, material in (("viscosity", "viscoelastic"), ("yield_velocity", "plastic")):
            value, named = getattr(self, key), self.material == material
            if named != (value > 0):
                raise SceneError(key, value, f"allowed is a number > 0 with material = {material}, and 0 without")
        if self.material != "constant" and self.restitution == 1:
            raise SceneError("restitution", self.restitution, f"allowed is less than 1: material = {self.material} dissipates")
        fastest = FASTEST * self.velocity_half_width
        if self.viscosity * fastest**0.2 > MOST_VISCOUS:
            allowed = f"allowed is at most {MOST_VISCOUS / fastest**0.2:.4g}, where r of collisions at {fastest:g} m/s is least"
            raise SceneError("viscosity", self.viscosity, allowed)

    def _refuse_models_that_are_none(self) -> None:
        exponent, lasts = self.contact_time_exponent, self.dissipates and any(self.contact_times)
        if exponent and not lasts:
            allowed = "allowed is 0 without a contact_time > 0 and a restitution < 1"
            raise SceneError("contact_time_exponent", exponent, allowed)
        if (self.contact_velocity > 0) != (exponent > 0):
            allowed = "allowed is a number > 0 with a contact_time_exponent > 0, and 0 without"
            raise SceneError("contact_velocity", self.contact_velocity, allowed)
        if self.critical_distance > self.diameter:
            allowed = f"allowed is at most the diameter, {self.diameter:g} m"
            raise SceneError("critical_distance", self.critical_distance, allowed)
        if self.rotation_angle and self.dimensions == 1:
            raise SceneError("rotation_angle", self.rotation_angle, "allowed is 0 in one dimension, where nothing can turn")
        if (self.kick_velocity > 0) != (self.kick_energy > 0):
            raise SceneError("kick_energy", self.kick_energy, "allowed is a number > 0 with a kick_velocity > 0, and 0 without")
        if self.kick_energy and self.restitution == 1:
            raise SceneError("kick_energy", self.kick_energy, "allowed is 0 at restitution = 1, where no energy is lost")
        if self.mode_damping and not self.internal_modes:
            raise SceneError("mode_damping", self.mode_damping, "allowed is 0 without internal_modes")
        longest = max(self.contact_times)
        if self.mode_damping * longest >= 1:
            allowed = f"allowed is less than {1 / longest:g} 1/s: modes ring longer than a contact_time of {longest:g} s"
            raise SceneError("mode_damping", self.mode_damping, allowed)

    def _refuse_clusters_of_anything_but_beads(self) -> None:
        if self.lrv_velocity == 0:
            return
        others = [key for key in SCENE_KEYS if key not in LRV_KEYS and getattr(self, key) != DEFAULTS[key]]
        reasons = {
            "unless dimensions = 1: only beads on a line pass impacts on one by one": self.dimensions != 1,
            "at restitution = 1, where no energy is lost": self.restitution == 1,
            f"with contact_time = {self.contact_time!r}: slow contacts merge, none of them lasts": self.contact_time != 0,
            f"with {', '.join(others)}: the model knows equal beads on a ring and nothing else": bool(others),
        }
        for reason, holds in reasons.items():
            if holds:
                raise SceneError("lrv_velocity", self.lrv_velocity, f"allowed is 0 {reason}")

    @property
    def walled(self) -> tuple[bool, ...]:
        """For each axis of space, whether the box ends there in walls."""
        words = self.boundary.split()
        return tuple(word == "wall" for word in (words * self.dimensions if len(words) == 1 else words))

    @property
    def fed(self) -> bool:
        """Whether particles gain kinetic energy between their collisions or from the floor."""
        return self.gravity > 0 or self.floor != "still"

    def speed_gained_2(self, height: float) -> float:
        """What a fall through a height (m) and the motion of the floor may add to the square of a velocity (m^2/s^2)."""
        return 2 * self.gravity * height + (2 * math.pi * self.floor_frequency * self.floor_amplitude) ** 2

    @property
    def volume(self) -> float:
        """V = N pi <d^2> / (4 nu) in m^2, or what it is in D dimensions, in m^D."""
        volume = box_volume(self.n_particles, self.area_fraction, self.diameter, self.dimensions)
        if self.sizes == "equal":
            return volume
        from granugas.diameters import moment  # which knows of scenes, and loads numpy

        return volume * moment(self, self.dimensions)

    @property
    def energy_per_mass(self) -> float:
        """E(0)/M = D w^2 / 6 in (m/s)^2, of components that are uniform in +-w, and kept through the equilibration."""
        return self.dimensions * self.velocity_half_width**2 / 6

    @property
    def rough(self) -> bool:
        """Whether surfaces rub: neither beta = -1 nor without friction."""
        return self.tangential_restitution > -1 and self.friction > 0

    @property
    def dissipates(self) -> bool:
        """Whether collisions are other than elastic ones of smooth particles: only then a contact duration changes them."""
        return self.restitution < 1 or self.rough

    @property
    def contact_times(self) -> tuple[float, ...]:
        """Every t_c of the scene, in s."""
        return self.contact_time if isinstance(self.contact_time, tuple) else (self.contact_time,)

    def at_start(self) -> "Scene":
        """The scene of its equilibration: elastic, with nothing of what does not decide the start state."""
        kept = {key.name: getattr(self, key.name) for key in fields(self) if key.metadata["start"]}
        return Scene(**kept, restitution=1.0, contact_time=0.0)

    def as_dict(self) -> dict[str, Any]:
        """All keys and values, as they were given."""
        return asdict(self)


SCENE_KEYS = tuple(key.name for key in fields(Scene))

DEFAULTS = {key.name: key.default for key in fields(Scene)}
"""What keys hold that nobody names."""

LRV_KEYS = (
    *("n_particles", "area_fraction", "restitution", "contact_time", "diameter", "velocity_half_width", "dynamics"),
    *("lattice", "dimensions", "lrv_velocity"),
)
"""Keys that scenes with an lrv_velocity may name."""

CHECKS = {key.name: key.metadata["check"] for key in fields(Scene)}

START_KEYS = tuple(key.name for key in fields(Scene) if key.metadata["start"])
"""Keys that decide a start state."""


def check_value(key: str, value: Any) -> None:
    """See whether a key may hold a value, in some scene or other.

    Raises:
        SceneError: it never may.
    """
    CHECKS[key](key, value)


def scene_from(values: Mapping[str, Any]) -> Scene:
    """A scene from keys and values.

    Raises:
        SceneError: an unknown key or a value that is not allowed.
    """
    for key in values:
        if key not in SCENE_KEYS:
            raise SceneError(key, values[key], f"unknown key; allowed are {', '.join(SCENE_KEYS)}")
    return Scene(**values)

"""A scene: what is simulated, as pure data that is checked when it is made."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any

from granugas.combinations import refuse_what_does_not_go_together
from granugas.geometry import box_volume
from granugas.keys import EXTREME, SceneError, area_fraction_key, boundary_key, choice, contact_time_key, integer, number

MAX_PARTICLES = 10_000_000

MOST_SLENDER = 1.0e4
"""Ratio of the sides of a box, either way."""

LATTICES = ("auto", "triangular", "square", "cubic", "fcc")
"""Start lattices."""

MOST_MODES = 100
"""Of a particle."""


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
        dynamics: the method that moves the particles: hard ones from event to event, or by random partners in cells (dsmc), or
            soft ones in steps of time.
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
        steps_per_contact: of soft spheres: steps in which t_c passes.
        particles_per_cell: of dsmc, on average: random partners come from one cell.

    Raises:
        SceneError: a value outside of what is allowed.
    """

    n_particles: int = integer(5740, 1, MAX_PARTICLES, start=True)
    area_fraction: float = area_fraction_key(0.2267)
    restitution: float = number(0.4, at_least=0.0, at_most=1.0)
    contact_time: float | tuple[float, ...] = contact_time_key(1.0e-5)
    diameter: float = number(1.0e-3, above=0.0, within=EXTREME, unit="m", start=True)
    velocity_half_width: float = number(0.5, above=0.0, within=EXTREME, unit="m/s", start=True)
    dynamics: str = choice("events", "soft_spheres", "dsmc")
    lattice: str = choice(*LATTICES, start=True)
    dimensions: int = choice(2, 1, 3, start=True)
    boundary: str = boundary_key("periodic")
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
    steps_per_contact: int = integer(50, 10, 1000)
    particles_per_cell: float = number(40.0, at_least=2.0, at_most=1.0e4)

    def __post_init__(self) -> None:
        if isinstance(self.contact_time, (tuple, list)):
            object.__setattr__(self, "contact_time", tuple(self.contact_time))
        for key in SCENE_KEYS:
            check_value(key, getattr(self, key))
        refuse_what_does_not_go_together(self)
        words = self.boundary.split()
        object.__setattr__(self, "boundary", words[0] if len(set(words)) == 1 else " ".join(words))
        if isinstance(self.contact_time, tuple):
            object.__setattr__(self, "contact_time", tuple(map(float, self.contact_time)))

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
    def soft(self) -> bool:
        """Whether contacts last, as those of soft spheres do."""
        return self.dynamics == "soft_spheres"

    @property
    def one_trajectory(self) -> bool:
        """Whether one trajectory serves all contact times: that of elastic collisions that last no time."""
        return not self.dissipates and not self.soft

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
        return {key: getattr(self, key) for key in SCENE_KEYS}


SCENE_KEYS = tuple(key.name for key in fields(Scene))

DEFAULTS = {key.name: key.default for key in fields(Scene)}
"""What keys hold that nobody names."""

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

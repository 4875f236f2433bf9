"""One run of a study, and the addresses of its files, which follow from its physics and from nothing else."""

import hashlib
import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from granugas.scene import DEFAULTS, SCENE_KEYS, START_KEYS, Scene

GRID_KEYS = tuple(SCENE_KEYS[: SCENE_KEYS.index("lattice") + 1])
"""Keys that every scene has; the others, effects, enter an address only where they are not the default."""

START_SECONDS = 2.0
SECONDS_PER_COLLISION, SECONDS_OF_DSMC = 1e-6, 1e-7
SECONDS_PER_STEP = 1e-8
"""What a job costs before its first collision, each collision (by events, of random partners) and each step of a soft sphere:
to plan with."""

MOST_IN_COOLING = 100.0
"""Exponent of a cooling gas (B Eq. 3) up to which the time is expected that its collisions take; numbers would overflow."""


@dataclass(frozen=True)
class Run:
    """One job of a study: one realization of one point of its grid, or a fixed chunk of them.

    Attributes:
        scene: what is simulated; at r = 1 with all contact times of its grid.
        seed, realizations: of the random streams.
        until: limits, `time` in s and `collisions_per_particle`, either or both.
        samples: `spacing`, `count`, `first` and `axis` of the sampling times.
        snapshots: times in s, ascending.
        equilibration: collisions per particle before the start state is judged.
        keep_positions: whether positions at the sampling times are kept.
        keep_motion: whether velocities and numbers of collisions are kept with them.
        max_collisions: of pairs, after which a run stops with what it has; None: no such limit.
    """

    scene: Scene
    seed: int
    realizations: tuple[int, ...]
    until: Mapping[str, float]
    samples: Mapping[str, Any]
    snapshots: tuple[float, ...]
    equilibration: float
    keep_positions: bool
    keep_motion: bool = False
    max_collisions: int | None = None

    @cached_property
    def address(self) -> str:
        """Name of the run's files: what people look for, then a digest of everything that decides the result."""
        times = self.scene.contact_times
        contact_time = f"{times[0]:g}" if len(times) == 1 else f"{len(times)}values"
        name = f"{self._label}_r{self.scene.restitution:g}_tc{contact_time}_s{self._numbers}"
        content = {
            "scene": {key: value for key, value in self.scene.as_dict().items() if _counts(key, value)},
            "until": self.until,
            "samples": self.samples,
            "snapshots": self.snapshots,
            "keep_positions": self.keep_positions,
        }
        content |= {"keep_motion": True} if self.keep_motion else {}
        content |= {"max_collisions": self.max_collisions} if self.max_collisions else {}
        kept = "_xy" if self.keep_positions else ""
        return f"{name}_{digest_of(self._stream | content)}{kept}"

    @cached_property
    def state_address(self) -> str:
        """Name of the start state's file, which runs with other r, t_c or limits share."""
        scene = self.scene.as_dict()
        content = {key: scene[key] for key in START_KEYS if _counts(key, scene[key])}
        return f"{self._label}_s{self._numbers}_{digest_of(self._stream | {'scene': content})}"

    @property
    def _label(self) -> str:
        space = "" if self.scene.dimensions == 2 else f"d{self.scene.dimensions}_"
        return f"{space}n{self.scene.n_particles}_nu{self.scene.area_fraction:g}"

    @property
    def _numbers(self) -> str:
        first, last = self.realizations[0], self.realizations[-1]
        return f"{first}" if first == last else f"{first}-{last}"

    @property
    def _stream(self) -> dict[str, Any]:
        return {"seed": self.seed, "realizations": self.realizations, "equilibration": self.equilibration}

    @cached_property
    def cost(self) -> float:
        """Expected s on one core, to plan with: from the collisions in an elastic gas, in homogeneous cooling, in clusters."""
        from granugas.analysis.enskog import enskog_rate
        from granugas.dynamics.soft_contact import step_of

        scene = self.scene
        rate = float(enskog_rate(scene.area_fraction, scene.energy_per_mass, scene.diameter, scene.dimensions))
        if scene.soft:
            steps = _time_in_cooling(self.until, rate, scene) / step_of(scene)
            return START_SECONDS + SECONDS_PER_STEP * scene.n_particles * steps * len(self.realizations)
        tau = rate * self.until.get("time", math.inf)
        collisions = tau if self.scene.restitution == 1 or self.scene.heating > 0 else _collisions_in_cooling(tau, self.scene)
        collisions = min(collisions, self.until.get("collisions_per_particle", math.inf))
        collisions *= len(self.realizations)
        seconds = SECONDS_OF_DSMC if scene.dynamics == "dsmc" else SECONDS_PER_COLLISION
        return START_SECONDS + seconds * self.scene.n_particles * collisions / 2


def _time_in_cooling(until: Mapping[str, float], rate: float, scene: Scene) -> float:
    """Until limits are reached (s) by a gas that begins with a collision rate (1/s): B Eq. 4 for its collisions."""
    loss = (1 - scene.restitution**2) / (2 * scene.dimensions)  # of sqrt(K)
    collisions = min(until.get("collisions_per_particle", math.inf), MOST_IN_COOLING / loss if loss else math.inf)
    time = (math.expm1(loss * collisions) / loss if loss else collisions) / rate
    return min(time, until.get("time", math.inf))


def _collisions_in_cooling(tau: float, scene: Scene) -> float:
    """Of a particle: B Eq. 4, or what was measured in clusters at r = .4 (they take over at tau of about 50)."""
    if tau < 50:
        return tau
    loss = (1 - scene.restitution**2) / (2 * scene.dimensions)
    clustered = 13 * math.sqrt(tau) * (max(*scene.contact_times, 1e-13) / 1e-5) ** -0.227
    return max(math.log(1 + loss * tau) / loss, clustered)


def digest_of(content: Any) -> str:
    """Twelve hexadecimal digits that are equal where numbers agree to 12 significant digits, 5 and 5.0 too."""
    return hashlib.sha256(json.dumps(_canonical(content), sort_keys=True).encode()).hexdigest()[:12]


def _counts(key: str, value: Any) -> bool:
    """Whether a key enters an address."""
    return key in GRID_KEYS or value != DEFAULTS[key]


def _canonical(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _canonical(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_canonical(item) for item in value]
    return f"{value:.12g}" if isinstance(value, float) else str(value)

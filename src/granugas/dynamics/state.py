"""The state of a gas at one instant: what every kind of dynamics takes and gives back."""

from dataclasses import dataclass, field

import numpy as np


@dataclass
class State:
    """All particles at one time.

    Attributes:
        time: s.
        box: (Lx, Ly) in m, as many sides as space has dimensions D.
        position: (N, D), in m, inside the box.
        velocity: (N, D), in m/s.
        last_collision_time: (N,), in s; -inf where there was none.
        last_collision_interval: (N,), time between the last two collisions in s; inf where there were none.
        collisions: (N,), number of collisions so far.
        more: arrays (N, ...) of what effects know of each particle (diameter, mass, spin ...), by name.
        seed: numbers that what is drawn at random on the way follows from.
    """

    time: float
    box: tuple[float, ...]
    position: np.ndarray
    velocity: np.ndarray
    last_collision_time: np.ndarray
    last_collision_interval: np.ndarray
    collisions: np.ndarray
    more: dict[str, np.ndarray] = field(default_factory=dict)
    seed: tuple[int, ...] = ()

"""The state of a gas at one instant: what every kind of dynamics takes and gives back."""

from dataclasses import dataclass

import numpy as np


@dataclass
class State:
    """All disks at one time.

    Attributes:
        time: s.
        box: (Lx, Ly) in m.
        position: (N, 2), in m, inside the box.
        velocity: (N, 2), in m/s.
        last_collision_time: (N,), in s; -inf where there was none.
        last_collision_interval: (N,), time between the last two collisions in s; inf where there were none.
        collisions: (N,), number of collisions so far.
    """

    time: float
    box: tuple[float, float]
    position: np.ndarray
    velocity: np.ndarray
    last_collision_time: np.ndarray
    last_collision_interval: np.ndarray
    collisions: np.ndarray

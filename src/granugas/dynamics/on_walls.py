"""The pressure on the walls of a box, of whatever dynamics."""

import math
from typing import Any

import numpy as np

from granugas.dynamics.state import State
from granugas.scene import Scene


def wall_pressure(scene: Scene, state: State, tally: Any, interval: float) -> float:
    """P V / (N k T) from the momentum that the walls took up in an interval (s); NaN where there is none.

    Args:
        scene: with walls.
        state: at the end of the interval.
        tally: of the interval, with `wall_momentum` (D, 2), per mass (m/s).
        interval: s.
    """
    if tally is None or interval <= 0:
        return math.nan
    box, walled = np.array(state.box), np.array(scene.walled)
    force = np.sum(np.abs(tally.more["wall_momentum"])) / interval
    area = 2 * np.sum(math.prod(state.box) / box[walled])
    squares = np.sum(state.velocity**2, axis=1) * state.more.get("mass", 1.0)
    gone, gone_time = tally.loss + tally.stored, tally.loss_time + tally.stored_time
    energy = np.sum(squares) / 2 + gone - gone_time / interval  # mean over the interval
    return float(force / area * math.prod(state.box) / (2 * energy / scene.dimensions))

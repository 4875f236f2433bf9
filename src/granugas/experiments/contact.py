"""Two soft and two hard particles that collide head on (A Fig. 1)."""

import numpy as np
import xarray as xr

from granugas.dynamics import soft_contact
from granugas.dynamics.events.effects.constant import Constant
from granugas.dynamics.events.effects.contact_time import ContactTime
from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import at_rest
from granugas.scene import Scene

SPEED, RESTITUTION, CONTACT_TIME, DIAMETER = 0.5, 0.6, 1e-3, 1e-3
"""Speed of each particle (m/s), r, t_c (s) and d (m): at these an overlap can be seen."""

GAP, UNTIL, STEP = 1.0, 4.0, 1 / 200
"""Distance of the surfaces at the start (d), end and step of the integration (t_c)."""


def measure() -> xr.Dataset:
    """Positions (m) of two soft particles, integrated, and of two hard ones, by the engine, at the same times (s)."""
    spring = soft_contact.spring(CONTACT_TIME, RESTITUTION)
    path = soft_contact.integrate(spring, GAP * DIAMETER, -2 * SPEED, UNTIL * CONTACT_TIME, STEP * CONTACT_TIME)
    begin, end = soft_contact.contacts(path)
    hard, collision_time = _hard(path.time)
    soft = np.outer((DIAMETER + path.h) / 2, [-1, 1])  # the centre of mass rests
    return xr.Dataset(
        {
            "soft_position": (("experiment_time", "particle"), soft),
            "hard_position": (("experiment_time", "particle"), hard),
            "contact_begin": begin[0],
            "contact_end": end[0],
            "collision_time": collision_time,
        },
        {"experiment_time": path.time},
        {"restitution": RESTITUTION, "contact_time": CONTACT_TIME, "diameter": DIAMETER},
    )


def _hard(times: np.ndarray) -> tuple[np.ndarray, float]:
    """Positions from the centre of the box, (times, 2), and the time of the collision."""
    scene = Scene(2, restitution=RESTITUTION, contact_time=CONTACT_TIME, diameter=DIAMETER)
    side = 10 * DIAMETER
    apart = (1 + GAP) * DIAMETER / 2
    place = np.array([[side / 2 - apart, side / 2], [side / 2 + apart, side / 2]])
    start = at_rest(place, np.array([[SPEED, 0.0], [-SPEED, 0.0]]), (side, side))
    engine = Engine(scene, start, rule=ContactTime(Constant(RESTITUTION), CONTACT_TIME))
    positions = np.empty((len(times), 2))
    for row, time in zip(positions, times, strict=True):
        engine.advance(time)
        row[:] = engine.state().position[:, 0] - side / 2
    return positions, float(engine.state().last_collision_time[0])

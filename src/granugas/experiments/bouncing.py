"""One ball that bounces on a plate until it rests, and then (A section 4.2, Fig. 2, table 1)."""

from collections.abc import Iterator

import numpy as np
import xarray as xr

from granugas.dynamics import soft_contact
from granugas.dynamics.events.effects.constant import Constant
from granugas.dynamics.events.effects.contact_time import ContactTime
from granugas.dynamics.plate import Averages, Ball, Bounces, averages, bounce, next_hit, plate, state_at

GRAVITY, FIRST_SPEED = 9.81, 1.0
"""g (m/s^2) and v_1 (m/s)."""

FIRST_PERIOD = 2 * FIRST_SPEED / GRAVITY
"""t_1 (s)."""

RESTITUTIONS = (0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99)
CONTACT_RATIOS = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
"""t_c / t_1."""

MOST_HITS = 5000
"""Of a run: more than double precision resolves of a collapse at r = .99."""

WINDOWS = (1.0, 1.5, 10.5, 100.5)
"""Lengths of the averages in periods t_inf: one, and longer ones that do not end as they began."""

WINDOW_ENDS = 16
"""Of each window, spread over the period."""

RELEASES = 10_000
"""Phases of the period at which gravity is switched off."""

SHOWN = {"restitution": 0.8, "contact_ratio": 0.1}
"""The ball whose height is kept, and which a soft one is compared with."""

SOFT_STEP, SOFT_REST = 1 / 200, 200
"""Step of the integration, and when the soft particle rests to rounding (t_c)."""


def measure() -> xr.Dataset:
    """Numbers of hits, times, periods and averages over r and t_c / t_1, and the heights of the ball that is shown."""
    hard = xr.concat([_collapse(r) for r in RESTITUTIONS], "restitution")
    points = [[_rest(r, ratio * FIRST_PERIOD) for ratio in CONTACT_RATIOS] for r in RESTITUTIONS]
    rest = xr.combine_nested(points, ["restitution", "contact_ratio"])
    data = xr.merge([hard, rest, _heights(), _soft_at_rest()]).transpose("restitution", "contact_ratio", ...)
    data["rest_time_difference"] = data["rest_time_hard"] - data["rest_time"]
    data = data.assign(gravity=GRAVITY, first_period=FIRST_PERIOD).assign_attrs(SHOWN)
    return data.assign_coords(
        restitution=list(RESTITUTIONS),
        contact_ratio=list(CONTACT_RATIOS),
        window=list(WINDOWS),
        window_end=_phases(WINDOW_ENDS),
    )


def _phases(count: int) -> np.ndarray:
    """The middles of `count` equal parts of a period."""
    return (np.arange(count) + 0.5) / count


def _from_first_hit(rule: Constant | ContactTime) -> Bounces:
    return bounce(rule, Ball(0.0, -FIRST_SPEED), GRAVITY, MOST_HITS)


def _collapse(restitution: float) -> xr.Dataset:
    """The IHS model, until the flights are too short for double precision."""
    run = _from_first_hit(Constant(restitution))
    return xr.Dataset(
        {
            "rest_time_hard": run.time[-1],
            "hits_to_collapse": len(run.time),
            "speed_at_collapse": run.after[-1],
            "stop_reason": run.stop,
        }
    )


def _rest(restitution: float, contact_time: float) -> xr.Dataset:
    """The TC model: how it comes to rest, and what it does there."""
    rule = ContactTime(Constant(restitution), contact_time)
    run = _from_first_hit(rule)
    dissipative = np.flatnonzero(~run.elastic)
    speed, period = run.after[-1], run.since[-1]
    # Its clock begins anew, so that it resolves short periods as well.
    staying = bounce(rule, Ball(0.0, -speed, period), GRAVITY, int(max(WINDOWS)) + 4)
    windows = [[_window(staying, period * length, phase, contact_time) for phase in _phases(WINDOW_ENDS)] for length in WINDOWS]
    mean = Averages(*np.moveaxis(np.array(windows), -1, 0))
    over = ("window", "window_end")
    return xr.Dataset(
        {
            "hits_to_rest": len(dissipative),
            "rest_time": run.time[dissipative[-1]],
            "staying_period": period,
            "mean_velocity": (over, mean.v),
            "mean_square_velocity": (over, mean.v2),
            "elastic_square_velocity": (over, mean.v2_elastic),
            "mean_height": (over, mean.h),
            "plate_force": (over, mean.force / GRAVITY),
            "released_square_velocity": np.mean([v**2 for v in _released(rule, staying, period)]),
        }
    )


def _window(staying: Bounces, length: float, phase: float, contact_time: float) -> Averages:
    """Averages over the last window that ends at a phase of the period."""
    period = staying.since[-1]
    return averages(staying, staying.time[-1] + phase * period, length, contact_time)


def _released(rule: ContactTime, staying: Bounces, period: float) -> Iterator[float]:
    """Velocities that the ball ends up with when gravity is switched off, one for each phase (A section 4.2.3)."""
    weightless = plate(0.0)
    since = _phases(RELEASES) * period
    for state in np.stack([*state_at(staying, staying.time[0] + since), since], axis=1).tolist():
        ball = Ball(*state)
        while hit := next_hit(rule, ball, weightless):
            ball = Ball(0.0, hit.after, 0.0)
        yield ball.v


def _heights() -> xr.Dataset:
    """Height against time from the first hit on: hard (no state after the collapse), TC and soft."""
    r, contact_time = SHOWN["restitution"], SHOWN["contact_ratio"] * FIRST_PERIOD
    time = np.linspace(0, 1.5 * r / (1 - r) * FIRST_PERIOD, 6001)
    soft = _soft(time[-1])
    heights = {
        "height_hard": state_at(_from_first_hit(Constant(r)), time)[0],
        "height_contact_time": state_at(_from_first_hit(ContactTime(Constant(r), contact_time)), time)[0],
        "height_soft": np.interp(time, soft.time, soft.h),
    }
    return xr.Dataset({name: ("experiment_time", h) for name, h in heights.items()}, {"experiment_time": time})


def _soft(until: float) -> soft_contact.Path:
    """The soft ball from its first contact on."""
    contact_time = SHOWN["contact_ratio"] * FIRST_PERIOD
    spring = soft_contact.spring(contact_time, SHOWN["restitution"])
    return soft_contact.integrate(spring, 0.0, -FIRST_SPEED, until, SOFT_STEP * contact_time, GRAVITY)


def _soft_at_rest() -> xr.Dataset:
    """Energies and force per mass of the soft ball at rest; how long the contact of its spring lasts without a dashpot."""
    contact_time = SHOWN["contact_ratio"] * FIRST_PERIOD
    stiffness = soft_contact.spring(contact_time, SHOWN["restitution"]).stiffness
    path = _soft(SOFT_REST * contact_time)
    h, v = path.h[-1], path.v[-1]
    undamped = soft_contact.Spring(stiffness, 0.0)
    bounced = soft_contact.integrate(undamped, contact_time, -1.0, 4 * contact_time, SOFT_STEP * contact_time)
    (begin,), (end,) = soft_contact.contacts(bounced)
    return xr.Dataset(
        {
            "soft_kinetic_energy": v**2 / 2,
            "soft_elastic_energy": stiffness * h**2 / 2,
            "soft_potential_energy": GRAVITY * h,
            "soft_force": -stiffness * h / GRAVITY,
            "soft_contact_time": end - begin,
        }
    )

"""Gases without a contact duration on their way into the inelastic collapse (A section 2.1): the last collisions of each."""

import math
from dataclasses import replace

import numpy as np
import xarray as xr

from granugas.analysis.enskog import enskog_rate
from granugas.analysis.observables import kinetic_energy
from granugas.dynamics.events import loop
from granugas.dynamics.events.effects.recorder import recorder
from granugas.dynamics.events.engine import Engine
from granugas.dynamics.state import State
from granugas.equilibrate import equilibrate, state_of
from granugas.scene import Scene

GAS = Scene(1435, 0.226725, restitution=0.3, contact_time=0.0, lattice="triangular")
RESTITUTIONS = (0.3, 0.4, 0.5)
"""Below the measured r_c: all of them collapse."""

SEED, REALIZATIONS = 1998, 4

LAST = 1000
"""Collisions that are kept: those of the disks that take part, the last ones."""

MOST_COLLISIONS = 500
"""Of a particle; a gas that has not collapsed by then is not one to look at."""


def measure() -> xr.Dataset:
    """The time that is left to the collapse at each of the last collisions of the disks that take part in it.

    Returns:
        Dataset over restitution, realization and collisions_left (1: the last but one): time_left = t* - t in s, where t* is
        the time at which the collapse was noticed, NaN where there were fewer collisions; disks_involved, stop_time = t* in s
        and events of each run; enskog_rate in 1/s.

    Raises:
        RuntimeError: a gas that does not collapse.
    """
    starts = [state_of(equilibrate(GAS, seed=SEED, realization=k)) for k in range(REALIZATIONS)]
    scenes = [replace(GAS, restitution=r) for r in RESTITUTIONS]
    found = [xr.concat([_approach(scene, start) for start in starts], "realization") for scene in scenes]
    data = xr.concat(found, "restitution").assign_coords(restitution=list(RESTITUTIONS))
    energy = float(kinetic_energy(starts[0].velocity).sum()) / GAS.n_particles
    return data.assign(enskog_rate=float(enskog_rate(GAS.area_fraction, energy, GAS.diameter))).assign_attrs(
        n_particles=GAS.n_particles, area_fraction=GAS.area_fraction, diameter=GAS.diameter
    )


def _approach(scene: Scene, start: State) -> xr.Dataset:
    """One gas: once until its collapse is noticed, and the same again with every collision written down."""
    engine = Engine(scene, start)
    if engine.advance(math.inf, MOST_COLLISIONS * scene.n_particles // 2) != loop.WATCH:
        raise RuntimeError(f"r = {scene.restitution}: no collapse in {MOST_COLLISIONS} collisions per particle")
    watch = recorder(engine.collisions)
    Engine(scene, start, watch=watch).advance(math.inf)
    who, seen = engine.involved(), watch.seen.rows
    moved = np.flatnonzero(np.diff(seen["time"]) < 0)  # the origin of times, which moves on now and then
    seen = seen[moved[-1] + 1 if len(moved) else 0 :]
    theirs = seen["time"][np.isin(seen["i"], who) & np.isin(seen["j"], who)]
    left = (seen["time"][-1] - theirs[-2 : -LAST - 2 : -1]) if len(theirs) > 1 else np.empty(0)
    return xr.Dataset(
        {
            "time_left": ("collisions_left", np.pad(left, (0, LAST - len(left)), constant_values=np.nan)),
            "disks_involved": len(who),
            "stop_time": engine.time,
            "events": engine.collisions,
        },
        {"collisions_left": np.arange(1, LAST + 1)},
    )

"""What a physicist would doubt about a run: one line each, said once in the log, kept in the attribute `warnings`.

The lines follow from the scene, its start state and the run, so that equal runs have equal lines.
"""

import logging
import math
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from typing import Any

import xarray as xr

from granugas.analysis.enskog import enskog_rate
from granugas.scene import Scene

RELAXED = 10.0
"""Collisions per particle after which velocities that were uniformly distributed have the kurtosis of Maxwellian ones within
2 % (measured up to nu = .6)."""

RESOLVED = 1e-30
"""K below which rounding decides: the common velocity that it leaves, 1e-16 of the first speeds, does not decay."""

MOST_OVERLAP = 0.1
"""Overlap of soft spheres (d) up to which they are nearly hard: at larger ones the gas is denser than that of hard ones."""

FEWEST_CELLS = 3
"""In a box of fewer in one direction, a disk is a neighbour of the images of its neighbours."""

FEWEST_FOR_CLUSTERS = 10
"""A box that is fewer mean distances wide, in 2D one of fewer than 100 disks: a cluster of ten meets its own image."""

logger = logging.getLogger("granugas")


def doubts_of_start(n_particles: int, start: Mapping[str, Any]) -> list[str]:
    """Whether a start state, with the attributes that `equilibrate` gives it, is in equilibrium."""
    collided = float(start["equilibration_collisions_per_particle"])
    if n_particles == 1:
        return []
    if not start["equilibration_reached"]:
        signs = ", ".join(f"{sign} {start[f'equilibration_{sign}']:.4g}" for sign in ("kurtosis", "anisotropy", "order"))
        return [f"start state: not in equilibrium after {collided:g} collisions per particle ({signs})"]
    if collided < RELAXED:
        return [
            f"start state: equilibrated for {collided:.3g} collisions per particle, velocities need about {RELAXED:g} to "
            "become Maxwellian"
        ]
    return []


def doubts_before(scene: Scene, start: Mapping[str, Any], cells: Sequence[int], keep_positions: bool) -> list[str]:
    """What is doubtful already at t = 0.

    Args:
        scene: what is simulated; at r = 1 of smooth disks any t_c will do, it is only looked at.
        start: attributes of the start state.
        cells: of the engine, along each axis.
        keep_positions: whether there will be positions for a cluster analysis.
    """
    n, lines = scene.n_particles, doubts_of_start(scene.n_particles, start)
    longest = max(scene.contact_times) if not scene.one_trajectory else 0.0
    flight = 1 / float(enskog_rate(scene.area_fraction, scene.energy_per_mass, scene.diameter, scene.dimensions))
    if longest > flight and n > 1:
        so = "particles are in several contacts at once" if scene.soft else "most collisions are elastic"
        lines.append(
            f"contact_time = {longest:g} s is longer than the mean time between collisions at t = 0, {flight:.4g} s "
            f"(A Eq. 19): {so} from the start"
        )
    if scene.soft and (overlap := scene.velocity_half_width * longest / math.pi / scene.diameter) > MOST_OVERLAP:
        lines.append(
            f"contact_time = {longest:g} s: soft spheres that meet at velocity_half_width overlap by {overlap:.2g} diameters"
        )
    if scene.friction < math.inf and scene.tangential_restitution == -1:
        lines.append(f"friction = {scene.friction:g} does nothing: the surfaces are smooth (tangential_restitution = -1)")
    if scene.heating > 0 and not scene.dissipates:
        lines.append(
            f"heating = {scene.heating:g} m^2/s^3 at restitution = 1: nothing dissipates, the energy grows without end"
        )
    lines += _without_effect(scene)
    around = [count for count, wall in zip(cells, scene.walled, strict=True) if not wall and scene.dynamics != "dsmc"]
    if min(around, default=FEWEST_CELLS) < FEWEST_CELLS:
        sides = " x ".join(f"{float(start[f'box_{axis}']) / scene.diameter:.3g}" for axis in "xyz"[: scene.dimensions])
        lines.append(
            f"box of {sides} diameters in {' x '.join(map(str, cells))} cells: with fewer than {FEWEST_CELLS} in a direction "
            "disks meet several images of one neighbour"
        )
    fewest = FEWEST_FOR_CLUSTERS**scene.dimensions
    if keep_positions and n < fewest:
        lines.append(
            f"n_particles = {n}: too few for a cluster analysis, with fewer than {fewest} a cluster soon meets its own image"
        )
    return lines


def _without_effect(scene: Scene) -> list[str]:
    """Keys of sizes that the scene does not have."""
    belongs = {"size_ratio": ("bidisperse",), "size_share": ("bidisperse",), "size_spread": ("uniform", "log_normal")}
    return [
        f"{key} = {getattr(scene, key):g} has no effect with sizes = {scene.sizes}"
        for key, sizes in belongs.items()
        if scene.sizes not in sizes and getattr(scene, key) != getattr(Scene, key)
    ]


def doubts_after(run: xr.Dataset) -> list[str]:
    """What lies beyond the end of a run that has `stop_time` and `stop_reason`, and beyond that of double precision."""
    end = f"beyond the end of the run at t = {run['stop_time'].item():.6g} s ({run['stop_reason'].item()})"
    samples, snapshots = run["kinetic_energy"].isnull(), run["velocity"].isnull().any(["particle", "axis"])
    lines = []
    if number := int((run["kinetic_energy"] < RESOLVED).sum()):
        lines.append(
            f"kinetic_energy: {number} of {samples.size} samples lie below {RESOLVED:g}, beyond the end of double precision: "
            "they count the common motion that rounding leaves"
        )
    if samples.any():
        lines.append(f"samples: {int(samples.sum())} of {samples.size} lie {end} and are NaN")
    if snapshots.any():
        times = ", ".join(f"{time:g}" for time in run["snapshot"].values[snapshots])
        lines.append(f"snapshots: those at {times} s lie {end} and are NaN")
    return lines


def tell(lines: Iterable[str], level: int = logging.WARNING) -> None:
    """Say each line once in the log: realizations that one job runs share their doubts."""
    for line in lines:
        _say(line, level)


@cache
def _say(line: str, level: int) -> None:
    logger.log(level, "%s", line)

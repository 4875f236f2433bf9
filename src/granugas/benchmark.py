"""How long a collision takes: one scene, timed inside one process, compilation apart."""

import statistics
import time
from dataclasses import dataclass, replace
from typing import Any

from granugas.arguments import is_number, need_integer
from granugas.dynamics import engine_of
from granugas.dynamics.events.effects.constant import Constant
from granugas.dynamics.events.effects.contact_time import ContactTime
from granugas.equilibrate import equilibrate, state_of
from granugas.scene import Scene
from granugas.warm_up import warm_up

ROUNDS = 5
"""Timed parts of equal length; the median is quoted."""


@dataclass(frozen=True)
class Timing:
    """Cost of the collisions of one scene.

    Attributes:
        ns_per_collision: median over the rounds, processor time.
        fastest, slowest: of the rounds.
        collisions: of pairs, in all rounds.
        bytes_per_particle: of the engine's arrays.
        compile_s: time until the kernels were there, compiled or loaded from the cache.
    """

    ns_per_collision: float
    fastest: float
    slowest: float
    collisions: int
    bytes_per_particle: float
    compile_s: float


def time_collisions(
    scene: Scene,
    collisions: int,
    *,
    equilibration: float = 30.0,
    begin: float = 0.0,
    seed: int = 1,
    **effects: Any,
) -> Timing:
    """Time the collisions of a scene from equilibrium, or from the time `begin` (s) on.

    `effects` replace those that the scene calls for (rule=always_contact_time(scene), to see what the rule costs).

    Raises:
        ValueError: no collision to time, or no time to begin at.
    """
    need_integer("collisions", collisions, 1)
    if not is_number(begin) or begin < 0:
        raise ValueError(f"begin = {begin!r}: allowed is a number >= 0 s")
    started = time.perf_counter()
    warm_up([replace(scene)])
    compile_s = time.perf_counter() - started
    start = equilibrate(scene, seed=seed, collisions_per_particle=equilibration)
    engine: Any = engine_of(scene, state_of(start), **effects)
    engine.advance(begin)
    costs = []
    for _ in range(ROUNDS):
        done, clock = engine.collisions, time.process_time()
        engine.advance(float("inf"), -(-collisions // ROUNDS))
        costs.append((time.process_time() - clock) / max(engine.collisions - done, 1) * 1e9)
    return Timing(statistics.median(costs), min(costs), max(costs), collisions, engine.bytes_per_particle, compile_s)


def time_span(scene: Scene, until: float, *, equilibration: float = 30.0, seed: int = 1) -> Timing:
    """Time all collisions of a scene from t = 0 to `until` (s), in one piece."""
    started = time.perf_counter()
    warm_up([replace(scene)])
    compile_s = time.perf_counter() - started
    engine: Any = engine_of(scene, state_of(equilibrate(scene, seed=seed, collisions_per_particle=equilibration)))
    clock = time.process_time()
    engine.advance(until)
    cost = (time.process_time() - clock) / max(engine.collisions, 1) * 1e9
    return Timing(cost, cost, cost, engine.collisions, engine.bytes_per_particle, compile_s)


def always_contact_time(scene: Scene) -> ContactTime:
    """The TC rule also where the scene does not call for it (r = 1, t_c = 0)."""
    return ContactTime(Constant(float(scene.restitution)), float(max(scene.contact_times)))

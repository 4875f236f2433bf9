"""What looser arithmetic gains and loses: the engine as it is, with fused operations, and with fast-math.

Each kind is compiled in a process of its own and in memory only: the flags of an entry of the loop go down to all functions
that it calls, so those of two kinds must not meet in one process, and none may come into the cache of kernels.
"""

import math
import pickle
import subprocess
import sys
import time
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import xarray as xr

from granugas.analysis.accuracy import bias
from granugas.analysis.observables import kinetic_energy
from granugas.benchmark import always_contact_time
from granugas.dynamics.events.arithmetic import use
from granugas.dynamics.events.engine import Engine
from granugas.dynamics.state import State
from granugas.equilibrate import equilibrate, state_of
from granugas.scene import Scene

ALONE = ("the time of a collision",)

FLAGS: dict[str, str] = {
    "strict": "",
    "fused": "contract",
    "fast but for infinity": "contract reassoc nsz arcp afn",
    "fast": "fast",
}
"""LLVM's fast-math flags of each setting: none; a b + c with one rounding; sums in any order and division by multiplication;
and all of them, which also take it that no number is infinite, as the next collision of a lone disk is."""

COOLING = Scene(1435, 0.226725, restitution=0.4, contact_time=1e-5, lattice="triangular")
ELASTIC = replace(COOLING, restitution=1.0, contact_time=0.0)
SEED = 1998

PRESSURE = "elastic P V/E"
"""Name of the only observable of the elastic gas."""


class Plan(NamedTuple):
    """How much is measured.

    Attributes:
        settings: names in FLAGS; the first is what the others are compared with.
        realizations: of both gases.
        followed: collisions of pairs of the elastic gas that are looked at one by one.
        collisions: of pairs after them, for its pressure and energy.
        looks: times (s) of the cooling gas.
    """

    settings: tuple[str, ...]
    realizations: int
    followed: int
    collisions: int
    looks: tuple[float, ...]


FULL = Plan(tuple(FLAGS), 12, 20_000, 200_000, (0.1, 1.0))
SMALL = Plan(("strict", "fused"), 2, 1_000, 10_000, (0.01, 0.02))


def measure(plan: Plan = FULL) -> xr.Dataset:
    """Every kind of arithmetic from the same start states.

    Returns:
        Dataset over case, setting (the arithmetic) and observable, as `analysis.accuracy.bias` has it, the truth being the
        first setting; cpu_seconds of a cooling gas to the last look, median over realizations. Over setting and realization
        as well what `_elastic` finds and first_difference, the collision of pairs at which the order of the elastic gas
        departs from that of the first setting (NaN: none of those that were followed).
    """
    starts = [state_of(equilibrate(ELASTIC, seed=SEED, realization=k)) for k in range(plan.realizations)]
    found = xr.concat([_in_own_process(FLAGS[name], starts, plan) for name in plan.settings], "setting")
    found = found.assign_coords(setting=list(plan.settings))
    other = (found["partners"] != found["partners"].isel(setting=0)).any("partner")
    found["first_difference"] = (other.argmax("collision") + 1.0).where(other.any("collision"))
    values = found[[PRESSURE, *map(_named, plan.looks)]].to_dataarray("observable")
    data = bias(values, values.isel(setting=0, drop=True)).assign(cpu_seconds=found["cpu_seconds"].median("realization"))
    kept = found[["smallest_gap", "rms_gap", "energy_balance", "cpu_per_collision", "first_difference"]]
    data = data.expand_dims(case=[f"N = {COOLING.n_particles}"])
    return data.merge(kept).assign_attrs(
        knob="arithmetic of the kernels",
        flags=[f"{name}: {FLAGS[name] or 'none'}" for name in plan.settings],
        **{key: getattr(COOLING, key) for key in ("area_fraction", "restitution", "contact_time", "diameter")},
    )


def _in_own_process(flags: str, starts: list[State], plan: Plan) -> xr.Dataset:
    """What `_both` returns, of a fresh process with these flags.

    Raises:
        subprocess.CalledProcessError: it failed; its own message stands above.
    """
    command = [sys.executable, "-m", __name__, flags]
    return pickle.loads(subprocess.run(command, input=pickle.dumps((starts, plan)), stdout=subprocess.PIPE, check=True).stdout)


def _both(starts: list[State], plan: Plan) -> xr.Dataset:
    """Both gases from each of their start states, with whatever arithmetic this process has."""
    _engine(ELASTIC, starts[0]).advance(math.inf, 1)  # compiles the kernel of both
    return xr.concat([xr.merge([_elastic(start, plan), _cooling(start, plan)]) for start in starts], "realization")


def _engine(scene: Scene, state: State) -> Engine:
    """Both gases with one kernel: elastic disks follow a TC rule that has nothing to do."""
    return Engine(scene, state, rule=always_contact_time(scene))


def _elastic(start: State, plan: Plan) -> xr.Dataset:
    """The elastic gas.

    Returns:
        partners (collision, partner) of the followed collisions; smallest_gap and rms_gap of these at their contacts (d);
        PRESSURE and cpu_per_collision (ns) of the later ones; energy_balance at the end.
    """
    engine = _engine(ELASTIC, start)
    partners, gaps = np.empty((plan.followed, 2), np.int64), np.empty(plan.followed)
    for k in range(plan.followed):
        engine.advance(math.inf, 1)
        partners[k] = np.flatnonzero(engine.arrays["clocks"]["last"] == engine.arrays["calendar"]["now"])
        gaps[k] = gap(engine, *partners[k])
    engine.take_tally()
    begin, clock = engine.time, time.process_time()
    engine.advance(math.inf, plan.collisions)
    seconds = time.process_time() - clock
    energy, before = (kinetic_energy(state.velocity).sum() for state in (engine.state(), start))
    stress = engine.take_tally().stress / (energy * (engine.time - begin))
    return xr.Dataset(
        {
            "partners": (("collision", "partner"), partners),
            "smallest_gap": gaps.min(),
            "rms_gap": np.sqrt(np.mean(gaps**2)),
            "energy_balance": energy / before - 1,
            "cpu_per_collision": seconds / plan.collisions * 1e9,
            PRESSURE: 1 - np.trace(stress) / 2,
        }
    )


def gap(engine: Engine, i: int, j: int) -> float:
    """Distance of two disks less d, in d, from where each of them was when it last collided: coordinates within their cells."""
    disks, cells, width = engine.arrays["disks"], engine.arrays["grid"]["cells"][0], engine.arrays["grid"]["width"][0]
    apart = disks["cell"][j].astype(int) - disks["cell"][i]
    apart -= cells * np.rint(apart / cells).astype(int)
    return float(np.linalg.norm(disks["x"][j] - disks["x"][i] + apart * width) - 1)


def _cooling(start: State, plan: Plan) -> xr.Dataset:
    """K of the cooling gas at the looks, and the processor time to the last of them."""
    engine, energies, clock = _engine(COOLING, start), {}, time.process_time()
    for look in plan.looks:
        engine.advance(look)
        energies[_named(look)] = kinetic_energy(engine.state().velocity).sum() / kinetic_energy(start.velocity).sum()
    return xr.Dataset({**energies, "cpu_seconds": time.process_time() - clock})


def _named(look: float) -> str:
    return f"K at {look:g} s"


if __name__ == "__main__":
    use(set(sys.argv[1].split()))
    sys.stdout.buffer.write(pickle.dumps(_both(*pickle.load(sys.stdin.buffer))))

"""What the contact duration changes and costs: gases that begin alike, with t_c from far too long to hardly any."""

from dataclasses import replace
from functools import cache
from typing import NamedTuple

import xarray as xr

from granugas.analysis.accuracy import at_zero, bias
from granugas.analysis.clusters import find_clusters
from granugas.equilibrate import equilibrate
from granugas.scene import Scene
from granugas.simulate import simulate
from granugas.warm_up import warm_up

ALONE = ("the processor time of a run",)

GAS = Scene(5740, 0.226725, restitution=0.4, contact_time=1e-5, lattice="triangular")
SEED = 1998
DISTANCE_FACTOR = 1.1
"""S_c of the clusters."""

SHORT = 1e-5
"""Contact durations (s) up to which the limit t_c -> 0 is taken: there nothing but chance tells them apart."""

VANISHING = ("n_e", "E_e/E")
"""Observables whose limit is 0."""

OBSERVABLES = {
    "K": "kinetic_energy",
    "<M>": "mean_cluster_size",
    "M_max": "largest_cluster_size",
    "n_e": "elastic_particle_fraction",
    "E_e/E": "elastic_energy_fraction",
}


class Size(NamedTuple):
    """Gases of one size: number of particles, contact durations in s, and realizations."""

    n_particles: int
    contact_times: tuple[float, ...]
    realizations: int


class Plan(NamedTuple):
    """How much is measured: sizes of the gases, and the two times (s) when they are looked at; they end with the second."""

    sizes: tuple[Size, ...]
    looks: tuple[float, float] = (1.0, 5.0)


FULL = Plan(
    (
        Size(5740, (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-10, 1e-12), 5),
        Size(79524, (1e-3, 1e-5, 1e-6, 1e-8), 2),
    )
)
SMALL = Plan((Size(378, (1e-2, 1e-3, 1e-5, 1e-6, 1e-7), 3),), (0.1, 0.5))


def measure(plan: Plan = FULL) -> xr.Dataset:
    """Each size with each t_c, from the same start states.

    Trajectories part chaotically, so that below SHORT every t_c is one more sample of the same gas: the truth is the limit
    t_c -> 0 of those, for each start state by itself.

    Returns:
        Dataset over case (the sizes), setting (t_c in s) and observable, as `analysis.accuracy.bias` has it; cpu_seconds of a
        run to the second look, median over realizations. The truth of n_e and E_e, which vanish with t_c, is 0.
    """
    data = xr.concat([_gases(size, plan.looks) for size in plan.sizes], "case")
    return data.assign_attrs(
        knob="contact duration t_c in s",
        looks=list(plan.looks),
        distance_factor=DISTANCE_FACTOR,
        **{key: getattr(GAS, key) for key in ("area_fraction", "restitution", "diameter")},
    )


def _gases(size: Size, looks: tuple[float, float]) -> xr.Dataset:
    """All runs of one size, against the limit of those with a short t_c."""
    scenes = [replace(GAS, n_particles=size.n_particles, contact_time=t_c) for t_c in size.contact_times]
    warm_up(scenes[:1])
    runs = [xr.concat([_run(scene, k, looks) for k in range(size.realizations)], "realization") for scene in scenes]
    pooled = xr.concat(runs, "setting").assign_coords(setting=list(size.contact_times))
    values = pooled["value"]
    truths = at_zero(values.sel(setting=values["setting"] <= SHORT), "setting")
    vanishing = [name for name in values["observable"].values if name.startswith(VANISHING)]
    found = bias(values, truths.where(~truths["observable"].isin(vanishing), 0.0))
    seconds = pooled["cpu_seconds"].median("realization")
    return found.assign(cpu_seconds=seconds).assign_coords(case=f"N = {size.n_particles}")


@cache
def _start(scene: Scene, realization: int) -> xr.Dataset:
    """The start state that all t_c share; `scene` is that of its equilibration."""
    return equilibrate(scene, seed=SEED, realization=realization)


def _run(scene: Scene, realization: int, looks: tuple[float, float]) -> xr.Dataset:
    """OBSERVABLES of one gas at both looks, and the processor time that it took."""
    start = _start(scene.at_start(), realization)
    samples = {"spacing": "linear", "count": 2, "first": looks[0]}
    run = simulate(scene, looks[1], state=start, samples=samples, progress=False)
    found = find_clusters(run, distance_factors=[DISTANCE_FACTOR]).sel(distance_factor=DISTANCE_FACTOR)
    both = xr.merge([run, found], compat="override").isel(time=slice(1, None))
    values = {f"{name} at {t:g} s": float(both[OBSERVABLES[name]].sel(time=t)) for t in looks for name in OBSERVABLES}
    of_run = xr.DataArray(list(values.values()), {"observable": list(values)}, ("observable",))
    return xr.Dataset({"value": of_run, "cpu_seconds": float(run["cpu_time"])})

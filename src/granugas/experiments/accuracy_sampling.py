"""What sampling misses: snapshots against averages over all times, and averages over a part of the time."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import xarray as xr

from granugas.analysis.accuracy import mean_error, scatter
from granugas.equilibrate import equilibrate
from granugas.scene import Scene
from granugas.simulate import simulate
from granugas.warm_up import warm_up

ALONE = ("the processor time of a run",)

GAS = Scene(1435, 0.226725, restitution=1.0, contact_time=(1e-3, 1e-4, 1e-5), lattice="triangular")
"""Elastic disks: all t_c are asked of one trajectory, and n_e is added up between the collisions."""

SEED = 1998
SPAN = 0.2
"""s that the snapshots are spread over: some ninety collisions of a particle."""

AT_SNAPSHOTS = {"n_e": "elastic_particle_fraction", "E_e/E": "elastic_energy_fraction"}
ALL_THE_TIME = {"P V/E": "reduced_pressure", "collision rate": "collision_rate", "n_e": "elastic_particle_time_fraction"}
"""Variables of a run by the names of the observables."""


class Plan(NamedTuple):
    """How much is measured.

    Attributes:
        realizations: of everything.
        snapshots: numbers of them in SPAN; the last is only the truth of E_e/E, as good as continuous.
        durations: collisions of a particle that are averaged over; the last is only the truth.
    """

    realizations: int
    snapshots: tuple[int, ...]
    durations: tuple[float, ...]


FULL = Plan(24, (5, 20, 80, 320, 2560), (1.0, 4.0, 16.0, 64.0, 256.0, 1024.0))
SMALL = Plan(4, (5, 20, 160), (1.0, 4.0, 32.0))


def measure(plan: Plan = FULL) -> xr.Dataset:
    """Elastic disks, looked at now and then or all the time.

    Case "snapshots": n_e and E_e/E from so many snapshots, evenly over SPAN, against the average of the same run over all
    times, which is exact for n_e. Case "duration": P V/E, n_e and the collision rate of all collisions in so many of a
    particle, against those of much longer runs.

    Returns:
        Dataset over case, setting and observable, as `analysis.accuracy.scatter` has it: the error of a single run; NaN
        where a case has no such setting or observable. cpu_seconds of a run, samples included, median over realizations.
    """
    warm_up([GAS])
    starts = [equilibrate(GAS, seed=SEED, realization=k) for k in range(plan.realizations)]
    cases = xr.concat([_snapshots(starts, plan.snapshots), _durations(starts, plan.durations)], "case", join="outer")
    return cases.assign_coords(case=["snapshots", "duration"]).assign_attrs(
        knob="snapshots in the span of time, or collisions of a particle in the average",
        span=SPAN,
        **{key: getattr(GAS, key) for key in ("n_particles", "area_fraction", "restitution", "diameter")},
    )


def _snapshots(starts: list[xr.Dataset], counts: tuple[int, ...]) -> xr.Dataset:
    """n_e and E_e/E from few snapshots, against all times of the same run."""
    runs = [[_run(start, SPAN, {"spacing": "linear", "count": k, "first": SPAN / k}) for start in starts] for k in counts]
    found = _pooled(runs, AT_SNAPSHOTS, counts)
    exact = _pooled(runs[-1:], {"n_e": ALL_THE_TIME["n_e"]}, counts[-1:])["value"]
    few, finest = found.sel(setting=list(counts[:-1])), found["value"].sel(setting=counts[-1], drop=True)
    truths = exact.isel(setting=0, drop=True).combine_first(finest).sel(observable=finest["observable"])
    return scatter(few["value"], truths).assign(cpu_seconds=few["cpu_seconds"])


def _durations(starts: list[xr.Dataset], durations: tuple[float, ...]) -> xr.Dataset:
    """Averages over all collisions of short runs, against the mean of long ones."""
    runs = [[_run(start, {"collisions_per_particle": c}, {"count": 1}) for start in starts] for c in durations]
    found = _pooled(runs, ALL_THE_TIME, durations)
    short, long = found.sel(setting=list(durations[:-1])), found["value"].sel(setting=durations[-1], drop=True)
    compared = scatter(short["value"], long.mean("realization"))
    return compared.assign(truth_error=mean_error(long), cpu_seconds=short["cpu_seconds"])


def _run(start: xr.Dataset, until: Any, samples: dict[str, Any]) -> xr.Dataset:
    """Means over the samples of one run, without the one at t = 0."""
    run = simulate(GAS, until, state=start, samples=samples, keep_positions=False, progress=False)
    means = run[[*AT_SNAPSHOTS.values(), *ALL_THE_TIME.values()]].isel(time=slice(1, None)).mean("time")
    return means.assign(cpu_time=run["cpu_time"])


def _pooled(runs: list[list[xr.Dataset]], names: dict[str, str], settings: Sequence[float]) -> xr.Dataset:
    """The named variables over setting, realization and observable, one for each t_c of those that depend on it."""
    pooled = xr.concat([xr.concat(row, "realization") for row in runs], "setting").assign_coords(
        setting=list(map(float, settings))
    )
    columns = {}
    for name, variable in names.items():
        if "contact_time" not in pooled[variable].dims:
            columns[name] = pooled[variable]
            continue
        for t_c in pooled["contact_time"].values:
            columns[f"{name} at t_c = {t_c:g} s"] = pooled[variable].sel(contact_time=t_c, drop=True)
    value = xr.concat(list(columns.values()), xr.Variable("observable", list(columns)))
    return xr.Dataset({"value": value, "cpu_seconds": pooled["cpu_time"].median("realization")})

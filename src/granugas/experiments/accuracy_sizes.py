"""What the number of disks changes and costs, what chance does to one run, and what an exponent owes to S_c and its window."""

import time
from typing import NamedTuple

import numpy as np
import xarray as xr

from granugas.analysis.accuracy import in_large_systems, mean_error
from granugas.analysis.clusters import find_clusters
from granugas.analysis.growth import window_exponents
from granugas.analysis.observables import kinetic_energy
from granugas.equilibrate import equilibrate
from granugas.scene import Scene
from granugas.simulate import simulate

ALONE = ("the processor time of a run",)

GAS = {"area_fraction": 0.226725, "restitution": 0.4, "contact_time": 1e-5, "lattice": "triangular"}
"""That of A Figs. 8 and 9."""

SEED = 1998
DISTANCE_FACTORS = (1.05, 1.1, 1.2, 1.3, 1.4)
CHOSEN = 1.1
"""S_c of the exponent beside other observables."""

ELASTIC_COLLISIONS = 50.0
"""Of a particle, in which the pressure of the elastic gas is taken."""


class Plan(NamedTuple):
    """How much is measured.

    Attributes:
        realizations: by number of particles.
        looks: times (s) at which K is looked at; runs end with the last one.
        window: in which the exponent of <M> is fitted (s), and by what both its ends are moved.
        samples: of the clusters.
    """

    realizations: dict[int, int]
    looks: tuple[float, ...]
    window: tuple[float, float]
    moved: tuple[float, ...]
    samples: int


FULL = Plan({42: 400, 378: 100, 1435: 32, 5740: 16, 22960: 8, 97776: 4}, (0.1, 1.0), (0.25, 2.0), (0.71, 1.0, 1.41), 48)
SMALL = Plan({42: 6, 120: 4, 378: 3}, (0.1, 0.2), (0.02, 0.16), (0.71, 1.0, 1.41), 24)


def measure(plan: Plan = FULL) -> xr.Dataset:
    """The same gas with more and more disks.

    Returns:
        Dataset over setting (N) and observable, as `analysis.accuracy.bias` has it, but that systems of different sizes share
        nothing; the truth is the limit of large systems. Beside it relative_spread, the standard deviation of one run by the
        truth, and cpu_seconds of one run with its equilibration, median over realizations. exponents of <M> over setting,
        distance_factor and window_shift (by what the ends are moved), with exponents_error.
    """
    found = xr.concat([_size(n, plan) for n in plan.realizations], "setting").assign_coords(setting=list(plan.realizations))
    truth = in_large_systems(found["measured"], found["measured_error"], "setting")
    size = abs(truth["truth"])
    error = np.hypot(found["measured_error"], truth["truth_error"])
    return found.assign(
        **truth,
        relative_error=abs(found["measured"] - truth["truth"]) / size,
        relative_error_error=error / size,
        relative_spread=found["measured_spread"] / size,
    ).assign_attrs(knob="number of disks N", distance_factor=CHOSEN, fit_window=list(plan.window), **GAS)


def _size(n: int, plan: Plan) -> xr.Dataset:
    """All realizations with n disks."""
    runs = xr.concat([_run(Scene(n, **GAS), k, plan) for k in range(plan.realizations[n])], "realization")
    return xr.Dataset(
        {
            "measured": runs["value"].mean("realization"),
            "measured_error": mean_error(runs["value"]),
            "measured_spread": runs["value"].std("realization", ddof=1),
            "exponents": runs["exponents"].mean("realization"),
            "exponents_error": mean_error(runs["exponents"]),
            "cpu_seconds": runs["cpu_seconds"].median("realization"),
        }
    )


def _run(scene: Scene, realization: int, plan: Plan) -> xr.Dataset:
    """K, the exponent of <M> and the pressure of the elastic gas at the start."""
    clock = time.process_time()
    start = equilibrate(scene, seed=SEED, realization=realization)
    begun = time.process_time() - clock
    elastic = simulate(
        Scene(**{**GAS, "n_particles": scene.n_particles, "restitution": 1.0}),
        {"collisions_per_particle": ELASTIC_COLLISIONS},
        state=start,
        samples={"spacing": "linear", "count": 1},
        keep_positions=False,
        progress=False,
    )
    samples = {"spacing": "log", "count": plan.samples, "first": plan.window[0] * plan.moved[0]}
    last = max(plan.looks[-1], plan.window[1] * plan.moved[-1])
    run = simulate(scene, last, state=start, samples=samples, snapshots=plan.looks, progress=False)
    sizes = find_clusters(run, distance_factors=DISTANCE_FACTORS)["mean_cluster_size"].isel(time=slice(1, None))
    exponents = [_exponents(sizes.sel(distance_factor=factor), plan) for factor in DISTANCE_FACTORS]
    unit = scene.n_particles * scene.energy_per_mass
    looked = zip(plan.looks, run["velocity"].values, strict=True)
    values = {f"K at {t:g} s": float(kinetic_energy(velocity).sum()) / unit for t, velocity in looked}
    values["exponent of <M>"] = exponents[DISTANCE_FACTORS.index(CHOSEN)][plan.moved.index(1.0)]
    values["P V/E at r = 1"] = float(elastic["reduced_pressure"][-1])
    return xr.Dataset(
        {
            "value": ("observable", list(values.values())),
            "exponents": (("distance_factor", "window_shift"), exponents),
            "cpu_seconds": begun + float(run["cpu_time"]),
        },
        {"observable": list(values), "distance_factor": list(DISTANCE_FACTORS), "window_shift": list(plan.moved)},
    )


def _exponents(sizes: xr.DataArray, plan: Plan) -> list[float]:
    """d ln <M> / d ln t in the window, moved to earlier and later times."""
    y = sizes.values[np.newaxis]
    low, high = plan.window
    return [float(window_exponents(sizes["time"], y, low * move, high * move)[0, 0]) for move in plan.moved]

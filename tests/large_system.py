"""The dataset of a world in which sections 4 and 5 of the second paper are right about energy, collisions and clusters."""

import numpy as np
import xarray as xr

from granugas.analysis.theory import homogeneous_cooling

N, RATE, RUNS, END = 79524, 258.0, 4, 446.6
TIMES = np.concatenate([[0], np.geomspace(5e-3, END, 250)])
FACTORS = np.array([1.01, 1.05, 1.1, 1.2, 1.3, 1.4])
SCATTER = np.array([0.998, 1.003, 0.9995, 1.0005])
"""Factors of the realizations."""


def broken(points: dict[float, float]) -> np.ndarray:
    """Power laws through points (t, y), at the samples after t = 0."""
    return np.exp(np.interp(np.log(TIMES[1:]), np.log(list(points)), np.log(list(points.values()))))


def series(first: float, later: np.ndarray) -> np.ndarray:
    """(realization, time), with the value at t = 0."""
    return np.column_stack([np.full(RUNS, first), np.multiply.outer(SCATTER, later)])


def whole() -> dict[str, xr.Dataset]:
    """Growth from 1 to 40 s, in the energy from .2 to 50 s; C/N as printed."""
    cooling = homogeneous_cooling(RATE * TIMES[1:], 0.8)
    energy = cooling * broken({5e-3: 1, 0.2: 1, 50: 250, END: 250 * (END / 50) ** 0.2})
    count = broken({5e-3: 1.2, 0.01: 2.27, 0.64: 39, 2.56: 70, 40.96: 670, END: 5258})
    elastic = count * broken({5e-3: 2e-3, 50: 1e-2, END: 0.2})
    mean, largest = [], []
    for factor in FACTORS:
        base, tiny = 1 + 4 * (factor - 1), 4 + 200 * (factor - 1)
        grown = {5e-3: 1, 1: 1.02, 6.3: 1.02 * 6.3**0.27, 40: 1.02 * 6.3 ** (0.27 + 0.33), END: 1.04 * 6.3**0.6}
        mean.append(base * series(1, broken(grown)))
        largest.append(series(tiny, broken({5e-3: tiny, 1: 1.5 * tiny, 70: 0.6 * N, END: 0.65 * N})))
    clusters = ("realization", "distance_factor", "time")
    mean, largest = (np.stack(values, axis=1) for values in (mean, largest))
    data = xr.Dataset(
        {
            "tau": (("realization", "time"), np.tile(RATE * TIMES, (RUNS, 1))),
            "kinetic_energy": (("realization", "time"), series(1, energy)),
            "collisions_per_particle": (("realization", "time"), series(0, count)),
            "elastic_collisions_per_particle": (("realization", "time"), series(0, elastic)),
            "box_x": ("realization", np.full(RUNS, 1.0)),
            "cluster_count": (clusters, N / mean),
            "mean_cluster_size": (clusters, mean),
            "largest_cluster_size": (clusters, largest),
        },
        {"time": TIMES, "distance_factor": FACTORS, "realization": np.arange(RUNS)},
    )
    point = {"n_particles": N, "restitution": 0.8, "contact_time": 1e-5, "diameter": 2e-3}
    return {"cluster1999_large": data.expand_dims({name: [value] for name, value in point.items()})}

"""Datasets of a world in which sections 2 and 3 of the second paper are right, as its text has them."""

import numpy as np
import xarray as xr

from granugas.analysis.theory import collisions_until, homogeneous_cooling

RATE = 251.2
COLLISIONS = np.concatenate([[0], np.geomspace(0.1, 1000, 400)])
SIGNS = np.array(
    [[1, -1, 1, -1, 1], [-1, 1, -1, 1, 1], [1, 1, -1, 1, -1], [-1, -1, 1, -1, 1], [1, 1, 1, -1, -1], [-1, 1, -1, 1, -1]]
)
"""Of (Kx - Kz)/K, of (realization, contact time)."""

SCATTER = np.array([-0.6, 0.6, -0.5, 0.5, -0.4, 0.4])
"""Of the ln K of the realizations, once there are clusters."""

ONSETS = {0.99: 1e10, 0.97: 1e10, 0.95: 3e3, 0.9: 1e3, 0.8: 300, 0.6: 80, 0.2: 40}
"""tau at which K is twice Eq. 1."""

RUNS = len(SCATTER)
SMALL = 1e-3 * np.arange(-2.5, 3)[:, np.newaxis]


def dataset(series: dict[str, np.ndarray], n: int, time: np.ndarray, **point: float) -> xr.Dataset:
    """One point of a grid, from arrays of (realization, sample)."""
    side = 2e-3 * np.sqrt(n * np.pi / 4 / 0.2463)
    once = {"box_x": side, "box_y": side, "enskog_rate": RATE, "equilibration_kurtosis": 1.0}
    data = xr.Dataset(
        {
            **{name: (("realization", "time"), values) for name, values in series.items()},
            **{name: ("realization", np.full(RUNS, value)) for name, value in once.items()},
        },
        {"time": time, "realization": np.arange(RUNS)},
    )
    return data.expand_dims({name: [value] for name, value in {"n_particles": n, "diameter": 2e-3, **point}.items()})


def by_collisions(restitution: float, contact_time: float, tau: np.ndarray, anisotropy: np.ndarray, **series) -> xr.Dataset:
    """A run until C/N = 1000: K leaves Eq. 1 at an onset that scatters over the runs."""
    late = tau / ONSETS[restitution]
    energy = homogeneous_cooling(tau, restitution) * (1 + late * np.exp(SCATTER[:, np.newaxis] * (late > 0.1)))
    energy = energy * series.pop("factor", 1.0)
    found = {
        "tau": tau,
        "sampling_time": tau / RATE,
        "kinetic_energy": energy,
        "kinetic_energy_x": energy * (1 + anisotropy) / 2,
        "kinetic_energy_y": energy * (1 - anisotropy) / 2,
        "collisions_per_particle": np.broadcast_to(COLLISIONS, tau.shape),
        "elastic_collisions_per_particle": np.broadcast_to(1e-3 * COLLISIONS, tau.shape),
        **series,
    }
    return dataset(found, 784, np.arange(401), restitution=restitution, contact_time=contact_time)


def homogeneous_tau(restitution: float) -> np.ndarray:
    """Tau of the samples by Eq. 4, of (realization, sample), with some scatter."""
    loss = (1 - restitution**2) / 4
    return np.expm1(loss * COLLISIONS) / loss * (1 + SMALL)


def restitutions() -> xr.Dataset:
    """Seven coefficients: the smaller the sooner out of homogeneous cooling, with anisotropy; jumps for r = .6 and .2."""
    points = []
    for r, onset in ONSETS.items():
        tau = homogeneous_tau(r)
        elastic = 1e-3 * np.broadcast_to(COLLISIONS, tau.shape)
        if r < 0.7:
            jump = np.maximum(COLLISIONS - 900, 0)
            tau = np.where(COLLISIONS > 900, tau[:, [np.searchsorted(COLLISIONS, 900) - 1]] * (1 + 1e-9 * jump), tau)
            elastic = elastic + jump / 2
        shear = np.where(tau / onset > 0.3, 0.9, 0.02) * SIGNS[:, :1]
        points.append(by_collisions(r, 1e-5, tau, shear, elastic_collisions_per_particle=elastic))
    return xr.concat(points, "restitution", data_vars="all").sortby("restitution")


def contact_times() -> xr.Dataset:
    """Five contact times: the largest cools slower, 1e-8 s is later than the others where they all have as many collisions."""
    points = []
    for place, t_c in enumerate((1e-10, 1e-8, 1e-6, 1e-5, 1e-3)):
        tau = homogeneous_tau(0.6)
        if t_c == 1e-8:
            tau = tau * np.exp(4 * (COLLISIONS > 500))
        shear = np.where(COLLISIONS > 40, 0.9 * SIGNS[:, [place]], 0.02)
        slower = np.where(COLLISIONS > 0.5, 1.5 if t_c == 1e-3 else 1 + 0.01 * place, 1)
        elastic = np.broadcast_to(1e-2 * np.maximum(COLLISIONS - 1.0, 0), tau.shape)  # none at first
        points.append(by_collisions(0.6, t_c, tau, shear, factor=slower, elastic_collisions_per_particle=elastic))
    return xr.concat(points, "contact_time", data_vars="all")


def by_time(n: int, times: np.ndarray) -> xr.Dataset:
    """Homogeneous cooling at r = .8 with hardly any scatter."""
    tau = np.broadcast_to(RATE * times, (RUNS, len(times)))
    energy = homogeneous_cooling(tau, 0.8) * np.exp(SMALL * (tau > 0))
    series = {"tau": tau, "kinetic_energy": energy, "collisions_per_particle": collisions_until(tau, 0.8)}
    return dataset(series, n, times, restitution=0.8, contact_time=1e-5)


def whole() -> dict[str, xr.Dataset]:
    """Every study that the claims of both sections ask for."""
    return {
        "cluster1999_restitutions": restitutions(),
        "cluster1999_contact_times": contact_times(),
        "cluster1999_large": by_time(79524, np.concatenate([[0], np.geomspace(5e-3, 446.6, 250)])),
        "tc1998_restitutions": by_time(5740, np.linspace(0, 5, 5001)),
    }

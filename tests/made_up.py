"""Made-up studies whose answers are known."""

import numpy as np
import xarray as xr

from granugas.analysis import theory

RATE, N = 1000.0, 50
SMOOTH = {"material": "constant", "tangential_restitution": -1.0, "friction": np.inf, "boundary": "periodic"}


def elastic_study(
    contact_times=(1e-7, 1e-3), area_fractions=(0.2, 0.4), realizations: int = 3, rate: float = RATE
) -> xr.Dataset:
    """Elastic disks in two intervals, of .1 and .3 s, with one rate for all area fractions, crystals above .7.

    Over whole runs P_0 = 2, c_e is .95 of mean field, n_e as in mean field, e_e 5/4 of it.
    """
    dims = ("n_particles", "area_fraction", "restitution", "contact_time", "realization", "time")
    shape = (1, len(area_fractions), 1, len(contact_times), realizations, 3)
    time = np.array([0.0, 0.1, 0.4])
    t_c = np.array(contact_times)[:, np.newaxis, np.newaxis]
    c_e, n_e = theory.elastic_collision_fraction(t_c, rate), theory.elastic_particle_fraction(t_c, rate)
    values = {
        "sampling_time": time,
        "collisions_per_particle": rate * time,
        "elastic_collisions_per_particle": 0.95 * c_e * rate * time,
        "reduced_pressure": np.array([np.nan, 5.0, 1.0]),  # mean over the samples 3, over time 2
        "elastic_particle_fraction": n_e * np.array([7.0, 0.9, 1.1]),
        "elastic_particle_time_fraction": n_e * np.array([np.nan, 1.3, 0.9]),  # over the samples 1.1, over time 1
        "elastic_energy_fraction": n_e * np.array([7.0, 1.2, 1.3]),
    }
    branch = np.where(np.array(area_fractions) > 0.7, "crystal", "fluid")[:, np.newaxis, np.newaxis, np.newaxis]
    once = {"enskog_rate": rate, "events": N * rate * time[-1] / 2, "branch": branch}
    data = {name: (dims, np.broadcast_to(value, shape)) for name, value in values.items()}
    data |= {name: (dims[:-1], np.broadcast_to(value, shape[:-1])) for name, value in once.items()}
    coordinates = {
        "n_particles": [N],
        "area_fraction": list(area_fractions),
        "restitution": [1.0],
        "contact_time": list(contact_times),
        "realization": np.arange(realizations),
        "time": np.arange(3),
    }
    return xr.Dataset(data, coordinates, {"diameter": 1e-3, "velocity_half_width": 0.5})


def collapse_study(n_particles: int, realizations: int = 3) -> xr.Dataset:
    """Runs without t_c that collapse after 50 collisions per particle below r = .6, and go on to 500 above."""
    r = np.array([0.4, 0.5, 0.7, 0.8])
    dims = ("n_particles", "area_fraction", "restitution", "contact_time", "realization")
    collapsed = np.broadcast_to((r < 0.6)[:, np.newaxis, np.newaxis], (1, 1, len(r), 1, realizations))
    data = {
        "events": (dims, np.where(collapsed, 25, 250) * n_particles),
        "stop_reason": (dims, np.where(collapsed, "inelastic_collapse", "collisions_per_particle")),
    }
    grid = {"n_particles": [n_particles], "area_fraction": [0.226725], "restitution": r, "contact_time": [0.0]}
    return xr.Dataset(data, grid | {"realization": np.arange(realizations)})


def cooling_study(realizations=2, clusters=False, **grid):
    """A pooled dataset over a grid: homogeneous cooling with some scatter, and clusters that grow as t^.3."""
    rng = np.random.default_rng(1)
    grid = {"n_particles": [100], "restitution": [0.4], "contact_time": [1e-5]} | grid
    shape = (*(len(values) for values in grid.values()), realizations)
    time = np.concatenate([[0], np.geomspace(1e-3, 446.6, 60)])
    dims, at = (*grid, "realization", "time"), (*grid, "realization", "snapshot")
    once = {"enskog_rate": 445.0, "box_x": 1.0, "box_y": 1.0}
    tau = np.broadcast_to(445 * time, (*shape, len(time)))
    energy = theory.homogeneous_cooling(tau, 0.4) * np.exp(0.05 * rng.normal(size=(*shape, 1)) * (time > 0))
    collisions = theory.collisions_until(tau, 0.4)
    data = xr.Dataset(
        {
            "tau": (dims, tau),
            "kinetic_energy": (dims, energy),
            "kinetic_energy_x": (dims, 0.6 * energy),
            "kinetic_energy_y": (dims, 0.4 * energy),
            "collisions_per_particle": (dims, collisions),
            "elastic_collisions_per_particle": (dims, 0.01 * collisions),
            "elastic_particle_fraction": (dims, np.full(tau.shape, 0.004)),
            "elastic_energy_fraction": (dims, np.full(tau.shape, 0.005)),
            "position": ((*at, "particle", "axis"), rng.random((*shape, 2, 100, 2))),
            "velocity": ((*at, "particle", "axis"), rng.normal(0, 0.01, (*shape, 2, 100, 2))),
            "collision_frequency": ((*at, "particle"), rng.exponential(500, (*shape, 2, 100))),
            "last_collision_interval": ((*at, "particle"), rng.exponential(1e-4, (*shape, 2, 100))),
            "initial_y": ((*dims[:-1], "particle"), rng.random((*shape, 100))),
            **{name: (dims[:-1], np.full(shape, value)) for name, value in once.items()},
        },
        coords=grid | {"time": time, "realization": np.arange(realizations), "snapshot": [0.1, 5.0]},
        attrs={"area_fraction": 0.25, "diameter": 0.05, "velocity_half_width": 0.5, "dimensions": 2, "boundary": "periodic"}
        | SMOOTH,
    )
    if clusters:
        factors = np.array([1.05, 1.1, 1.2, 1.3, 1.4])
        sizes = (1 + time) ** 0.3 * factors[:, np.newaxis] * np.exp(0.02 * rng.normal(size=(*shape, 1, 1)))
        over = (*dims[:-1], "distance_factor", "time")
        data = data.assign(
            mean_cluster_size=(over, sizes),
            cluster_count=(over, 100 / sizes),
            weighted_cluster_size=(over, sizes**1.5),
            largest_cluster_size=(over, sizes**2),
            cluster_size_distribution=((*over, "cluster_size"), 100 * np.exp(-np.arange(1, 5) / sizes[..., np.newaxis])),
        ).assign_coords(distance_factor=factors, cluster_size=[1, 2, 3, 4], cluster_size_upper=("cluster_size", [2, 3, 4, 6]))
    return data

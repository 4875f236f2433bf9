"""Made-up studies whose answers are known."""

import numpy as np
import xarray as xr

from granugas.analysis import theory

RATE, N = 1000.0, 50


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

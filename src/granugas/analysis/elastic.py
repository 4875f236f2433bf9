"""Elastic systems (A section 5): what whole runs give, and its ratio to mean field."""

import xarray as xr

from granugas.analysis.theory import elastic_collision_fraction, elastic_particle_fraction

LEAST_COUNT = 10
"""A quality factor with fewer expected counts behind it says nothing."""

OVER = ("contact_time", "area_fraction", "realization")


def whole_runs(study: xr.Dataset) -> xr.Dataset:
    """Means over whole runs, without the state at t = 0, each variable under the name that it has in a run.

    Collisions are counted from beginning to end; what belongs to an interval counts by its duration; snapshots (n_e and
    e_e) count equally.

    Args:
        study: pooled, of one N and r, over `OVER` and `time`; its runs end by collisions.

    Returns:
        Dataset over (area_fraction, realization), and contact_time where it matters: reduced_pressure, collision_rate (1/s),
        elastic_collision_fraction, elastic_particle_fraction, elastic_particle_time_fraction, elastic_energy_fraction,
        enskog_rate (1/s), events, snapshots (their number), n_particles, branch.

    Raises:
        ValueError: several N or r.
    """
    study = study.squeeze([dim for dim in ("n_particles", "restitution") if dim in study.dims], drop=True)
    late, end = study.isel(time=slice(1, None)), study.isel(time=-1, drop=True)
    duration = study["sampling_time"].diff("time").fillna(0)
    mean = xr.Dataset(
        {
            "collision_rate": end["collisions_per_particle"] / end["sampling_time"],
            "reduced_pressure": late["reduced_pressure"].weighted(duration).mean("time"),
            "elastic_collision_fraction": end["elastic_collisions_per_particle"] / end["collisions_per_particle"],
            "elastic_particle_fraction": late["elastic_particle_fraction"].mean("time"),
            "elastic_particle_time_fraction": late["elastic_particle_time_fraction"].weighted(duration).mean("time"),
            "elastic_energy_fraction": late["elastic_energy_fraction"].mean("time"),
            "enskog_rate": study["enskog_rate"],
            "events": study["events"],
            "branch": study["branch"],
        }
    ).assign(snapshots=late.sizes["time"], n_particles=2 * study["events"] / end["collisions_per_particle"])
    one_trajectory = ("collision_rate", "reduced_pressure", "enskog_rate", "events", "n_particles", "branch")
    same = {name: mean[name].isel(contact_time=0, drop=True) for name in one_trajectory}
    return mean.assign(same).transpose(*OVER)


def quality_factors(runs: xr.Dataset, least: float = LEAST_COUNT, rate: str = "enskog_rate") -> xr.Dataset:
    """Measured fractions by those of mean field (A Eqs. 20, 21), by default with the Enskog rate 1/t_E (A Eq. 19).

    Args:
        runs: of `whole_runs`.
        least: hide (NaN) what all runs of a point together are expected to have fewer counts for: elastic collisions for
            q_c, elastic particles in the snapshots for q_n and q_e.
        rate: name of the variable that is 1/t_E; "collision_rate" leaves the equation of state out of the comparison.

    Returns:
        Dataset over `OVER`: q_n = n_e / (A Eq. 20) by snapshots, q_n_time by the exact time average of n_e, q_c = c_e /
        (A Eq. 21), q_e = e_e / (A Eq. 20).
    """
    n_e = xr.apply_ufunc(elastic_particle_fraction, runs["contact_time"], runs[rate])
    c_e = xr.apply_ufunc(elastic_collision_fraction, runs["contact_time"], runs[rate])
    particles = (n_e * runs["n_particles"] * runs["snapshots"]).sum("realization")
    collisions = (c_e * runs["events"]).sum("realization")
    factors = xr.Dataset(
        {
            "q_n": (runs["elastic_particle_fraction"] / n_e).where(particles >= least),
            "q_n_time": (runs["elastic_particle_time_fraction"] / n_e).where(collisions >= least),
            "q_c": (runs["elastic_collision_fraction"] / c_e).where(collisions >= least),
            "q_e": (runs["elastic_energy_fraction"] / n_e).where(particles >= least),
        }
    )
    return factors.transpose(*OVER)

"""What every dataset of a study obeys, whatever its parameters: conservation, counts that agree, nothing missing."""

from collections.abc import Iterator

import numpy as np
import xarray as xr

from granugas.scene import DEFAULTS

ROUNDING = 1e-12
SHARES = ("elastic_collision_fraction", "elastic_particle_fraction", "elastic_energy_fraction")
COUNTS = ("collisions_per_particle", "elastic_collisions_per_particle")
ALONG = ("kinetic_energy_x", "kinetic_energy_y", "kinetic_energy_z")
ALWAYS = ("tau", "kinetic_energy", *COUNTS, *SHARES[1:])
"""Variables with a value at every sample; those over an interval lack one at t = 0, and where nothing collides."""


def findings(data: xr.Dataset) -> list[str]:
    """Compare a pooled dataset with what must hold; an empty list is what one hopes for.

    Each finding is one line: the variable, what is wrong, at how many places, and where it is worst.
    """
    return [*_complete(data), *_energy(data), *_momentum(data), *_counted(data), *_clusters(data)]


def _complete(data: xr.Dataset) -> Iterator[str]:
    """A value at every sample until a run's end, none after it."""
    alive = _times(data) <= data["stop_time"] * (1 + ROUNDING)
    along = [name for name, axis in zip(ALONG, range(3), strict=True) if np.any(_dimensions(data) > axis)]
    for name in (*ALWAYS, *along):
        there = alive & (_dimensions(data) > ALONG.index(name)) if name in along else alive
        yield from _finding(name, "has no value", (data[name].isnull() & there).astype(float))
        yield from _finding(name, "has a value after the end of the run", (data[name].notnull() & ~alive).astype(float))


def _energy(data: xr.Dataset) -> Iterator[str]:
    energy = data["kinetic_energy"]
    yield from _finding("kinetic_energy", "is not 1 at t = 0", abs(energy.isel(time=0) - 1) - ROUNDING)
    shares = sum(data[name].fillna(0) for name in ALONG if name in data)
    yield from _finding("kinetic_energy", "is not the sum of its shares", abs(energy - shares) - ROUNDING)
    rotation, overlaps = (data[name].fillna(0) if name in data else 0.0 for name in ("rotational_energy", "elastic_energy"))
    isolated = (_parameter(data, "heating") == 0) & (_parameter(data, "gravity") == 0) & (_parameter(data, "floor") == "still")
    isolated = isolated & (_parameter(data, "kick_energy") == 0) & (_parameter(data, "internal_modes") == 0)
    soft = _parameter(data, "dynamics") == "soft_spheres"
    of_steps = (np.pi / _parameter(data, "steps_per_contact")) ** 2 / 2
    total = energy + rotation + overlaps
    yield from _finding("kinetic_energy", "rises", total.diff("time").where(isolated) - xr.where(soft, of_steps, ROUNDING * 10))
    elastic = (_parameter(data, "restitution") == 1) & (_parameter(data, "wall_restitution") == 1) & (rotation == 0)
    lost = abs(energy + overlaps - 1).where(isolated & elastic) - xr.where(soft, of_steps, 1e-10)
    yield from _finding("kinetic_energy", "is not conserved at r = 1", lost)


def _momentum(data: xr.Dataset) -> Iterator[str]:
    if "velocity" in data:
        mass = data.get("particle_mass", 1.0)
        momentum = abs((mass * data["velocity"]).sum("particle")) / _parameter(data, "n_particles")
        limit = ROUNDING * _parameter(data, "velocity_half_width")
        free = _parameter(data, "boundary") == "periodic"
        yield from _finding("velocity", "has a mean that is not zero", (momentum - limit).where(free))


def _counted(data: xr.Dataset) -> Iterator[str]:
    for name in COUNTS:
        yield from _finding(name, "falls", -data[name].diff("time"))
        yield from _finding(name, "is not 0 at t = 0", data[name].isel(time=0))
    yield from _finding(COUNTS[1], "is more than all collisions", data[COUNTS[1]] - data[COUNTS[0]] * (1 + ROUNDING))
    for name in SHARES:
        yield from _finding(name, "is outside of 0 to 1", abs(data[name] - 0.5) - 0.5 - ROUNDING)
    times = _times(data)
    counted, sampled = 2 * data["events"] / _parameter(data, "n_particles"), data[COUNTS[0]].max("time")
    last = times.where(data[COUNTS[0]].notnull()).max("time")
    ends_with_sample = abs(last - data["stop_time"]) <= ROUNDING * data["stop_time"]
    apart = (sampled - counted).where(~ends_with_sample, abs(sampled - counted))
    yield from _finding("events", "differ from collisions_per_particle", apart - 1e-9 * counted)
    in_interval = data[COUNTS[0]].diff("time")
    apart = abs(data["collision_rate"] * times.diff("time") - in_interval) - 1e-9 * (1 + in_interval)
    yield from _finding("collision_rate", "does not add up to collisions_per_particle", apart)


def _clusters(data: xr.Dataset) -> Iterator[str]:
    if "cluster_count" not in data:
        return
    n, count, largest = _parameter(data, "n_particles"), data["cluster_count"], data["largest_cluster_size"]
    product = abs(count * data["mean_cluster_size"] - n) - 1e-9 * n
    yield from _finding("mean_cluster_size", "times cluster_count is not N", product)
    yield from _finding("cluster_count", "rises with the distance factor", count.diff("distance_factor"))
    yield from _finding("largest_cluster_size", "falls with the distance factor", -largest.diff("distance_factor"))
    yield from _finding("largest_cluster_size", "is more than N", largest - n)
    binned = data["cluster_size_distribution"].sum("cluster_size", skipna=False)
    yield from _finding("cluster_size_distribution", "does not add up to cluster_count", abs(binned - count) - ROUNDING)


def _times(data: xr.Dataset) -> xr.DataArray:
    """Times of the samples in s."""
    return data["sampling_time"] if "sampling_time" in data else data["time"]


def _dimensions(data: xr.Dataset) -> xr.DataArray:
    """Of space."""
    return _parameter(data, "dimensions")


def _parameter(data: xr.Dataset, key: str) -> xr.DataArray:
    """A grid key: a coordinate where the study varies it, else an attribute, or what it is where no scene names it."""
    return data[key] if key in data.variables else xr.DataArray(data.attrs.get(key, DEFAULTS[key]))


def _finding(name: str, what: str, excess: xr.DataArray) -> Iterator[str]:
    """One line if something exceeds 0 anywhere, with the place where it does most."""
    if excess.size and np.any(excess > 0):
        worst = excess.isel(excess.argmax(...))
        place = ", ".join(f"{key} = {worst[key].item()}" for key in worst.coords)
        yield f"{name} {what} ({np.count_nonzero(excess > 0)} places, worst at {place})"

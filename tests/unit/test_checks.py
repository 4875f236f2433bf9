"""The checks find nothing in sound data, and each finds what was broken for it."""

from collections.abc import Callable

import numpy as np
import pytest
import xarray as xr

from granugas.checks import findings

N, RUN = 10, ("restitution", "realization")


def sound() -> xr.Dataset:
    """A pooled dataset of two restitutions and two realizations that obeys everything."""
    time = np.array([0.0, 0.1, 0.2, 0.4, 0.8])
    r = xr.DataArray([0.4, 1.0], dims="restitution", coords={"restitution": [0.4, 1.0]})
    run = xr.ones_like(r) * xr.DataArray([1.0, 1.0], dims="realization", coords={"realization": [0, 1]})
    t = xr.DataArray(time, dims="time", coords={"time": time})
    energy = run / (1 + (1 - r**2) * t) ** 2
    events = run * xr.DataArray([0, 5, 10, 15, 25], dims="time", coords={"time": time})
    collisions, elastic = 2 * events / N, events / N
    factor = xr.DataArray([1.05, 1.1], dims="distance_factor", coords={"distance_factor": [1.05, 1.1]})
    count = run * t.astype(bool) + 4 + xr.zeros_like(factor)
    share = 0.1 * run * xr.ones_like(t)
    return xr.Dataset(
        {
            "tau": 100 * t * run,
            "kinetic_energy": energy,
            "kinetic_energy_x": energy * 0.4,
            "kinetic_energy_y": energy * 0.6,
            "collisions_per_particle": collisions,
            "elastic_collisions_per_particle": elastic,
            "collision_rate": collisions.diff("time") / t.diff("time"),
            "elastic_collision_fraction": (elastic.diff("time") / collisions.diff("time")).reindex(time=time),
            "elastic_particle_fraction": share,
            "elastic_energy_fraction": share,
            "events": events.isel(time=-1, drop=True),
            "stop_time": 0.8 * run,
            "stop_reason": run.astype(str).where(False, "time"),
            "velocity": run * xr.DataArray(np.tile([0.5, -0.5], (1, N // 2)), dims=("snapshot", "particle")),
            "cluster_count": count,
            "mean_cluster_size": N / count,
            "largest_cluster_size": 0 * count + 3,
            "cluster_size_distribution": count * xr.DataArray([0.25, 0.75], dims="cluster_size"),
        },
        attrs={"n_particles": N, "velocity_half_width": 0.5},
    ).reindex(time=time)


def at(variable: str, value: float, **place: int) -> Callable[[xr.Dataset], None]:
    """A change of a variable by a value, at one place (of the first run unless it is named)."""

    def change(data: xr.Dataset) -> None:
        where = {"restitution": 0, "realization": 1} | place
        data[variable] = data[variable].copy()
        data[variable][where] = data[variable][where] + value

    return change


BROKEN = [
    (at("kinetic_energy", np.nan, time=2), "kinetic_energy has no value"),
    (at("tau", np.nan, time=0), "tau has no value"),
    (at("stop_time", -0.5), "kinetic_energy has a value after the end of the run"),
    (at("kinetic_energy", 1e-6, time=0), "kinetic_energy is not 1 at t = 0"),
    (at("kinetic_energy", 0.5, time=3), "kinetic_energy rises"),
    (at("kinetic_energy_x", 1e-6, time=3), "kinetic_energy is not the sum of its shares"),
    (at("kinetic_energy", -1e-6, time=4, restitution=1), "kinetic_energy is not conserved at r = 1"),
    (at("velocity", 1e-9, snapshot=0, particle=3), "velocity has a mean that is not zero"),
    (at("collisions_per_particle", -1.5, time=2), "collisions_per_particle falls"),
    (at("collisions_per_particle", 0.1, time=0), "collisions_per_particle is not 0 at t = 0"),
    (at("elastic_collisions_per_particle", 9.0, time=4), "elastic_collisions_per_particle is more than all collisions"),
    (at("elastic_particle_fraction", 1.0, time=1), "elastic_particle_fraction is outside of 0 to 1"),
    (at("elastic_collision_fraction", -1.0, time=1), "elastic_collision_fraction is outside of 0 to 1"),
    (at("events", 1), "events differ from collisions_per_particle"),
    (at("collision_rate", 1e-3, time=2), "collision_rate does not add up"),
    (at("mean_cluster_size", 1e-3, time=2, distance_factor=0), "mean_cluster_size times cluster_count is not N"),
    (at("cluster_count", 1, time=2, distance_factor=1), "cluster_count rises with the distance factor"),
    (at("largest_cluster_size", 1, time=2, distance_factor=0), "largest_cluster_size falls with the distance factor"),
    (at("largest_cluster_size", 8, time=2, distance_factor=1), "largest_cluster_size is more than N"),
    (at("cluster_size_distribution", 1, time=2, distance_factor=1), "cluster_size_distribution does not add up"),
]


def test_sound_data_have_no_finding() -> None:
    assert findings(sound()) == []


@pytest.mark.parametrize(("damage", "said"), BROKEN, ids=[said for _, said in BROKEN])
def test_what_is_broken_is_found_where_it_is(damage: Callable[[xr.Dataset], None], said: str) -> None:
    data = sound()
    damage(data)
    (finding,) = (line for line in findings(data) if line.startswith(said))
    assert "realization = 1" in finding


def test_a_run_that_collapsed_is_sound_up_to_its_end() -> None:
    data = sound()
    late = data.time > 0.3
    first = (data.restitution == 0.4) & (data.realization == 0)
    for name in data.data_vars:
        if "time" in data[name].dims:
            data[name] = data[name].where(~(late & first))
    data["stop_time"] = data["stop_time"].where(~first, 0.3)
    data["stop_reason"] = data["stop_reason"].where(~first, "inelastic_collapse")
    assert findings(data) == []


def test_runs_that_end_by_collisions_have_their_own_times() -> None:
    data = sound()
    times = data.time * xr.ones_like(data["tau"])
    data = data.assign_coords(time=range(5))
    data["sampling_time"] = times.assign_coords(time=range(5))
    assert findings(data) == []
    data["sampling_time"][{"time": 2, "realization": 0}] *= 1.1
    assert any(line.startswith("collision_rate does not add up") for line in findings(data))


def test_energy_of_rotation_counts() -> None:
    """Translation may gain what rotation loses, and lose energy to it at r = 1; both together fall."""
    data = sound()
    passed = 0.1 * data.time * (data.restitution == 1) * xr.ones_like(data["kinetic_energy"])
    data["rotational_energy"] = passed.where(data.restitution == 1)  # smooth runs have none
    for name, share in (("kinetic_energy", 1.0), ("kinetic_energy_x", 0.4), ("kinetic_energy_y", 0.6)):
        data[name] = data[name] - share * passed
    assert findings(data) == []
    data["rotational_energy"] = 2 * data["rotational_energy"]
    assert any(line.startswith("kinetic_energy rises") for line in findings(data))


def test_a_heated_gas_may_gain_energy():
    data = sound().assign_attrs(heating=1.0)
    at("kinetic_energy", 2.0, time=-1)(data)
    at("kinetic_energy_x", 2.0, time=-1)(data)
    assert findings(data) == []
    assert findings(data.assign_attrs(heating=0.0))


def test_the_momentum_counts_masses():
    data = sound()
    data["velocity"] = data["velocity"] * xr.DataArray(np.tile([2.0, 1.0], N // 2), dims="particle")
    assert any("mean that is not zero" in line for line in findings(data))
    data["particle_mass"] = "particle", np.tile([1.0, 2.0], N // 2)
    assert findings(data) == []

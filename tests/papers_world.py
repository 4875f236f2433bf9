"""Datasets of a world in which the first paper is right: what its text says, as small synthetic studies."""

from collections.abc import Callable

import numpy as np
import xarray as xr

from granugas.analysis.enskog import enskog_rate, reduced_pressure
from granugas.analysis.theory import (
    collisions_until,
    elastic_collision_fraction,
    elastic_particle_fraction,
    homogeneous_cooling,
)
from granugas.geometry import CLOSE_PACKING

NU, DIAMETER, HALF_WIDTH = 0.226725, 1e-3, 0.5
RATE = 444.0
ATTRS = {"diameter": DIAMETER, "velocity_half_width": HALF_WIDTH}
REALIZATIONS = 4
SCATTER = np.array([0.999, 1.001, 0.9995, 1.0005])
"""Factors of the realizations, whose mean is 1."""

Curve = Callable[[np.ndarray], np.ndarray]


def clustering(tau: np.ndarray, restitution: float = 0.4, onset: float = 60.0) -> np.ndarray:
    """T that leaves homogeneous cooling: 10 % above it at a tenth of `onset`."""
    return homogeneous_cooling(tau, restitution) * (1 + tau / onset)


def gas(n: int, energy: Curve, times: np.ndarray, restitution: float = 0.4, contact_time: float = 1e-5, **more) -> xr.Dataset:
    """One point of a grid: T as given, collisions as in homogeneous cooling unless `more` says otherwise."""
    tau, over = RATE * times, ("realization", "time")
    T = SCATTER[:, np.newaxis] ** (times > 0) * energy(tau)
    count = more.pop("collisions", collisions_until(tau, restitution))
    rate = np.concatenate([[np.nan], np.diff(count) / np.diff(times)])
    everybody = np.ones((REALIZATIONS, 1))
    side = np.sqrt(n * np.pi / 4 / 0.227) * DIAMETER
    data = xr.Dataset(
        {
            "tau": (over, everybody * tau),
            "kinetic_energy": (over, T),
            "collisions_per_particle": (over, SCATTER[:, np.newaxis] * count),
            "collision_rate": (over, SCATTER[:, np.newaxis] * rate),
            "enskog_rate": ("realization", np.full(REALIZATIONS, RATE)),
            "stop_reason": ("realization", np.full(REALIZATIONS, "time")),
            "stop_time": ("realization", np.full(REALIZATIONS, times[-1])),
            "box_x": ("realization", np.full(REALIZATIONS, side)),
            "box_y": ("realization", np.full(REALIZATIONS, side)),
            "equilibration_kurtosis": ("realization", SCATTER),
            **{name: (over, everybody * values) for name, values in more.items()},
        },
        {"time": times, "snapshot": [], "realization": np.arange(REALIZATIONS)},
        ATTRS,
    )
    return data.expand_dims(n_particles=[n], restitution=[restitution], contact_time=[contact_time])


def wave(n: int, side: float, periods: int, seed: int, depth: float = 0.95) -> tuple[np.ndarray, np.ndarray]:
    """Positions whose density is a wave of so many periods along x, and that density."""
    rng = np.random.default_rng(seed)
    x, y, u = rng.random((3, 8 * n))
    density = 1 + depth * np.cos(2 * np.pi * periods * x)
    kept = np.flatnonzero(u < density / 2)[:n]
    return np.stack([x, y], axis=1)[kept] * side, density[kept]


def with_frames(data: xr.Dataset, frames: dict[float, list[np.ndarray]], **particles: list[np.ndarray]) -> xr.Dataset:
    """The same for all realizations: positions at the times of snapshots, and other values of particles."""

    def stacked(values: list[np.ndarray]) -> xr.Variable:
        dims = ("snapshot", "particle", "axis")[: 1 + values[0].ndim]
        return xr.Variable(("realization", *dims), np.broadcast_to(np.stack(values), (REALIZATIONS, *np.shape(values))))

    found = data.drop_vars("snapshot").assign_coords(snapshot=list(frames))
    values = {"position": list(frames.values()), **particles}
    return found.assign({name: stacked(several) for name, several in values.items()})


def sizes() -> dict[str, xr.Dataset]:
    """Six systems: the smallest homogeneous, the others on a common curve that the smaller ones leave the sooner."""
    times = np.concatenate([[0], np.geomspace(1e-3, 5, 150)])
    ends = {378: 200, 1435: 500, 5740: 1100, 22960: 4e3, 97776: np.inf}
    data = {"tc1998_n42": gas(42, lambda tau: homogeneous_cooling(tau, 0.4), times)}
    for n, end in ends.items():
        growing = np.where(RATE * times > 5, 1 + RATE * times / 40, 1)
        rate = RATE * np.sqrt(homogeneous_cooling(RATE * times, 0.4)) * growing
        count = np.concatenate([[0], np.cumsum(np.diff(times) * (rate[1:] + rate[:-1]) / 2)])
        count[1:20] = collisions_until(RATE * times[1:20], 0.4)
        law = lambda tau, end=end: clustering(tau) / (1 + 0.25 * (tau / end) ** 2)  # noqa: E731
        data[f"tc1998_n{n}"] = gas(n, law, times, collisions=count)
    waves = {0.05: 9, 0.2: 6, 0.5: 4, 1.0: 3, 2.0: 2, 5.0: 1}
    side = float(data["tc1998_n22960"]["box_x"].max())
    frames = [wave(22960, side, periods, seed=periods) for periods in waves.values()]
    data["tc1998_n22960"] = with_frames(
        data["tc1998_n22960"],
        dict(zip(waves, [positions for positions, _ in frames], strict=True)),
        collision_frequency=[700 * density for _, density in frames],
    )
    return data


def contact_times() -> xr.Dataset:
    """Nine contact times: the larger ones cool slower, the smaller ones have more collisions, and jumps."""
    times, points = np.linspace(0, 5, 5001), []
    for place, t_c in enumerate((1e-12, 1e-10, 1e-8, 1e-6, 1e-5, 1e-4, 5e-4, 1e-3, 1e-2)):
        slower = {1e-4: 1.01, 5e-4: 1.3, 1e-3: 1.6}.get(t_c, 1 + 0.1 * (9 - place) / 9 * (RATE * times > 500))
        elastic = elastic_collision_fraction(t_c, RATE)

        def law(tau: np.ndarray, t_c: float = t_c, slower: np.ndarray = slower) -> np.ndarray:
            return 1 / (1 + tau / 4e3) if t_c == 1e-2 else clustering(tau) * slower ** (tau > 0)

        count = collisions_until(RATE * times, 0.4) * (1 + times / 5 * (0 if t_c == 1e-2 else 3 - np.log10(t_c)))
        count = count + 0.02 * count[-1] * (times > 1) * (t_c < 1e-9)
        late = np.clip(elastic, 0.14, 1)
        count_e = np.where(times < 0.01, elastic * count, elastic * count[10] + late * (count - count[10]))
        n_e = elastic_particle_fraction(t_c, RATE) * 1e-2 ** (t_c < 5e-3)
        more = {
            "elastic_collisions_per_particle": count_e * np.where(times > 0, 1, 0),
            "elastic_particle_fraction": np.full(5001, n_e),
            "elastic_energy_fraction": np.full(5001, 0.9 * n_e),
        }
        point = gas(5740, law, times, contact_time=t_c, collisions=count, **more)
        periods, seed = (1, 0) if t_c <= 1e-8 else (1, place)
        depth = 0 if t_c == 1e-2 else 0.95
        positions, _ = wave(5740, float(point["box_x"].max()), periods, seed, depth)
        positions[:, 0] += 0.03 * seed * point["box_x"].values.max()
        velocity = np.random.default_rng(place).normal(size=(5740, 2))
        points.append(with_frames(point, {5.0: positions}, velocity=[velocity]))
    return xr.concat(points, "contact_time", data_vars="all").sortby("contact_time")


def restitutions() -> xr.Dataset:
    """Seven coefficients, each departing from homogeneous cooling earlier than the one before but for the first."""
    times, points = np.linspace(0, 5, 5001), []
    onsets = {0.99: 1e5, 0.95: 3e3, 0.9: 1e3, 0.8: 300, 0.6: 80, 0.4: 40, 0.2: 35}
    shares = {0.99: 1e-3, 0.95: 1e-3, 0.9: 1e-3, 0.8: 1.5e-3, 0.6: 0.05, 0.4: 0.1, 0.2: 0.2}
    for r, onset in onsets.items():
        law = lambda tau, r=r, onset=onset: clustering(tau, r, onset)  # noqa: E731
        count = -2 / (1 - r**2) * np.log(homogeneous_cooling(RATE * times, r)) * (1 if r > 0.97 else 1.2)
        n_e = 0.002 if r < 0.7 else 1e-4
        more = {
            "elastic_collisions_per_particle": shares[r] * count,
            "elastic_particle_fraction": np.full(5001, n_e),
            "elastic_energy_fraction": np.full(5001, n_e),
        }
        points.append(gas(5740, law, times, restitution=r, collisions=count, **more))
    return xr.concat(points, "restitution", data_vars="all").sortby("restitution")


def elastic(n: int) -> xr.Dataset:
    """Elastic disks: fluid and crystal, 30 samples, 5 per cent fewer elastic collisions than mean field has them."""
    nu = np.array([0.01, 0.03, 0.226725, 0.3, 0.4, 0.5, 0.6, 0.65, 0.69, 0.7, 0.71, 0.74, 0.8, 0.86])
    t_c = np.array([1e-7, 1e-6, 1e-5, 1e-4, 1e-3])
    free_volume = 2 / (1 - nu / CLOSE_PACKING[2])
    solid = free_volume * np.where(nu > 0.75, 1.03 if n == 42 else 1, 0.8)
    P_0 = np.where(nu < 0.7, reduced_pressure(nu), solid)
    w_0 = enskog_rate(nu, HALF_WIDTH**2 / 3, DIAMETER) / (reduced_pressure(nu) - 1)
    rng = np.random.default_rng(n)
    scatter = 1 + 1e-3 * np.array([-1, 0, 1]) * np.where(abs(nu - 0.7) < 0.02, 10, 1)[:, np.newaxis]
    pressure = 1 + (P_0 - 1)[:, np.newaxis] * scatter  # (nu, realization)
    rate = w_0[:, np.newaxis] * (pressure - 1)
    time = np.linspace(0, 500, 31) / rate[..., np.newaxis]
    enskog = enskog_rate(nu, HALF_WIDTH**2 / 3, DIAMETER)[:, np.newaxis]
    n_e = elastic_particle_fraction(t_c[:, np.newaxis, np.newaxis], rate)[..., np.newaxis]
    noise = rng.normal(size=(5, *time.shape)) / np.sqrt(n_e * n)
    counted = np.linspace(0, 500, 31) * np.ones_like(time)
    c_e = 0.95 * elastic_collision_fraction(t_c[:, np.newaxis, np.newaxis], enskog * np.ones(3))[..., np.newaxis]
    over = ("area_fraction", "realization", "time")
    each = ("contact_time", *over)
    stress = {f"collisional_stress_{a}{b}": (over, np.full(time.shape, float(a == b))) for a in "xy" for b in "xy"}
    data = xr.Dataset(
        {
            "kinetic_energy": (over, np.ones_like(time)),
            "sampling_time": (over, time),
            "reduced_pressure": (over, np.where(counted > 0, pressure[..., np.newaxis], np.nan)),
            "collisions_per_particle": (over, counted),
            "elastic_collisions_per_particle": (each, c_e * counted),
            "elastic_collision_fraction": (each, c_e * np.ones_like(time)),
            "elastic_particle_fraction": (each, n_e * (1 + 0.02 * noise)),
            "elastic_particle_time_fraction": (each, n_e * np.ones_like(time)),
            "elastic_energy_fraction": (each, n_e * np.where(n_e > 0.5, 1.05, 1.25) * np.ones_like(time)),
            "enskog_rate": (over[:2], enskog * np.ones(3)),
            "events": (over[:2], np.full(rate.shape, 250 * n)),
            "branch": (over[:2], np.where(nu > 0.7, "crystal", "fluid")[:, np.newaxis].repeat(3, axis=1)),
            **stress,
        },
        {"area_fraction": nu, "contact_time": t_c, "realization": np.arange(3), "time": np.arange(31)},
        ATTRS,
    )
    alike = [name for name in data.data_vars if "contact_time" not in data[name].dims]
    data = data.assign({name: data[name].expand_dims(contact_time=t_c) for name in alike})
    return data.expand_dims(n_particles=[n], restitution=[1.0])


def collapse() -> xr.Dataset:
    """Without t_c: what has r < r_c ends at .2 s, with the numbers of `contact_times` until then."""
    times, rows = np.linspace(0, 5, 501), []
    for n in (42, 378, 1435, 5740):
        points = []
        for r in (0.4, 0.95):
            ends = n > 42 and r < 0.9
            point = gas(n, clustering, times, restitution=r, contact_time=0.0)
            velocity = np.random.default_rng(n).normal(size=(5740, 2)) * 0.3615 / np.sqrt(np.pi / 2)
            point = with_frames(point, {0.0: velocity}, velocity=[velocity])
            if ends:
                point["stop_reason"] = point["stop_reason"].astype(object).where(False, "inelastic_collapse")
                point["stop_time"] = 0.0 * point["stop_time"] + 0.2
            points.append(point)
        rows.append(xr.concat(points, "restitution", data_vars="all"))
    return xr.concat(rows, "n_particles", data_vars="all")


def outlook_cooling() -> xr.Dataset:
    """The beginning of cooling, whose rate has the factor 1 - c_e."""
    times, rows = np.linspace(0, 0.0225, 51), []
    for r in (0.8, 0.99):
        points = []
        for ratio in (0.01, 0.1, 0.3, 1.0, 3.0):
            left = float(np.exp(-2 * ratio))
            law = lambda tau, left=left, r=r: (1 + left * (1 - r**2) * tau / 4) ** -2  # noqa: E731
            count = collisions_until(RATE * times, r)
            more = {"elastic_collisions_per_particle": (1 - left) * count}
            points.append(gas(22960, law, times, restitution=r, contact_time=ratio / RATE, collisions=count, **more))
        point = xr.concat(points, "contact_time", data_vars="all")
        point["kinetic_energy"] = point["kinetic_energy"].mean("realization") + 0 * point["kinetic_energy"]
        rows.append(point)
    return xr.concat(rows, "restitution", data_vars="all")


def outlook_transition() -> xr.Dataset:
    """From clustering to hardly any cooling between t_c = 3e-3 and 5e-3 s."""
    times = np.linspace(0, 5, 11)
    ends = {1e-3: 5e-4, 3e-3: 2e-3, 5e-3: 0.3, 1e-2: 0.9}
    points = [gas(5740, lambda tau, e=e: e ** (tau / tau[-1]), times, contact_time=t_c) for t_c, e in ends.items()]
    return xr.concat(points, "contact_time", data_vars="all")


def whole() -> dict[str, xr.Dataset]:
    """Every study that claims ask for."""
    return {
        **sizes(),
        "tc1998_contact_times": contact_times(),
        "tc1998_restitutions": restitutions(),
        "tc1998_collapse": collapse(),
        "tc1998_outlook_cooling": outlook_cooling(),
        "tc1998_outlook_transition": outlook_transition(),
        **{f"tc1998_elastic_n{n}": elastic(n) for n in (42, 1435, 16680)},
    }


def volumes() -> xr.Dataset:
    """Pressures in test volumes: even in equilibrium, uneven and streaming among clusters."""
    parts, intervals = np.array([1, 4, 16, 64, 256]), np.array([1, 4, 16, 64]) / 64
    spread = np.sqrt(parts[:, np.newaxis] / intervals) * 1e-3 * np.array([1, 30])[:, np.newaxis, np.newaxis]
    spread[:, 0] = np.nan
    kinetic = np.stack([np.ones(5), parts**-0.2])
    runs = ("restitution", "realization", "test_volumes")
    data = xr.Dataset(
        {
            "pressure_spread": ((*runs, "averaging_interval"), np.repeat(spread[:, np.newaxis], REALIZATIONS, axis=1)),
            "kinetic_pressure": (runs, np.repeat(kinetic[:, np.newaxis], REALIZATIONS, axis=1)),
            "collisional_pressure": (runs, np.full((2, REALIZATIONS, 5), 0.7)),
            "tally_pressure": (runs[:2], np.full((2, REALIZATIONS), 0.7)),
        },
        {"restitution": [1.0, 0.4], "test_volumes": parts, "averaging_interval": intervals},
    )
    return data

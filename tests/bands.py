"""Runs that are quickly made up, for the explorer: disks that drift from a lattice into bands, with all files of a run."""

import numpy as np
import xarray as xr

from granugas.analysis.clusters import clusters_of_run
from granugas.explorer import Source
from granugas.storage.dataset import write, write_positions

DIAMETER = 0.002
FACTORS = (1.05, 1.1, 1.2, 1.3, 1.4)


def made_up_run(side, times, spacing=1.77, sizes=False, seed=1, aspect=1.0, **attributes):
    """side^2 disks (aspect: fewer rows) of DIAMETER on a square lattice, shaken, and pressed into bands as time goes on."""
    rng = np.random.default_rng(seed)
    sites = np.stack(np.meshgrid(np.arange(side), np.arange(round(side * aspect))), axis=-1).reshape(-1, 2)
    n, box = len(sites), spacing * DIAMETER * np.array([side, round(side * aspect)])
    place = (sites + 0.5 + 0.15 * rng.uniform(-1, 1, (n, 2))) * spacing * DIAMETER
    pressed = np.sin(2 * np.pi * place[:, ::-1] / box) * np.sin(6 * np.pi * place / box) / (6 * np.pi) * box * 0.45
    share = np.linspace(0, 1, len(times))[:, np.newaxis, np.newaxis]
    velocity = rng.normal(size=(len(times), n, 2)) * 0.1 * (1 + 3 * (sites[:, :1] / side))
    counts = np.cumsum(rng.poisson(3.0, (len(times), n)), axis=0) - 3
    variables = {
        "trajectory": (("time", "particle", "axis"), (place + share * pressed) % box),
        "trajectory_velocity": (("time", "particle", "axis"), velocity.astype(np.float32)),
        "trajectory_collisions": (("time", "particle"), np.maximum(counts, 0).astype(np.int32)),
        "kinetic_energy": ("time", np.exp(-np.arange(len(times)) / 5)),
        "collisions_per_particle": ("time", np.arange(len(times)) * 3.0),
    }
    if sizes:
        variables["particle_diameter"] = ("particle", DIAMETER * rng.uniform(0.7, 1.0, n))
    about = {"n_particles": n, "area_fraction": 0.25, "restitution": 0.8, "contact_time": 1e-5, "diameter": DIAMETER}
    about |= {"box_x": box[0], "box_y": box[1], "boundary": "periodic"} | attributes
    return xr.Dataset(variables, {"time": np.asarray(times, float), "axis": ["x", "y"]}, about)


def source_of(run, folder, label, factors=FACTORS, filmed=True):
    """Write the files that the workflow would have of a run."""
    motion = ["trajectory_velocity", "trajectory_collisions"]
    write_positions(run if filmed else run.drop_vars(motion), folder / f"positions/{label}.nc")
    write(run[["kinetic_energy", "collisions_per_particle"]], folder / f"runs/{label}.nc")
    if factors:
        with xr.open_dataset(folder / f"positions/{label}.nc") as stored:
            write(clusters_of_run(stored, factors), folder / f"clusters/{label}.nc")
    clusters = folder / f"clusters/{label}.nc" if factors else None
    return Source(label, folder / f"positions/{label}.nc", folder / f"runs/{label}.nc", clusters)

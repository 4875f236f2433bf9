"""Positions at the sampling times in a file of their own: packed, so that clusters can be analysed again later.

With the motion of the particles beside them where an animation wants it.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import xarray as xr

from granugas.cost import input_output
from granugas.storage.damage import reading, seal
from granugas.storage.files import chunk_sizes, encoding, labels, replacing
from granugas.storage.variables import VARIABLES, describe

LEVELS = 2**32 - 1
"""Steps of the longest side of the box; the code LEVELS itself means that there is no value."""

MOTION = {"trajectory_velocity": "f4", "trajectory_collisions": "i4"}
BESIDE = ("sampling_time", "particle_diameter")
"""What an analysis of positions needs with them, where a run has it."""

VELOCITY_BITS = 10
"""Of a velocity's mantissa, one part in a thousand: enough for a picture, and half the bytes."""


@input_output
def write_positions(dataset: xr.Dataset, path: str | Path) -> None:
    """Write `trajectory`, its motion, diameters where they differ, coordinates and the global attributes, whole or not at all.

    A position takes 4 bytes a number.

    A position is rounded down to a multiple of L / (2^32 - 1), L the longest side of the box; CF readers find that as
    `scale_factor`. It is packed time step by time step, so that no second copy is in memory.

    Args:
        dataset: a run with `trajectory` (time, particle, axis) in m, in [0, L), NaN after its end, and the attributes
            `box_x`, `box_y` ... in m. `trajectory_velocity` and `trajectory_collisions` are written where it has them.

    Raises:
        KeyError: no trajectory, or no size of the box.
        ValueError: a position outside of the box.
    """
    trajectory = dataset["trajectory"]
    sides = np.array([dataset.attrs[f"box_{axis}"] for axis in dataset["axis"].values])
    names = [name for name in dataset.variables if name in trajectory.coords or name in BESIDE]
    header = describe(dataset[names])
    header.attrs = labels() | {name: value for name, value in dataset.attrs.items() if name != "content_sha256"}
    scale = sides.max() / LEVELS
    attributes = VARIABLES["trajectory"].attributes() | {"scale_factor": scale}
    with replacing(path) as temporary:
        header.to_netcdf(temporary, engine="netcdf4", encoding=encoding(header))
        with netCDF4.Dataset(temporary, "a") as file:
            for dim in {*trajectory.dims} - {*file.dimensions}:
                file.createDimension(str(dim), trajectory.sizes[dim])
            packed = _variable(file, trajectory, "u4", fill_value=LEVELS)
            packed.set_auto_maskandscale(False)
            packed.setncatts(attributes)
            for i, codes in enumerate(_codes(trajectory, sides, scale)):
                packed[i] = codes
            for name in (name for name in MOTION if name in dataset):
                rounding = {"significant_digits": VELOCITY_BITS, "quantize_mode": "BitRound"} if MOTION[name] == "f4" else {}
                written = _variable(file, dataset[name], MOTION[name], **rounding)
                written.setncatts(VARIABLES[name].attributes())
                written[:] = dataset[name].values
        seal(temporary)


@input_output
def read_positions(path: str | Path) -> xr.Dataset:
    """The file's dataset, opened and not yet read: `trajectory` in m is read and unpacked where it is indexed.

        with read_positions(path) as data:
            for step in data["trajectory"]:
                positions = step.values  # (particle, axis) in m

    Raises:
        FileNotFoundError: no such file.
        DamagedFile: it is not what was written.
    """
    with reading(path):
        return xr.open_dataset(path, engine="netcdf4", decode_times=False)


def _variable(file: netCDF4.Dataset, data: xr.DataArray, kind: str, **options: Any) -> "netCDF4.Variable[Any]":
    """A compressed variable of an open file, still empty."""
    chunks = chunk_sizes(data.shape)
    return file.createVariable(
        str(data.name), kind, tuple(map(str, data.dims)), chunksizes=chunks, zlib=True, complevel=1, **options
    )


def _codes(trajectory: xr.DataArray, sides: np.ndarray, scale: float) -> Iterator[np.ndarray]:
    """Multiples of the scale, one time step (particle, axis) after the other."""
    largest = np.minimum(np.floor(sides / scale), LEVELS - 1)
    largest -= largest * scale >= sides  # unpacked positions are inside of the box, too
    for step in trajectory:
        positions = step.values
        if ((positions < 0) | (positions > sides)).any():
            allowed = " x ".join(f"[0, {side:g})" for side in sides)
            raise ValueError(f"trajectory: a position outside of the box, allowed is {allowed} m")
        codes = np.minimum(np.floor(positions / scale), largest)
        yield np.where(np.isnan(codes), LEVELS, codes).astype(np.uint32)

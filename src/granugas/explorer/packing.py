"""Frames of a run, small: disks in the order of linked cells, their places in whole steps of a cell.

A cell is no narrower than the longest bond, so the page finds bonds between neighbouring cells, and decides them with whole
numbers. Rounding moves a bond's distance factor by less than `Grid.margin`. So that nothing shown at an S_c of the
dataset depends on it, a frame names the bonds that hold there by less than twice the margin.
"""

import base64
import math
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from granugas.analysis.burning import join_neighbours, sort_into_cells
from granugas.analysis.clusters import cells_for, periodic_box

LARGEST_FACTOR = 1.6
"""The largest S_c that the page offers."""

STEP = 2.5e-4
"""Of the places, by the smallest diameter, at most: it needs 13 bits a coordinate, and 16 are the most there can be."""

SIZES = 2**16 - 1
"""Steps of a diameter, by the largest one, where diameters differ."""

Numbers = NDArray[np.float64]
Arrays = Mapping[str, NDArray[Any]]


@dataclass(frozen=True)
class Grid:
    """What the frames of a run have in common.

    Attributes:
        box: (2,) sides in m.
        periodic: (2,) bool.
        diameters: (n,) in m.
        cells: (2,) cells along each axis.
        bits: of a place within a cell, along each axis.
        factors: (k,) S_c at which clusters are exact, ascending.
    """

    box: Numbers
    periodic: NDArray[np.bool_]
    diameters: Numbers
    cells: NDArray[np.int64]
    bits: int
    factors: Numbers

    @property
    def sizes(self) -> NDArray[np.uint16] | None:
        """(n,) diameters in steps of the largest by SIZES; None where all are equal."""
        largest = self.diameters.max()
        return None if (self.diameters == largest).all() else np.rint(self.diameters / largest * SIZES).astype(np.uint16)

    @property
    def margin(self) -> float:
        """How far rounding moves a bond's distance factor |r_i - r_j| / ((d_i + d_j) / 2), and a little more."""
        step = (self.box / self.cells / 2**self.bits).max()
        unequal = 0.0 if self.sizes is None else LARGEST_FACTOR * self.diameters.max() / SIZES
        return float(1.01 * (math.sqrt(2) * step + unequal) / self.diameters.min())


def grid_of(run: Mapping[str, Any], diameters: Numbers, factors: Sequence[float]) -> Grid:
    """The grid of a run in two dimensions.

    Args:
        run: its attributes box_x, box_y (m) and boundary.
        diameters: (n,) in m.
        factors: S_c at which clusters are to be exact; those beyond LARGEST_FACTOR are left out.
    """
    box, sides = np.array([run["box_x"], run["box_y"]]), np.array(periodic_box(run, ("x", "y")))
    lengths = np.array([*box, diameters.max()])
    cells = cells_for(lengths, LARGEST_FACTOR * diameters.max(), len(diameters))[:2]
    bits = int(np.clip(np.ceil(np.log2((box / cells).max() / (STEP * diameters.min()))), 1, 16))
    exact = np.unique([factor for factor in factors if factor <= LARGEST_FACTOR])
    return Grid(box, np.isfinite(sides), diameters, cells, bits, exact)


def frame_of(grid: Grid, positions: Numbers, values: Arrays) -> dict[str, NDArray[Any]]:
    """One frame: disks cell by cell, x fastest.

    Args:
        grid: of the run.
        positions: (n, 2) in m, in the box.
        values: what else is known of each disk, (n,) whole numbers by their names.

    Returns:
        `count` (cells,) disks in each cell; `x`, `y` (n,) places in the cell in steps of 2^-bits of its sides; `size` where
        diameters differ; the values; and for the c-th S_c the bonds `first_<c>`, `second_<c>` (pairs of disks of the frame)
        that hold by less than twice the margin, as far as nothing else joins them.
    """
    cells, lengths = np.array([*grid.cells, 1]), np.array([*grid.box, grid.diameters.max()])
    periodic = np.array([*grid.periodic, False])
    rank, start, disks = sort_into_cells(positions, grid.diameters / 2, np.zeros(3), lengths, periodic, cells)
    order = np.argsort(rank)
    home = np.repeat(np.arange(len(start) - 1), np.diff(start))
    frame: dict[str, NDArray[Any]] = {"count": np.diff(start).astype(np.uint16)}
    for axis, (name, cell) in enumerate({"x": home % cells[0], "y": home // cells[0]}.items()):
        place = (disks[:, axis] / lengths[axis] * cells[axis] - cell) * 2**grid.bits
        frame[name] = np.clip(np.floor(place), 0, 2**grid.bits - 1).astype(np.uint16)
    if grid.sizes is not None:
        frame["size"] = grid.sizes[order]
    frame |= {name: numbers[order] for name, numbers in values.items()}
    for c, bonds in enumerate(_close_calls(grid, start, disks, lengths, periodic, cells)):
        frame |= {f"first_{c}": bonds[:, 0], f"second_{c}": bonds[:, 1]}
    return frame


def packed(frame: Arrays) -> tuple[list[tuple[str, str, int]], str]:
    """A frame as (name, kind, length) of its arrays and one text: base64 of what zlib makes of their bytes.

    The lowest bytes of an array stand together, then the next, each with a code of its own: those that say little take little
    room.
    """
    layout = [(name, f"u{array.itemsize}", len(array)) for name, array in frame.items()]
    stream = zlib.compressobj(9, strategy=zlib.Z_FILTERED)
    data = b""
    for array in frame.values():
        for plane in array.astype(f"<u{array.itemsize}").view(np.uint8).reshape(len(array), array.itemsize).T:
            data += stream.compress(plane.tobytes()) + stream.flush(zlib.Z_FULL_FLUSH)
    return layout, base64.b64encode(data + stream.flush()).decode()


def _close_calls(
    grid: Grid, start: NDArray[Any], disks: Numbers, lengths: Numbers, periodic: NDArray[np.bool_], cells: NDArray[np.int64]
) -> list[NDArray[np.uint32]]:
    """For each S_c the (b, 2) bonds of a distance factor from S_c - 2 margin to S_c, by their first disks."""
    if not grid.factors.size:
        return []
    edges = np.unique([grid.factors - 2 * grid.margin, grid.factors])
    parent = np.arange(len(disks)).astype(np.int32)
    bonds, last_bond = join_neighbours(parent, disks, start, lengths, periodic, cells, edges * edges)
    return [
        np.array(
            sorted(
                (min(pair), max(pair))
                for edge in np.flatnonzero((edges > factor - 2 * grid.margin) & (edges <= factor))
                for pair in _linked(bonds, last_bond[edge])
            ),
            np.uint32,
        ).reshape(-1, 2)
        for factor in grid.factors
    ]


def _linked(bonds: NDArray[np.int32], bond: int) -> list[tuple[int, int]]:
    """The pairs of a linked list of bonds."""
    found = []
    while bond >= 0:
        first, second, bond = bonds[bond]
        found.append((int(first), int(second)))
    return found

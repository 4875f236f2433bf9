"""Clusters by distance (B section 5): of one configuration, and through a run."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from granugas.analysis.burning import label_clusters
from granugas.storage.variables import describe

PAPER_FACTORS = (1.05, 1.1, 1.2, 1.3, 1.4)
"""The distance factors S_c of B Fig. 7."""


@dataclass(frozen=True)
class Clusters:
    """Clusters of one configuration for k distance factors.

    Attributes:
        distance_factors: (k,) S_c, ascending.
        labels: (k, n) int32, the cluster of each particle, numbered from 0 in the order of their first particles.
        sizes: for each S_c the numbers of particles M_i of its I_c clusters.
    """

    distance_factors: NDArray[np.float64]
    labels: NDArray[np.int32]
    sizes: tuple[NDArray[np.int32], ...]

    @property
    def counts(self) -> NDArray[np.int64]:
        """(k,) number of clusters I_c."""
        return np.array([len(sizes) for sizes in self.sizes])

    @property
    def mean_sizes(self) -> NDArray[np.float64]:
        """(k,) mean cluster size <M> = N / I_c (B Eq. 7)."""
        return self.labels.shape[1] / self.counts

    @property
    def weighted_sizes(self) -> NDArray[np.float64]:
        """(k,) mean size of the cluster of a particle, sum M_i^2 / N: independent of I_c, unlike <M>."""
        return np.array([np.square(sizes, dtype=float).sum() for sizes in self.sizes]) / self.labels.shape[1]

    @property
    def largest_sizes(self) -> NDArray[np.int64]:
        """(k,) size of the largest cluster M_max."""
        return np.array([sizes.max() for sizes in self.sizes], dtype=np.int64)

    def __repr__(self) -> str:
        rows = zip(self.distance_factors, self.counts, self.mean_sizes, self.weighted_sizes, self.largest_sizes, strict=True)
        lines = [
            f"{factor:8g} {count:10d} {mean:10.4g} {of_one:10.4g} {largest:10d}"
            for factor, count, mean, of_one, largest in rows
        ]
        title = f"Clusters of {self.labels.shape[1]} particles"
        return "\n".join([title, f"{'S_c':>8} {'I_c':>10} {'<M>':>10} {'M_w':>10} {'M_max':>10}", *lines])


def find_clusters(
    positions: ArrayLike | xr.Dataset,
    box: ArrayLike | None = None,
    diameter: ArrayLike | None = None,
    distance_factors: Sequence[float] = PAPER_FACTORS,
) -> Clusters | xr.Dataset:
    """Particles are in contact if |r_i - r_j| <= S_c (d_i + d_j) / 2 (B Eq. 6); clusters are what contacts connect.

    Args:
        positions: (n, dim) in m, dim = 1, 2 or 3, anywhere; or the dataset of one run, see `clusters_of_run`, which
            brings its box and diameter.
        box: (dim,) sides of a periodic box in m, an infinite one for an open axis; None for open boundaries.
        diameter: of all particles, or (n,) of each, in m; 1 where it is not given, all lengths are in diameters then.
        distance_factors: S_c; they are sorted, all are done in one sweep.

    Returns:
        Clusters, or for a run a dataset of the cluster observables.

    Raises:
        ValueError: an argument that has no meaning; the message names it.
    """
    if isinstance(positions, xr.Dataset):
        if box is not None or diameter is not None:
            raise ValueError("box, diameter: a run brings its own, give distance_factors only")
        return clusters_of_run(positions, distance_factors)
    return _find(_positions(positions), box, diameter, _factors(distance_factors))


def clusters_of_run(run: xr.Dataset, distance_factors: Sequence[float] = PAPER_FACTORS) -> xr.Dataset:
    """Clusters over the `trajectory` of a run, or over the `position` of its snapshots where it kept no trajectory.

    Args:
        run: dataset of one run with the attributes box_x, box_y and diameter in m; with the variable particle_diameter
            where diameters differ. It may be opened lazily: one time
            is in memory at once.
        distance_factors: S_c.

    Returns:
        The variables of `clusters_of_frames` with the coordinates and attributes of the run.

    Raises:
        ValueError: no positions in the dataset, or more than one run.
    """
    name = next((name for name in ("trajectory", "position") if name in run), None)
    if name is None:
        raise ValueError("the run has neither trajectory nor position: keep its positions or take snapshots")
    frames = run[name]
    time = frames.dims[0]
    if frames.ndim != 3 or time not in ("time", "snapshot"):
        raise ValueError(f"{name} has the dimensions {frames.dims}: select one run of them first")
    diameter = run["particle_diameter"].values if "particle_diameter" in run else run.attrs["diameter"]
    box = periodic_box(run.attrs, frames.axis.values)
    arrays = (frames.isel({time: index}).values for index in range(frames.sizes[time]))
    found = clusters_of_frames(arrays, box, diameter, distance_factors).rename(time=time)
    coordinates = {key: value for key, value in frames.coords.items() if set(value.dims) <= {time}}
    return describe(found.assign_coords(coordinates).assign_attrs(run.attrs))


def clusters_of_frames(
    frames: Iterable[ArrayLike], box: ArrayLike | None, diameter: ArrayLike, distance_factors: Sequence[float]
) -> xr.Dataset:
    """Cluster observables of one configuration after the other.

    Args:
        frames: positions (n, dim) in m, n the same at each time; rows of NaN are nobody, a frame of them (of a run that
            has ended) gives NaN.
        box, diameter, distance_factors: as in `find_clusters`.

    Returns:
        cluster_count I_c, mean_cluster_size <M>, weighted_cluster_size and largest_cluster_size M_max over
        (distance_factor, time), and
        cluster_size_distribution over (distance_factor, time, cluster_size): the number of clusters in the bins of
        `size_bins`, sizes from cluster_size to below cluster_size_upper.
    """
    factors = _factors(distance_factors)
    rows = []
    for frame in frames:
        positions = _positions(frame)
        bins = size_bins(len(positions))
        nobody = np.isnan(positions[:, 0])
        if nobody.all():
            rows.append(np.full((len(factors), 4 + len(bins) - 1), np.nan))
            continue
        there = diameter
        if nobody.any():
            positions, there = positions[~nobody], np.broadcast_to(diameter, len(nobody))[~nobody]
        found = _find(positions, box, there, factors)
        numbers = [_binned(sizes, bins) for sizes in found.sizes]
        rows.append(np.column_stack([found.counts, found.mean_sizes, found.weighted_sizes, found.largest_sizes, numbers]))
    if not rows:
        raise ValueError("frames: there is none")
    table = np.stack(rows, axis=1)
    dims = ("distance_factor", "time")
    return xr.Dataset(
        {
            "cluster_count": (dims, table[..., 0]),
            "mean_cluster_size": (dims, table[..., 1]),
            "weighted_cluster_size": (dims, table[..., 2]),
            "largest_cluster_size": (dims, table[..., 3]),
            "cluster_size_distribution": ((*dims, "cluster_size"), table[..., 4:]),
        },
        coords={
            "distance_factor": factors,
            "cluster_size": bins[:-1],
            "cluster_size_upper": ("cluster_size", bins[1:]),
        },
    )


def size_bins(n: int) -> NDArray[np.int64]:
    """Edges 1, 2, 3, 4, 6, 8, 12, 16, 24 ... of half-open bins of sizes up to n: two an octave, alike for all n."""
    octaves = 2 ** np.arange(n.bit_length())
    edges = np.unique(np.concatenate([octaves, octaves * 3 // 2, [2 ** n.bit_length()]]))
    return edges[: np.searchsorted(edges, n, side="right") + 1]


def _binned(sizes: NDArray[np.int32], bins: NDArray[np.int64]) -> NDArray[np.int64]:
    return np.add.reduceat(np.bincount(sizes, minlength=bins[-1]), bins[:-1])


def _find(
    positions: NDArray[np.float64], box: ArrayLike | None, diameter: ArrayLike | None, factors: NDArray[np.float64]
) -> Clusters:
    n, dim = positions.shape
    diameters = _numbers("diameter", 1.0 if diameter is None else diameter)
    if diameters.shape not in ((), (n,)) or not np.all((diameters > 0) & np.isfinite(diameters)):
        raise ValueError(f"diameter: allowed are a number > 0 m or {n} of them")
    sides = np.full(3, np.inf)
    if box is not None:
        sides[:dim] = _box(box, dim)
    periodic = np.isfinite(sides)
    low, high = np.zeros(3), np.zeros(3)
    low[:dim] = [column.min() for column in positions.T]
    high[:dim] = [column.max() for column in positions.T]
    if not np.isfinite(high - low).all():
        raise ValueError("positions: some are not finite")
    origin = np.where(periodic, 0.0, low)
    lengths = np.where(periodic, sides, np.maximum(high - low, diameters.max()))
    cells = cells_for(lengths, factors[-1] * diameters.max(), n)
    radii = np.ascontiguousarray(np.broadcast_to(diameters / 2, n))
    labels, sizes, counts = label_clusters(positions, radii, origin, lengths, periodic, cells, factors)
    return Clusters(factors, labels, tuple(row[:count] for row, count in zip(sizes, counts, strict=True)))


def cells_for(lengths: NDArray[np.float64], reach: float, n: int) -> NDArray[np.int64]:
    """Cells that a bond cannot jump over, not many more of them than particles."""
    most = 4 * n + 64
    cells = np.minimum(lengths / (reach * (1 + 1e-9)), most).astype(np.int64).clip(min=1)
    while math.prod(cells.tolist()) > most:
        cells[cells.argmax()] //= 2
    return cells


def _positions(positions: ArrayLike) -> NDArray[np.float64]:
    array = np.ascontiguousarray(_numbers("positions", positions))
    if array.ndim != 2 or array.shape[1] not in (1, 2, 3) or not len(array):
        raise ValueError(f"positions of shape {array.shape}: allowed is (n, dim) with n >= 1 and dim = 1, 2 or 3")
    return array


def periodic_box(run: Mapping[str, Any], axes: Sequence[str]) -> list[float]:
    """The sides of the box of a run, with its attributes; infinite between walls, across which nothing is near."""
    words = str(run.get("boundary", "periodic")).split()
    edges = words * len(axes) if len(words) == 1 else words
    return [math.inf if edge == "wall" else float(run[f"box_{axis}"]) for axis, edge in zip(axes, edges, strict=True)]


def _box(box: ArrayLike, dim: int) -> NDArray[np.float64]:
    sides = _numbers("box", box)
    if sides.shape not in ((), (dim,)) or not np.all(sides > 0):
        raise ValueError(f"box = {box}: allowed are {dim} sides > 0 m, inf for an open axis")
    return sides


def _factors(distance_factors: Sequence[float]) -> NDArray[np.float64]:
    factors = np.unique(np.atleast_1d(_numbers("distance_factors", distance_factors)))
    if not factors.size or not np.all((factors > 0) & np.isfinite(factors)):
        raise ValueError(f"distance_factors = {distance_factors}: allowed are numbers > 0, at least one")
    return factors


def _numbers(name: str, values: ArrayLike) -> NDArray[np.float64]:
    try:
        return np.asarray(values, dtype=float)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{name} = {values!r}: allowed are numbers") from error

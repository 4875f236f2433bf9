"""How far a cheap measurement is from the truth, with an error of that; errors come from the spread over realizations.

Arguments are over `realization` and any other dimensions. Where runs of one realization begin alike, differences are taken
within it before anything is averaged: what they share drops out, and the error of the truth is in that of the difference.
"""

import numpy as np
import xarray as xr

REALIZATION = "realization"


def mean_error(values: xr.DataArray) -> xr.DataArray:
    """Standard error of the mean over realizations; NaN for a single one."""
    return values.std(REALIZATION, ddof=1) / np.sqrt(values.count(REALIZATION))


def at_zero(values: xr.DataArray, dim: str) -> xr.DataArray:
    """The value at 0 of the straight line through the values along a numbered dimension, for each realization by itself.

    All points count alike: they are of one quantity, whose spread hardly depends on where it is measured. The error of a
    limit is that of its mean over realizations, whatever the points of one of them share.

    Raises:
        ValueError: fewer than three points.
    """
    x = values[dim].values.astype(float)
    if len(x) < 3:
        raise ValueError(f"{dim} = {x.tolist()}: at least 3 values are needed to extrapolate with an error")
    scale = np.abs(x).max()
    weights = np.linalg.pinv(np.stack([np.ones_like(x), x / scale], axis=1))[0]
    return (values * xr.DataArray(weights, {dim: values[dim]})).sum(dim, skipna=False)


def bias(values: xr.DataArray, truths: xr.DataArray) -> xr.Dataset:
    """|mean - truth| / truth: what is wrong with a setting however many runs are averaged.

    Args:
        values: as measured.
        truths: of the same realizations, or one that is exact; they may have fewer dimensions.

    Returns:
        Dataset without `realization`: measured, measured_error, truth, truth_error, relative_error and relative_error_error,
        which is the standard error of the paired difference. Where the truth is 0 the last two are NaN.
    """
    shift, found = values - truths, _means(values, truths)
    size = abs(found["truth"]).where(found["truth"] != 0)
    return found.assign(relative_error=abs(shift.mean(REALIZATION)) / size, relative_error_error=mean_error(shift) / size)


def scatter(values: xr.DataArray, truths: xr.DataArray) -> xr.Dataset:
    """Root mean square of (value - truth) / truth: how wrong one run alone is, whether by bias or by chance.

    Arguments and result as of `bias`; the standard error of the root is that of the mean square by twice the root.
    """
    squares, found = (values - truths) ** 2, _means(values, truths)
    root, size = np.sqrt(squares.mean(REALIZATION)), abs(found["truth"]).where(found["truth"] != 0)
    error = mean_error(squares) / (2 * root.where(root > 0))
    return found.assign(relative_error=root / size, relative_error_error=error / size)


def _means(values: xr.DataArray, truths: xr.DataArray) -> xr.Dataset:
    return xr.Dataset(
        {
            "measured": values.mean(REALIZATION),
            "measured_error": mean_error(values),
            "truth": truths.mean(REALIZATION) if REALIZATION in truths.dims else truths,
            "truth_error": mean_error(truths) if REALIZATION in truths.dims else xr.zeros_like(truths),
        }
    )


def in_large_systems(measured: xr.DataArray, error: xr.DataArray, dim: str, largest: int = 3) -> xr.Dataset:
    """The limit of large systems: where the straight line in 1/N through the means of the largest ones is at 0.

    Args:
        measured, error: means and their standard errors over numbers of particles (dim) and any other dimensions; independent.
        largest: number of sizes that count, each by 1/error^2. The rest of a series in 1/N is taken to be small there.

    Returns:
        Dataset without `dim`: truth and truth_error.

    Raises:
        ValueError: fewer than two sizes.
    """
    sizes = measured.sortby(dim).isel({dim: slice(-largest, None)})
    if sizes.sizes[dim] < 2:
        raise ValueError(f"{dim} = {sizes[dim].values.tolist()}: at least 2 sizes are needed to extrapolate")
    weight = 1 / error.sortby(dim).isel({dim: slice(-largest, None)}) ** 2
    x = 1 / sizes[dim].astype(float)
    s, sx, sxx = weight.sum(dim), (weight * x).sum(dim), (weight * x**2).sum(dim)
    sy, sxy = (weight * sizes).sum(dim), (weight * x * sizes).sum(dim)
    determinant = s * sxx - sx**2
    return xr.Dataset({"truth": (sxx * sy - sx * sxy) / determinant, "truth_error": np.sqrt(sxx / determinant)})

"""cluster1999: exponents of the growth law with their intervals, and the times at which growth begins and ends."""

import pandas as pd
import xarray as xr

from granugas.analysis.growth import regime_boundaries
from granugas.analysis.statistics import fit_power_law
from granugas.analysis.theory import homogeneous_cooling
from granugas.plotting.runs import grid_points

STUDIES = ("cluster1999_large",)

WINDOWS = ((1.0, 40.0), (1.0, 6.3), (6.3, 40.0), (100.0, 446.6))
"""The growth regime of the paper and its halves, and what comes after, in s."""

SIZES = ("cluster_count", "mean_cluster_size", "weighted_cluster_size", "largest_cluster_size")


def table(data: dict[str, xr.Dataset]) -> pd.DataFrame:
    """One row a number: quantity, S_c, what, window (s), value (1, times in s), 95 % interval over realizations, their number.

    K has no S_c. "begins" and "ends" are the boundaries of the growth of <M>, and of K by Eq. 1.
    """
    rows = []
    for _, runs in grid_points(data[STUDIES[0]]):
        later = runs.isel(time=slice(1, None)).transpose("realization", ..., "time")
        excess = later["kinetic_energy"] / homogeneous_cooling(later["tau"], float(runs["restitution"]))
        curves = [("kinetic_energy", None, later["kinetic_energy"], excess)]
        for factor in runs["distance_factor"].values:
            found = later.sel(distance_factor=factor)
            curves += [(name, factor, found[name], found["mean_cluster_size"]) for name in SIZES if name in found]
        for name, factor, curve, grown in curves:
            fits = [fit_power_law(later["time"], curve, window) for window in WINDOWS]
            numbers = [("exponent", *fit.window, fit.exponent, *fit.interval) for fit in fits]
            if name in ("kinetic_energy", "mean_cluster_size"):
                times = regime_boundaries(later["time"], grown)
                numbers += [(what, None, None, *time) for what, time in zip(("begins", "ends"), times, strict=True)]
            rows += [(name, factor, *number, len(curve)) for number in numbers]
    columns = ["quantity", "distance_factor", "what", "window_from", "window_to", "value", "low", "high", "realizations"]
    return pd.DataFrame(rows, columns=columns)

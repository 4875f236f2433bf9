"""Runs of a study, pooled into one dataset over its grid."""

import json
import logging
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import product
from math import prod
from typing import Any

import numpy as np
import xarray as xr

from granugas.scene import SCENE_KEYS
from granugas.storage.files import labels
from granugas.storage.provenance import merge, plain
from granugas.storage.variables import ERROR, VARIABLES, describe

logger = logging.getLogger(__name__)

STOPPED = ("inelastic_collapse", "max_seconds", "max_collisions")
"""Values of `stop_reason` of runs that did not come to the end that was asked for."""

Place = dict[str, list[Any]]
"""The value of each grid key that a part has; several where one trajectory serves them all."""

Cell = tuple[tuple[int, ...], dict[str, int]]
"""A position in the grid, and the selection of a part that goes there."""


def pool(parts: Iterable[xr.Dataset], keys: Sequence[str]) -> xr.Dataset:
    """One dataset of many runs: every variable over the grid keys and `realization`, then over its own dimensions.

    What is missing (a run, a particle that a smaller system does not have, a sample that a run did not reach) is NaN,
    and "" in texts. Whole numbers stay whole where nothing is missing. A part with the dimension of a grid key (a run
    of r = 1 with a list of `contact_time`) fills all those values; its variables without that dimension are repeated.

    Args:
        parts: runs, each merged with its cluster dataset if there is one; grid keys are found among their attributes.
        keys: grid keys in the order of the dimensions.

    Raises:
        ValueError: no parts, two parts for one place, or sampling times in s that differ.
        KeyError: a part without one of the keys, or a variable that is not in the table.
    """
    grid = [*keys, "realization"]
    placed = sorted(((_place(part, grid), part) for part in parts), key=lambda item: [*item[0].values()])
    if not placed:
        raise ValueError("pool: no parts")
    places = [place for place, _ in placed]
    parts, attributes = _split_attributes([part for _, part in placed], grid)

    axes = {key: sorted({value for place in places for value in place[key]}) for key in grid}
    cells = [list(_cells(place, part, axes)) for place, part in placed]
    _refuse_duplicates(cells, axes)
    coordinates = _own_coordinates(parts, grid)
    dims = {str(dim) for part in parts for dim in part.dims}
    sizes = {dim: max(part.sizes.get(dim, 0) for part in parts) for dim in dims}
    sizes |= {str(dim): size for dim, size in coordinates.sizes.items()}
    sizes |= {key: len(values) for key, values in axes.items()}

    names = dict.fromkeys(str(name) for part in parts for name in part.data_vars if name not in grid)
    pooled = {name: _fill(name, parts, cells, grid, sizes, coordinates) for name in names}
    return describe(xr.Dataset(pooled, {**coordinates.coords, **axes}, attributes))


def with_errors(pooled: xr.Dataset) -> xr.Dataset:
    """The dataset, and beside each observable `<variable>_error`, the standard error of its mean over realizations.

    Observables are the numbers that runs have at their samples: series, elastic shares, clusters; neither what belongs to
    single particles nor what each run has once. The error has all dimensions of its variable but `realization` and is its
    unit; it is s / sqrt(n) of the n runs that reached a sample, s their standard deviation (ddof = 1), and NaN for n < 2. The
    variable names it in its attribute `ancillary_variables` (CF section 3.4). With one realization there are none.
    """
    if pooled.sizes.get("realization", 1) < 2:
        return pooled
    result = pooled.copy()
    for name in filter(lambda name: _is_observable(pooled[name]), pooled.data_vars):
        number = pooled[name].notnull().sum("realization")
        result[f"{name}{ERROR}"] = pooled[name].std("realization", ddof=1) / np.sqrt(number)
        result[name].attrs["ancillary_variables"] = f"{name}{ERROR}"
    return describe(result)


def _is_observable(variable: xr.DataArray) -> bool:
    return {"realization", "time"} <= {*variable.dims} and "particle" not in variable.dims and variable.dtype.kind in "fiu"


def tell_stops(pooled: xr.Dataset) -> None:
    """Say in the log how many runs of a study stopped before their end: a line for each reason."""
    reasons, times = np.ravel(pooled["stop_reason"]), np.ravel(pooled["stop_time"])
    for reason in STOPPED:
        at = times[reasons == reason]
        if len(at):
            words = "%s: %d of %d runs stopped before their end, the first at t = %g s, NaN after it"
            logger.warning(words, reason, len(at), np.count_nonzero(reasons), at.min())


def realization_of(pooled: xr.Dataset, realization: int) -> xr.Dataset:
    """One of the parts that were pooled over `realization` alone; the dataset itself where it holds nothing else."""
    if "realization" not in pooled.dims:
        return pooled
    part = pooled.sel(realization=realization, drop=True)
    scalars = [name for name, variable in part.data_vars.items() if variable.ndim == 0]
    return part.drop_vars(scalars).assign_attrs({name: part[name].item() for name in scalars})


def _place(part: xr.Dataset, grid: Sequence[str]) -> Place:
    place = {}
    for key in grid:
        if key not in part.variables and key not in part.attrs:
            raise KeyError(f"{key}: no attribute and no variable of a part that is to be pooled")
        values = part[key].values if key in part.variables else plain(part.attrs[key])
        place[key] = np.ravel(values).tolist()
    return place


def _cells(place: Place, part: xr.Dataset, axes: dict[str, list[Any]]) -> Iterator[Cell]:
    for choice in product(*(range(len(values)) for values in place.values())):
        chosen = dict(zip(place, choice, strict=True))
        position = tuple(axes[key].index(place[key][i]) for key, i in chosen.items())
        yield position, {key: i for key, i in chosen.items() if key in part.dims}


def _refuse_duplicates(cells: list[list[Cell]], axes: dict[str, list[Any]]) -> None:
    position, times = Counter(position for part in cells for position, _ in part).most_common(1)[0]
    if times > 1:
        where = ", ".join(f"{key} = {values[i]}" for (key, values), i in zip(axes.items(), position, strict=True))
        raise ValueError(f"{where}: {times} parts have this place in the pooled dataset, allowed is one")


def _split_attributes(parts: list[xr.Dataset], grid: Sequence[str]) -> tuple[list[xr.Dataset], dict[str, Any]]:
    """The parts with what belongs to one run (its box, its start state) as variables, and the attributes in common."""
    of_a_file = {*labels(), "content_sha256", "provenance"}
    common, varying = {}, []
    for name in dict.fromkeys(name for part in parts for name in part.attrs):
        values = [plain(part.attrs.get(name)) for part in parts]
        if name in grid or name in of_a_file:
            continue
        same = all(value == values[0] for value in values)
        if name in VARIABLES and not (same and name in SCENE_KEYS):
            varying.append(name)
        elif same:
            common[name] = parts[0].attrs[name]
        else:
            logger.warning("attribute %s differs between the runs and is left out of the pooled dataset", name)
    provenances = [json.loads(part.attrs["provenance"]) for part in parts if "provenance" in part.attrs]
    if provenances:
        common["provenance"] = json.dumps(merge(provenances), sort_keys=True)
    return [part.assign({name: part.attrs[name] for name in varying if name in part.attrs}) for part in parts], common


def _own_coordinates(parts: list[xr.Dataset], grid: Sequence[str]) -> xr.Dataset:
    """All values of each coordinate that is not of the grid."""
    own = [
        xr.Dataset(coords={name: value for name, value in part.coords.items() if {name, *value.dims}.isdisjoint(grid)})
        for part in parts
    ]
    merged = xr.merge(own, join="outer", compat="no_conflicts", combine_attrs="drop")
    in_seconds = "time" in merged.coords and merged["time"].dtype.kind == "f"
    if in_seconds and any(part.sizes["time"] != merged.sizes["time"] for part in own if "time" in part.dims):
        raise ValueError("time: the sampling times of the runs differ; allowed are equal ones in s, or numbered samples")
    return merged


def _fill(
    name: str,
    parts: list[xr.Dataset],
    cells: list[list[Cell]],
    grid: Sequence[str],
    sizes: dict[str, int],
    coordinates: xr.Dataset,
) -> xr.Variable:
    """One variable of all parts, in an array that is allocated once."""
    holders = [(part, where) for part, where in zip(parts, cells, strict=True) if name in part]
    variables = [part.variables[name] for part, _ in holders]
    own = [str(dim) for dim in variables[0].dims if dim not in grid]
    shape = [sizes[dim] for dim in (*grid, *own)]
    filled = sum(len(where) * prod(part.sizes[dim] for dim in own) for part, where in holders)
    pooled = _empty(shape, [variable.dtype for variable in variables], filled == prod(shape))
    for variable, (part, where) in zip(variables, holders, strict=True):
        window = _window([_positions(part, dim, coordinates) for dim in own])
        for position, selection in where:
            place: Any = (*position, ...)
            within: Any = (*window, ...)
            piece = variable.isel(selection, missing_dims="ignore").transpose(*own)
            pooled[place][within] = piece.values
    attributes = {
        key: value
        for key, value in variables[0].attrs.items()
        if all(plain(v.attrs.get(key)) == plain(value) for v in variables)
    }
    return xr.Variable((*grid, *own), pooled, attributes)


def _empty(shape: Sequence[int], dtypes: Sequence[np.dtype], complete: bool) -> np.ndarray:
    """An array for values of all these types, with the mark of what is missing in it unless all will be there."""
    if any(dtype.kind not in "fiub" for dtype in dtypes):
        return np.full(shape, "", dtype=object)
    if complete:
        return np.empty(shape, np.result_type(*dtypes))
    return np.full(shape, np.nan, np.result_type(*(d if d.kind == "f" else np.float64 for d in dtypes)))


def _positions(part: xr.Dataset, dim: str, coordinates: xr.Dataset) -> np.ndarray:
    if dim in coordinates.indexes and dim in part.indexes:
        return coordinates.indexes[dim].get_indexer(part.indexes[dim])
    return np.arange(part.sizes[dim])


def _window(positions: Sequence[np.ndarray]) -> tuple[Any, ...]:
    """An index of all positions along all dimensions; slices where they will do, which is much faster."""
    if all(len(p) and (np.diff(p) == 1).all() for p in positions):
        return tuple(slice(p[0], p[-1] + 1) for p in positions)
    return np.ix_(*positions)

"""Whether two datasets agree: bit for bit, or statistically and by how much."""

import math
from dataclasses import dataclass
from statistics import NormalDist
from typing import Any, cast

import numpy as np
import xarray as xr

from granugas.scene import SCENE_KEYS
from granugas.storage.dataset import NOT_CONTENT, content_sha256
from granugas.storage.provenance import plain
from granugas.storage.variables import ERROR

ROUNDING = 1e-12
"""Relative difference that is none."""

CHANCE = 1e-3
"""Probability that two sets of realizations of one system are called different, at most."""

OWN = ("seed", "realization", "warnings")
"""What may differ between two studies of one system: which random numbers they took, and what was said of them."""


@dataclass(frozen=True)
class Difference:
    """The largest difference of one variable.

    Attributes:
        name: of the variable.
        size: in standard errors, or relative where there are none.
        where: its place, in words; "" for a single number.
    """

    name: str
    size: float
    where: str


@dataclass(frozen=True)
class Comparison:
    """What two datasets have in common.

    Attributes:
        same_bits: their content has one SHA-256.
        statistical: whether realizations were compared by their means, in standard errors; else values, relatively.
        limit: size above which a difference is none by chance.
        differences: of the variables that both have, largest first; empty for the same bits.
        remarks: parameters, variables or places that only one has, or that differ.
    """

    same_bits: bool
    statistical: bool
    limit: float
    differences: tuple[Difference, ...]
    remarks: tuple[str, ...]

    @property
    def agree(self) -> bool:
        """Equal, or different by no more than chance (or rounding) explains."""
        return self.same_bits or (not self.remarks and all(found.size <= self.limit for found in self.differences))

    def __str__(self) -> str:
        if self.same_bits:
            return "equal bit for bit"
        unit = "standard errors" if self.statistical else "relative difference"
        how = "means over realizations" if self.statistical else "values"
        verdict = "equal within errors" if self.agree else "different"
        rows = [f"  {found.name:32} {found.size:10.3g}  {found.where}".rstrip() for found in self.differences]
        title = f"{verdict}: {how}, largest {unit} of each variable (chance explains {self.limit:.3g})"
        return "\n".join([*(f"{remark}" for remark in self.remarks), title, *rows])


def compare(first: xr.Dataset, second: xr.Dataset) -> Comparison:
    """Compare two datasets of one run, or two pooled studies.

    With several realizations in both, the means over them are compared in standard errors of their difference; with the
    few realizations that studies have, Student's t (Welch) is turned into the normal deviate of the same probability
    (Wallace 1959), and the variance at one place counts together with the typical relative variance of the variable there,
    as one more degree of freedom. The limit is that of the largest of so many independent deviates. Other datasets are
    compared value by value. Places that only one of them has are left out, and said.
    """
    if content_sha256(first) == content_sha256(second):
        return Comparison(True, False, 0.0, (), ())
    statistical = all(data.sizes.get("realization", 1) > 1 for data in (first, second))
    remarks = [*_parameters(first, second), *_only_in_one(first, second)]
    averaged = {"realization"} if statistical else set()
    unlabelled = {*first.dims, *second.dims} - ({*first.indexes} & {*second.indexes})
    first, second = xr.align(first, second, join="inner", exclude=unlabelled | averaged)
    found, count = [], 0
    for name in (name for name in map(str, first.data_vars) if name in second.data_vars and _counts(name)):
        a, b = first[name], second[name]
        shapes = [{dim: size for dim, size in data.sizes.items() if dim not in averaged} for data in (a, b)]
        if shapes[0] != shapes[1]:
            remarks.append(f"{name}: {shapes[0]} in the first, {shapes[1]} in the second")
        elif not averaged <= {*a.dims} & {*b.dims}:
            found.append(_largest(name, _relative(a, b) / ROUNDING))  # no error is known
        elif statistical and _is_text(a):
            remarks += _other_texts(a, b)
        else:
            sizes = _in_standard_errors(a, b) if statistical else _relative(a, b)
            count += int(sizes.notnull().sum())
            found += [_largest(name, sizes.fillna(0.0))] if sizes.size else []
    limit = NormalDist().inv_cdf(1 - CHANCE / (2 * max(count, 1))) if statistical else ROUNDING
    found.sort(key=lambda difference: -difference.size)
    return Comparison(False, statistical, limit, tuple(found), tuple(remarks))


def _in_standard_errors(a: xr.DataArray, b: xr.DataArray) -> xr.DataArray:
    """Differences of the means over realizations, as normal deviates; NaN where one has fewer than two values."""
    means = [data.mean("realization") for data in (a, b)]
    variances = [data.var("realization", ddof=1) for data in (a, b)]
    numbers = [data.notnull().sum("realization") for data in (a, b)]
    scale = _larger(*means) ** 2
    relative = (sum(variances) / 2 / scale.where(scale > 0)).fillna(0.0)
    alike = [dim for dim in ("time", "particle") if dim in relative.dims]
    typical = scale * (relative.median(alike) if alike else relative)
    errors = [((n - 1) * variance + typical) / n**2 for variance, n in zip(variances, numbers, strict=True)]
    total = errors[0] + errors[1] + ROUNDING**2 * scale
    squares: Any = sum(error**2 / n for error, n in zip(errors, numbers, strict=True))
    freedom = total**2 / squares.clip(min=np.finfo(float).tiny)
    t = abs(means[0] - means[1]) / np.sqrt(total.where(total > 0, 1.0))
    return _normal_deviate(t, freedom.clip(1.0, 1e6))


def _normal_deviate(t: xr.DataArray, freedom: xr.DataArray) -> xr.DataArray:
    """The deviate that is as improbable as Student's t of so many degrees of freedom (Wallace 1959)."""
    return (8 * freedom + 1) / (8 * freedom + 3) * np.sqrt(freedom * np.log1p(t**2 / freedom))


def _relative(a: xr.DataArray, b: xr.DataArray) -> xr.DataArray:
    """Differences by the larger of the two values; NaN agrees with NaN only, and texts differ by 1."""
    if _is_text(a) or _is_text(b):
        return (a.astype(str) != b.astype(str)).astype(float)
    a, b = a.astype(float), b.astype(float)
    larger = _larger(a, b)
    sizes = (abs(a - b) / larger.where(larger > 0, 1.0)).where(a != b, 0.0)  # infinity agrees with infinity
    return sizes.where(a.isnull() == b.isnull(), math.inf).fillna(0.0)


def _larger(a: xr.DataArray, b: xr.DataArray) -> xr.DataArray:
    """The larger of two magnitudes."""
    return cast(xr.DataArray, np.maximum(abs(a), abs(b)))


def _is_text(data: xr.DataArray) -> bool:
    return data.dtype.kind not in "fiub"


def _other_texts(a: xr.DataArray, b: xr.DataArray) -> list[str]:
    """A remark where two variables have no text in common."""
    texts = [sorted({*map(str, data.values.flat)}) for data in (a, b)]
    alike = {*texts[0]} & {*texts[1]}
    return [] if alike else [f"{a.name}: {', '.join(texts[0])} in the first, {', '.join(texts[1])} in the second"]


def _largest(name: str, sizes: xr.DataArray) -> Difference:
    worst = sizes.isel(sizes.argmax(...)) if sizes.ndim else sizes
    where = ", ".join(f"{key} = {value.item():.6g}" for key, value in worst.coords.items() if value.dtype.kind in "fiu")
    return Difference(name, float(worst), where)


def _counts(name: str) -> bool:
    """Whether a variable says anything of its own; errors follow from the values of the realizations."""
    return not name.startswith((*NOT_CONTENT, *OWN)) and not name.endswith(ERROR)


def _parameters(first: xr.Dataset, second: xr.Dataset) -> list[str]:
    """Parameters of the scene that are attributes of both and differ."""
    pairs = {key: (plain(first.attrs.get(key)), plain(second.attrs.get(key))) for key in SCENE_KEYS}
    return [f"{key}: {a} in the first, {b} in the second" for key, (a, b) in pairs.items() if a != b]


def _only_in_one(first: xr.Dataset, second: xr.Dataset) -> list[str]:
    remarks = []
    for one, other, which in ((first, second, "first"), (second, first, "second")):
        alone = sorted(name for name in map(str, one.variables) if name not in other.variables and _counts(name))
        remarks += [f"only in the {which}: {', '.join(alone)}"] if alone else []
    for key in sorted({*first.indexes} & {*second.indexes} - {"realization"}):
        a, b = first.indexes[key], second.indexes[key]
        if len(common := a.intersection(b)) < max(len(a), len(b)):
            remarks.append(f"{key}: {len(a)} values in the first, {len(b)} in the second, {len(common)} in common")
    return remarks

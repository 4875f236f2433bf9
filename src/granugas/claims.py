"""What a paper claims, and whether it holds: verdicts are computed from datasets, never typed in.

A claim is one short function of the data under `@claim(...)`; its docstring says the claim in words. What it expects and
how far from that is still right, with the reason, stand in the decorator and are written before the data are looked at.
"""

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from granugas.measured import Data, NotMeasured, Numbers, in_words

SIGMAS = 3
"""So many standard errors count as no difference."""

HOLDS, FAILS, SLIP, NOT_MEASURED = "holds", "does not hold", "slip of the print", "not measured"
PAPERS = {"A": "Luding & McNamara 1998", "B": "Luding & Herrmann 1999", "C": "of one's own"}
"""By the letter with which the ids of their claims begin."""

COLUMNS = ("id", "claim", "verdict", "quantity", "expected", "measured", "error", "tolerance", "remark", "figure", "section")


@dataclass(frozen=True)
class Expected:
    """An interval, and how far outside of it is still right.

    Attributes:
        low: end of the interval, a number, or an array for several values at once.
        high: its other end, equal to the first for a value.
        rounding: half a unit of the last figure in print.
        absolute: tolerance in the unit of the ends.
        relative: tolerance as a part of them.
        corrected: what should have been printed, where we think that the print has a slip.
    """

    low: ArrayLike
    high: ArrayLike
    rounding: ArrayLike = 0.0
    absolute: float = 0.0
    relative: float = 0.0
    corrected: ArrayLike | None = None

    def __str__(self) -> str:
        low, high = np.asarray(self.low, float), np.asarray(self.high, float)
        if np.array_equal(low, high):
            text = in_words(low)
        elif np.isinf(high).all():
            text = f">= {in_words(low)}"
        elif np.isinf(low).all():
            text = f"<= {in_words(high)}"
        else:
            text = f"{in_words(low)} ... {in_words(high)}"
        return text if self.corrected is None else f"{text} in print, {in_words(self.corrected)} corrected"

    @property
    def tolerance(self) -> str:
        """In words."""
        parts = [f"{self.relative:.2g} of it".replace("0.", ".")] if self.relative else []
        parts += [f"{self.absolute:.3g}"] if self.absolute else []
        parts += ["rounding"] if np.any(self.rounding) else []
        return " + ".join([*parts, f"{SIGMAS} standard errors"])


def value(number: ArrayLike, **tolerances: Any) -> Expected:
    """A value (or several), with the tolerances and the correction of `Expected`."""
    return Expected(number, number, **tolerances)


def at_least(number: ArrayLike, **tolerances: Any) -> Expected:
    """A lower bound."""
    return Expected(number, np.inf, **tolerances)


def at_most(number: ArrayLike, **tolerances: Any) -> Expected:
    """An upper bound."""
    return Expected(-np.inf, number, **tolerances)


def between(low: ArrayLike, high: ArrayLike, **tolerances: Any) -> Expected:
    """A range, its ends included."""
    return Expected(low, high, **tolerances)


@dataclass(frozen=True)
class Claim:
    """One statement of a paper.

    Attributes:
        id: paper, section, number: A-6.1-03.
        text: the claim in our words.
        figure: name of the figure that shows it, or "".
        quantity: what is measured, with its unit.
        expected: what the paper says of it.
        why: reason of the bounds and tolerances.
        remark: where it does not hold, why we think so.
        measure: from the data to a value, or to (value, standard error); may raise NotMeasured.
    """

    id: str
    text: str
    figure: str
    quantity: str
    expected: Expected
    why: str
    remark: str
    measure: Callable[[Data], Any]

    @property
    def section(self) -> str:
        """Of the paper."""
        return self.id.split("-")[1]


def claim(
    id: str, *, quantity: str, expected: Expected, why: str, figure: str = "", remark: str = ""
) -> Callable[[Callable[[Data], Any]], Claim]:
    """Make a claim of a function that measures it; the function's docstring is the claim in words.

    Args:
        id: paper, section and number, like A-6.2-12.
        quantity, expected, why, figure, remark: as in `Claim`.

    Raises:
        ValueError: another id.
    """
    if not re.fullmatch(rf"[{''.join(PAPERS)}]-[\w.]+-\w+", id):
        raise ValueError(f"id = {id!r}: allowed is a letter ({', '.join(PAPERS)}), a section and a number, like A-6.2-12")

    def made(measure: Callable[[Data], Any]) -> Claim:
        text = " ".join((measure.__doc__ or "").split())
        return Claim(id, text, figure, quantity, expected, why, remark, measure)

    return made


def claims_in(names: Mapping[str, Any]) -> list[Claim]:
    """All claims of a module, from its `globals()`, in the order in which they stand there."""
    return [item for item in names.values() if isinstance(item, Claim)]


def verdict(expected: Expected, measured: ArrayLike, error: ArrayLike = 0.0) -> str:
    """Compare: holds / holds within ... / slip of the print / does not hold. Of several values the worst decides.

    It holds where the interval, with the rounding of the print, has the measured value; it holds within what is named
    where the standard errors (NaN: unknown, taken as 0) or the tolerance are needed. The print has a slip where it does not
    hold and the corrected value does, with the same tolerance.
    """
    measured, slack = np.asarray(measured, float), SIGMAS * np.nan_to_num(error)
    excess, scale = _excess(measured, expected.low, expected.high)
    rounding = np.asarray(expected.rounding) * (1 + 1e-9)
    tolerance = expected.absolute + expected.relative * scale
    if np.all(excess <= rounding):
        return HOLDS
    if np.all(excess <= rounding + slack):
        return f"{HOLDS} within {SIGMAS} standard errors"
    if np.all(excess <= rounding + slack + tolerance):
        if expected.relative:
            parts = np.divide(excess, scale, out=np.zeros_like(excess), where=scale > 0)
            return f"{HOLDS} within {100 * parts.max():.3g} %"
        return f"{HOLDS} within {np.max(excess):.2g}"
    if expected.corrected is not None:
        excess, scale = _excess(measured, expected.corrected, expected.corrected)
        if np.all(excess <= rounding + slack + expected.absolute + expected.relative * scale):
            return SLIP
    return FAILS


def judge(claims: Iterable[Claim], data: Data) -> pd.DataFrame:
    """One row a claim in the order of their ids, with the columns `COLUMNS`; what cannot be measured says why.

    Raises:
        ValueError: two claims of one id.
    """
    rows = [_row(one, data) for one in sorted(claims, key=lambda one: one.id)]
    ids = [row["id"] for row in rows]
    twice = sorted({name for name in ids if ids.count(name) > 1})
    if twice:
        raise ValueError(f"claims: these ids stand twice: {', '.join(twice)}")
    return pd.DataFrame(rows, columns=list(COLUMNS))


def page(table: pd.DataFrame) -> str:
    """The table as a Markdown page: the verdicts counted, what does not hold and why, then all claims by section."""
    kinds = table["verdict"].where(~table["verdict"].str.startswith(HOLDS + " within"), HOLDS + " within ...")
    paper = table["id"].str[0]
    lines = ["# Claims", "", f"| {len(table)} claims | " + " | ".join(PAPERS[name] for name in paper.unique()) + " |"]
    lines += ["|---" * (1 + paper.nunique()) + "|"]
    for kind, counts in pd.crosstab(kinds, paper).iterrows():
        lines.append(f"| {kind} | " + " | ".join(str(counts[name]) for name in paper.unique()) + " |")
    open_ones = table[kinds.isin([FAILS, SLIP])]
    if len(open_ones):
        lines += ["", "## What does not hold", ""]
        lines += [f"- **{row.id}** ({row.verdict}): {row.claim} {row.remark}" for row in open_ones.itertuples()]
    for (name, section), rows in table.groupby([paper, "section"], sort=False):
        lines += ["", f"## {PAPERS[str(name)]}, section {section}", ""]
        lines += ["| id | claim | quantity | expected | measured | verdict | figure |", "|---|---|---|---|---|---|---|"]
        for row in rows.itertuples():
            measured = f"{row.measured!s} ± {row.error!s}" if row.error else row.measured
            cells = [row.id, row.claim, row.quantity, row.expected, measured, row.verdict, row.figure]
            lines.append(f"| {' | '.join(str(cell).replace('|', chr(92) + '|') for cell in cells)} |")
        lines += ["", "Bounds and tolerances:", ""]
        lines += [f"- {row.id}: {row.tolerance}" for row in rows.itertuples()]
    missing = table[kinds == NOT_MEASURED]
    if len(missing):
        lines += ["", "## Not measured", "", *(f"- {row.id}: {row.remark}" for row in missing.itertuples())]
    return "\n".join(lines) + "\n"


def _row(one: Claim, data: Data) -> dict[str, str]:
    row = {
        "id": one.id,
        "section": one.section,
        "figure": one.figure,
        "claim": one.text,
        "quantity": one.quantity,
        "expected": str(one.expected),
        "measured": "",
        "error": "",
        "tolerance": f"{one.expected.tolerance}: {one.why}",
    }
    try:
        found = one.measure(data)
        measured, error = found if isinstance(found, tuple) else (found, 0.0)
        if np.isnan(measured).any():
            raise NotMeasured("no value: the runs ended before, or nothing was counted")
    except NotMeasured as reason:
        return row | {"verdict": NOT_MEASURED, "remark": str(reason)}
    said = verdict(one.expected, measured, error)
    remark = (one.remark or "Not explained yet.") if said in (FAILS, SLIP) else ""
    shown = in_words(error, 2) if np.any(np.nan_to_num(error) > 0) else ""
    return row | {"measured": in_words(measured), "error": shown, "verdict": said, "remark": remark}


def _excess(measured: Numbers, low: ArrayLike, high: ArrayLike) -> tuple[Numbers, Numbers]:
    """How far the values are outside of the intervals, and the size of the end that is nearest."""
    low, high = np.broadcast_arrays(np.asarray(low, float), np.asarray(high, float))
    excess = np.maximum(np.maximum(low - measured, measured - high), 0)
    ends = np.where(low - measured > measured - high, low, high)
    return excess, np.where(np.isfinite(ends), abs(ends), 0.0)

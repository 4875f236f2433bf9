"""The style of the figures: widths, colours, marks and numbers, and how they are saved.

Figures are made without pyplot: no window, no state between two of them.
"""

from collections.abc import Callable, Sequence
from functools import wraps
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib import style
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter
from PIL import Image

from granugas.analysis.statistics import PowerLaw
from granugas.storage.files import replacing

STYLE = Path(__file__).with_name("granugas.mplstyle")
COLUMN, PAGE = 3.4, 7.0
"""Widths of one column and of a page in inches."""

THEORY = {"color": "black", "linestyle": (0, (5, 2)), "linewidth": 1.0, "zorder": 3}
"""How a closed formula is drawn."""

MARKERS = "osD^v<>ph*"
"""In this order where colours alone tell points apart."""

SYMBOLS = {
    "n_particles": "$N$",
    "area_fraction": r"$\nu$",
    "restitution": "$r$",
    "contact_time": "$t_c$",
    "diameter": "$d$",
    "velocity_half_width": "$w$",
}
"""Of the keys of a scene."""

METADATA = {
    ".png": {"Software": None},
    ".pdf": {"CreationDate": None, "Creator": None, "Producer": None},
    ".svg": {"Date": None, "Creator": None},
}
"""Nothing in a picture file that changes with the day."""

Draw = Callable[[dict[str, xr.Dataset]], Figure]


def styled(draw: Draw) -> Draw:
    """The function `draw`, with granugas.mplstyle in force while it draws."""

    @wraps(draw)
    def drawn(data: dict[str, xr.Dataset]) -> Figure:
        with style.context(STYLE):
            return draw(data)

    return drawn


def save(figure: Figure, *paths: str | Path) -> None:
    """Write a figure to each path, its format by the ending, laid out once; equal figures give equal files."""
    for path in map(Path, paths):
        with style.context(STYLE), replacing(path) as temporary:
            figure.savefig(temporary, format=path.suffix[1:], metadata=METADATA.get(path.suffix))
            if path.suffix == ".png":
                _use_a_palette(temporary)
            figure.set_layout_engine("none")


def _use_a_palette(path: Path) -> None:
    """A picture in its 256 commonest colours, which nobody can tell from all of them: a third of the bytes."""
    with Image.open(path) as picture:
        few = picture.convert("RGB").quantize(256, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
        dpi = picture.info["dpi"]
    few.save(path, format="PNG", optimize=True, dpi=dpi)


def number_1_2_5(*panels: Axes) -> None:
    """Numbers at 1, 2 and 5 of each decade, for logarithmic panels of about one."""
    for axes in panels:
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
            axis.set_major_formatter(lambda value, _: number(value))
            axis.set_minor_formatter(NullFormatter())


def shades(n: int) -> list[tuple[float, ...]]:
    """n colours in order, from dark to light, that differ in brightness too."""
    return [tuple(colour) for colour in mpl.colormaps["viridis"](np.linspace(0, 0.88, n))]


def mark_panels(*panels: Axes) -> None:
    """(a), (b), ... in the upper left corners, outside."""
    for letter, axes in zip("abcdefgh", panels, strict=False):
        axes.set_title(f"({letter})", loc="left")


def power_of_ten(value: float) -> str:
    """A number as people write contact times: 10^-5, 5 x 10^-4, 0."""
    if value == 0:
        return "$0$"
    mantissa, exponent = f"{value:.3e}".split("e")
    factor = "" if float(mantissa) == 1 else rf"{float(mantissa):g}\times"
    return f"${factor}10^{{{int(exponent)}}}$"


def exponent(fit: PowerLaw) -> str:
    """An exponent with its interval, if it has one."""
    error = "" if np.isnan(fit.half_width) else rf" \pm {fit.half_width:.2f}"
    return f"${fit.exponent:.2f}{error}$"


def number(value: Any) -> str:
    """A value in a legend: a power of ten where it is small, a word as it is."""
    if isinstance(value, str):
        return value
    return power_of_ten(value) if 0 < value < 0.02 else f"${value:.10g}$"


def text_table(cells: Sequence[Sequence[str]], widths: Sequence[float], notes: Sequence[str] = ()) -> Figure:
    """A table as a picture, ruled as in a journal: a header, rows, and notes below in small letters.

    Args:
        cells: rows of texts, the header first; the first column begins at its left edge, the others are centred.
        widths: of the columns in inches.
        notes: lines.
    """
    line, right = 0.24, sum(widths)
    height = line * (len(cells) + 0.8 * len(notes) + 0.6)
    figure = Figure(figsize=(right, height), layout="none")  # type: ignore[arg-type]  # the stub knows it as a word of set_layout_engine only
    axes = figure.add_axes((0, 0, 1, 1), xlim=(0, right), ylim=(height, 0))
    axes.axis("off")
    edges = np.cumsum([0, *widths])
    for k, row in enumerate(cells):
        for column, text in enumerate(row):
            x = edges[column] + 0.05 if column == 0 else edges[column : column + 2].mean()
            axes.text(x, line * (k + 0.65), text, ha="left" if column == 0 else "center", va="center")
    for y, width in ((0.1, 1.0), (1.2, 0.6), (len(cells) + 0.2, 1.0)):
        axes.plot([0.02, right - 0.02], [line * y] * 2, color="black", linewidth=width)
    for k, text in enumerate(notes):
        axes.text(0.05, line * (len(cells) + 0.7 + 0.8 * k), text, va="center", fontsize="small")
    return figure

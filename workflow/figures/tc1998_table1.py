"""tc1998 Table 1 as a picture: the energies of a particle at rest in three models, with measured numbers."""

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.at_rest import energies_at_rest, shown
from granugas.plotting.style import power_of_ten, styled, text_table

STUDIES = ()
EXPERIMENTS = ("bouncing",)
SYMBOLS = {"": "", "E": "$E$", "E_k": "$E_k$", "E_el": r"$E_{\rm el}$", "E_e": "$E_e$", "E_p": "$E_p$", "f": "$f$"}


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """Symbol and number of each energy: real (spring and dashpot), IHS at t_s, TC over one period and longer windows."""
    ball = data["bouncing"]
    r, ratio, t_1, period = (
        float(shown(ball)[name]) for name in ("restitution", "contact_ratio", "first_period", "staying_period")
    )
    longer = [f"{window:g}" for window in ball["window"].values if window > 2]
    header = ["", "Real, at rest", "IHS, at $t_s$", r"TC, $\Delta t = t_\infty$"]
    header += [rf"TC, $\Delta t = {window}\,t_\infty$" for window in longer]
    rows = [_texts(row, longer) for _, row in energies_at_rest(ball).iterrows()]
    notes = [
        rf"Energies in units of $m (g t_c)^2$, force in units of $m g$; $r = {r:g}$, $t_c = {ratio:g}\,t_1$, "
        rf"period that stays $t_\infty = {period / (ratio * t_1):.3f}\,t_c$.",
        r"Ranges: windows $\Delta t$ that end at different phases of the period. $-$: the model has no such quantity;",
        r"$10^{-31}$ is the rounding of double precision. After $t_s$ the IHS model has no state that could be averaged.",
    ]
    return text_table([header, *rows], [1.35, 1.15, 1.15, 1.05, 1.3, 1.3], notes)


def _texts(row: pd.Series, longer: list[str]) -> list[str]:
    """A row of the picture."""
    names = {model: SYMBOLS[row[f"{model}_symbol"]] for model in ("real", "ihs", "tc")}
    single = [_with_symbol(names[model], _number(row[model])) for model in ("real", "ihs", "tc")]
    ranges = [_range(row[f"tc_{window}_low"], row[f"tc_{window}_high"]) for window in longer]
    return [row["quantity"], *single, *ranges]


def _with_symbol(symbol: str, number: str) -> str:
    return f"{symbol} $=$ {number}" if symbol else number


def _range(low: float, high: float) -> str:
    return _number(low) if np.isnan(low) or low == high else rf"{_number(low)} $\ldots$ {_number(high)}"


def _number(value: float) -> str:
    if np.isnan(value):
        return "$-$"
    return power_of_ten(float(f"{value:.0e}")) if 0 < value < 1e-9 else f"${value:.4f}$" if value else "$0$"

"""The energies of a particle at rest on a plate in three models (A table 1)."""

import numpy as np
import pandas as pd
import xarray as xr


def shown(bouncing: xr.Dataset) -> xr.Dataset:
    """The r and t_c / t_1 whose ball is drawn and compared with a soft one: the attributes of those names choose them."""
    return bouncing.sel({name: bouncing.attrs[name] for name in ("restitution", "contact_ratio")})


def energies_at_rest(bouncing: xr.Dataset) -> pd.DataFrame:
    """A table 1 with measured numbers: energies of one particle at rest on a plate in m (g t_c)^2, its force on it in m g.

    Args:
        bouncing: as `granugas.experiments.bouncing` measures it; taken is the ball that is `shown`.

    Returns:
        A row for each energy and one for the force. `*_symbol` is what a model calls it; empty, and NaN as its number,
        where the model has none. Numbers: `real`, linear spring and dashpot, heights from where it touches; `ihs`, kinetic
        energy after the last hit that double precision resolves and potential energy at the top of the flight that would
        follow, as there is no state from t_s on; `tc`, average over one period; `tc_<w>_low` and `tc_<w>_high`, range of the
        averages over w periods that end at different phases.
    """
    ball = shown(bouncing)
    unit = float(ball["gravity"] * ball["contact_ratio"] * ball["first_period"]) ** 2
    soft = {name: float(ball[f"soft_{name}"]) for name in ("kinetic_energy", "elastic_energy", "potential_energy", "force")}
    left = float(ball["speed_at_collapse"]) ** 2 / 2
    elastic = ball["elastic_square_velocity"] / 2
    free = ball["mean_square_velocity"] / 2 - elastic
    potential = ball["gravity"] * ball["mean_height"]
    none = xr.full_like(elastic, np.nan)
    rows = [
        ("(free) kinetic energy", ("E", "E", "E_k"), soft["kinetic_energy"] / unit, left / unit, free / unit),
        ("contact energy", ("E_el", "", ""), soft["elastic_energy"] / unit, np.nan, none),
        ("elastic, kinetic energy", ("", "", "E_e"), np.nan, np.nan, elastic / unit),
        ("potential energy", ("E_p", "E_p", "E_p"), soft["potential_energy"] / unit, left / unit, potential / unit),
        ("force on the plate", ("f", "", "f"), soft["force"], np.nan, ball["plate_force"]),
    ]
    return pd.DataFrame([_row(*row) for row in rows])


def _row(quantity: str, symbols: tuple[str, str, str], real: float, ihs: float, tc: xr.DataArray) -> dict[str, str | float]:
    """One row of the table; `tc` over `window` and `window_end`."""
    period, *longer = tc.transpose("window", ...)
    row = {"quantity": quantity} | dict(zip(("real_symbol", "ihs_symbol", "tc_symbol"), symbols, strict=True))
    row |= {"real": real, "ihs": ihs, "tc": float(period.mean())}
    for average in longer:
        name = f"tc_{float(average['window']):g}"
        row |= {f"{name}_low": float(average.min()), f"{name}_high": float(average.max())}
    return row

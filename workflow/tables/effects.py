"""Each effect and model: what it conserves, a number against theory, what it costs, how long it is."""

import numpy as np
import pandas as pd
import xarray as xr

SECTION = "Effects"
STUDIES = ()
EXPERIMENTS = ("effects", "effects_cost")


def table(data: dict[str, xr.Dataset]) -> pd.DataFrame:
    """One row an effect; cost is the median of a collision by one of elastic disks, empty without a kernel of its own."""
    found, timed = data["effects"], data["effects_cost"]
    cost = timed["cpu_per_collision"]
    relative = (cost / (cost - timed["cpu_added"])).median("repetition")
    names = ("scene_keys", "momentum_drift", "energy_balance", "check", "measured", "expected", "allowed")
    rows = found[list(names)].to_dataframe().reset_index()
    rows["agrees"] = np.where(abs(rows["measured"] - rows["expected"]) <= rows["allowed"], "yes", "no")
    numbers = rows.select_dtypes(float).columns
    rows[numbers] = rows[numbers].map(lambda value: float(f"{value:.6g}"))
    for n in timed["n_particles"].values:
        rows[f"relative_cost_n{n}"] = rows["effect"].map(relative.sel(n_particles=n).to_series()).round(3)
    return rows.assign(code_lines=found["code_lines"].values)

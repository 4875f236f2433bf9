"""tc1998 Table 1: the energies of a particle at rest in three models, with measured numbers."""

import pandas as pd
import xarray as xr

from granugas.analysis.at_rest import energies_at_rest

STUDIES = ()
EXPERIMENTS = ("bouncing",)


def table(data: dict[str, xr.Dataset]) -> pd.DataFrame:
    """One particle on a plate: energies in m (g t_c)^2, force in m g."""
    return energies_at_rest(data["bouncing"])

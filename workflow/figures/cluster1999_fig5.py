"""cluster1999 Fig. 5: two snapshots of the large system, coloured by the collision frequency of each particle."""

import xarray as xr
from matplotlib.figure import Figure

from granugas.plotting.snapshots import by_frequency, draw_snapshots, frequency_or_contact
from granugas.plotting.style import styled

STUDIES = ("cluster1999_large",)
TIMES = (40.96, 446.6)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """Disks coloured by their collision frequency; red those whose last two collisions were less than t_c apart."""
    study = data[STUDIES[0]]

    def values(shot: xr.Dataset):
        contact = shot["last_collision_interval"] < float(shot["contact_time"])
        return frequency_or_contact(shot["collision_frequency"].values, contact.values)

    return draw_snapshots(study, TIMES, by_frequency(), values)

"""cluster1999 Fig. 4: four snapshots of the large system, coloured by energy."""

import xarray as xr
from matplotlib.figure import Figure

from granugas.plotting.snapshots import by_energy, draw_snapshots, relative_energy
from granugas.plotting.style import styled

STUDIES = ("cluster1999_large",)
TIMES = (0.64, 2.56, 40.96, 446.6)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """Disks coloured by their energy in the frame of the centre of mass, by the mean at each time."""
    return draw_snapshots(data[STUDIES[0]], TIMES, by_energy(), lambda shot: relative_energy(shot["velocity"].values))

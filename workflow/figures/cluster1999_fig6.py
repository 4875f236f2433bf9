"""cluster1999 Fig. 6: two snapshots of the large system, coloured by the height at which each particle began."""

import xarray as xr
from matplotlib.figure import Figure

from granugas.plotting.snapshots import by_height, draw_snapshots
from granugas.plotting.style import styled

STUDIES = ("cluster1999_large",)
TIMES = (40.96, 446.6)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """Disks coloured by their height at t = 0, by the height of the box."""
    return draw_snapshots(data[STUDIES[0]], TIMES, by_height(), lambda shot: (shot["initial_y"] / shot["box_y"]).values)

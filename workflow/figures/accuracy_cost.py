"""What accuracy costs in time: relative error against processor time for every knob, on the same axes."""

import xarray as xr
from matplotlib.figure import Figure

from granugas.plotting.accuracy import (
    accuracy_figure,
    arithmetic,
    contact_time,
    equilibration,
    exponents,
    methods,
    realizations,
    sampling,
    sizes,
)
from granugas.plotting.style import styled

SECTION = "Accuracy"
STUDIES = ("methods_events", "methods_soft_spheres", "methods_dsmc")
EXPERIMENTS = ("accuracy_contact_time", "accuracy_sizes", "accuracy_sampling", "accuracy_equilibration", "accuracy_arithmetic")
METHODS = {"soft_spheres": "soft spheres, steps in $t_c$", "dsmc": "DSMC"}
SECONDS, ERROR = (5e-4, 2e2), (1e-4, 20.0)
"""The axes of all panels."""


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """A panel a knob."""
    panels = {
        "contact duration $t_c$ (s)": contact_time(data["accuracy_contact_time"]),
        "sampling": sampling(data["accuracy_sampling"]),
        "collisions of a particle before the start": equilibration(data["accuracy_equilibration"]),
        "arithmetic": arithmetic(data["accuracy_arithmetic"]),
        "method, $K$": methods(data["methods_events"], {words: data[f"methods_{name}"] for name, words in METHODS.items()}),
        "number of disks $N$": sizes(data["accuracy_sizes"]),
        "realizations, $K$": realizations(data["accuracy_sizes"], SECONDS[1]),
        r"exponent of $\langle M \rangle$": exponents(data["accuracy_sizes"], SECONDS[1]),
    }
    return accuracy_figure(panels, SECONDS, ERROR)

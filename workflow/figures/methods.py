"""One scene by three methods from the same start states: where soft spheres and DSMC agree with events, and where not."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.structure import pair_correlation
from granugas.plotting.runs import band
from granugas.plotting.style import PAGE, mark_panels, styled

SECTION = "Accuracy"
STUDIES = ("methods_events", "methods_soft_spheres", "methods_dsmc")
NAMES = ("events", "soft spheres", "DSMC")
SERIES = {
    "kinetic_energy": "$K$",
    "collision_rate": "$C_r$ (1/s)",
    "elastic_collision_fraction": "$c_e$",
    "mean_cluster_size": r"$\langle M \rangle$",
}
SPEEDS, DISTANCES = np.linspace(-4, 4, 33), np.linspace(0.9, 4.0, 32)


def of_snapshots(runs: xr.Dataset, bins: np.ndarray, what: str) -> tuple[np.ndarray, np.ndarray]:
    """Middles of bins, and mean over realizations of what there is in each at the last snapshot."""
    found, last = [], runs.isel(snapshot=-1)
    for k in range(runs.sizes["realization"]):
        one = last.isel(realization=k)
        if what == "velocity":
            v = one["velocity"].values
            found.append(np.histogram((v / np.sqrt(np.mean(v**2))).ravel(), bins, density=True)[0])
        else:
            sides = np.array([float(one["box_x"]), float(one["box_y"])]) / runs.attrs["diameter"]
            found.append(pair_correlation(one["position"].values / runs.attrs["diameter"], sides, bins))
    return (bins[1:] + bins[:-1]) / 2, np.mean(found, axis=0)


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """(a) K, (b) rate, (c) share of elastic collisions, (d) <M>; at the end (e) velocities, (f) pairs."""
    figure = Figure(figsize=(PAGE, 6.6))
    panels = figure.subplots(3, 2).ravel()
    for k, (study, name) in enumerate(zip(STUDIES, NAMES, strict=True)):
        runs = data[study]
        if "steps_per_contact" in runs.dims:
            runs = runs.isel(steps_per_contact=-1)
        runs = runs.squeeze([dim for dim in runs.dims if runs.sizes[dim] == 1 and dim != "realization"], drop=True)
        for axes, key in zip(panels, SERIES, strict=False):
            band(axes, runs["time"][1:], runs[key].isel(time=slice(1, None)), color=f"C{k}", label=name)
        for axes, bins, what in ((panels[4], SPEEDS, "velocity"), (panels[5], DISTANCES, "position")):
            axes.plot(*of_snapshots(runs, bins, what), color=f"C{k}", label=name)
    for axes, label, scale in zip(panels, SERIES.values(), ("log", "log", "linear", "linear"), strict=False):
        axes.set(xscale="log", yscale=scale, xlabel="$t$ (s)", ylabel=label)
    panels[4].set(yscale="log", xlabel=r"$v_x / \sqrt{\langle v_x^2 \rangle}$", ylabel="probability density")
    panels[5].set(xlabel="$r / d$", ylabel="$g(r)$", ylim=(0, None))
    panels[0].legend()
    mark_panels(*panels)
    return figure

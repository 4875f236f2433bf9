"""The edge of the inelastic collapse (A section 2.1): r_c against N, by Eq. 22, and how the rate of collisions diverges."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from granugas.analysis.theory import collapse_restitution
from granugas.analysis.threshold import collapse_threshold, collapsed_within, rate_on_approach
from granugas.plotting.style import MARKERS, PAGE, THEORY, mark_panels, power_of_ten, shades, styled

SECTION = "Hard cases"
STUDIES = ("collapse_n42", "collapse_n378", "collapse_n1435", "collapse_n5740", "collapse_n22960")
EXPERIMENTS = ("approach",)
WITHIN = (100, 200, 500)
"""Collisions per particle within which a run has to collapse; (a) is for the middle one."""

CONTACT_TIME = 1e-5  # of the papers, in s: where the TC model ends the divergence


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """(a) Share of runs that collapse, (b) r_c and Eq. 22 against N, (c) rate of the disks that collapse against t* - t."""
    panels = share, edge, rate = (figure := Figure(figsize=(PAGE, 2.9))).subplots(1, 3)
    share.set(xlabel="$r$   (filled: Eq. (22))", ylabel="share of runs that collapse", xlim=(0.1, 1.15))
    edge.set(xscale="log", yscale="log", xlabel="$N$", ylabel="$1 - r_c$")
    edge.set_yticks([0.05, 0.1, 0.2, 0.5], ["0.05", "0.1", "0.2", "0.5"])
    edge.yaxis.set_minor_formatter("")
    found = []
    for name, colour, marker in zip(STUDIES, shades(len(STUDIES)), MARKERS, strict=False):
        gas = data[name][["events", "stop_reason"]]
        gas = gas.isel({key: 0 for key in gas["events"].dims if key not in ("restitution", "realization")})
        r, n, nu = gas["restitution"].values, int(gas["n_particles"]), float(gas["area_fraction"])
        for limit in WITHIN:
            collapsed = collapsed_within(gas, limit).transpose("realization", "restitution").values
            found.append((limit, n, *(1 - np.array(collapse_threshold(r, collapsed)))))
            if limit == WITHIN[1]:
                look = {"color": colour, "marker": marker, "linewidth": 0.8}
                share.plot(r, collapsed.mean(axis=0), label=f"${n}$", markerfacecolor="none", **look)
                share.plot(collapse_restitution(n, nu), 0.5, **look, markersize=5)
    share.set_xticks([0.2, 0.4, 0.6, 0.8, 1.0])
    share.legend(title="$N$", loc="upper right")
    sizes = np.geomspace(min(row[1] for row in found) / 1.3, max(row[1] for row in found) * 1.3)
    edge.plot(sizes, 1 - collapse_restitution(sizes, nu), **THEORY, label="Eq. (22)")
    for limit, colour, marker in zip(WITHIN, ("C5", "C0", "C1"), MARKERS, strict=False):
        n, value, low, high = np.transpose([row[1:] for row in found if row[0] == limit])
        look = {"color": colour, "marker": marker, "linewidth": 0.8, "capsize": 1.5, "label": f"within $C/N = {limit}$"}
        edge.errorbar(n, value, [value - high, low - value], **look)
    edge.legend()
    approach = data["approach"].transpose("restitution", "realization", "collisions_left")
    rate.set(xscale="log", yscale="log", xlabel="$(t^* - t)/t_E$", ylabel=r"collision rate $\times\, t_E$")
    t_e, decades = 1 / float(approach["enskog_rate"]), 10.0 ** np.arange(-14, 2)
    for r, colour in zip(approach["restitution"].values, shades(approach.sizes["restitution"]), strict=True):
        of_r = approach.sel(restitution=r)
        for left, disks, label in zip(of_r["time_left"], of_r["disks_involved"], [f"$r = {r:g}$", *[None] * 99], strict=False):
            per_disk, middle = 2 * rate_on_approach(left / t_e, decades) / float(disks), np.sqrt(decades[1:] * decades[:-1])
            rate.plot(middle, np.where(per_disk > 0, per_disk, np.nan), color=colour, linewidth=0.7, label=label)
    rate.axvline(CONTACT_TIME / t_e, **THEORY | {"color": "0.5"}, label=f"$t_c = {power_of_ten(CONTACT_TIME)[1:]} s")
    rate.legend()
    mark_panels(*panels)
    return figure

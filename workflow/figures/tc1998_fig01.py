"""tc1998 Fig. 1: two soft and two hard particles that collide, and the time t_c in which dissipation is affected."""

import xarray as xr
from matplotlib.figure import Figure

from granugas.plotting.style import COLUMN, mark_panels, styled

STUDIES = ()
EXPERIMENTS = ("contact",)
LINES = {
    "beginning": {"linestyle": (0, (5, 2)), "color": "0.5", "linewidth": 1.4},
    "end": {"linestyle": (0, (1, 1.5)), "color": "black", "linewidth": 1.1},
}


@styled
def draw(data: dict[str, xr.Dataset]) -> Figure:
    """Centres and extents of the particles against time; beginning dashed, end dotted, t_c shaded."""
    contact = data["contact"]
    begin, end, hit = (float(contact[name]) for name in ("contact_begin", "contact_end", "collision_time"))
    t_c, d = contact.attrs["contact_time"], contact.attrs["diameter"]
    figure = Figure(figsize=(1.5 * COLUMN, 2.9))
    panels = figure.subplots(1, 2, sharey=True)
    spans = {"soft": (begin, end, (begin, end)), "hard": (hit, hit, (hit, hit + t_c))}
    for axes, (kind, (first, last, shade)) in zip(panels, spans.items(), strict=True):
        time = (contact["experiment_time"] - first) / t_c
        axes.axvspan(*((t - first) / t_c for t in shade), color="0.88", label="$t_c$")
        for instant, (name, look) in zip((first, last), LINES.items(), strict=True):
            axes.axvline((instant - first) / t_c, label=name, **look)
        for k, colour in enumerate(("C0", "C1")):
            x = contact[f"{kind}_position"].isel(particle=k) / d
            axes.plot(time, x, color=colour, label=f"particle {k + 1}")
            axes.fill_between(time, x - 0.5, x + 0.5, color=colour, alpha=0.25, linewidth=0)
        axes.set(xlim=(time[0], 2.5), ylim=(-1.6, 1.6), xlabel="$(t - t_0) / t_c$", title=f"{kind} particles")
    panels[0].set_ylabel("$x / d$")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=5)
    mark_panels(*panels)
    return figure

"""Snapshots of disks, and what their colours say (B Figs. 4 to 6): blue is little, green the middle, red much."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import EllipseCollection
from matplotlib.colorbar import Colorbar
from matplotlib.colors import LinearSegmentedColormap, LogNorm, Normalize
from matplotlib.figure import Figure
from numpy.typing import NDArray

from granugas.plotting.runs import grid_points, times
from granugas.plotting.style import PAGE

Numbers = NDArray[np.float64]

COLOURS = ("#2166d1", "#1fa0b4", "#27a544", "#e3a313", "#d7191c")
"""From blue to red."""

LEVELS = 9
"""Of colours, the middle one green. So few make the files small, and a picture of 80 000 disks shows no more."""

ENERGIES = (0.15, 1 / 0.15)
"""Energies of the blue and of the red end, by their mean, which is green: in equilibrium, 14 % are below and .13 % above."""

FREQUENCIES = (0.3, 300.0)
"""Collision frequencies of the blue and of the green end in 1/s."""


@dataclass(frozen=True)
class Colouring:
    """A scale of colours, and the text of its bar."""

    scale: ScalarMappable
    label: str
    extend: str = "neither"
    ticks: Sequence[float] | None = None

    def __call__(self, values: Numbers) -> Numbers:
        """(n, 4) colours of values (n,); infinite ones are above the scale."""
        return self.scale.to_rgba(np.minimum(values, 1e99))  # to matplotlib, infinite is no number

    def bar(self, figure: Figure, **place: Any) -> Colorbar:
        """The bar in a figure, at a place as in `Figure.colorbar`."""
        bar = figure.colorbar(self.scale, extend=self.extend, label=self.label, **place)
        if self.ticks:
            bar.set_ticks(self.ticks, labels=[f"{tick:g}" for tick in self.ticks], minor=False)
            bar.minorticks_off()
        return bar


def draw_disks(
    axes: Axes,
    position: NDArray[np.float64],
    box: Sequence[float],
    diameter: float | NDArray[np.float64],
    colour: NDArray[np.float64],
    walled: Sequence[bool] = (False, False),
) -> None:
    """Disks to scale in their box, in units of their mean diameter, as a picture of dots in every format.

    Args:
        axes: without ticks afterwards.
        position: (n, 2) in m.
        box: sides in m.
        diameter: in m, of all or (n,).
        colour: (n, 4).
        walled: for each axis, whether the box ends there in walls; it is periodic elsewhere.
    """
    unit = float(np.mean(diameter))
    sides, width = np.asarray(box) / unit, np.broadcast_to(np.asarray(diameter) / unit, len(position))
    shifts = product(*[(0,) if wall else (-1, 0, 1) for wall in walled])
    images = [(position / unit + np.array(shift) * sides, colour, width) for shift in shifts]
    place, colour, width = (np.concatenate(parts) for parts in zip(*images, strict=True))
    reach = width[:, np.newaxis] / 2
    seen = ((place > -reach) & (place < sides + reach)).all(axis=1)
    diameters = width[seen]
    axes.add_collection(
        EllipseCollection(
            diameters,
            diameters,
            np.zeros_like(diameters),
            units="xy",
            offsets=place[seen],
            offset_transform=axes.transData,
            facecolors=colour[seen],
            linewidths=0,
            snap=True,  # on whole dots: crisp, and a third of the bytes
            rasterized=True,
        )
    )
    axes.set(xlim=(0, sides[0]), ylim=(0, sides[1]), aspect="equal", xticks=[], yticks=[])


def by_energy() -> Colouring:
    """Of `relative_energy`: logarithmic about the mean."""
    scale = ScalarMappable(LogNorm(*ENERGIES), _colours(COLOURS))
    return Colouring(scale, r"energy by its mean, $e_i / \langle e \rangle$", "both", (0.2, 0.5, 1, 2, 5))


def by_frequency() -> Colouring:
    """Of `frequency_or_contact`: logarithmic from blue to green, and red for particles in contact."""
    colours = _colours(COLOURS[:3]).with_extremes(over=COLOURS[-1])
    label = r"collision frequency (s$^{-1}$); red: time between collisions $< t_c$"
    return Colouring(ScalarMappable(LogNorm(*FREQUENCIES), colours), label, "max")


def by_height() -> Colouring:
    """Of the height at t = 0 by that of the box."""
    return Colouring(ScalarMappable(Normalize(0, 1), _colours(COLOURS)), "initial height, $y_i(0) / l$")


def _colours(ends: Sequence[str]) -> LinearSegmentedColormap:
    return LinearSegmentedColormap.from_list("blue_to_red", ends, N=LEVELS)


def relative_energy(velocity: Numbers) -> Numbers:
    """(n,) kinetic energy of each particle by the mean, from velocities (n, dim) in the frame of the centre of mass."""
    energy = np.einsum("ia,ia->i", velocity, velocity)
    return energy / energy.mean()


def frequency_or_contact(frequency: Numbers, contact: NDArray[np.bool_]) -> Numbers:
    """(n,) collision frequency in 1/s within the scale, infinite for particles in contact.

    Args:
        frequency: (n,) in 1/s.
        contact: (n,) whose time between collisions is below t_c.
    """
    return np.where(contact, np.inf, np.clip(frequency, *FREQUENCIES))


def draw_snapshots(
    data: xr.Dataset, wanted: Sequence[float], colouring: Colouring, values: Callable[[xr.Dataset], Numbers]
) -> Figure:
    """Snapshots of the first realization, two in a row, with t and C/N above each and one bar of colours.

    Args:
        data: a study with one point.
        wanted: times in s, ascending; where none of them is there, the last snapshots are drawn, as many.
        colouring: what the colours say.
        values: what it is about, (n,) of one snapshot; infinite ones get a ring.
    """
    ((key, runs),) = grid_points(data)
    run = runs.isel(realization=0)
    there = run["snapshot"].values
    chosen = [t for t in wanted if t in there] or list(there[-len(wanted) :])
    rows = -(-len(chosen) // 2)
    figure = Figure(figsize=(PAGE, 0.5 + 3.3 * rows))
    for place, time in enumerate(chosen, start=1):
        particles = run.sel(snapshot=time)
        axes = figure.add_subplot(rows, min(2, len(chosen)), place)
        box = float(particles["box_x"]), float(particles["box_y"])
        shown = values(particles)
        top = np.argsort(shown, kind="stable")  # the largest values are seen where disks touch
        position = particles["position"].values
        draw_disks(axes, position[top], box, key["diameter"], colouring(shown[top]))
        axes.collections[0].set_antialiased(False)  # half the bytes
        marked = position[np.isinf(shown)] / key["diameter"]
        axes.scatter(marked[:, 0], marked[:, 1], s=20, facecolors="none", edgecolors=COLOURS[-1], linewidths=0.6)
        count = np.interp(time, times(run), run["collisions_per_particle"])
        axes.set_title(f"$t = {time:g}$ s, $C/N = {count:.{0 if count > 10 else 1}f}$")
    colouring.bar(figure, ax=figure.axes, location="bottom", shrink=0.5, aspect=40, pad=0.02)
    return figure

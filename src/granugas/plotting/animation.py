"""A run as a film: the disks at its sampling times in the colours of B Figs. 4 to 6, over a clock."""

from collections.abc import Iterator
from contextlib import closing
from itertools import product
from pathlib import Path

import imageio_ffmpeg
import numpy as np
import xarray as xr
from matplotlib import style
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray

from granugas.plotting.snapshots import Colouring, by_energy, by_frequency, by_height, frequency_or_contact, relative_energy
from granugas.plotting.style import STYLE, power_of_ten
from granugas.storage.files import replacing

Numbers = NDArray[np.float64]
Picture = NDArray[np.uint8]

COLOURINGS = {"energy": by_energy, "collision_frequency": by_frequency, "initial_height": by_height}

SIDE, STRIP = 800, 96
"""Dots of the longer side of the box, and of the height of the strip below it."""

RATE = 20
"""Frames a second."""

LIMIT = 7.5e6
"""Bytes that a film may have, about."""

ENCODER = ["-preset", "fast", "-crf", "20", "-threads", "1", "-movflags", "+faststart", "-f", "mp4"]
"""One thread: equal frames give equal files."""


def render(run: xr.Dataset, path: str | Path, colour: str = "energy") -> None:
    """Write a film (H.264, mp4) of a run, one frame a sample, whole or not at all.

    Samples at equal steps of ln t give a film in logarithmic time.

    Args:
        run: with `trajectory` (time, particle, axis) in m, the coordinate `time` in s and the attributes box_x, box_y,
            diameter (m), n_particles, restitution and contact_time (s), opened lazily: one time is in memory at once.
            For "energy" also `trajectory_velocity` (time, particle, axis) in m/s, for "collision_frequency"
            `trajectory_collisions` (time, particle) since t = 0. A run that ended early makes a shorter film.
        path: ends by .mp4.
        colour: "energy" by its mean at each time (B Fig. 4); "collision_frequency" since the frame before, red where the
            mean time between these collisions is below t_c (B Fig. 5); "initial_height" (B Fig. 6).

    Raises:
        ValueError: no such colouring.
        KeyError: a variable that the colouring needs is missing.
        OSError: the film cannot be written.
    """
    if colour not in COLOURINGS:
        raise ValueError(f"colour = {colour!r}: allowed are {', '.join(COLOURINGS)}")
    box = np.array([run.attrs["box_x"], run.attrs["box_y"]])
    dots = 2 * np.rint(SIDE / 2 * box / box.max()).astype(int)  # even, as the encoder needs them
    size = int(dots[0]), int(dots[1]) + STRIP
    times = run["sampling_time" if "sampling_time" in run else "time"].values
    most = LIMIT * 8 * RATE / len(times) / 1000  # kbit/s
    limits = ["-maxrate", f"{0.9 * most:.0f}k", "-bufsize", f"{most:.0f}k"]
    encoded = {"fps": RATE, "codec": "libx264", "quality": None, "macro_block_size": 2, "output_params": [*ENCODER, *limits]}
    with style.context(STYLE), replacing(path) as temporary:
        sent = 0
        with closing(imageio_ffmpeg.write_frames(str(temporary), size, **encoded)) as film:
            film.send(None)
            colouring = COLOURINGS[colour]()
            frames = zip(_positions(run), _values(run, times, colour), _strips(run, times, colouring, size[0]), strict=False)
            for positions, values, strip in frames:
                picture = splat(positions, box, run.attrs["diameter"], colouring(values)[:, :3], dots)
                film.send(np.vstack([picture, strip]))
                sent += 1
        if imageio_ffmpeg.count_frames_and_secs(str(temporary))[0] != sent:  # an encoder that fails at its end says nothing
            raise OSError("the encoder stopped before its end")


def splat(positions: Numbers, box: Numbers, diameter: float, colours: Numbers, dots: NDArray[np.int64]) -> Picture:
    """(dots[1], dots[0], 3) picture of disks to scale in their periodic box, on white, the y axis upwards.

    A dot shows the mean of 2 x 2 points, each of which is inside of a disk or not.

    Args:
        positions: (n, 2) in m.
        box: (2,) sides in m.
        diameter: in m.
        colours: (n, 3) red, green and blue from 0 to 1.
        dots: (2,) along x and y.
    """
    points = 2 * dots
    centre = positions / box * points
    radius = diameter / 2 / box[0] * points[0]
    reach = np.arange(-int(radius) - 1, int(radius) + 2)[:, np.newaxis]
    near = np.floor(centre).astype(int) + reach[..., np.newaxis]  # (steps, n, 2)
    apart_x, apart_y = np.moveaxis(np.square(near + 0.5 - centre), -1, 0)
    column, row = np.moveaxis(near % points // 2, -1, 0)
    row = (dots[1] - 1 - row) * dots[0]
    hits, owners = [], []
    for i, j in product(range(len(reach)), repeat=2):
        inside = np.flatnonzero(apart_x[i] + apart_y[j] < radius**2)
        hits.append(column[i, inside] + row[j, inside])
        owners.append(inside)
    hit, owner = np.concatenate(hits), np.concatenate(owners)
    covered = np.bincount(hit, minlength=dots.prod())
    seen = np.flatnonzero(covered)
    picture = np.full((dots.prod(), 3), 255, np.uint8)
    for channel, part in zip(picture.T, colours.T, strict=True):
        painted = np.bincount(hit, part[owner])[seen] + np.maximum(4 - covered[seen], 0)
        channel[seen] = np.rint(255 * painted / np.maximum(covered[seen], 4))
    return picture.reshape(dots[1], dots[0], 3)


def _positions(run: xr.Dataset) -> Iterator[Numbers]:
    """Frame after frame in m, until the run has ended."""
    for frame in run["trajectory"]:
        positions = frame.values
        if np.isnan(positions).any():
            return
        yield positions


def _values(run: xr.Dataset, times: Numbers, colour: str) -> Iterator[Numbers]:
    """What the colours are about, (n,) for each frame."""
    if colour == "energy":
        yield from (relative_energy(frame.values) for frame in run["trajectory_velocity"])
    elif colour == "initial_height":
        height = run["trajectory"][0].sel(axis="y").values / run.attrs["box_y"]
        yield from (height for _ in times)
    else:
        before, begun = run["trajectory_collisions"][0].values, times[0]
        yield frequency_or_contact(np.zeros(before.shape), np.zeros(before.shape, bool))
        for frame, time in zip(run["trajectory_collisions"][1:], times[1:], strict=True):
            counts = frame.values
            rates = (counts - before) / (time - begun)
            yield frequency_or_contact(rates, rates * run.attrs["contact_time"] > 1)
            before, begun = counts, time


def _strips(run: xr.Dataset, times: Numbers, colouring: Colouring, width: int) -> Iterator[Picture]:
    """(STRIP, width, 3) picture of the clock, the scene and the colours for each frame."""
    figure = Figure(figsize=(width / 100, STRIP / 100), dpi=100, layout="none")  # type: ignore[arg-type]  # the stub knows it as a word of set_layout_engine only
    canvas = FigureCanvasAgg(figure)
    scene = f"$N = {run.attrs['n_particles']}$, $r = {run.attrs['restitution']:g}$, "
    scene += f"$t_c = $ {power_of_ten(run.attrs['contact_time'])} s"
    figure.text(0.33, 0.72, scene, fontsize=11)
    colouring.bar(figure, cax=figure.add_axes((0.62, 0.66, 0.35, 0.2)), orientation="horizontal")
    line = figure.add_axes((0.03, 0.4, 0.52, 0.16), xscale="log", yticks=[])
    line.set_xlim(times[times > 0].min(), np.nanmax(times))
    done = line.axvspan(*line.get_xlim(), color="0.7", animated=True)
    clock = figure.text(0.03, 0.72, "", fontsize=15, animated=True)
    canvas.draw()
    blank = canvas.copy_from_bbox(figure.bbox)
    for time in times:
        canvas.restore_region(blank)
        done.set_width(max(time - done.get_x(), 0))
        clock.set_text(f"$t = {time:.{_decimals(time)}f}$ s")
        line.draw_artist(done)
        figure.draw_artist(clock)
        yield np.asarray(canvas.buffer_rgba())[..., :3]


def _decimals(time: float) -> int:
    """Of a time in s, so that three figures are seen."""
    return int(np.clip(2 - np.floor(np.log10(time)), 0, 4)) if time > 0 else 4

"""What the colours of disks say, and snapshots in panels."""

import numpy as np
import pytest
import xarray as xr
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from granugas.plotting.snapshots import (
    COLOURS,
    FREQUENCIES,
    by_energy,
    by_frequency,
    by_height,
    draw_disks,
    draw_snapshots,
    frequency_or_contact,
    relative_energy,
)

BLUE, GREEN, RED = (to_rgb(COLOURS[k]) for k in (0, 2, 4))


def shown(colouring, values):
    return colouring(np.asarray(values))[:, :3]


def test_energies_are_relative_to_their_mean():
    np.testing.assert_allclose(
        relative_energy(np.array([[1.0, 0.0], [0.0, -1.0], [1.0, 2.0], [0.0, 0.0]])), [4 / 7, 4 / 7, 20 / 7, 0]
    )


def test_colours_of_energies():
    """As in print: the least blue, the mean green, the largest red; equal factors are equal steps."""
    np.testing.assert_allclose(shown(by_energy(), [1e-5, 1.0, 50.0]), [BLUE, GREEN, RED], atol=0.01)
    few = np.unique(shown(by_energy(), np.geomspace(1e-3, 1e3, 5000)), axis=0)
    assert len(few) == 9
    below, above = (
        len(np.unique(shown(by_energy(), values), axis=0)) for values in (np.geomspace(0.16, 0.99), np.geomspace(1.01, 6))
    )
    assert below == above == 5


def test_colours_of_frequencies():
    """Blue to green, and red for contacts alone, however large a frequency is."""
    values = frequency_or_contact(np.array([0.0, 0.1, 1e9, 5.0]), np.array([False, False, False, True]))
    np.testing.assert_allclose(values, [FREQUENCIES[0], FREQUENCIES[0], FREQUENCIES[1], np.inf])
    np.testing.assert_allclose(shown(by_frequency(), values), [BLUE, BLUE, GREEN, RED], atol=0.01)


def test_colours_of_heights():
    np.testing.assert_allclose(shown(by_height(), [0.0, 0.5, 1.0]), [BLUE, GREEN, RED], atol=0.01)


@pytest.fixture
def study():
    rng, n = np.random.default_rng(1), 20
    over = ("n_particles", "realization", "snapshot", "particle")
    data = xr.Dataset(
        {
            "kinetic_energy": (("n_particles", "realization", "time"), np.ones((1, 2, 3))),
            "collisions_per_particle": (("n_particles", "realization", "time"), [[[0.0, 10.0, 30.0], [0.0, 0.0, 0.0]]]),
            "position": ((*over, "axis"), rng.random((1, 2, 3, n, 2))),
            "height": (over, rng.random((1, 2, 3, n))),
            "box_x": (over[:2], [[1.0, 1.0]]),
            "box_y": (over[:2], [[1.0, 1.0]]),
        },
        {"n_particles": [n], "realization": [0, 1], "time": [0.0, 1.0, 2.0], "snapshot": [0.5, 1.0, 1.5]},
        {"diameter": 0.02},
    )
    return data


def heights(shot):
    return np.where(np.arange(20) == 7, np.inf, shot["height"].values)


@pytest.mark.parametrize(
    ("wanted", "titles"),
    [
        ((0.5, 1.5), ["$t = 0.5$ s, $C/N = 5.0$", "$t = 1.5$ s, $C/N = 20$"]),
        ((1.0, 40.96), ["$t = 1$ s, $C/N = 10.0$"]),
        ((40.96, 446.6), ["$t = 1$ s, $C/N = 10.0$", "$t = 1.5$ s, $C/N = 20$"]),
    ],
)
def test_panels_are_the_snapshots_that_there_are(study, wanted, titles):
    figure = draw_snapshots(study, wanted, by_height(), heights)
    panels = figure.axes[:-1]
    assert [axes.get_title() for axes in panels] == titles
    assert figure.axes[-1].get_xlabel() == by_height().label


def test_disks_have_their_colours_and_what_is_infinite_a_ring(study):
    figure = draw_snapshots(study, (1.5,), by_height(), heights)
    disks, rings = figure.axes[0].collections
    shot = study.isel(n_particles=0, realization=0, snapshot=2)
    places = shot["position"].values / 0.02
    np.testing.assert_allclose(rings.get_offsets(), places[[7]])
    inside = {tuple(place): colour for place, colour in zip(disks.get_offsets(), disks.get_facecolors(), strict=True)}
    for place, value in zip(places, heights(shot), strict=True):
        np.testing.assert_allclose(inside[tuple(place)], by_height()(value))


def test_disks_are_drawn_to_scale_and_across_the_edges():
    """A fourth of the box is covered, by each disk alike wherever it lies."""
    n = 8
    covered = []
    for shift in (0.0, 0.5):
        figure = Figure(figsize=(4, 4))
        axes = figure.add_axes((0, 0, 1, 1))
        d = np.sqrt(4 * 0.25 / np.pi) / n
        position = (np.stack(np.meshgrid(*[np.arange(n)] * 2), axis=-1).reshape(-1, 2) + shift) / n
        draw_disks(axes, position, (1.0, 1.0), d, np.tile([0.0, 0.0, 0.0, 1.0], (n * n, 1)))
        axes.set_axis_off()
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
        covered.append(1 - np.asarray(canvas.buffer_rgba())[..., 0].mean() / 255)
    np.testing.assert_allclose(covered, 0.25, rtol=0.06)

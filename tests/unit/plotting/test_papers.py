"""Drawings that the figures of one paper share."""

import numpy as np
import pytest
import xarray as xr
from made_up import cooling_study
from matplotlib.figure import Figure

from granugas.plotting import papers


def test_blue_green_red():
    colour = papers.blue_green_red(300, 700, 1100).to_rgba
    for rate, strongest in ((0, 2), (300, 2), (700, 1), (1100, 0), (5000, 0)):
        assert np.argmax(colour(rate)[:3]) == strongest
    assert colour(100) == colour(300) != colour(400)
    assert colour(9000) == colour(1100) != colour(1000)


def test_elastic_fractions_in_windows():
    runs = cooling_study(2).squeeze(drop=True)
    figure = papers.elastic_fractions([runs], [{"label": "one"}], 10.0, ((1e-3, 1), (1e-4, 1)))
    assert [axes.get_ylim()[0] for axes in figure.axes] == [1e-3, 1e-4, 1e-4]
    for axes, expected in zip(figure.axes, (0.01, 0.004, 0.005), strict=True):
        np.testing.assert_allclose(axes.lines[0].get_ydata(), expected, rtol=1e-9)


def test_the_growth_regime_is_shaded_where_the_mean_size_grows():
    time = np.concatenate([[0], np.geomspace(1e-2, 400, 120)])
    sizes = np.stack([np.clip(time, 1, end) ** 0.3 for end in (40, 20)])
    runs = xr.Dataset(
        {"mean_cluster_size": (("distance_factor", "realization", "time"), np.stack([sizes[:1], sizes[1:]]))},
        {"distance_factor": [1.09, 1.4], "time": time},
    )
    axes = Figure().add_subplot(xscale="log")
    axes.plot([2, 5], [1, 2])
    limits = axes.get_xlim()
    papers.mark_growth(runs, axes)
    (area,) = axes.patches
    assert (area.get_x(), area.get_x() + area.get_width()) == pytest.approx((1, 40), rel=0.05)
    assert axes.get_xlim() == limits
    papers.mark_growth(runs.isel(time=slice(0, 80)), axes)  # does not end
    assert axes.patches[-1].get_x() + axes.patches[-1].get_width() == pytest.approx(limits[1])

"""The figures of cluster growth draw the exponents that there are."""

import math
import runpy
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

FIGURES = Path(__file__).parents[2] / "workflow/figures"
TIMES = np.concatenate([[0], np.geomspace(0.05, 446.6, 100)])


def grows(power: float, realizations: int = 3) -> np.ndarray:
    """Mean sizes that grow by a power law from 1 to 40 s, one run a little faster than the other."""
    powers = power + 0.01 * np.arange(realizations)[:, np.newaxis]
    return 2 * np.clip(TIMES, 1.0, 40.0) ** powers


def study(key: str, powers: dict[float, float], **scene: float | str) -> xr.Dataset:
    """Runs over one key of the grid."""
    values = list(powers)
    sizes = np.array([grows(power) for power in powers.values()])[..., np.newaxis] * np.array([0.9, 1.0, 1.1])
    over = (key, "realization", "time")
    return xr.Dataset(
        {"kinetic_energy": (over, np.ones(sizes.shape[:-1])), "mean_cluster_size": ((*over, "distance_factor"), sizes)},
        {key: values, "realization": range(3), "time": TIMES, "distance_factor": [1.05, 1.1, 1.2]},
        scene,
    )


@pytest.fixture(scope="module")
def figure():
    smooth = {"material": "constant", "tangential_restitution": -1.0, "friction": math.inf}
    rough = smooth | {"restitution": 0.9, "tangential_restitution": 0.4}
    studies = {
        "growth_smooth": study("restitution", {0.9: 0.2, 0.6: 0.3, 0.4: 0.4}, **smooth),
        "growth_rough": study("friction", {0.2: 0.15, math.inf: 0.1}, **rough),
        "growth_viscoelastic": study("restitution", {0.9: 0.25}, **smooth | {"material": "viscoelastic"}),
    }
    return runpy.run_path(str(FIGURES / "growth_models.py"))["draw"](studies)


def test_each_gas_is_named_with_its_window(figure):
    names = [text.get_text() for text in figure.axes[2].get_yticklabels()]
    gases, windows = zip(*(name.split("\n") for name in names), strict=True)
    assert gases[:3] == ("$r = 0.9$", "$r = 0.6$", "$r = 0.4$")
    assert gases[3:] == (r"$r = 0.9$, $\beta = 0.4$, $\mu = 0.2$", r"$r = 0.9$, $\beta = 0.4$", "viscoelastic")
    begin, end = (np.array([float(window.split()[k]) for window in windows]) for k in (0, 2))
    np.testing.assert_allclose(begin, 1.0, rtol=0.15)
    np.testing.assert_allclose(end, 40.0, rtol=0.15)


def test_exponents_are_those_of_the_runs(figure):
    """Mean and 95 % of three runs; the window may reach a sample beyond the kinks."""
    points = figure.axes[2].containers
    found = [point[0].get_xdata()[0] for point in points]
    np.testing.assert_allclose(found, np.array([0.2, 0.3, 0.4, 0.15, 0.1, 0.25]) + 0.01, rtol=0.06)
    for point in points:
        (low, _), (high, _) = point[2][0].get_segments()[0]
        assert 0.03 < high - low < 0.07


def spheres() -> xr.Dataset:
    """One run of a thousand spheres: sizes grow from 1 to 40 s, half of them are single and a cluster holds the rest."""
    factors, bins = [1.05, 1.1, 1.2], 2 ** np.arange(10)
    sizes = np.stack([grows(power, 1) for power in (0.1, 0.2, 0.3)], axis=-1)
    numbers = np.zeros((1, TIMES.size, 3, bins.size))
    numbers[..., 0], numbers[..., 8] = 500, 1
    over = ("realization", "time")
    return xr.Dataset(
        {
            "kinetic_energy": (over, np.exp(-TIMES)[np.newaxis]),
            "tau": (over, 100 * TIMES[np.newaxis]),
            "mean_cluster_size": ((*over, "distance_factor"), sizes),
            "largest_cluster_size": ((*over, "distance_factor"), sizes**4),
            "cluster_size_distribution": ((*over, "distance_factor", "cluster_size"), numbers),
        },
        {"realization": [0], "time": TIMES, "distance_factor": factors, "cluster_size": bins},
        {"n_particles": 1000, "restitution": 0.7, "dimensions": 3},
    )


@pytest.fixture(scope="module")
def figure_3d():
    return runpy.run_path(str(FIGURES / "growth_3d.py"))["draw"]({"growth_3d": spheres()})


@pytest.mark.parametrize(("panel", "power"), [(0, 1), (1, 4)])
def test_sizes_of_spheres_have_the_exponents_of_the_run(figure_3d, panel, power):
    """And the window, in words; one run has no interval."""
    words = [text.get_text().split() for text in figure_3d.axes[panel].get_legend().get_texts()]
    found, begin, end = (np.array([float(text[k].strip("$(")) for text in words]) for k in (1, 2, 4))
    np.testing.assert_allclose(found, power * np.array([0.1, 0.2, 0.3]), rtol=0.06, atol=0.005)
    np.testing.assert_allclose(begin, 1.0, rtol=0.15)
    np.testing.assert_allclose(end, 40.0, rtol=0.15)


def test_homogeneous_cooling_of_spheres_is_that_of_three_dimensions(figure_3d):
    _, theory = figure_3d.axes[2].get_lines()
    np.testing.assert_allclose(theory.get_ydata(), (1 + 0.51 / 6 * 100 * TIMES[1:]) ** -2)


def test_size_distribution_counts_single_spheres_and_leaves_out_empty_bins(figure_3d):
    for axes in figure_3d.axes[3:]:
        for line in axes.get_lines():
            there = ~np.isnan(line.get_ydata())
            np.testing.assert_allclose(line.get_ydata()[there], [0.5, 1 / 256 / 1000])
            np.testing.assert_allclose(line.get_xdata()[there], [1, np.sqrt(256 * 511)])

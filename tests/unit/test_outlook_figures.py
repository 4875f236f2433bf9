"""The figures of the outlook draw what the analysis finds."""

import runpy
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from granugas.analysis.clusters import clusters_of_frames
from granugas.analysis.criteria import compare
from granugas.analysis.sizes import octaves, scaling
from granugas.analysis.statistics import fit_power_law
from granugas.analysis.structure import mean_wavelength, structure_factor
from granugas.plotting.style import exponent

FIGURES = Path(__file__).parents[2] / "workflow/figures"
LARGE, RUNS, N, D = "cluster1999_large", 3, 400, 0.02
SHOTS = [0.64, 2.56, 10.24, 40.96]


@pytest.fixture(scope="module")
def data():
    """Disks that gather and slow down."""
    rng, times = np.random.default_rng(4), np.concatenate([[0], np.geomspace(5e-3, 446.6, 40)])
    start, drift = rng.random((2, RUNS, N, 2))
    squeeze = np.log(times + 1)[:, np.newaxis, np.newaxis, np.newaxis] / np.log(500)
    trajectory = np.moveaxis((start + 0.1 * squeeze * drift - 0.5) * (1 - 0.6 * squeeze) + 0.5, 0, 1)
    found = xr.concat([clusters_of_frames(run, (1.0, 1.0), D, [1.01, 1.05, 1.1, 1.2]) for run in trajectory], "realization")
    at = [abs(times - shot).argmin() for shot in SHOTS]
    over = ("realization", "snapshot", "particle")
    speed = 1 / np.array(SHOTS)[:, np.newaxis, np.newaxis]
    runs = found.assign_coords(time=times, realization=range(RUNS), snapshot=SHOTS).assign(
        kinetic_energy=(("realization", "time"), np.ones((RUNS, len(times)))),
        position=((*over, "axis"), trajectory[:, at]),
        velocity=((*over, "axis"), rng.normal(size=(RUNS, len(SHOTS), N, 2)) * speed),
        collision_frequency=(over, rng.exponential(size=(RUNS, len(SHOTS), N))),
        box_x=("realization", np.ones(RUNS)),
        box_y=("realization", np.ones(RUNS)),
    )
    return runs.expand_dims(n_particles=[N], diameter=[D]).assign_attrs(velocity_half_width=0.5)


def test_sizes(data):
    module = runpy.run_path(str(FIGURES / "cluster1999_outlook_sizes.py"))
    axes = np.reshape(module["draw"]({LARGE: data}).axes, (3, 3))
    runs = data.squeeze().sel(distance_factor=1.1).sel(time=list(module["TIMES"]), method="nearest")
    numbers, lower, upper = octaves(runs["cluster_size_distribution"], data["cluster_size"].values)
    weighted = runs["weighted_cluster_size"].values
    for k in range(6):
        m, n_of_m = axes[0, 1].containers[k][0].get_data()
        there = numbers[:, k].any(axis=0)
        np.testing.assert_allclose(m, np.sqrt(lower * (upper - 1.0))[there])
        np.testing.assert_allclose(n_of_m, (numbers[:, k].mean(axis=0) / (upper - lower) / N)[there])
        np.testing.assert_allclose(axes[1, 1].containers[k][0].get_ydata(), m**2 * n_of_m)
        scaled = axes[2, 1].containers[k][0].get_data()
        np.testing.assert_allclose(scaled, [m / weighted[:, k].mean(), m**2 * n_of_m])
    words = [text.get_text() for text in axes[2, 1].texts]
    for smallest in module["SMALLEST"]:
        q, error = scaling(numbers, weighted, lower, upper, N, smallest)
        assert any(f"\\geq {smallest})" in word and f"{q:.2f}" in word and f"{error:.2f}" in word for word in words)
    alone = module["draw"]({LARGE: data.isel(realization=[0])})
    assert not any(r"\pm" in text.get_text() for panel in alone.axes for text in panel.texts)


def test_criteria(data):
    module = runpy.run_path(str(FIGURES / "cluster1999_outlook_criteria.py"))
    axes = np.reshape(module["draw"]({LARGE: data}).axes, (3, 3))
    runs = data.squeeze()
    expected, waves = np.empty((RUNS, 4, 10, 3)), np.empty((RUNS, 4))
    for run, shot in np.ndindex(RUNS, 4):
        x, v, rate = (runs[name].values[run, shot] for name in ("position", "velocity", "collision_frequency"))
        rms, initial = np.sqrt((v**2).sum(axis=1).mean()), 0.5 * np.sqrt(2 / 3)
        speeds = [0.1 * rms, 0.3 * rms, rms, 0.01 * initial, 0.03 * initial, 0.1 * initial]
        rates = np.array([0.5, 1, 2]) * rate.mean()
        expected[run, shot] = compare(x, v, rate, (1.0, 1.0), 1.1 * D, 1.5 * D, speeds, rates)
        k, strength = structure_factor(x, (1.0, 1.0), 512)
        waves[run, shot] = mean_wavelength(k, strength, 5 * D) / D
    means = np.exp(np.log(expected).mean(axis=0))
    for row, quantity in ((0, 0), (1, 2)):
        for c in range(3):
            for line, criterion in zip(axes[row, c].lines, [0, *range(1 + 3 * c, 4 + 3 * c)], strict=True):
                np.testing.assert_allclose(line.get_data(), [SHOTS, means[:, criterion, quantity]])
    for line, criterion in zip(axes[2, 0].lines, (0, 2, 5, 8), strict=True):
        np.testing.assert_allclose(line.get_ydata(), means[:, criterion, 1])
    np.testing.assert_allclose(axes[2, 2].lines[0].get_ydata(), np.exp(np.log(waves).mean(axis=0)))
    for line, quantity in zip(axes[2, 2].lines[1:], range(3), strict=True):
        np.testing.assert_allclose(line.get_ydata(), np.sqrt(means[:, 0, quantity]))
    fit = fit_power_law(SHOTS, expected[:, :, 0, 0], module["WINDOW"])
    assert axes[0, 0].get_legend().get_texts()[0].get_text() == f"$S_c = 1.1$: {exponent(fit)}"
    few = module["draw"]({LARGE: data.isel(snapshot=[0, 1, 3])})
    assert few.axes[0].get_legend().get_texts()[0].get_text() == "$S_c = 1.1$"

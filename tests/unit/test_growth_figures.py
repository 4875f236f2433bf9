"""The figure of cluster growth in gases that dissipate differently draws the exponents that there are."""

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


def study(key: str, powers: dict[float, float], **scene: float) -> xr.Dataset:
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
    smooth = study("restitution", {0.9: 0.2, 0.6: 0.3, 0.4: 0.4}, tangential_restitution=-1.0, friction=math.inf)
    rough = study("friction", {0.2: 0.15, math.inf: 0.1}, restitution=0.9, tangential_restitution=0.4)
    return runpy.run_path(str(FIGURES / "growth_models.py"))["draw"]({"growth_smooth": smooth, "growth_rough": rough})


def test_each_gas_is_named_with_its_window(figure):
    names = [text.get_text() for text in figure.axes[2].get_yticklabels()]
    gases, windows = zip(*(name.split("\n") for name in names), strict=True)
    assert gases[:3] == ("$r = 0.9$", "$r = 0.6$", "$r = 0.4$")
    assert gases[3:] == (r"$r = 0.9$, $\beta = 0.4$, $\mu = 0.2$", r"$r = 0.9$, $\beta = 0.4$")
    begin, end = (np.array([float(window.split()[k]) for window in windows]) for k in (0, 2))
    np.testing.assert_allclose(begin, 1.0, rtol=0.15)
    np.testing.assert_allclose(end, 40.0, rtol=0.15)


def test_exponents_are_those_of_the_runs(figure):
    """Mean and 95 % of three runs; the window may reach a sample beyond the kinks."""
    points = figure.axes[2].containers
    found = [point[0].get_xdata()[0] for point in points]
    np.testing.assert_allclose(found, np.array([0.2, 0.3, 0.4, 0.15, 0.1]) + 0.01, rtol=0.06)
    for point in points:
        (low, _), (high, _) = point[2][0].get_segments()[0]
        assert 0.03 < high - low < 0.07

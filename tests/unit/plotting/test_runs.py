"""Curves, bands and points: what is drawn of made-up runs."""

import numpy as np
import pytest
import xarray as xr
from made_up import cooling_study
from matplotlib.figure import Figure

from granugas.plotting import runs as drawing


def curves(values=((1.0, 2.0, 4.0, 8.0), (1.0, 8.0, 16.0, np.nan))):
    x = xr.DataArray([0.0, 1.0, 2.0, 3.0], dims="time")
    return x, xr.DataArray(np.array(values), dims=("realization", "time"))


def test_band_on_logarithmic_axes():
    """The geometric mean and the range, without t = 0 and up to the first end."""
    axes = Figure().add_subplot(xscale="log", yscale="log")
    line = drawing.band(axes, *curves(), color="C1")
    np.testing.assert_allclose(line.get_data(), [[1, 2], [4, 8]])
    (fill,) = axes.collections
    assert {2.0, 8.0, 4.0, 16.0} == set(fill.get_paths()[0].vertices[:, 1])


def test_band_on_linear_axes():
    axes = Figure().add_subplot()
    line = drawing.band(axes, *curves(), spread=False)
    np.testing.assert_allclose(line.get_data(), [[0, 1, 2], [1, 5, 10]])
    assert not axes.collections


def test_band_of_one_realization_is_a_line():
    axes = Figure().add_subplot()
    drawing.band(axes, *curves([[1.0, 2.0, 3.0, 4.0]]))
    assert not axes.collections


def test_power_line():
    figure = Figure()
    axes = figure.add_subplot(xscale="log", yscale="log")
    curve = drawing.band(axes, *curves([[1.0, 2.0, 4.0, 8.0]]))
    drawing.power_line(curve, (1, 3), -2, 10, "slope")
    x, y = axes.lines[-1].get_data()
    assert (x[0], x[-1], y[0]) == (1, 3, 20)
    assert y[-1] / y[0] == pytest.approx(3.0**-2)


def test_grid_points():
    data = cooling_study(3, n_particles=[42, 378], restitution=[0.4, 0.8])
    data["kinetic_energy"] = data["kinetic_energy"].copy()
    data["kinetic_energy"].loc[{"n_particles": 42, "restitution": 0.8}] = np.nan
    data["kinetic_energy"].loc[{"n_particles": 378, "realization": 1}] = np.nan
    data["kinetic_energy"].loc[{"n_particles": 42, "restitution": 0.4, "realization": 2, "time": slice(9, None)}] = np.nan
    found = list(drawing.grid_points(data))
    assert [(key["n_particles"], key["restitution"]) for key, _ in found] == [(42, 0.4), (378, 0.4), (378, 0.8)]
    assert found[0][0]["area_fraction"] == 0.25
    assert [runs.sizes["realization"] for _, runs in found] == [3, 2, 2]
    assert found[0][1]["tau"].dims == ("realization", "time")


def test_times_of_runs_that_ended_by_collisions():
    data = cooling_study(2).squeeze()
    assert drawing.times(data).identical(data["time"])
    numbered = data.assign(sampling_time=(("realization", "time"), [data["time"].values, 3 * data["time"].values]))
    np.testing.assert_allclose(drawing.times(numbered), 2 * data["time"])


def test_names_of_points():
    points = [{"n_particles": 97776, "contact_time": 1e-5, "lattice": lattice} for lattice in ("auto", "square")]
    assert drawing.point_names(points) == ["lattice = auto", "lattice = square"]
    points[0]["n_particles"], points[1]["contact_time"] = 42, 0.0
    assert drawing.point_names(points)[0] == "$N$ = $42$, $t_c$ = $10^{-5}$, lattice = auto"
    assert drawing.point_names(points)[1] == "$N$ = $97776$, $t_c$ = $0$, lattice = square"


def test_thinned_runs_keep_what_a_logarithmic_axis_shows():
    linear = xr.Dataset({"tau": ("time", np.arange(5001.0))}, {"time": np.arange(5001) / 1000})
    few = drawing.thinned(linear, 100)
    assert 60 < few.sizes["time"] <= 101
    assert (float(few["time"][0]), float(few["time"][-1])) == (0.0, 5.0)
    assert np.diff(np.log(few["time"].values[1:])).max() <= np.log(2) + 1e-12  # 1 ms to 2 ms
    assert drawing.thinned(few.isel(time=[0, 1, 2]), 100).sizes["time"] == 3


def test_means_of_counts():
    """Arithmetic, where a realization has none too; nothing where all have none."""
    axes = Figure().add_subplot(yscale="log", ylim=(0.1, 10))
    values = xr.DataArray([[0.0, 0.0, 2.0, np.nan], [4.0, 0.0, 2.0, np.nan]], dims=("realization", "time"))
    line = drawing.mean_and_range(axes, xr.DataArray([1.0, 2.0, 3.0, 4.0], dims="time"), values)
    np.testing.assert_allclose(line.get_ydata(), [2.0, np.nan, 2.0, np.nan])
    drawing.mean_and_range(axes, xr.DataArray([1.0, 2.0, 3.0, 4.0], dims="time"), values[:1])
    assert len(axes.collections) == 1


@pytest.mark.parametrize(("scale", "shift"), [("log", [1.0, 2.0, 5.0]), ("linear", [1.0, 1.0, 1.0])])
def test_run_and_others(scale, shift):
    """The band is where all but the first are: at common x, though each has its own."""
    axes = Figure().add_subplot(xscale="log", yscale=scale)
    dims, shift = ("realization", "time"), np.array(shift)[:, np.newaxis]
    x = xr.DataArray(np.array([0, 1, 10, 100.0]) * shift, dims=dims)
    y = xr.DataArray(np.array([[8.0], [1.0], [3.0]]) * np.array([7, 1, 1e-2, 1e-4]) * shift**-2, dims=dims)
    line = drawing.run_and_others(axes, x, y, color="C1")
    np.testing.assert_allclose(line.get_data(), [[1, 10, 100], [8, 8e-2, 8e-4]])
    place, edge = axes.collections[0].get_paths()[0].vertices.T
    last = 100 * shift[1:].min()
    assert (place.min(), place.max()) == pytest.approx((shift[1:].max(), last))
    assert (edge[place < place.min() * 1.01].min(), edge[place < place.min() * 1.01].max()) == pytest.approx(
        (place.min() ** -2, 3 * place.min() ** -2)
    )
    single = drawing.run_and_others(axes, x[:1], y[:1])
    assert len(axes.collections) == 1 and len(single.get_xdata()) == 3


def test_points_have_bars_where_there_are_several_runs():
    axes = Figure().add_subplot()
    values = xr.DataArray([[1.0, 2.0, np.nan], [3.0, np.nan, np.nan]], {"x": [10, 20, 30]}, ("realization", "x"))
    drawing.error_points(axes, values, color="C1")
    ((points, _, (bars,)),) = axes.containers
    np.testing.assert_allclose(points.get_data(), [[10, 20], [2, 2]])
    np.testing.assert_allclose([np.ptp(bar[:, 1]) for bar in bars.get_segments()], [2, 0])


def test_contact_times_in_the_legend():
    axes = Figure().add_subplot()
    values = xr.DataArray(
        np.ones((12, 2, 3)), {"contact_time": np.geomspace(1e-12, 1e-1, 12)}, ("contact_time", "realization", "x")
    )
    drawing.by_contact_time(axes, values.assign_coords(x=[1, 2, 3]))
    labels = axes.get_legend_handles_labels()[1]
    assert len(labels) == 12 and (labels[0], labels[-1]) == ("$10^{-1}$", "$10^{-12}$")


def test_each_run_is_a_point_and_crystals_are_filled():
    axes = Figure().add_subplot()
    dims = ("area_fraction", "realization")
    values = xr.DataArray([[1.0, 2.0], [3.0, 4.0]], {"area_fraction": [0.2, 0.8]}, dims)
    drawing.each_run(axes, values, xr.DataArray([["fluid"] * 2, ["crystal"] * 2], dims=dims), "runs", marker="o", color="C0")
    fluid, crystal = axes.lines
    np.testing.assert_allclose(fluid.get_data(), [[0.2, 0.2], [1, 2]])
    np.testing.assert_allclose(crystal.get_data(), [[0.8, 0.8], [3, 4]])
    assert (fluid.get_markerfacecolor(), crystal.get_markerfacecolor()) == ("none", "C0")
    assert axes.get_legend_handles_labels()[1] == ["runs"]

"""The drawings that figures share, and every figure on made-up studies: full grids, small ones, single runs."""

import itertools
import runpy
import subprocess
import sys
from functools import cache
from importlib import import_module
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pandas as pd
import pytest
import xarray as xr
from made_up import collapse_study, elastic_study
from matplotlib import style
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from granugas import plotting, plotting_papers
from granugas.analysis import theory
from granugas.analysis.clusters import find_clusters
from granugas.analysis.statistics import fit_power_law
from granugas.scene import Scene
from granugas.simulate import simulate
from granugas.storage.pooling import pool

FIGURES = Path(__file__).parents[2] / "workflow" / "figures"
NAMES = sorted(path.stem for path in FIGURES.glob("*.py"))
SMOOTH = {"material": "constant", "tangential_restitution": -1.0, "friction": np.inf, "boundary": "periodic"}


def study(realizations=2, clusters=False, **grid):
    """A pooled dataset over a grid: homogeneous cooling with some scatter, and clusters that grow as t^.3."""
    rng = np.random.default_rng(1)
    grid = {"n_particles": [100], "restitution": [0.4], "contact_time": [1e-5]} | grid
    shape = (*(len(values) for values in grid.values()), realizations)
    time = np.concatenate([[0], np.geomspace(1e-3, 446.6, 60)])
    dims, at = (*grid, "realization", "time"), (*grid, "realization", "snapshot")
    once = {"enskog_rate": 445.0, "box_x": 1.0, "box_y": 1.0}
    tau = np.broadcast_to(445 * time, (*shape, len(time)))
    energy = theory.homogeneous_cooling(tau, 0.4) * np.exp(0.05 * rng.normal(size=(*shape, 1)) * (time > 0))
    collisions = theory.collisions_until(tau, 0.4)
    data = xr.Dataset(
        {
            "tau": (dims, tau),
            "kinetic_energy": (dims, energy),
            "kinetic_energy_x": (dims, 0.6 * energy),
            "kinetic_energy_y": (dims, 0.4 * energy),
            "collisions_per_particle": (dims, collisions),
            "elastic_collisions_per_particle": (dims, 0.01 * collisions),
            "elastic_particle_fraction": (dims, np.full(tau.shape, 0.004)),
            "elastic_energy_fraction": (dims, np.full(tau.shape, 0.005)),
            "position": ((*at, "particle", "axis"), rng.random((*shape, 2, 100, 2))),
            "velocity": ((*at, "particle", "axis"), rng.normal(0, 0.01, (*shape, 2, 100, 2))),
            "collision_frequency": ((*at, "particle"), rng.exponential(500, (*shape, 2, 100))),
            "last_collision_interval": ((*at, "particle"), rng.exponential(1e-4, (*shape, 2, 100))),
            "initial_y": ((*dims[:-1], "particle"), rng.random((*shape, 100))),
            **{name: (dims[:-1], np.full(shape, value)) for name, value in once.items()},
        },
        coords=grid | {"time": time, "realization": np.arange(realizations), "snapshot": [0.1, 5.0]},
        attrs={"area_fraction": 0.25, "diameter": 0.05, "velocity_half_width": 0.5, "dimensions": 2, "boundary": "periodic"}
        | SMOOTH,
    )
    if clusters:
        factors = np.array([1.05, 1.1, 1.2, 1.3, 1.4])
        sizes = (1 + time) ** 0.3 * factors[:, np.newaxis] * np.exp(0.02 * rng.normal(size=(*shape, 1, 1)))
        over = (*dims[:-1], "distance_factor", "time")
        data = data.assign(
            mean_cluster_size=(over, sizes),
            cluster_count=(over, 100 / sizes),
            weighted_cluster_size=(over, sizes**1.5),
            largest_cluster_size=(over, sizes**2),
            cluster_size_distribution=((*over, "cluster_size"), 100 * np.exp(-np.arange(1, 5) / sizes[..., np.newaxis])),
        ).assign_coords(distance_factor=factors, cluster_size=[1, 2, 3, 4], cluster_size_upper=("cluster_size", [2, 3, 4, 6]))
    return data


def needed_by(studies, realizations, contact_times):
    return {
        name: study(realizations, clusters=True)
        if name.startswith(("cluster1999", "growth"))
        else elastic_study(contact_times, (0.1, 0.2, 0.72), realizations)
        if name.startswith("tc1998_elastic")
        else collapse_study(int(name.removeprefix("collapse_n")), realizations)
        if name.startswith("collapse_n")
        else by_method(name.removeprefix("methods_"), realizations)
        if name.startswith("methods_")
        else study(realizations, contact_time=contact_times)
        if name == "tc1998_contact_times"
        else study(realizations, n_particles=[100 + index])
        for index, name in enumerate(studies)
    }


@cache
def by_method(dynamics, realizations):
    """A small gas of real runs, over two lengths of steps where there are steps."""
    several = [{"steps_per_contact": n} for n in (10, 20)] if dynamics == "soft_spheres" else [{}]
    parts = []
    for keys, k in itertools.product(several, range(realizations)):
        scene = Scene(49, 0.2267, restitution=0.6, contact_time=3e-4, dynamics=dynamics, **keys)
        run = simulate(scene, 0.02, realization=k, samples={"count": 6}, snapshots=[0.01, 0.02], progress=False)
        found = find_clusters(run, distance_factors=[1.1]).drop_vars(["snapshot"], errors="ignore")
        parts.append(xr.merge([run.drop_vars("trajectory"), found], compat="override", combine_attrs="override"))
    return pool(parts, ["restitution", *several[0]])


def costs():
    """What four jobs took."""
    rows = {
        "study": ["one", "one", None, None],
        "rule": ["simulate", "pool", "experiments", "figures"],
        "name": ["n42", "one", "soft", "fig02"],
        "cpu_seconds": [60.0, 2.0, 9.0, 3.0],
    }
    return xr.Dataset.from_dataframe(pd.DataFrame(rows))


@cache
def measured(experiment):
    """The experiment's dataset, by its small plan if it has one: these take seconds, so they need not be made up."""
    module = import_module(f"granugas.experiments.{experiment}")
    return module.measure(*([module.SMALL] if hasattr(module, "SMALL") else []))


def texts(figure):
    """All words of a figure's legends."""
    legends = [axes.get_legend() for axes in figure.axes] + figure.legends
    return [text.get_text() for legend in legends if legend for text in [legend.get_title(), *legend.get_texts()]]


@pytest.mark.parametrize(("realizations", "contact_times"), [(1, [1e-5]), (3, [1e-12, 1e-5, 1e-3, 1e-2])])
@pytest.mark.parametrize("name", NAMES)
def test_every_figure_draws(name, realizations, contact_times, tmp_path):
    figure_file = runpy.run_path(str(FIGURES / f"{name}.py"))
    experiments = figure_file.get("EXPERIMENTS", ())
    studies = figure_file["STUDIES"] if experiments else figure_file["STUDIES"] or ("tc1998_contact_times",)
    made = {name: measured(name) for name in experiments} | {name: costs() for name in figure_file.get("TABLES", ())}
    figure = figure_file["draw"](needed_by(studies, realizations, contact_times) | made)
    plotting.save(figure, tmp_path / "figure.png")
    assert (tmp_path / "figure.png").stat().st_size > 10_000
    assert all(axes.has_data() for axes in figure.axes)


@pytest.mark.parametrize("name", NAMES)
def test_figures_are_short_and_have_a_caption(name):
    assert len((FIGURES / f"{name}.py").read_text().splitlines()) <= 60
    assert len((FIGURES.parent / "report" / f"{name}.rst").read_text()) > 100


def test_fig08_names_the_sizes_that_there_are():
    figure_file = runpy.run_path(str(FIGURES / "tc1998_fig08.py"))
    data = needed_by(figure_file["STUDIES"], 2, [1e-5])
    figure = figure_file["draw"](data)
    assert texts(figure)[1:] == [*(f"$N = {n}$" for n in range(105, 99, -1)), "Eq. (23)"]
    assert len(figure.axes[0].collections) == 6
    tau, theory_line = figure.axes[0].lines[-1].get_data()
    np.testing.assert_allclose(theory_line, theory.homogeneous_cooling(tau, 0.4))


def test_collapse_threshold_is_found_and_compared():
    """Runs that collapse below r = .6 within 50 collisions: one r_c for every limit, beside Eq. 22."""
    figure_file = runpy.run_path(str(FIGURES / "collapse_threshold.py"))
    made = needed_by(figure_file["STUDIES"], 4, [0.0]) | {"approach": measured("approach")}
    share, edge, rate = figure_file["draw"](made).axes
    np.testing.assert_allclose(share.lines[0].get_ydata(), [1, 1, 0, 0])
    for found in edge.containers:
        np.testing.assert_allclose(found[0].get_data(), [[42, 378, 1435, 5740, 22960], [0.4] * 5])
        np.testing.assert_allclose(np.array(found[2][0].get_segments())[:, :, 1], [[0.3, 0.5]] * 5)
    sizes, estimate = edge.lines[0].get_data()
    np.testing.assert_allclose(estimate, 1 - theory.collapse_restitution(sizes, 0.226725))
    x, y = np.concatenate([line.get_xydata() for line in rate.lines[:-1]]).T
    early = (x < 1e-2) & ~np.isnan(y)
    assert np.corrcoef(np.log(x[early]), np.log(y[early]))[0, 1] < -0.9


def test_rounding_gives_the_exponent_of_the_data():
    """Copies made up to part by exp(.8 C/N): that is what the legend says."""
    figure_file = runpy.run_path(str(FIGURES / "rounding.py"))
    data = measured("rounding").copy()
    growth = 1e-15 * np.exp(0.8 * data["collisions_per_particle"])
    data["separation"] = (growth / (1 + growth)).broadcast_like(data["separation"])
    words = texts(figure_file["draw"]({"rounding": data}))
    assert all(rf"$r = {r}$: $\lambda = 0.80 \pm 0.00$" in words for r in ("1", "0.9"))
    assert sum("t_L = 1.2" in word for word in words) == 2


def test_fig7_gives_window_exponents_and_intervals():
    figure_file = runpy.run_path(str(FIGURES / "cluster1999_fig7.py"))
    data = study(4, clusters=True)
    words = texts(figure_file["draw"]({"cluster1999_large": data}))
    sizes = data["mean_cluster_size"].squeeze().sel(distance_factor=1.2)
    fit = fit_power_law(data["time"], sizes, figure_file["WINDOW"])
    assert sum("1 to 40 s" in word and "95 %" in word and "4 runs" in word for word in words) == 2
    assert f"$1.2$: {plotting.exponent(fit)}" in words
    alone = texts(figure_file["draw"]({"cluster1999_large": study(1, clusters=True)}))
    assert not any(r"\pm" in word for word in alone)
    assert sum("no interval" in word for word in alone) == 2


def test_overview_tells_the_points_of_a_grid_apart():
    draw = runpy.run_path(str(FIGURES / "overview.py"))["draw"]
    figure = draw({"mine": study(2, clusters=True, n_particles=[50, 100], restitution=[0.4, 0.8])})
    assert len(figure.axes) == 4
    assert "$N$ = $50$, $r$ = $0.8$" in texts(figure)
    assert "$S_c = 1.05$" in texts(figure)
    assert len(draw({"mine": study(1)}).axes) == 2


@pytest.mark.parametrize("ending", ["png", "pdf", "svg"])
def test_equal_figures_give_equal_files(ending, tmp_path):
    for name in ("one", "two"):
        figure = Figure()
        plotting.band(figure.add_subplot(xscale="log", yscale="log"), *curves())
        plotting.save(figure, tmp_path / "new" / f"{name}.{ending}")
    one, two = ((tmp_path / "new" / f"{name}.{ending}").read_bytes() for name in ("one", "two"))
    assert one == two
    assert b"Date" not in one and b"matplotlib.org" not in one[-500:]


def test_style_is_in_force_while_drawing_only():
    before = mpl.rcParams["xtick.direction"]
    drawn = plotting.styled(lambda data: mpl.rcParams["xtick.direction"])({})
    assert (before, drawn, mpl.rcParams["xtick.direction"]) == ("out", "in", "out")


def test_style_is_for_everybody():
    """No two colours of the cycle are as close in brightness and hue as grey prints or colour blindness confuse."""
    with style.context(plotting.STYLE):
        cycle = mpl.rcParams["axes.prop_cycle"].by_key()["color"]
    assert len(set(cycle)) == 7
    brightness = [np.dot([0.2126, 0.7152, 0.0722], to_rgb(colour)) for colour in plotting.shades(9)]
    assert (np.diff(brightness) > 0.03).all()


def test_pyplot_is_not_needed():
    code = "import sys, granugas.plotting; sys.exit('matplotlib.pyplot' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


def curves(values=((1.0, 2.0, 4.0, 8.0), (1.0, 8.0, 16.0, np.nan))):
    x = xr.DataArray([0.0, 1.0, 2.0, 3.0], dims="time")
    return x, xr.DataArray(np.array(values), dims=("realization", "time"))


def test_band_on_logarithmic_axes():
    """The geometric mean and the range, without t = 0 and up to the first end."""
    axes = Figure().add_subplot(xscale="log", yscale="log")
    line = plotting.band(axes, *curves(), color="C1")
    np.testing.assert_allclose(line.get_data(), [[1, 2], [4, 8]])
    (fill,) = axes.collections
    assert {2.0, 8.0, 4.0, 16.0} == set(fill.get_paths()[0].vertices[:, 1])


def test_band_on_linear_axes():
    axes = Figure().add_subplot()
    line = plotting.band(axes, *curves(), spread=False)
    np.testing.assert_allclose(line.get_data(), [[0, 1, 2], [1, 5, 10]])
    assert not axes.collections


def test_band_of_one_realization_is_a_line():
    axes = Figure().add_subplot()
    plotting.band(axes, *curves([[1.0, 2.0, 3.0, 4.0]]))
    assert not axes.collections


def test_power_line():
    figure = Figure()
    axes = figure.add_subplot(xscale="log", yscale="log")
    curve = plotting.band(axes, *curves([[1.0, 2.0, 4.0, 8.0]]))
    plotting.power_line(curve, (1, 3), -2, 10, "slope")
    x, y = axes.lines[-1].get_data()
    assert (x[0], x[-1], y[0]) == (1, 3, 20)
    assert y[-1] / y[0] == pytest.approx(3.0**-2)


def test_grid_points():
    data = study(3, n_particles=[42, 378], restitution=[0.4, 0.8])
    data["kinetic_energy"] = data["kinetic_energy"].copy()
    data["kinetic_energy"].loc[{"n_particles": 42, "restitution": 0.8}] = np.nan
    data["kinetic_energy"].loc[{"n_particles": 378, "realization": 1}] = np.nan
    data["kinetic_energy"].loc[{"n_particles": 42, "restitution": 0.4, "realization": 2, "time": slice(9, None)}] = np.nan
    found = list(plotting.grid_points(data))
    assert [(key["n_particles"], key["restitution"]) for key, _ in found] == [(42, 0.4), (378, 0.4), (378, 0.8)]
    assert found[0][0]["area_fraction"] == 0.25
    assert [runs.sizes["realization"] for _, runs in found] == [3, 2, 2]
    assert found[0][1]["tau"].dims == ("realization", "time")


def test_times_of_runs_that_ended_by_collisions():
    data = study(2).squeeze()
    assert plotting.times(data).identical(data["time"])
    numbered = data.assign(sampling_time=(("realization", "time"), [data["time"].values, 3 * data["time"].values]))
    np.testing.assert_allclose(plotting.times(numbered), 2 * data["time"])


def test_words():
    assert [plotting.power_of_ten(t) for t in (0, 1e-12, 5e-4, 1.5e-3)] == [
        "$0$",
        "$10^{-12}$",
        r"$5\times10^{-4}$",
        r"$1.5\times10^{-3}$",
    ]
    points = [{"n_particles": 97776, "contact_time": 1e-5, "lattice": lattice} for lattice in ("auto", "square")]
    assert plotting.point_names(points) == ["lattice = auto", "lattice = square"]
    points[0]["n_particles"], points[1]["contact_time"] = 42, 0.0
    assert plotting.point_names(points)[0] == "$N$ = $42$, $t_c$ = $10^{-5}$, lattice = auto"
    assert plotting.point_names(points)[1] == "$N$ = $97776$, $t_c$ = $0$, lattice = square"


def test_points_have_bars_where_there_are_several_runs():
    axes = Figure().add_subplot()
    values = xr.DataArray([[1.0, 2.0, np.nan], [3.0, np.nan, np.nan]], {"x": [10, 20, 30]}, ("realization", "x"))
    plotting.error_points(axes, values, color="C1")
    ((points, _, (bars,)),) = axes.containers
    np.testing.assert_allclose(points.get_data(), [[10, 20], [2, 2]])
    np.testing.assert_allclose([np.ptp(bar[:, 1]) for bar in bars.get_segments()], [2, 0])


def test_contact_times_in_the_legend():
    axes = Figure().add_subplot()
    values = xr.DataArray(
        np.ones((12, 2, 3)), {"contact_time": np.geomspace(1e-12, 1e-1, 12)}, ("contact_time", "realization", "x")
    )
    plotting.by_contact_time(axes, values.assign_coords(x=[1, 2, 3]))
    labels = axes.get_legend_handles_labels()[1]
    assert len(labels) == 12 and (labels[0], labels[-1]) == ("$10^{-1}$", "$10^{-12}$")


def test_each_run_is_a_point_and_crystals_are_filled():
    axes = Figure().add_subplot()
    dims = ("area_fraction", "realization")
    values = xr.DataArray([[1.0, 2.0], [3.0, 4.0]], {"area_fraction": [0.2, 0.8]}, dims)
    plotting.each_run(axes, values, xr.DataArray([["fluid"] * 2, ["crystal"] * 2], dims=dims), "runs", marker="o", color="C0")
    fluid, crystal = axes.lines
    np.testing.assert_allclose(fluid.get_data(), [[0.2, 0.2], [1, 2]])
    np.testing.assert_allclose(crystal.get_data(), [[0.8, 0.8], [3, 4]])
    assert (fluid.get_markerfacecolor(), crystal.get_markerfacecolor()) == ("none", "C0")
    assert axes.get_legend_handles_labels()[1] == ["runs"]


def test_quality_factors_are_drawn_as_they_are():
    data = {"tc1998_elastic_n1435": elastic_study((1e-4, 1e-3), (0.1, 0.2), 3)}
    for name, expected in {"tc1998_fig05": 1.0, "tc1998_fig06": 0.95, "tc1998_fig07": 1.25}.items():
        for axes in runpy.run_path(str(FIGURES / f"{name}.py"))["draw"](data).axes:
            drawn = [points.get_data() for points, *_ in axes.containers]
            np.testing.assert_allclose(drawn, [[[0.1, 0.2], [expected] * 2]] * 2)


def test_thinned_runs_keep_what_a_logarithmic_axis_shows():
    linear = xr.Dataset({"tau": ("time", np.arange(5001.0))}, {"time": np.arange(5001) / 1000})
    few = plotting.thinned(linear, 100)
    assert 60 < few.sizes["time"] <= 101
    assert (float(few["time"][0]), float(few["time"][-1])) == (0.0, 5.0)
    assert np.diff(np.log(few["time"].values[1:])).max() <= np.log(2) + 1e-12  # 1 ms to 2 ms
    assert plotting.thinned(few.isel(time=[0, 1, 2]), 100).sizes["time"] == 3


def test_means_of_counts():
    """Arithmetic, where a realization has none too; nothing where all have none."""
    axes = Figure().add_subplot(yscale="log", ylim=(0.1, 10))
    values = xr.DataArray([[0.0, 0.0, 2.0, np.nan], [4.0, 0.0, 2.0, np.nan]], dims=("realization", "time"))
    line = plotting.mean_and_range(axes, xr.DataArray([1.0, 2.0, 3.0, 4.0], dims="time"), values)
    np.testing.assert_allclose(line.get_ydata(), [2.0, np.nan, 2.0, np.nan])
    plotting.mean_and_range(axes, xr.DataArray([1.0, 2.0, 3.0, 4.0], dims="time"), values[:1])
    assert len(axes.collections) == 1


def test_blue_green_red():
    colour = plotting_papers.blue_green_red(300, 700, 1100).to_rgba
    for rate, strongest in ((0, 2), (300, 2), (700, 1), (1100, 0), (5000, 0)):
        assert np.argmax(colour(rate)[:3]) == strongest
    assert colour(100) == colour(300) != colour(400)
    assert colour(9000) == colour(1100) != colour(1000)


def test_disks_are_drawn_to_scale_and_across_the_edges():
    """A fourth of the box is covered, by each disk alike wherever it lies."""
    n = 8
    covered = []
    for shift in (0.0, 0.5):
        figure = Figure(figsize=(4, 4))
        axes = figure.add_axes((0, 0, 1, 1))
        d = np.sqrt(4 * 0.25 / np.pi) / n
        position = (np.stack(np.meshgrid(*[np.arange(n)] * 2), axis=-1).reshape(-1, 2) + shift) / n
        plotting.draw_disks(axes, position, (1.0, 1.0), d, np.tile([0.0, 0.0, 0.0, 1.0], (n * n, 1)))
        axes.set_axis_off()
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
        covered.append(1 - np.asarray(canvas.buffer_rgba())[..., 0].mean() / 255)
    np.testing.assert_allclose(covered, 0.25, rtol=0.06)


def test_elastic_fractions_in_windows():
    runs = study(2).squeeze(drop=True)
    figure = plotting_papers.elastic_fractions([runs], [{"label": "one"}], 10.0, ((1e-3, 1), (1e-4, 1)))
    assert [axes.get_ylim()[0] for axes in figure.axes] == [1e-3, 1e-4, 1e-4]
    for axes, expected in zip(figure.axes, (0.01, 0.004, 0.005), strict=True):
        np.testing.assert_allclose(axes.lines[0].get_ydata(), expected, rtol=1e-9)


def test_text_tables_keep_inside_their_columns():
    cells = [["", "one", "two"], ["energy", "$E = 0.1250$", "$-$"], ["force", "$f = 1$", ""]]
    figure = plotting.styled(lambda _: plotting.text_table(cells, [1.2, 1.0, 0.8], ["a note"]))({})
    (axes,) = figure.axes
    FigureCanvasAgg(figure).draw()
    boxes = [text.get_window_extent().transformed(axes.transData.inverted()) for text in axes.texts]
    assert [text.get_text() for text in axes.texts] == [*(cell for row in cells for cell in row), "a note"]
    edges = np.array([0, 1.2, 2.2, 3.0])
    for k, box in enumerate(boxes[:-1]):
        assert edges[k % 3] <= box.x0 <= box.x1 <= edges[k % 3 + 1]
    middles = [(box.y0 + box.y1) / 2 for box in boxes]
    rules = [line.get_ydata()[0] for line in axes.lines]
    assert rules[0] < middles[1] < rules[1] < middles[4] < middles[7] < rules[2] < middles[-1] < axes.get_ylim()[0]


@pytest.mark.parametrize(("scale", "shift"), [("log", [1.0, 2.0, 5.0]), ("linear", [1.0, 1.0, 1.0])])
def test_run_and_others(scale, shift):
    """The band is where all but the first are: at common x, though each has its own."""
    axes = Figure().add_subplot(xscale="log", yscale=scale)
    dims, shift = ("realization", "time"), np.array(shift)[:, np.newaxis]
    x = xr.DataArray(np.array([0, 1, 10, 100.0]) * shift, dims=dims)
    y = xr.DataArray(np.array([[8.0], [1.0], [3.0]]) * np.array([7, 1, 1e-2, 1e-4]) * shift**-2, dims=dims)
    line = plotting.run_and_others(axes, x, y, color="C1")
    np.testing.assert_allclose(line.get_data(), [[1, 10, 100], [8, 8e-2, 8e-4]])
    place, edge = axes.collections[0].get_paths()[0].vertices.T
    last = 100 * shift[1:].min()
    assert (place.min(), place.max()) == pytest.approx((shift[1:].max(), last))
    assert (edge[place < place.min() * 1.01].min(), edge[place < place.min() * 1.01].max()) == pytest.approx(
        (place.min() ** -2, 3 * place.min() ** -2)
    )
    single = plotting.run_and_others(axes, x[:1], y[:1])
    assert len(axes.collections) == 1 and len(single.get_xdata()) == 3


@pytest.mark.parametrize(("name", "grid", "scale"), [("1", "restitution", "linear"), ("2", "contact_time", "log")])
def test_four_views_of_small_systems(name, grid, scale):
    """K, C/N, t and (Kx - Kz)/K against each other, with the theories of each r."""
    figure_file = runpy.run_path(str(FIGURES / f"cluster1999_fig{name}.py"))
    values = {"restitution": [0.2, 0.9], "contact_time": [1e-8, 1e-3]}[grid]
    data = study(3, **{grid: values})
    figure = figure_file["draw"](dict.fromkeys(figure_file["STUDIES"], data))
    energy, spent, clock, shear = figure.axes
    first = data.isel({grid: 1, "realization": 0}).squeeze().isel(time=slice(1, None))
    for axes, x, y in ((energy, "time", "kinetic_energy"), (clock, "collisions_per_particle", "time")):
        np.testing.assert_allclose(axes.lines[0].get_data(), [first[x], first[y]])
    np.testing.assert_allclose(spent.lines[0].get_data(), [first["collisions_per_particle"], first["kinetic_energy"]])
    np.testing.assert_allclose(shear.lines[1].get_ydata(), 0.2)
    assert (spent.get_xscale(), clock.get_xscale(), shear.get_yscale()) == (scale, scale, "linear")
    assert [len(axes.collections) for axes in figure.axes] == [2, 2, 2, 2]
    assert texts(figure)[0] == {"1": "$r$", "2": "$t_c$ (s)"}[name]
    dashed = [line for line in energy.lines if line.get_linestyle() == "--"]
    r = {"1": [0.9, 0.2], "2": [0.4]}[name]
    assert len(dashed) == len(r)
    for line, one in zip(dashed, r, strict=True):
        t, drawn = line.get_data()
        np.testing.assert_allclose(drawn, theory.homogeneous_cooling(445 * t, one))
    for line, one in zip([line for line in spent.lines if line.get_linestyle() == "--"], r, strict=True):
        count, drawn = line.get_data()
        np.testing.assert_allclose(drawn, theory.energy_after_collisions(count, one))


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
    plotting_papers.mark_growth(runs, axes)
    (area,) = axes.patches
    assert (area.get_x(), area.get_x() + area.get_width()) == pytest.approx((1, 40), rel=0.05)
    assert axes.get_xlim() == limits
    plotting_papers.mark_growth(runs.isel(time=slice(0, 80)), axes)  # does not end
    assert axes.patches[-1].get_x() + axes.patches[-1].get_width() == pytest.approx(limits[1])


def test_growth_shows_exponents_and_their_intervals():
    draw = runpy.run_path(str(FIGURES / "cluster1999_growth.py"))["draw"]
    data = study(4, clusters=True)
    for name in ("mean_cluster_size", "largest_cluster_size"):
        data[name] = data[name] * np.maximum(data["time"], 1) ** (0.01 * data["realization"] - 0.015)
    local, against, mean, largest, *_ = draw({"cluster1999_large": data}).axes
    sizes = data["mean_cluster_size"].squeeze()
    t = data["time"].values[1:]
    (curve,) = (line for line in local.lines if line.get_label() == "$1.4$")
    x, y = curve.get_data()
    np.testing.assert_allclose(y, 0.3 * x / (1 + x), atol=0.02)  # <M> ~ (1 + t)^.3
    fits = [fit_power_law(t, sizes.sel(distance_factor=s)[:, 1:], (1, 40)) for s in data["distance_factor"].values]
    points, _, (bars,) = against.containers[0]
    np.testing.assert_allclose(points.get_ydata().astype(float), [fit.exponent for fit in fits])
    np.testing.assert_allclose([bar[:, 1] for bar in bars.get_segments()], [fit.interval for fit in fits])
    np.testing.assert_allclose(against.containers[-1][0].get_ydata().astype(float), 2 * fits[0].exponent, rtol=1e-3)
    assert [axes.lines[0].get_xydata().tolist() for axes in (mean, largest)] == [[[1, 40]]] * 2
    alone = texts(draw({"cluster1999_large": study(1, clusters=True)}))
    assert "one run, no interval" in alone

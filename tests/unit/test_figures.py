"""Every figure on made-up studies: full grids, small ones, single runs."""

import itertools
import runpy
from functools import cache
from importlib import import_module
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from made_up import collapse_study, cooling_study, elastic_study

from granugas.analysis import theory
from granugas.analysis.clusters import find_clusters
from granugas.analysis.statistics import fit_power_law
from granugas.plotting import style
from granugas.scene import Scene
from granugas.simulate import simulate
from granugas.storage.pooling import pool

FIGURES = Path(__file__).parents[2] / "workflow" / "figures"
NAMES = sorted(path.stem for path in FIGURES.glob("*.py"))


def needed_by(studies, realizations, contact_times):
    return {
        name: cooling_study(realizations, clusters=True)
        if name.startswith(("cluster1999", "growth"))
        else elastic_study(contact_times, (0.1, 0.2, 0.72), realizations)
        if name.startswith("tc1998_elastic")
        else collapse_study(int(name.removeprefix("collapse_n")), realizations)
        if name.startswith("collapse_n")
        else by_method(name.removeprefix("methods_"), realizations)
        if name.startswith("methods_")
        else cooling_study(realizations, contact_time=contact_times)
        if name == "tc1998_contact_times"
        else cooling_study(realizations, n_particles=[100 + index])
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
    style.save(figure, tmp_path / "figure.png")
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


def test_quality_factors_are_drawn_as_they_are():
    data = {"tc1998_elastic_n1435": elastic_study((1e-4, 1e-3), (0.1, 0.2), 3)}
    for name, expected in {"tc1998_fig05": 1.0, "tc1998_fig06": 0.95, "tc1998_fig07": 1.25}.items():
        for axes in runpy.run_path(str(FIGURES / f"{name}.py"))["draw"](data).axes:
            drawn = [points.get_data() for points, *_ in axes.containers]
            np.testing.assert_allclose(drawn, [[[0.1, 0.2], [expected] * 2]] * 2)


@pytest.mark.parametrize(("name", "grid", "scale"), [("1", "restitution", "linear"), ("2", "contact_time", "log")])
def test_four_views_of_small_systems(name, grid, scale):
    """K, C/N, t and (Kx - Kz)/K against each other, with the theories of each r."""
    figure_file = runpy.run_path(str(FIGURES / f"cluster1999_fig{name}.py"))
    values = {"restitution": [0.2, 0.9], "contact_time": [1e-8, 1e-3]}[grid]
    data = cooling_study(3, **{grid: values})
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


def test_fig7_gives_window_exponents_and_intervals():
    figure_file = runpy.run_path(str(FIGURES / "cluster1999_fig7.py"))
    data = cooling_study(4, clusters=True)
    words = texts(figure_file["draw"]({"cluster1999_large": data}))
    sizes = data["mean_cluster_size"].squeeze().sel(distance_factor=1.2)
    fit = fit_power_law(data["time"], sizes, figure_file["WINDOW"])
    assert sum("1 to 40 s" in word and "95 %" in word and "4 runs" in word for word in words) == 2
    assert f"$1.2$: {style.exponent(fit)}" in words
    alone = texts(figure_file["draw"]({"cluster1999_large": cooling_study(1, clusters=True)}))
    assert not any(r"\pm" in word for word in alone)
    assert sum("no interval" in word for word in alone) == 2


def test_growth_shows_exponents_and_their_intervals():
    draw = runpy.run_path(str(FIGURES / "cluster1999_growth.py"))["draw"]
    data = cooling_study(4, clusters=True)
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
    alone = texts(draw({"cluster1999_large": cooling_study(1, clusters=True)}))
    assert "one run, no interval" in alone


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


def test_overview_tells_the_points_of_a_grid_apart():
    draw = runpy.run_path(str(FIGURES / "overview.py"))["draw"]
    figure = draw({"mine": cooling_study(2, clusters=True, n_particles=[50, 100], restitution=[0.4, 0.8])})
    assert len(figure.axes) == 4
    assert "$N$ = $50$, $r$ = $0.8$" in texts(figure)
    assert "$S_c = 1.05$" in texts(figure)
    assert len(draw({"mine": cooling_study(1)}).axes) == 2

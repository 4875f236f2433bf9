"""Error against time on made-up numbers: points, names, open symbols, edges."""

import runpy
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib.colors import to_rgb

from granugas.plotting.accuracy import Curve, accuracy_figure, arithmetic, contact_time, curve_of, equilibration, sampling

FIGURE = Path(__file__).parents[3] / "workflow/figures/accuracy_cost.py"
AXES = (1e-3, 1e2), (1e-4, 10.0)


def measured(cases, settings, observables, **attrs) -> xr.Dataset:
    """Error and uncertainty that tell which case, setting and observable they are of."""
    error = np.fromfunction(lambda i, j, k: 10.0 ** -(i + 1) / (j + 1) / (k + 1), (len(cases), len(settings), len(observables)))
    over = ("case", "setting", "observable")
    return xr.Dataset(
        {
            "relative_error": (over, error),
            "relative_error_error": (over, error / 10),
            "cpu_seconds": (over[:2], np.fromfunction(lambda i, j: (i + 1.0) * (j + 1.0), error.shape[:2])),
        },
        {"case": list(cases), "setting": list(settings), "observable": list(observables)},
        attrs,
    )


KNOBS = {
    "accuracy_contact_time": measured(
        ("N = 5740", "N = 79524"),
        (1e-2, 1e-5),
        [f"{name} at {t} s" for t in (1, 5) for name in ("K", "<M>", "M_max")],
        looks=[1.0, 5.0],
    ),
    "accuracy_sampling": measured(
        ("snapshots", "duration"),
        (5.0, 20.0),
        ("n_e at t_c = 0.0001 s", "E_e/E at t_c = 0.0001 s", "P V/E", "collision rate"),
    ),
    "accuracy_equilibration": measured(
        ("area fraction 0.2267", "area fraction 0.6"), (0.0, 10.0), ("<v^4>/<v^2>^2", "collision rate", "P V/E")
    ),
    "accuracy_arithmetic": measured(("N = 1435",), ("strict", "fused"), ("elastic P V/E", "K at 1 s")),
}


def test_a_curve_is_what_was_measured():
    data = KNOBS["accuracy_contact_time"]
    curve = curve_of(data, "K at 5 s", "K", "{:g}".format, case="N = 79524")
    at = data.sel(case="N = 79524", observable="K at 5 s")
    np.testing.assert_array_equal(curve.seconds, at["cpu_seconds"])
    np.testing.assert_array_equal(curve.error, at["relative_error"])
    np.testing.assert_array_equal(curve.uncertainty, at["relative_error_error"])
    assert curve.names == ["0.01", "1e-05"]


def test_settings_that_a_case_has_not_are_left_out():
    data = KNOBS["accuracy_sampling"].copy(deep=True)
    data["relative_error"].loc[{"case": "duration", "setting": 5.0}] = np.nan
    assert curve_of(data, "P V/E", "P", "{:g}".format, case="duration").names == ["20"]
    assert curve_of(data, "P V/E", "P", "{:g}".format, case="snapshots").names == ["5", "20"]


def test_each_knob_has_its_curves():
    labels = {knob: [c.label for c in make(KNOBS[f"accuracy_{knob}"])] for knob, make in
              {"contact_time": contact_time, "sampling": sampling, "equilibration": equilibration}.items()}  # fmt: skip
    assert labels["contact_time"] == ["$K$, $N = 5740$", r"$\langle M \rangle$, $N = 5740$", r"$M_{\max}$, $N = 5740$",
                                      "$K$, $N = 79524$"]  # fmt: skip
    assert len(labels["sampling"]) == 4
    assert labels["equilibration"][:2] == [r"$\langle v^4 \rangle$, $\nu = 0.2267$", r"$\langle v^4 \rangle$, $\nu = 0.6$"]
    assert [c.names for c in equilibration(KNOBS["accuracy_equilibration"])] == [["0", "10"], [], [], []]


def test_arithmetic_has_a_curve_for_each_setting_that_is_not_the_truth():
    data = KNOBS["accuracy_arithmetic"].copy(deep=True)
    data["relative_error"].loc[{"setting": "strict"}] = 0.0
    (curve,) = arithmetic(data)
    assert curve.label == "fused" and list(curve.names) == ["elastic P V/E", "K at 1 s"]
    np.testing.assert_array_equal(curve.seconds, [2.0, 2.0])
    np.testing.assert_array_equal(curve.error, data["relative_error"].sel(setting="fused").squeeze())


def drawn(curve: Curve):
    axes = accuracy_figure({"knob": [curve]}, *AXES).axes[0]
    return axes, [bars[0] for bars in axes.containers]


def test_what_is_no_more_than_chance_is_open_and_has_no_lower_bar():
    axes, (certain, chance) = drawn(Curve("a", np.array([1.0, 2.0]), np.array([0.1, 0.01]), np.array([0.01, 0.02])))
    np.testing.assert_array_equal(certain.get_data(), [[1.0], [0.1]])
    np.testing.assert_array_equal(chance.get_data(), [[2.0], [0.01]])
    assert to_rgb(chance.get_markerfacecolor()) == (1, 1, 1) != to_rgb(certain.get_markerfacecolor())
    ends = [bars[2][0].get_segments()[0][:, 1] for bars in axes.containers]
    np.testing.assert_allclose(ends, [[0.09, 0.11], [0.01, 0.03]])


def test_points_are_named_and_what_is_outside_is_at_the_edge_with_its_value():
    axes, (points, _) = drawn(Curve("a", np.array([1.0, 2.0]), np.array([0.1, 300.0]), np.zeros(2), ["5", "20"]))
    assert 1 < points.get_ydata()[1] < AXES[1][1]
    assert [text.get_text() for text in axes.texts] == ["10 %", "1 %", "0.1 %", "5", r"20: $3\times10^{2}$"]


@pytest.mark.parametrize("count", [1, 3, 8])
def test_all_panels_have_the_same_axes(count):
    curve = Curve("a", np.array([1.0]), np.array([0.1]), np.array([0.01]))
    figure = accuracy_figure({f"knob {k}": [curve] for k in range(count)}, *AXES)
    shown = [axes for axes in figure.axes if axes.axison]
    assert [axes.get_title() for axes in shown] == [f"knob {k}" for k in range(count)]
    assert {(axes.get_xlim(), axes.get_ylim()) for axes in shown} == {AXES}
    assert shown[0].get_title(loc="left") == "(a)"


def sized() -> xr.Dataset:
    """Systems of three sizes, as `experiments.accuracy_sizes` has them."""
    cases, ones = ("K at 1 s", "exponent of <M>"), np.ones((3, 2))
    over = ("setting", "observable")
    return xr.Dataset(
        {name: (over, value * ones) for name, value in
         {"relative_error": 0.02, "relative_error_error": 0.005, "relative_spread": 0.1, "measured_spread": 0.03}.items()}
        | {"exponents": (("setting", "distance_factor", "window_shift"), np.linspace(0.4, 0.6, 12).reshape(3, 2, 2)),
           "cpu_seconds": ("setting", [0.01, 0.1, 1.0])},
        {"setting": [42, 378, 1435], "observable": list(cases), "distance_factor": [1.1, 1.2], "window_shift": [0.71, 1.0]},
        {"distance_factor": 1.1},
    )  # fmt: skip


def study(seconds: float, energies, **settings) -> xr.Dataset:
    """Three realizations of one method at two times."""
    energy = np.multiply.outer(np.asarray(energies), np.ones((3, 2))) + 0.01 * np.arange(3)[:, np.newaxis]
    over = (*settings, "realization")
    coords = {"realization": range(3), "time": [0.0, 5.0]} | settings
    cost = np.full(energy.shape[:-1], seconds)
    return xr.Dataset({"kinetic_energy": ((*over, "time"), energy), "cpu_time": (over, cost)}, coords)


def test_the_figure_draws_every_knob():
    module = runpy.run_path(str(FIGURE))
    studies = {
        "methods_events": study(0.1, 0.5),
        "methods_dsmc": study(0.2, 0.6),
        "methods_soft_spheres": study(3.0, [0.55, 0.52], steps_per_contact=[10, 50]),
    }
    data = KNOBS | {"accuracy_sizes": sized()} | studies
    assert {*module["EXPERIMENTS"], *module["STUDIES"]} == set(data)
    figure = module["draw"](data)
    assert len(figure.axes) == 8 and all(axes.get_legend().get_texts() for axes in figure.axes)
    for axes, make in zip(figure.axes, (contact_time, sampling, equilibration, arithmetic), strict=False):
        curves = make(KNOBS[f"accuracy_{make.__name__}"])
        assert [text.get_text() for text in axes.get_legend().get_texts()] == [curve.label for curve in curves]
        seen = np.concatenate([bars[0].get_ydata() for bars in axes.containers])
        assert set(seen.round(12)) <= set(np.concatenate([curve.error for curve in curves]).round(12))

"""Every line of docs/analyses.md runs, on a study of the same form that is small, and says what it should."""

import re
from pathlib import Path

import matplotlib
import numpy as np
import pandas as pd
import pytest
from extxyz import read_dicts

import granugas as gg
from granugas.storage.dataset import pool, with_errors, write

PAGE = (Path(__file__).parents[2] / "docs/analyses.md").read_text(encoding="utf-8")
LINES = [re.sub(r"^ +", "", block) for block in re.findall(r"```python\n(.*?)```", PAGE, re.S)]
KEYS = ["n_particles", "area_fraction", "restitution", "contact_time", "diameter", "lattice"]


@pytest.fixture(scope="module")
def namespace(tmp_path_factory):
    """What the page begins with, in a folder with a study of two runs in it."""
    matplotlib.use("Agg")
    folder = tmp_path_factory.mktemp("analyses")
    scene = gg.Scene(100, area_fraction=0.25, restitution=0.8, contact_time=1e-5, diameter=2e-3, lattice="square")
    parts = []
    for k in (0, 1):
        options = {"samples": {"count": 20, "first": 5e-3}, "snapshots": [0.0, 2.56], "progress": False}
        run = gg.simulate(scene, until=50.0, seed=1, realization=k, **options).assign(realization=k)
        run = run.merge(gg.find_clusters(run, distance_factors=[1.05, 1.1]), combine_attrs="override")
        parts.append(run.drop_vars("trajectory"))
    write(with_errors(pool(parts, KEYS)), folder / "results/studies/cluster1999_large.nc")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        known = {}
        exec(LINES[0], known)
        yield known


def said_by(number, known):
    """The value of an analysis."""
    return eval(LINES[number].strip(), known)


def test_there_are_ten_of_one_line():
    assert len(LINES) == 12 and all(len(line.strip().splitlines()) == 1 for line in LINES[1:])


def test_the_study_is_labelled(namespace):
    energy = namespace["energy"]
    assert energy.dims == ("realization", "time") and energy.attrs["symbol"].startswith("K = E/E(0)")
    assert energy.attrs["units"] == "1" and "B Eq. 1" in energy.attrs["equation"]


def test_1_and_4_draw(namespace):
    from matplotlib import pyplot

    for number, lines in ((1, 2), (4, 1)):
        said_by(number, namespace)
        assert pyplot.gca().get_xscale() == "log" and len(pyplot.gca().lines) == lines
        pyplot.close("all")


def test_2_mean_and_error(namespace):
    mean, error = said_by(2, namespace)
    first, second = namespace["energy"].values[:, -1]
    assert mean == pytest.approx((first + second) / 2) and error == pytest.approx(abs(first - second) / 2)


def test_3_half_of_the_energy(namespace):
    times = said_by(3, namespace)
    assert len(times) == 2 and times.between(0.001, 1).all()


def test_5_exponent(namespace):
    low, high = said_by(5, namespace)
    assert -1 < low <= high < 3


def test_6_largest_cluster(namespace):
    shares = said_by(6, namespace)
    assert list(shares.index) == [1.05, 1.1] and (shares > 0).all() and shares.is_monotonic_increasing and (shares <= 1).all()


def test_7_collision_rate(namespace):
    np.testing.assert_allclose(said_by(7, namespace), 1, atol=0.7)


def test_8_kurtosis(namespace):
    table = said_by(8, namespace)
    assert table.shape == (2, 2) and table[0.0].between(0.7, 1.3).all()


def test_9_clusters(namespace, capsys):
    said_by(9, namespace)
    assert "Clusters of 100 particles" in capsys.readouterr().out


def test_10_table(namespace):
    said_by(10, namespace)
    table = pd.read_csv("cooling.csv")
    assert len(table) == 2 * 21 and {"realization", "time", "kinetic_energy"} <= {*table}


def test_snapshots_for_others(namespace):
    said_by(11, namespace)
    position = namespace["study"]["position"].sel(realization=0, snapshot=2.56)
    np.testing.assert_array_equal(read_dicts("snapshots.xyz").arrays["pos"][:, :2], position)

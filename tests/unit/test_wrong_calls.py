"""Wrong calls, from Python and from the shell: one line that names the argument, the value and what is allowed."""

import math
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import granugas as gg
from granugas.__main__ import main
from granugas.scene import SceneError
from granugas.storage.damage import DamagedFile

GAS = gg.Scene(n_particles=42)
PAIR = [[0.0, 0.0], [1.0, 1.0]]


def run(until: object = 0.01, **arguments: object) -> xr.Dataset:
    return gg.simulate(GAS, until, progress=False, **arguments)


FROM_PYTHON = [
    # call, error, what it says
    (lambda: gg.Scene(n=5), TypeError, "'n'"),
    (lambda: gg.Scene(n_particles="5"), SceneError, "n_particles = '5': allowed is an integer from 1 to 10000000"),
    (lambda: gg.Scene(restitution=2), SceneError, "restitution = 2: allowed is a number >= 0 and <= 1"),
    (lambda: gg.Scene(contact_time=np.array([1e-5, 1e-4])), SceneError, "contact_time = array"),
    (lambda: gg.Scene(lattice=np.zeros(2)), SceneError, "allowed are auto, triangular, square"),
    (lambda: gg.Scene(diameter=1e200), SceneError, "diameter = 1e+200: allowed is a number from 1e-50 to 1e+50"),
    (lambda: gg.simulate({"n_particles": 42}, 1.0), TypeError, "scene = {'n_particles': 42}: allowed is a granugas.Scene"),
    (lambda: gg.simulate(gg.Scene(n_particles=5, area_fraction=0.6), 1.0), SceneError, "5 disks fit on a lattice up to"),
    (lambda: gg.simulate(gg.Scene(n_particles=1), {"collisions_per_particle": 3}), ValueError, "single particle"),
    (lambda: run(until="5"), ValueError, "until.time = '5': allowed is a positive number"),
    (lambda: run(until={"tme": 5}), ValueError, "until = {'tme': 5}: allowed are time (s) and collisions_per_particle"),
    (lambda: run(until=math.nan), ValueError, "until.time = nan: allowed is a positive number"),
    (lambda: run(seed=-1), ValueError, "seed = -1: allowed is an integer >= 0"),
    (lambda: run(seed=2**64), ValueError, "allowed is an integer >= 0"),
    (lambda: run(realization=0.5), ValueError, "realization = 0.5: allowed is an integer >= 0"),
    (lambda: run(samples="log"), ValueError, "samples = 'log': allowed is a mapping"),
    (lambda: run(samples={"count": math.inf}), ValueError, "samples.count = inf: allowed is an integer >= 1"),
    (lambda: run(samples={"first": "1e-3"}), ValueError, "samples.first = '1e-3': allowed is a number > 0"),
    (lambda: run(samples={"frist": 1e-3}), ValueError, "samples.frist: allowed are spacing, count, first, axis"),
    (lambda: run(snapshots=[-1.0]), ValueError, "snapshots = -1.0: allowed are times >= 0 s"),
    (lambda: run(snapshots=[math.nan]), ValueError, "snapshots = nan: allowed are times >= 0 s"),
    (lambda: run(snapshots=0.1), ValueError, "snapshots = 0.1: allowed is a list of times"),
    (lambda: run(snapshots=[1e-3, 1e-3]), ValueError, "snapshots = [0.001, 0.001]: allowed is each time once"),
    (lambda: run(max_seconds=math.nan), ValueError, "max_seconds = nan: allowed is a number >= 0 s"),
    (lambda: run(max_collisions=0), ValueError, "max_collisions = 0: allowed is an integer >= 1"),
    (lambda: run(state=42), TypeError, "state = int: allowed is a dataset of granugas.equilibrate"),
    (lambda: run(state=gg.equilibrate(gg.Scene(n_particles=50))), ValueError, "state = 50 disks: allowed are the 42"),
    (lambda: run(state=gg.equilibrate(gg.Scene(n_particles=42, diameter=1.0))), ValueError, "state = a box of 145"),
    (lambda: gg.equilibrate(GAS, collisions_per_particle=0), ValueError, "collisions_per_particle = 0: allowed is a number"),
    (lambda: gg.equilibrate(None), TypeError, "scene = None: allowed is a granugas.Scene"),
    (lambda: gg.find_clusters("here"), ValueError, "positions = 'here': allowed are numbers"),
    (lambda: gg.find_clusters([1.0, 2.0]), ValueError, "positions of shape (2,): allowed is (n, dim)"),
    (lambda: gg.find_clusters([[0.0, math.nan]]), ValueError, "positions: some are not finite"),
    (lambda: gg.find_clusters(PAIR, box=[1.0, -1.0]), ValueError, "box = [1.0, -1.0]: allowed are 2 sides > 0 m"),
    (lambda: gg.find_clusters(PAIR, box="big"), ValueError, "box = 'big': allowed are numbers"),
    (lambda: gg.find_clusters(PAIR, diameter=0.0), ValueError, "diameter: allowed are a number > 0 m"),
    (lambda: gg.find_clusters(PAIR, distance_factors=[]), ValueError, "distance_factors = []: allowed are numbers > 0"),
    (lambda: gg.find_clusters(PAIR, distance_factors=["S"]), ValueError, "distance_factors = ['S']: allowed are numbers"),
    (lambda: gg.find_clusters(xr.Dataset()), ValueError, "neither trajectory nor position"),
    (lambda: gg.load_study("nowhere/mine.nc"), FileNotFoundError, "nowhere/mine.nc: no such study"),
]


def test_a_file_that_is_no_dataset_is_no_study(tmp_path: Path) -> None:
    (tmp_path / "study.nc").write_text("no dataset")
    with pytest.raises(DamagedFile, match="is damaged"):
        gg.load_study(tmp_path / "study.nc")


@pytest.mark.parametrize(("call", "error", "said"), FROM_PYTHON, ids=[case[2] for case in FROM_PYTHON])
def test_from_python(call: Callable[[], object], error: type[Exception], said: str) -> None:
    with pytest.raises(error) as raised:
        call()
    assert said in str(raised.value)
    assert "\n" not in str(raised.value)


FROM_THE_SHELL = [
    ([], "the following arguments are required"),
    (["rum"], "invalid choice: 'rum'"),
    (["run"], "name --time or --collisions-per-particle"),
    (["run", "--time", "soon"], "argument --time: invalid float value: 'soon'"),
    (["run", "--time", "nan"], "until.time = nan: allowed is a positive number"),
    (["run", "--time", "1", "--n", "1e3"], "argument --n: invalid int value: '1e3'"),
    (["run", "--time", "1", "--contact-time", "inf"], "contact_time = inf: allowed is a number >= 0 s"),
    (["run", "--time", "1", "--contact-time", "1e-5", "1e-4"], "at restitution = 1 only"),
    (["run", "--time", "1", "--seed", "-1"], "seed = -1: allowed is an integer >= 0"),
    (["run", "--time", "1", "--samples", "0"], "samples.count = 0: allowed is an integer >= 1"),
    (["run", "--time", "1", "--snapshots", "-1"], "snapshots = -1.0: allowed are times >= 0 s"),
    (["run", "--time", "1", "--tiem", "2"], "unrecognized arguments: --tiem 2"),
    (["run", "--time", "0.01", "--n", "42", "--output", "no.nc/run.nc"], "no.nc"),
    (["bench", "--lattice", "$(touch hacked)"], "lattice = '$(touch hacked)': allowed are auto, triangular, square"),
    (["bench", "--collisions", "0"], "collisions = 0: allowed is an integer >= 1"),
    (["bench", "--begin", "nan"], "begin = nan: allowed is a number >= 0 s"),
    (["compare", "a.nc"], "the following arguments are required: B.nc"),
    (["compare", "a.nc", "b.nc"], "a.nc"),
    (["compare", "no.nc", "no.nc"], "no.nc is damaged"),
    (["prune"], "No such file or directory: 'workflow/schemas/config.schema.yaml'"),
    (["prune", "--workflow", "nowhere"], "nowhere/schemas/config.schema.yaml"),
]


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder to call from, with nothing in it but a file that is no dataset."""
    (tmp_path / "no.nc").write_text("no dataset")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize(("words", "said"), FROM_THE_SHELL, ids=[" ".join(case[0]) for case in FROM_THE_SHELL])
def test_from_the_shell(words: list[str], said: str, capsys: pytest.CaptureFixture[str], here: Path) -> None:
    try:
        code = main(words)
    except SystemExit as stopped:  # as argparse ends
        code = stopped.code
    error = capsys.readouterr().err
    assert code == 2
    assert error.startswith("granugas: ") and said in error
    assert error.count("\n") == 1
    assert [path.name for path in here.iterdir()] == ["no.nc"]


def test_the_real_command(here: Path) -> None:
    command = [sys.executable, "-m", "granugas", "run", "--time", "1", "--restitution", "1.2"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "granugas: restitution = 1.2: allowed is a number >= 0 and <= 1\n"

import json
import shutil
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import numpy as np

import granugas
from granugas.digest import physics
from granugas.storage.provenance import merge, plain, provenance

PROGRAM = "import sys; sys.path.insert(0, '.'); from granugas.storage.provenance import commit; print(commit())"


def test_provenance_names_versions_sources_parameters_and_machine():
    found = provenance({"scene": {"restitution": np.float64(0.4)}, "snapshots": (0.64, 2.56), "until": None})
    assert json.loads(json.dumps(found)) == found
    assert found["package"] == f"granugas {version('granugas')}"
    assert found["engine"] == physics()
    assert found["parameters"] == {"scene": {"restitution": 0.4}, "snapshots": [0.64, 2.56], "until": None}
    assert found["libraries"]["numpy"] == np.__version__ and found["libraries"]["netCDF4"] == version("netCDF4")
    assert found["python"].startswith(f"{sys.version_info.major}.")
    assert found["machine"] and found["commit"]


def test_the_commit_is_that_of_the_sources(tmp_path):
    def git(*words):
        who = ["-c", "user.name=nobody", "-c", "user.email=nobody@localhost"]
        done = subprocess.run(["git", *who, *words], cwd=tmp_path, check=True, capture_output=True, text=True)
        return done.stdout.strip()

    def commit():
        done = subprocess.run([sys.executable, "-c", PROGRAM], cwd=tmp_path, check=True, capture_output=True, text=True)
        return done.stdout.strip()

    sources = Path(granugas.__file__).parent
    shutil.copytree(sources, tmp_path / "granugas", ignore=shutil.ignore_patterns("__pycache__"))
    (tmp_path / ".gitignore").write_text("__pycache__\n")
    assert commit() == "unknown"
    git("init")
    git("add", ".gitignore")
    git("commit", "-m", "without the package")
    assert commit() == "unknown"
    git("add", ".")
    git("commit", "-m", "with it")
    head = git("rev-parse", "HEAD")
    assert commit() == head
    (tmp_path / "granugas" / "__init__.py").write_text("")
    assert commit() == f"{head}-dirty"


def test_merge_keeps_what_is_common_and_lists_what_differs():
    runs = [{"package": "p", "parameters": {"seed": 1, "r": r, "snapshots": [1, 2]}} for r in (0.4, 0.8, 0.4)]
    assert merge(runs) == {"package": "p", "parameters": {"seed": 1, "r": [0.4, 0.8], "snapshots": [1, 2]}}


def test_plain_values_are_those_of_json_and_netcdf():
    assert plain({"a": (1.0,), "b": np.array([1, 2]), "c": np.float64(2), "d": [[1, 2], [3]]}) == {
        "a": 1.0,
        "b": [1, 2],
        "c": 2.0,
        "d": [[1, 2], 3],
    }
    assert type(plain(np.array([1.0]))) is float

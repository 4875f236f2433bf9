"""What the README shows works, in any order of imports."""

import subprocess
import sys

import numpy as np
import pytest

import granugas as gg


def test_the_doors_are_functions_whoever_imported_what_before():
    from granugas.equilibrate import equilibrate
    from granugas.simulate import simulate

    assert gg.simulate is simulate
    assert gg.equilibrate is equilibrate
    assert gg.simulate is simulate


def test_the_readme_lines():
    scene = gg.Scene(n_particles=64, area_fraction=0.2267, restitution=0.4, contact_time=1e-5)
    data = gg.simulate(scene, until=0.5, seed=1, progress=False)
    found = gg.find_clusters(data, distance_factors=[1.05, 1.1])
    assert found.sizes["distance_factor"] == 2
    np.testing.assert_allclose(found["mean_cluster_size"] * found["cluster_count"], 64)


def test_a_study_that_is_not_there(tmp_path):
    (tmp_path / "other.nc").touch()
    with pytest.raises(FileNotFoundError, match="there are: other"):
        gg.load_study(tmp_path / "mine.nc")


def test_unknown_names():
    with pytest.raises(AttributeError, match="simulat"):
        gg.simulat  # noqa: B018


def test_importing_is_light():
    heavy = "{'numba', 'xarray', 'matplotlib'}"
    code = f"import sys, granugas, granugas.scene, granugas.studies; print(sorted({heavy} & set(sys.modules)))"
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert said.stdout.strip() == "[]"

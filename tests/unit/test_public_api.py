"""What the README shows works, in any order of imports."""

import subprocess
import sys

import numpy as np
import pytest

import granugas as gg
from granugas.storage.damage import DamagedFile
from granugas.storage.dataset import pool, with_errors, write


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


def test_a_study_is_found_by_name_and_by_path(tmp_path):
    scene = gg.Scene(n_particles=36, area_fraction=0.25, restitution=0.8)
    options = {"samples": {"count": 3}, "keep_positions": False, "progress": False}
    runs = [gg.simulate(scene, until=0.05, realization=k, **options).assign(realization=k) for k in (0, 1)]
    path = tmp_path / "results/studies/mine.nc"
    write(with_errors(pool(runs, ["restitution"])), path)
    study = gg.load_study("mine", output=tmp_path / "results")
    assert study.identical(gg.load_study(path)) and study.identical(gg.load_study(str(path)))
    assert study["kinetic_energy"].dims == ("restitution", "realization", "time")
    assert all(study[name].attrs["long_name"] for name in study.variables)
    np.testing.assert_array_equal(study["kinetic_energy"][0, 1], runs[1]["kinetic_energy"])
    error = abs(runs[0]["kinetic_energy"] - runs[1]["kinetic_energy"]).values / 2
    np.testing.assert_allclose(study["kinetic_energy_error"][0], error)
    with open(path, "rb+") as file:
        file.seek(-1000, 2)
        file.write(b"\x00\x01\x02")
    with pytest.raises(DamagedFile, match=r"mine\.nc is damaged"):
        gg.load_study("mine", output=tmp_path / "results")


def test_a_study_that_is_not_there(tmp_path):
    (tmp_path / "other.nc").touch()
    with pytest.raises(FileNotFoundError, match="there are: other"):
        gg.load_study(tmp_path / "mine.nc")
    with pytest.raises(FileNotFoundError, match=r"studies.mine\.nc: no such study; in .* there are: none"):
        gg.load_study("mine", output=tmp_path)


def test_unknown_names():
    with pytest.raises(AttributeError, match="simulat"):
        gg.simulat  # noqa: B018


def test_importing_is_light():
    heavy = "{'numba', 'xarray', 'matplotlib'}"
    code = f"import sys, granugas, granugas.scene, granugas.studies; print(sorted({heavy} & set(sys.modules)))"
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert said.stdout.strip() == "[]"

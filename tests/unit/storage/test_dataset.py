import json
import os
import subprocess
import sys

import netCDF4
import numpy as np
import pytest
import xarray as xr

from granugas.storage import dataset as storage
from granugas.storage.files import chunk_sizes, replacing


@pytest.fixture
def run(make_run):
    run = make_run()
    run["kinetic_energy"][-1] = np.nan
    return run.drop_vars("trajectory")


def test_read_gives_back_what_was_written(run, tmp_path):
    storage.write(run, tmp_path / "folder" / "run.nc")
    again = storage.read(tmp_path / "folder" / "run.nc")
    xr.testing.assert_equal(again, run)
    assert {name: again[name].dtype for name in ("kinetic_energy", "seed")} == {"kinetic_energy": "f8", "seed": "i8"}
    assert again.attrs["n_particles"] == 5 and again.attrs["lattice"] == "auto"
    assert again["kinetic_energy"].attrs["equation"] == "A Eq. 23, B Eq. 1"


@pytest.mark.parametrize("until_collisions", [False, True])
@pytest.mark.parametrize("contact_time", [1.0e-5, (1.0e-5, 1.0e-4), (1.0e-5,)])
def test_content_is_the_same_in_memory_and_on_disk(make_run, tmp_path, contact_time, until_collisions):
    run = make_run(restitution=1.0, contact_time=contact_time, until_collisions=until_collisions)
    storage.write(run, tmp_path / "run.nc")
    again = storage.read(tmp_path / "run.nc")
    assert storage.content_sha256(again) == again.attrs["content_sha256"] == storage.content_sha256(run)
    storage.write(again, tmp_path / "again.nc")
    assert storage.read(tmp_path / "again.nc").attrs["content_sha256"] == again.attrs["content_sha256"]


def test_content_of_pooled_runs_is_the_same_in_memory_and_on_disk(make_run, tmp_path):
    parts = [make_run(k, n_particles=n, restitution=r) for k, n, r in [(0, 5, 0.4), (1, 5, 0.4), (0, 3, 0.8)]]
    pooled = storage.pool(parts, ["n_particles", "restitution"])
    storage.write(pooled, tmp_path / "study.nc")
    again = storage.read(tmp_path / "study.nc")
    assert storage.content_sha256(again) == again.attrs["content_sha256"] == storage.content_sha256(pooled)
    for i, part in enumerate(parts):
        storage.write(part, tmp_path / f"{i}.nc")
    read = [storage.read(tmp_path / f"{i}.nc") for i in (2, 0, 1)]
    assert storage.content_sha256(storage.pool(read, ["n_particles", "restitution"])) == storage.content_sha256(pooled)


def test_content_leaves_out_times_of_the_machine_and_labels(run):
    other = run.assign(wall_time=-1.0, cpu_time=-1.0)
    other.attrs |= {"provenance": "{}", "history": "today", "content_sha256": "0", "title": "t", "Conventions": "none"}
    assert storage.content_sha256(other) == storage.content_sha256(run)


def test_content_does_not_depend_on_form(run):
    reordered = xr.Dataset({name: run[name] for name in reversed(list(run.data_vars))}, attrs=run.attrs)
    wide = run.assign(kinetic_energy=run["kinetic_energy"].astype(">f8"), seed=run["seed"].astype(np.int16))
    texts = run.assign(stop_reason=run["stop_reason"].astype(object))
    nan = run.copy(deep=True)
    nan["kinetic_energy"][-1] = np.array(0xFFF8000000000001, np.uint64).view(np.float64)
    for form in (reordered, wide, texts, nan, storage.describe(run)):
        assert storage.content_sha256(form) == storage.content_sha256(run)


@pytest.mark.parametrize(
    "change",
    [
        lambda run: run.assign(seed=2),
        lambda run: run.rename_dims(particle="disk"),
        lambda run: run.assign(stop_reason="inelastic_collapse"),
        lambda run: run.assign(kinetic_energy=run["kinetic_energy"] * (1 + 2.3e-16)),
        lambda run: run.assign_coords(time=run["time"] + 1),
        lambda run: run.assign_coords(axis=["x", "z"]),
        lambda run: run.assign_attrs(restitution=0.5),
        lambda run: run.drop_vars("events"),
        lambda run: run.rename(initial_y="elastic_energy_fraction"),
        lambda run: run.transpose("axis", ...),
        lambda run: run.assign(kinetic_energy=run["kinetic_energy"].assign_attrs(window="4 samples")),
    ],
)
def test_content_depends_on_every_value_name_dimension_and_attribute(run, change):
    assert storage.content_sha256(change(run)) != storage.content_sha256(run)


def test_content_knows_whole_numbers_from_real_ones():
    whole, real = xr.Dataset({"events": 0}), xr.Dataset({"events": 0.0})
    assert storage.content_sha256(whole) != storage.content_sha256(real)


def test_content_sees_every_number_of_a_large_variable():
    numbers = np.zeros(storage.BLOCK + 3)
    contents = set()
    for i in (0, storage.BLOCK - 1, storage.BLOCK, storage.BLOCK + 2):
        numbers[:], numbers[i] = 0, 1
        contents.add(storage.content_sha256(xr.Dataset({"initial_y": ("particle", numbers)})))
    assert len(contents) == 4


def test_file_is_labelled_as_cf_wants_it(run, tmp_path):
    storage.write(run, tmp_path / "run.nc", {"until": {"time": 1.0}, "snapshots": (0.1, 0.2)})
    with netCDF4.Dataset(tmp_path / "run.nc") as file:
        assert file.Conventions == "CF-1.11" and file.title and "granugas" in file.history
        assert json.loads(file.provenance)["parameters"] == {"until": {"time": 1.0}, "snapshots": [0.1, 0.2]}
        for name in ("time", "snapshot", "axis"):
            assert "_FillValue" not in file[name].ncattrs()
        assert all("long_name" in variable.ncattrs() for variable in file.variables.values())
        assert file["position"].filters()["zlib"] and file["position"].dtype == np.float64


def test_provenance_that_is_there_stays_without_parameters(run, tmp_path):
    storage.write(run.assign_attrs(provenance='{"package": "granugas 0"}'), tmp_path / "run.nc")
    assert storage.read(tmp_path / "run.nc").attrs["provenance"] == '{"package": "granugas 0"}'
    storage.write(run, tmp_path / "run.nc")
    assert json.loads(storage.read(tmp_path / "run.nc").attrs["provenance"])["parameters"]["restitution"] == 0.4


def test_a_write_that_fails_leaves_the_old_file_and_no_other(run, tmp_path):
    storage.write(run, tmp_path / "run.nc")
    before = (tmp_path / "run.nc").read_bytes()
    with pytest.raises(TypeError):
        storage.write(run.assign_attrs(lattice={"a"} - {"a"}, boundary=object()), tmp_path / "run.nc")
    with pytest.raises(KeyError, match="temperature"):
        storage.write(run.assign(temperature=1.0), tmp_path / "run.nc")
    with pytest.raises(ValueError, match="broken"), replacing(tmp_path / "run.nc") as temporary:
        temporary.write_text("half of")
        assert str(os.getpid()) in temporary.name and temporary.parent == tmp_path
        raise ValueError("broken")
    assert [path.name for path in tmp_path.iterdir()] == ["run.nc"]
    assert (tmp_path / "run.nc").read_bytes() == before


def test_equal_data_give_equal_files_in_any_process(run, tmp_path):
    storage.write(run, tmp_path / "here.nc", {"seed": 1})
    program = """if True:
        import sys
        from granugas.storage import dataset
        dataset.write(dataset.read(sys.argv[1]), sys.argv[2], {"seed": 1})
    """
    for name in ("there.nc", "elsewhere.nc"):
        subprocess.run([sys.executable, "-c", program, tmp_path / "here.nc", tmp_path / name], check=True)
    assert (tmp_path / "there.nc").read_bytes() == (tmp_path / "elsewhere.nc").read_bytes()


def test_how_a_dataset_was_stored_before_does_not_count(run, tmp_path):
    storage.write(run, tmp_path / "run.nc")
    part = storage.read(tmp_path / "run.nc").isel(time=slice(2))
    part["kinetic_energy"].encoding |= {"dtype": "f4", "scale_factor": 0.5}
    storage.write(part, tmp_path / "part.nc")
    xr.testing.assert_equal(storage.read(tmp_path / "part.nc"), run.isel(time=slice(2)))


def test_chunks_keep_the_last_dimensions_together():
    assert chunk_sizes((40, 6, 97776, 2)) == (1, 1, 65536, 2)
    assert chunk_sizes((201, 1000)) == (131, 1000)
    assert chunk_sizes((3, 4)) == (3, 4)
    assert chunk_sizes(()) == ()

"""Datasets as others open them: by the rules of CF 1.11, and with libraries that know nothing of this package."""

import warnings

import netCDF4
import numpy as np
import pandas as pd
import pytest
import xarray as xr
from compliance_checker.runner import CheckSuite

import granugas as gg
from granugas.storage.dataset import pool, with_errors, write, write_positions
from granugas.storage.files import encoding

ACCEPTED = {"Coordinate variable 'time' should have standard_name='time', found: 'None'"}
"""Simulated time has no date: the standard name `time` asks for units `... since <date>`."""

PACKED = {
    "Variable is not of type byte, short, or int as required for different type add_offset/scale_factor.",
    "attribute trajectory_velocity:_QuantizeBitRoundNumberOfSignificantBits should begin with a letter and be composed of "
    "letters, digits, and underscores",
}
"""Of packed positions: unsigned integers, which CF allows since 1.9 and the checker does not know; netCDF's own name."""

TEXTS = ("axis", "lattice")
"""Coordinates of words, along which CF has no order; the checker stumbles over them."""


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """A run, its positions, a study with clusters, snapshots and words in its grid, and one that ends by collisions."""
    folder = tmp_path_factory.mktemp("files")
    options = {"samples": {"count": 5}, "progress": False}
    runs = []
    for lattice in ("auto", "square"):
        for k in (0, 1):
            scene = gg.Scene(n_particles=36, area_fraction=0.25, restitution=0.8, lattice=lattice)
            run = gg.simulate(scene, until=0.1, seed=1, realization=k, snapshots=[0.1], keep_motion=True, **options)
            runs.append(run.assign(realization=k))
    write(runs[0], folder / "run.nc")
    write_positions(runs[0], folder / "positions.nc")
    parts = [run.merge(gg.find_clusters(run, distance_factors=[1.1, 1.4]), combine_attrs="override") for run in runs]
    kept = [part.drop_vars([name for name in part if name.startswith("trajectory")]) for part in parts]
    write(with_errors(pool(kept, ["restitution", "lattice"])), folder / "study.nc")
    scene = gg.Scene(n_particles=36, area_fraction=0.25, restitution=0.8)
    until, options["keep_positions"] = {"collisions_per_particle": 5}, False
    counted = [gg.simulate(scene, until, realization=k, **options).assign(realization=k) for k in (0, 1)]
    write(pool(counted, ["restitution"]), folder / "counted.nc")
    return folder


@pytest.mark.parametrize("name", ["run", "positions", "study", "counted"])
def test_they_keep_to_cf(files, name):
    found, errors = findings(files / f"{name}.nc")
    assert found <= (ACCEPTED | PACKED if name == "positions" else ACCEPTED)
    assert errors <= {"check_coordinate_variables_strict_monotonicity"}  # cannot subtract words


def test_the_rest_of_a_file_with_words_keeps_to_cf(files):
    study = xr.load_dataset(files / "study.nc", decode_times=False).drop_vars(TEXTS)
    study.to_netcdf(files / "numbers.nc", encoding=encoding(study))
    assert findings(files / "numbers.nc") == (ACCEPTED, set())


def test_the_checker_finds_what_is_wrong(files):
    broken = xr.load_dataset(files / "study.nc", decode_times=False)
    broken["kinetic_energy"].attrs["units"] = "lots"
    broken.attrs["Conventions"] = "none"
    broken.to_netcdf(files / "broken.nc")
    found, _ = findings(files / "broken.nc")
    assert any("kinetic_energy" in line for line in found) and any("Conventions" in line for line in found)


@pytest.mark.parametrize("name", ["run", "study", "counted"])
def test_plain_netcdf(files, name):
    with netCDF4.Dataset(files / f"{name}.nc") as file:
        for variable in file.variables.values():
            assert variable.long_name and (variable.dtype is str or variable.units)
        energy = file["kinetic_energy"]
        assert energy.dimensions[-1] == "time" and energy.units == "1" and energy.equation == "A Eq. 23, B Eq. 1"
        assert np.ma.allclose(energy[..., 0], 1.0) and energy[..., -1].max() < 1


@pytest.mark.parametrize("name", ["run", "positions", "study", "counted"])
def test_xarray_with_its_defaults(files, name):
    """No time becomes a date, nothing is to be warned of."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with xr.open_dataset(files / f"{name}.nc") as data:
            times = [key for key in data.variables if data[key].attrs.get("units") == "s"]
            assert times or name == "positions"
            assert all(data[key].dtype.kind == "f" for key in times)
            xr.testing.assert_equal(data.load(), xr.load_dataset(files / f"{name}.nc", decode_times=False))


def test_pandas(files):
    study = gg.load_study(files / "study.nc")
    table = study["kinetic_energy"].to_dataframe()
    assert table.index.names == ["restitution", "lattice", "realization", "time"] and len(table) == 2 * 2 * 6
    assert table["kinetic_energy"].notna().all()
    table.to_csv(files / "study.csv")
    again = pd.read_csv(files / "study.csv", index_col=table.index.names)
    pd.testing.assert_frame_equal(again[["kinetic_energy"]], table[["kinetic_energy"]], check_index_type=False)


def findings(path):
    """What CF 1.11 has against a file, and which of its checks broke off."""
    suite = CheckSuite()
    suite.load_all_available_checkers()
    with suite.load_dataset(str(path)) as file:
        ((results, errors),) = suite.run_all(file, ["cf:1.11"]).values()
    failed = [result for result in results if np.diff(result.value)[0] > 0]
    return {line for result in failed for line in result.msgs}, {*errors}

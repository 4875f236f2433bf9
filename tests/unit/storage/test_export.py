"""Snapshots as extended XYZ, read back with the library of the format."""

import sys

import numpy as np
import pytest
from extxyz import read_dicts

import granugas as gg
from granugas.__main__ import main
from granugas.storage.dataset import pool, write

TIMES = [0.1, 0.2]


@pytest.fixture
def bed(make_run):
    """A run of disks of two sizes between two walls, as the simulation hands it over; one of them has not collided yet."""
    rng = np.random.default_rng(1)
    run, frequency = make_run(n_particles=40, boundary="periodic wall"), rng.random((2, 40))
    frequency[0, 7] = np.nan
    return run.assign(
        velocity=run["position"].copy(data=rng.normal(size=(2, 40, 2))),
        particle_diameter=("particle", rng.choice([1e-3, 2e-3], 40)),
        particle_mass=("particle", rng.random(40)),
        collision_frequency=(("snapshot", "particle"), frequency),
    )


def test_every_particle_comes_back_to_the_last_bit(bed, tmp_path):
    assert gg.export_snapshots(bed, tmp_path / "new/bed.xyz") == 2
    frames = read_dicts(tmp_path / "new/bed.xyz")
    assert [frame.info["time"] for frame in frames] == TIMES
    box = [bed.attrs["box_x"], bed.attrs["box_y"], bed.attrs["diameter"]]
    for k, frame in enumerate(frames):
        assert frame.natoms == 40 and set(frame.arrays["species"]) == {"X"}
        np.testing.assert_array_equal(frame.cell, np.diag(box))
        assert frame.pbc.tolist() == [True, False, False]
        for column, name in (("pos", "position"), ("velo", "velocity")):
            np.testing.assert_array_equal(frame.arrays[column][:, :2], bed[name].values[k])
            assert not frame.arrays[column][:, 2].any()
        np.testing.assert_array_equal(2 * frame.arrays["radius"], bed["particle_diameter"])
        np.testing.assert_array_equal(frame.arrays["mass"], bed["particle_mass"])
        np.testing.assert_array_equal(frame.arrays["initial_y"], bed["initial_y"])
        np.testing.assert_array_equal(frame.arrays["id"], np.arange(40) + 1)
    assert ["collision_frequency" in frame.arrays for frame in frames] == [False, True]  # there is no way to write NaN


@pytest.mark.parametrize("dimensions", [1, 3])
def test_beads_and_spheres(make_run, tmp_path, dimensions):
    rng, axes = np.random.default_rng(2), ["x", "y", "z"][:dimensions]
    run = make_run(boundary="periodic").drop_vars(["position", "trajectory", "axis"]).assign_attrs(box_z=2.5)
    run = run.assign(position=(("snapshot", "particle", "axis"), rng.random((2, 5, dimensions)))).assign_coords(axis=axes)
    assert gg.export_snapshots(run, tmp_path / "run.xyz", time=0.2) == 1
    frame = read_dicts(tmp_path / "run.xyz")
    np.testing.assert_array_equal(frame.arrays["pos"][:, :dimensions], run["position"].values[1])
    assert frame.pbc.sum() == dimensions and frame.arrays["pos"].shape == (5, 3)
    assert frame.cell[2, 2] == (2.5 if dimensions == 3 else run.attrs["diameter"])
    assert (frame.arrays["radius"] == run.attrs["diameter"] / 2).all() and "velo" not in frame.arrays


def test_kept_positions_are_frames_where_there_are_no_snapshots(make_run, tmp_path):
    run = make_run(samples=4).drop_vars("position").drop_dims("snapshot")
    assert gg.export_snapshots(run, tmp_path / "run.xyz") == 4
    assert [frame.info["time"] for frame in read_dicts(tmp_path / "run.xyz")] == run["time"].values.tolist()


def test_one_run_of_a_study(make_run, tmp_path):
    parts = [make_run(k, n_particles=n) for n in (5, 3) for k in (0, 1)]
    study = pool(parts, ["n_particles"])
    gg.export_snapshots(study.sel(n_particles=3, realization=1), tmp_path / "one.xyz", time=0.2)
    frame = read_dicts(tmp_path / "one.xyz")
    np.testing.assert_array_equal(frame.arrays["pos"][:, :2], parts[3]["position"].values[1])
    assert frame.cell[0, 0] == 3.0
    with pytest.raises(ValueError, match="several runs, select one of them along n_particles, realization"):
        gg.export_snapshots(study, tmp_path / "all.xyz")


def test_from_the_shell(bed, tmp_path, capsys):
    write(bed, tmp_path / "bed.nc")
    words = ["export", str(tmp_path / "bed.nc"), str(tmp_path / "out.xyz")]
    assert main([*words, "--snapshot", "0.2"]) == 0
    assert capsys.readouterr().out == f"{tmp_path / 'out.xyz'}: 1 frame\n"
    assert read_dicts(tmp_path / "out.xyz").info["time"] == 0.2
    assert main(words) == 0 and "2 frames" in capsys.readouterr().out
    assert main([*words, "--snapshot", "0.07"]) == 2
    assert "snapshot = 0.07: there is none at this time; there are 0.1, 0.2 s" in capsys.readouterr().err


def test_what_cannot_be_exported(bed, tmp_path, monkeypatch):
    nothing = bed.drop_dims("snapshot").drop_vars("trajectory")
    with pytest.raises(ValueError, match="kept no positions"):
        gg.export_snapshots(nothing, tmp_path / "out.xyz")
    monkeypatch.setitem(sys.modules, "extxyz", None)
    with pytest.raises(ValueError, match="the package extxyz is missing; `pip install granugas"):
        gg.export_snapshots(bed, tmp_path / "out.xyz")
    assert not list(tmp_path.iterdir())

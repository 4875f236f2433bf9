import netCDF4
import numpy as np
import pytest
import xarray as xr

from granugas.storage.positions import LEVELS, read_positions, write_positions


def run_of(trajectory, box=(3.0, 0.7), **variables):
    return xr.Dataset(
        {"trajectory": (("time", "particle", "axis"), trajectory), "kinetic_energy": ("time", np.ones(len(trajectory)))}
        | variables,
        {"time": np.arange(len(trajectory)) * 0.5, "axis": ["x", "y"]},
        {"box_x": box[0], "box_y": box[1], "diameter": 0.002},
    )


def test_positions_come_back_within_a_step_of_the_packing(tmp_path):
    trajectory = np.random.default_rng(1).random((7, 50, 2)) * [3.0, 0.7]
    write_positions(run_of(trajectory), tmp_path / "positions.nc")
    with read_positions(tmp_path / "positions.nc") as found:
        assert found["trajectory"].dtype == np.float64 and found["trajectory"].dims == ("time", "particle", "axis")
        assert found["trajectory"].attrs["units"] == "m" and found.attrs["Conventions"] == "CF-1.11"
        assert found.attrs["box_x"] == 3.0 and found.attrs["box_y"] == 0.7 and found.attrs["diameter"] == 0.002
        assert found["time"].values.tolist() == [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0]
        assert set(found.data_vars) == {"trajectory"}
        for step, expected in zip(found["trajectory"], trajectory, strict=True):
            assert np.abs(step.values - expected).max() <= 1.01 * 3.0 / LEVELS


@pytest.mark.parametrize("box", [(3.0, 0.7), (0.7, 3.0), (0.1 + 0.2, 0.3), (1.0, 0.5), (7.3e-2, 7.3e-2), (2.0**32 - 1, 2.0)])
def test_positions_stay_inside_of_the_box(tmp_path, box):
    edges = np.array([[0.0, 0.0], np.nextafter(box, 0), box, np.array(box) * (1 - 1e-11)])
    write_positions(run_of(edges[None], box), tmp_path / "positions.nc")
    with read_positions(tmp_path / "positions.nc") as found:
        positions = found["trajectory"].values[0]
    assert ((positions >= 0) & (positions < box)).all()
    assert np.abs(positions - edges).max() <= 2.01 * max(box) / LEVELS


def test_after_the_end_of_a_run_there_is_nothing(tmp_path):
    trajectory = np.random.default_rng(1).random((3, 4, 2)) * 0.5
    trajectory[2] = np.nan
    write_positions(run_of(trajectory, sampling_time=("time", [0.0, 0.1, np.nan])), tmp_path / "positions.nc")
    with read_positions(tmp_path / "positions.nc") as found:
        assert np.isnan(found["trajectory"][2]).all() and not np.isnan(found["trajectory"][:2]).any()
        assert np.isnan(found["sampling_time"][2]) and found["sampling_time"][1] == 0.1


def test_a_number_takes_four_bytes_and_a_time_step_lies_together(tmp_path):
    trajectory = np.random.default_rng(1).random((8, 20000, 2)) * 0.5
    write_positions(run_of(trajectory), tmp_path / "positions.nc")
    assert (tmp_path / "positions.nc").stat().st_size < 1.05 * 4 * trajectory.size
    with netCDF4.Dataset(tmp_path / "positions.nc") as file:
        assert file["trajectory"].dtype == np.uint32 and file["trajectory"].chunking() == [3, 20000, 2]


def test_opening_reads_no_positions(tmp_path):
    write_positions(run_of(np.zeros((4, 30, 2))), tmp_path / "positions.nc")
    with read_positions(tmp_path / "positions.nc") as found:
        step = found["trajectory"][1]
        step.load()
        assert not found["trajectory"].variable._in_memory


@pytest.mark.parametrize("outside", [[-1e-9, 0.1], [0.1, 0.7001], [3.1, 0.1]])
def test_a_position_outside_of_the_box_is_refused(tmp_path, outside):
    with pytest.raises(ValueError, match=r"allowed is \[0, 3\) x \[0, 0\.7\) m"):
        write_positions(run_of(np.array([[outside]])), tmp_path / "positions.nc")
    assert list(tmp_path.iterdir()) == []


def test_runs_without_positions_or_box_are_refused(tmp_path):
    run = run_of(np.zeros((1, 2, 2)))
    with pytest.raises(KeyError, match="trajectory"):
        write_positions(run.drop_vars("trajectory"), tmp_path / "positions.nc")
    del run.attrs["box_y"]
    with pytest.raises(KeyError, match="box_y"):
        write_positions(run, tmp_path / "positions.nc")


def test_motion_is_kept_rounded(tmp_path):
    rng = np.random.default_rng(1)
    velocity = rng.normal(size=(5, 3000, 2)) * 10.0 ** -rng.integers(0, 30, (5, 3000, 1))
    collisions = rng.integers(0, 10**6, (5, 3000)).astype(np.int32)
    motion = {
        "trajectory_velocity": (("time", "particle", "axis"), velocity.astype(np.float32)),
        "trajectory_collisions": (("time", "particle"), collisions),
    }
    write_positions(run_of(rng.random((5, 3000, 2)) * 0.5, **motion), tmp_path / "positions.nc")
    with read_positions(tmp_path / "positions.nc") as found:
        np.testing.assert_allclose(found["trajectory_velocity"], velocity, rtol=1e-3)
        assert np.any(abs(found["trajectory_velocity"] - velocity) > 1e-5 * abs(velocity))  # rounded, so smaller
        np.testing.assert_array_equal(found["trajectory_collisions"], collisions)
        assert found["trajectory_velocity"].attrs["units"] == "m s-1"


def test_different_diameters_are_kept(tmp_path):
    diameters = [0.002, 0.003, 0.001]
    write_positions(run_of(np.full((2, 3, 2), 0.5), particle_diameter=("particle", diameters)), tmp_path / "positions.nc")
    with read_positions(tmp_path / "positions.nc") as found:
        assert found["particle_diameter"].values.tolist() == diameters

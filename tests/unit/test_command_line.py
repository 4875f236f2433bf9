"""The package from the shell."""

import json

import pytest

from granugas.__main__ import main
from granugas.storage.dataset import read


def test_run_writes_a_dataset(tmp_path, capsys):
    path = tmp_path / "run.nc"
    words = ["run", "--n", "42", "--restitution", "0.9", "--time", "0.1", "--samples", "5", "--seed", "4"]
    assert main([*words, "--snapshots", "0.1", "--output", str(path)]) == 0
    data = read(path)
    assert data.sizes == {"time": 6, "snapshot": 1, "particle": 42, "axis": 2}
    assert data.attrs["restitution"] == 0.9
    assert "42 particles" in capsys.readouterr().out


def test_bench_prints_one_line_of_json(capsys):
    assert main(["bench", "--n", "100", "--restitution", "1", "--contact-time", "0", "--collisions", "5000"]) == 0
    said = json.loads(capsys.readouterr().out)
    assert said["collisions"] == 5000
    assert 10 < said["ns_per_collision"] < 1e5
    assert 50 < said["bytes_per_particle"] < 2000
    assert said["compile_s"] > 0


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["run", "--time", "1", "--restitution", "1.2"], "restitution = 1.2: allowed is a number >= 0 and <= 1"),
        (["run", "--time", "1", "--contact-time", "-1"], "contact_time = -1.0: allowed is a number >= 0"),
        (["run", "--time", "-1"], "until.time = -1.0: allowed is a positive number"),
        (["run"], "name --time or --collisions-per-particle"),
        (["run", "--time", "1", "--n", "5", "--area-fraction", "0.6"], "5 disks fit on a lattice up to"),
        (["bench", "--n", "0"], "n_particles = 0: allowed is an integer from 1"),
        (["bench", "--lattice", "hexagonal"], "allowed are auto, triangular, square"),
    ],
)
def test_wrong_values_end_in_one_line(words, said, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(words) == 2
    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == 1
    assert not list(tmp_path.iterdir())

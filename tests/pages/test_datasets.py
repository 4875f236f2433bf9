"""Datasets open with the tool that netCDF itself brings."""

import subprocess

from bands import made_up_run, source_of


def test_ncdump_opens_datasets(tmp_path):
    source = source_of(made_up_run(8, [0, 1.0, 2.0]), tmp_path, "run")
    for path, variables in (
        (source.positions, ("uint trajectory(time, particle, axis)", "float trajectory_velocity(time, particle, axis)")),
        (source.run, ("double kinetic_energy(time)", 'kinetic_energy:symbol = "K = E/E(0) (A: T)"')),
        (source.clusters, ("double cluster_count(distance_factor, time)", 'cluster_count:units = "1"')),
    ):
        said = subprocess.run(["ncdump", "-h", path], capture_output=True, text=True, check=True).stdout
        assert ':Conventions = "CF-1.11"' in said and all(variable in said for variable in variables)

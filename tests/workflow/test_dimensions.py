"""One study of beads, disks and spheres goes through the whole chain, side by side in one dataset."""

import numpy as np
from workflow.project import Project

from granugas.storage.dataset import read

STUDY = {
    "grid": {"n_particles": 64, "area_fraction": 0.2, "restitution": 0.8, "dimensions": [1, 2, 3]},
    "until": {"time": 0.02},
    "samples": {"count": 5},
    "snapshots": [0.01],
    "distance_factors": [1.05, 1.2],
}


def test_beads_disks_and_spheres(project: Project) -> None:
    project.configure(studies={"spaces": STUDY}, figures=["study_spaces"])
    project.build("--", "all", "check")
    results = project.folder / "results"
    data = read(results / "studies/spaces.nc")
    assert data["dimensions"].values.tolist() == [1, 2, 3]
    assert data.sizes["axis"] == 3
    there = data["position"].notnull().all("particle").squeeze()
    np.testing.assert_array_equal(there.transpose("dimensions", "axis"), np.tri(3, dtype=bool))
    np.testing.assert_array_equal(data["kinetic_energy_z"].notnull().squeeze().any("time"), [False, False, True])
    assert data["cluster_count"].notnull().all()
    assert (results / "checks.txt").read_text() == "1 studies, no finding\n"
    assert {path.name[:3] for path in (results / "runs").glob("*.nc")} == {"d1_", "n64", "d3_"}
    assert (results / "figures/study_spaces.png").stat().st_size > 5000

import os
import subprocess
import sys

import yaml
from workflow.project import ROOT

from granugas.explored import explored
from granugas.studies import load

SCHEMA = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text())


def test_first_realizations_whose_positions_are_kept():
    common = {"until": {"time": 1.0}, "distance_factors": [1.1], "realizations": 2}
    alone = {"grid": {"n_particles": 100, "restitution": 0.9, "contact_time": 1.0e-5}}
    studies = {
        "scan": common | {"grid": {"n_particles": [100, 200], "restitution": [0.9, 0.6], "contact_time": 1.0e-5}},
        "still": {"until": {"time": 1.0}},
        "space": common | {"scene": {"dimensions": 3}},
        "again": common | alone,
        "filmed": {"until": {"time": 2.0}},
    }
    found = load({"studies": studies, "animations": {"film": {"study": "filmed"}}}, SCHEMA)
    shown = explored(found)
    scan = ["scan, n_particles = 100, restitution = 0.9", "scan, n_particles = 100, restitution = 0.6"]
    scan += ["scan, n_particles = 200, restitution = 0.9", "scan, n_particles = 200, restitution = 0.6"]
    assert [one.label for one in shown] == ["filmed", *scan]  # what is filmed comes first, a shared run comes once
    assert all(one.run.realizations == (0,) and one.run.keep_positions for one in shown)
    assert shown[0].clusters is None
    assert all(found.clusters()[one.clusters][0] == one.run for one in shown[1:])


def test_importing_is_light():
    code = "import sys, granugas.explored; print(*{'numpy', 'numba', 'xarray', 'matplotlib'} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=os.environ, check=True)
    assert done.stdout.strip() == ""

"""The kernels as plain Python with checked indices (NUMBA_DISABLE_JIT=1) do bit for bit what the compiled ones do.

Run as a program, this file writes the engine's arrays after some thousand events; the test lets it run in both modes.
"""

import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from gases import lattice_gas

from granugas.dynamics import engine_of
from granugas.dynamics.events.memory import COMPILED, Table, allocate
from granugas.scene import Scene

SCENES = {
    "elastic dense": Scene(42, 0.7, restitution=1.0, contact_time=0.0),
    "elastic dilute": Scene(42, 0.01, restitution=1.0, contact_time=0.0),
    "shares": Scene(64, 0.25, restitution=1.0, contact_time=(1e-5, 1e-3)),
    "contact time": Scene(64, 0.5, restitution=0.4, contact_time=1e-5),
    "elongated": Scene(64, 0.25, restitution=0.9, contact_time=0.0, aspect_ratio=8.0),
    "rough": Scene(64, 0.25, restitution=0.8, contact_time=1e-5, tangential_restitution=0.5, friction=0.3),
    "bidisperse": Scene(64, 0.3, restitution=0.8, contact_time=1e-5, sizes="bidisperse", size_ratio=1.5),
    "heated": Scene(64, 0.25, restitution=0.9, contact_time=0.0, heating=5.0),
    "shaken": Scene(
        64,
        0.25,
        restitution=0.8,
        contact_time=1e-4,
        boundary="periodic wall",
        wall_restitution=0.9,
        wall_contact_time=1e-4,
        gravity=9.81,
        floor="harmonic",
        floor_amplitude=1e-3,
        floor_frequency=40.0,
    ),
    "two": Scene(2, 0.3, restitution=1.0, contact_time=0.0),
    "spheres": Scene(64, 0.3, restitution=0.8, contact_time=1e-5, dimensions=3),
    "beads": Scene(64, 0.3, restitution=0.95, contact_time=1e-5, dimensions=1),
    "viscoelastic, rotated, kicked": Scene(
        64,
        0.4,
        contact_time=0.0,
        material="viscoelastic",
        viscosity=0.5,
        critical_distance=1e-5,
        rotation_angle=5.0,
        kick_velocity=0.1,
        kick_energy=1e-3,
    ),
    "spheres turned in space": Scene(64, 0.2, restitution=0.8, contact_time=0.0, dimensions=3, rotation_angle=5.0),
    "plastic, with modes": Scene(
        64,
        0.4,
        restitution=0.9,
        contact_time_exponent=0.5,
        contact_velocity=0.1,
        material="plastic",
        yield_velocity=0.1,
        internal_modes=2,
        mode_damping=100.0,
    ),
    "soft": Scene(64, 0.5, restitution=0.8, contact_time=1e-3, steps_per_contact=10, dynamics="soft_spheres"),
    "soft spheres between walls": Scene(
        64,
        0.4,
        restitution=0.8,
        contact_time=1e-3,
        steps_per_contact=10,
        dynamics="soft_spheres",
        dimensions=3,
        boundary="periodic wall wall",
        wall_restitution=0.7,
    ),
    "soft beads": Scene(
        64, 0.5, restitution=0.8, contact_time=1e-3, steps_per_contact=10, dynamics="soft_spheres", dimensions=1
    ),
}
COLLISIONS = 400


def after_some_collisions(scene: Scene) -> dict[str, np.ndarray]:
    """The whole state of the dynamics; the engine looks ahead as it does for large systems, which changes nothing."""
    engine = engine_of(scene, lattice_gas(scene))
    if "calendar" in engine.arrays:
        engine.arrays["calendar"]["look_ahead"] = 1
    engine.advance(math.inf, COLLISIONS)
    return engine.arrays


def write_all(folder: Path) -> None:
    """One file a scene."""
    for name, scene in SCENES.items():
        np.savez(folder / f"{name}.npz", **after_some_collisions(scene))


@pytest.fixture(scope="module")
def plain(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("plain")
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1", "PYTHONPATH": str(Path(__file__).parents[2])}
    subprocess.run([sys.executable, "-W", "error", __file__, str(folder)], check=True, env=environment, timeout=600)
    return folder


@pytest.mark.skipif(not COMPILED, reason="compares the other mode with this one")
@pytest.mark.parametrize("name", SCENES)
def test_both_modes_agree_bit_for_bit(plain, name):
    compiled = after_some_collisions(SCENES[name])
    with np.load(plain / f"{name}.npz") as other:
        assert set(other) == set(compiled)
        for table, rows in compiled.items():
            if table != "near":  # scratch
                for field in rows.dtype.names:  # the rest of a row, up to its cache line, means nothing
                    assert rows[field].tobytes() == other[table][field].tobytes(), (table, field)


def test_other_tests_pass_in_plain_python_without_a_warning():
    """Cells, flight, prediction and collisions, and a part of the comparison with brute force."""
    tests = Path(__file__).parents[2]
    files = [Path(__file__).parent / f"test_{name}.py" for name in ("cells", "collisions", "flight", "predict")]
    brute = [f"test_many_disks[{nu}-0.4-1e-05-42]" for nu in (0.01, 0.25, 0.85)]
    brute += [f"test_few_disks[0.25-{r}-{t_c}-{n}]" for n in (2, 3, 5) for r in (1.0, 0.4, 0.0) for t_c in (0.0, 0.001)]
    chosen = [*map(str, files), *(f"{tests / 'validation' / 'test_brute_force.py'}::{name}" for name in brute)]
    command = [sys.executable, "-m", "pytest", "-q", "-W", "error::RuntimeWarning", "-p", "no:cacheprovider", *chosen]
    done = subprocess.run(
        command, capture_output=True, text=True, env=os.environ | {"NUMBA_DISABLE_JIT": "1"}, cwd=tests.parent
    )
    assert done.returncode == 0, done.stdout


def test_columns_check_their_indices_in_plain_python():
    code = (
        "import numpy as np; from granugas.dynamics.events.memory import Table;"
        "t = Table(np.zeros(3, [('x', 'f8')])); t.x[2] = 1.0;"
        "import sys\n"
        "for k in (-1, 3):\n"
        "    try: t.x[k]\n"
        "    except IndexError as error: print(error)\n"
    )
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1"}
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment, check=True)
    assert said.stdout.splitlines() == ["x[-1] of 3 rows", "x[3] of 3 rows"]


def test_tables_begin_with_a_cache_line():
    for count in (1, 7, 1000):
        rows = allocate(count, np.dtype([("x", "f8"), ("k", "i4")]))
        assert rows.ctypes.data % 64 == 0
        assert len(rows) == count
        assert not rows["x"].any()
        assert Table(rows).address == rows.ctypes.data


if __name__ == "__main__":
    write_all(Path(sys.argv[1]))

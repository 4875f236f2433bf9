"""Wherever a write is cut off, what was there before stays, and the next write is whole."""

import os
import resource
import signal
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure

from granugas.build import claim
from granugas.plotting.animation import render
from granugas.plotting.style import save
from granugas.storage.checkpoint import Checkpoint
from granugas.storage.dataset import write, write_positions
from granugas.storage.files import replacing

ROOT = Path(__file__).resolve().parents[3]
KINDS = ("run.nc", "positions.nc", "figure.png", "figure.pdf", "run.npz", "table.csv", "film.mp4")
OLD = b"what was there before"


def film() -> xr.Dataset:
    rng = np.random.default_rng(1)
    motion = {
        "trajectory": (("time", "particle", "axis"), rng.random((3, 20, 2))),
        "trajectory_velocity": (("time", "particle", "axis"), rng.random((3, 20, 2))),
    }
    scene = {"box_x": 1.0, "box_y": 1.0, "diameter": 0.05, "n_particles": 20, "restitution": 0.5, "contact_time": 1e-5}
    return xr.Dataset(motion, {"time": [0.1, 0.2, 0.4], "axis": ["x", "y"]}, scene)


def draw(path: Path) -> None:
    figure = Figure()
    figure.subplots().plot(np.random.default_rng(1).random(500))
    save(figure, path)


def writer(name: str, make_run: Callable[[], xr.Dataset]) -> Callable[[Path], None]:
    """The function that writes this kind of file."""
    if name == "run.nc":
        return partial(write, make_run())
    if name == "positions.nc":
        return partial(write_positions, make_run().assign_attrs(box_x=1.0, box_y=1.0))
    if name == "film.mp4":
        return partial(render, film())
    if name.startswith("figure"):
        return draw
    if name == "run.npz":
        return lambda path: Checkpoint(path, "physics").save({"disks": np.arange(5000.0)})

    def table(path: Path) -> None:
        with replacing(path) as temporary:
            make_run()["trajectory"].to_dataframe().to_csv(temporary)

    return table


def in_a_child(action: Callable[[], None], most: int, deadly: bool, die_at_the_end: bool = False) -> int:
    """Do it where no file may be larger than `most` bytes: the end of the process (see os.waitstatus_to_exitcode)."""
    pid = os.fork()
    if pid:
        return os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
    code = 1
    try:
        signal.signal(signal.SIGXFSZ, signal.SIG_DFL if deadly else signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))
        if die_at_the_end:
            os.replace = lambda *_: os.kill(os.getpid(), signal.SIGKILL)
        action()
        code = 0
    except OSError:
        code = 2
    finally:
        os._exit(code)


@pytest.mark.parametrize("name", KINDS)
def test_a_write_that_is_cut_off_leaves_what_was_there(name: str, make_run, tmp_path: Path) -> None:
    action, path = writer(name, make_run), tmp_path / "kind" / name
    action(path)
    size = path.stat().st_size
    path.write_bytes(OLD)
    for share in (0.0, 0.01, 0.3, 0.6, 0.9, 0.999):
        for deadly in (True, False):
            end = in_a_child(partial(action, path), int(share * size), deadly)
            assert end != 0 or name == "run.npz", "a file that is not whole was taken for one"  # a run outlives its checkpoint
            assert path.read_bytes() == OLD
    assert in_a_child(partial(action, path), resource.RLIM_INFINITY, True, die_at_the_end=True) == -signal.SIGKILL
    assert path.read_bytes() == OLD and len(list(path.parent.iterdir())) > 1
    claim(tmp_path)
    assert list(path.parent.iterdir()) == [path]
    action(path)
    assert path.stat().st_size == size


def test_nothing_is_written_but_under_another_name_first() -> None:
    """Each line of the package and of the scripts that writes a file stands below `replacing`; logs and marks do not count."""
    writes = (".to_netcdf(", ".to_csv(", ".savefig(", ".write_text(", "write_frames(", "np.savez(", ".write_bytes(")
    paths = [*ROOT.glob("src/granugas/**/*.py"), *ROOT.glob("workflow/**/*.py")]
    found = 0
    for path in paths:
        lines = path.read_text().splitlines()
        for k, line in enumerate(lines):
            if any(write in line for write in writes):
                found += 1
                assert any("replacing(" in before for before in lines[max(0, k - 5) : k + 1]), f"{path}:{k + 1}"
    assert found >= 8


def test_an_error_says_which_file_and_how_much_room_there_is(tmp_path: Path) -> None:
    said = r"a/run\.nc: not written \(\[Errno 28\] No space left on device; \d+ MB are free\)$"
    with pytest.raises(OSError, match=said), replacing(tmp_path / "a/run.nc"):
        raise OSError(28, "No space left on device")
    assert list((tmp_path / "a").iterdir()) == []

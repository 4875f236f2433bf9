"""Checkpoints: whole, of one's own version, or not taken."""

import time

import numpy as np
import pytest

from granugas.storage import checkpoint
from granugas.storage.checkpoint import Checkpoint

DISKS = np.array([(1.5, 7), (np.nan, -1)], [("x", "f8"), ("partner", "i4")])


@pytest.fixture
def saved(tmp_path):
    kept = Checkpoint(tmp_path / "checkpoints/run.npz", "physics")
    kept.save({"disks": DISKS, "done": np.array(3)})
    return tmp_path / "checkpoints/run.npz"


def test_what_is_saved_comes_back_bit_for_bit(saved):
    found = Checkpoint(saved, "physics").load()
    assert found.keys() == {"disks", "done"}
    assert found["disks"].tobytes() == DISKS.tobytes() and found["disks"].dtype == DISKS.dtype
    assert int(found["done"]) == 3
    assert [path.name for path in saved.parent.iterdir()] == ["run.npz"]


def test_the_last_one_counts_and_goes_when_the_run_is_done(saved):
    kept = Checkpoint(saved, "physics")
    kept.save({"done": np.array(4)})
    assert int(kept.load()["done"]) == 4
    kept.remove()
    kept.remove()
    assert kept.load() is None


def test_another_version_is_not_taken(saved, caplog):
    assert Checkpoint(saved, "other physics").load() is None
    assert caplog.messages == ["checkpoint run.npz: it belongs to another version of the program; the run begins again"]


@pytest.mark.parametrize("part", [0.0, 0.02, 0.5, 0.98])
def test_half_a_file_is_not_taken(saved, caplog, part):
    content = saved.read_bytes()
    saved.write_bytes(content[: int(part * len(content))])
    assert Checkpoint(saved, "physics").load() is None
    assert "it is damaged" in caplog.text


def test_no_garbled_byte_is_believed(saved):
    """A byte that is not where it should be is noticed, or does not matter."""
    content = saved.read_bytes()
    for place in range(0, len(content), 7):
        garbled = bytearray(content)
        garbled[place] ^= 0xFF
        saved.write_bytes(garbled)
        found = Checkpoint(saved, "physics").load()
        assert found is None or (found["disks"].tobytes() == DISKS.tobytes() and int(found["done"]) == 3)


def test_a_disk_that_is_full_costs_the_checkpoint_and_not_the_run(saved, caplog, monkeypatch):
    def full(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(np, "savez", full)
    Checkpoint(saved, "physics").save({"done": np.array(5)})
    (said,) = caplog.messages
    assert said.startswith("no checkpoint: ") and "run.npz: not written ([Errno 28] No space left on device; " in said
    assert int(Checkpoint(saved, "physics").load()["done"]) == 3
    assert len(list(saved.parent.iterdir())) == 1


def test_it_is_due_from_time_to_time_and_not_more_often_than_writing_allows(tmp_path, monkeypatch):
    now = [100.0]
    monkeypatch.setattr(checkpoint.time, "monotonic", lambda: now[0])
    kept = Checkpoint(tmp_path / "run.npz", "physics", every=60.0)
    assert not kept.is_due
    now[0] += 60.0
    assert kept.is_due
    kept.save({})
    assert not kept.is_due

    def slow(*_, **__):
        now[0] += 9.0

    monkeypatch.setattr(np, "savez", slow)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(checkpoint, "replacing", lambda path: _nowhere(path))
        kept.save({})
    now[0] += 179.0
    assert not kept.is_due
    now[0] += 2.0
    assert kept.is_due
    assert time.monotonic() == now[0]


class _nowhere:
    def __init__(self, path):
        self.path = path.with_name("unused")

    def __enter__(self):
        return self.path

    def __exit__(self, *_):
        self.path.unlink(missing_ok=True)

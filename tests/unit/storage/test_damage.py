"""Files that were cut off or garbled are told, and never read as something else."""

import os
from pathlib import Path

import pytest

from granugas.storage.damage import DamagedFile, check, is_complete, reading
from granugas.storage.dataset import (
    content_sha256,
    describe,
    read,
    read_by_name,
    read_or_make,
    read_positions,
    write,
    write_positions,
)

BOX = {"box_x": 1.0, "box_y": 1.0}


@pytest.fixture
def stored(make_run, tmp_path: Path) -> Path:
    write(make_run(), tmp_path / "run.nc")
    return tmp_path / "run.nc"


@pytest.fixture
def positions(make_run, tmp_path: Path) -> Path:
    write_positions(make_run().assign_attrs(BOX), tmp_path / "positions.nc")
    return tmp_path / "positions.nc"


def test_every_missing_byte_is_seen_at_a_glance(stored: Path, positions: Path) -> None:
    for path in (stored, positions):
        assert is_complete(path)
        size = path.stat().st_size
        for length in (size - 1, size // 2, 52, 51, 8, 0):
            os.truncate(path, length)
            assert not is_complete(path)


def test_another_kind_of_file_is_not_complete(tmp_path: Path) -> None:
    (tmp_path / "text.nc").write_text("no numbers here" * 10)
    assert not is_complete(tmp_path / "text.nc")
    with pytest.raises(DamagedFile, match=r"text\.nc is damaged .*; the same command makes it again$"):
        read(tmp_path / "text.nc")
    with pytest.raises(FileNotFoundError):
        read(tmp_path / "none.nc")


@pytest.mark.parametrize("step", [7, pytest.param(1, marks=pytest.mark.full)])
def test_no_garbled_byte_is_believed(stored: Path, positions: Path, step: int) -> None:
    for path in (stored, positions):
        content, other = path.read_bytes(), path.with_name("garbled.nc")
        for place in range(0, len(content), step):
            other.write_bytes(content[:place] + bytes([content[place] ^ 0xFF]) + content[place + 1 :])
            with pytest.raises(DamagedFile):
                check(other)
    for reader in (read, read_positions):
        with pytest.raises(DamagedFile, match="its bytes are not those of its seal"):
            reader(other)


def test_files_without_a_seal_are_read_as_they_are(make_run, tmp_path: Path) -> None:
    describe(make_run()).to_netcdf(tmp_path / "run.nc", engine="netcdf4")
    assert content_sha256(read(tmp_path / "run.nc")) == content_sha256(make_run())
    tmp_path.joinpath("run.nc").write_bytes(tmp_path.joinpath("run.nc").read_bytes() + b"more")
    with pytest.raises(DamagedFile):
        read(tmp_path / "run.nc")


def test_studies_are_checked_before_figures_read_them(stored: Path) -> None:
    assert read_by_name([stored])["run"].attrs["content_sha256"] == read(stored).attrs["content_sha256"]
    os.truncate(stored, 5000)
    with pytest.raises(DamagedFile):
        read_by_name([stored])


def test_a_damaged_file_is_made_again_and_a_whole_one_is_not(stored: Path, make_run, caplog) -> None:
    assert read_or_make(stored, lambda: pytest.fail("made")).identical(read(stored))
    whole = content_sha256(read(stored))
    os.truncate(stored, 5000)
    assert content_sha256(read_or_make(stored, make_run)) == whole == content_sha256(read(stored))
    assert caplog.messages == [f"{stored}: it is damaged and made again"]
    assert stored.stat().st_mtime == 0


@pytest.mark.parametrize("error", [MemoryError(), OSError(24, "Too many open files"), PermissionError(13, "no")])
def test_what_is_no_fault_of_the_file_is_no_damage(error: Exception, stored: Path) -> None:
    with pytest.raises(type(error)), reading(stored):
        raise error

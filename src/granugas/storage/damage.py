"""Files that are not what was written: cut off, or with other bytes in them.

A netCDF file is sealed: behind its last byte, where its readers do not look, stands the SHA-256 of all bytes before. It is
checked before a reader sees the file, as a single wrong byte can make the HDF5 library loop without end.
"""

import hashlib
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

SIGNATURE = b"\x89HDF\r\n\x1a\n"
END_AT = {0: 40, 1: 44, 2: 28, 3: 28}
"""Where a netCDF-4 file says how long it is, for each version of its first block (HDF5 file format, section II.A)."""

SEAL = b"\nsha256 of the bytes before: "
SEALED = len(SEAL) + 64
"""Bytes of a seal with its hexadecimal digest."""

BLOCK = 2**20
"""Bytes that are read at a time."""


class DamagedFile(Exception):
    """A file whose content cannot be trusted."""

    def __init__(self, path: str | Path, reason: object) -> None:
        super().__init__(f"{path} is damaged ({reason}); the same command makes it again")
        self.path = Path(path)


def seal(path: str | Path) -> None:
    """Put a seal behind the last byte of a netCDF-4 file."""
    with open(path, "rb+") as file:
        digest = hashlib.file_digest(file, "sha256").hexdigest()  # now the end is reached
        file.write(SEAL + digest.encode())


def is_complete(path: str | Path) -> bool:
    """Whether a netCDF-4 file is as long as its first bytes say, with a seal or without one; nothing else is read.

    Raises:
        FileNotFoundError: no such file.
    """
    end = _end(path)
    return end > 0 and Path(path).stat().st_size - end in (0, SEALED)


def check(path: str | Path) -> None:
    """Read a netCDF-4 file and compare it with its seal; of one without a seal only the length is known.

    Raises:
        FileNotFoundError: no such file.
        DamagedFile: it is not what was written.
    """
    if not is_complete(path):
        raise DamagedFile(path, "it is cut off, or no netCDF-4 file")
    left, digest = _end(path), hashlib.sha256()
    with open(path, "rb") as file:
        while block := file.read(min(left, BLOCK)):
            digest.update(block)
            left -= len(block)
        if file.read() not in (b"", SEAL + digest.hexdigest().encode()):
            raise DamagedFile(path, "its bytes are not those of its seal")


@contextmanager
def reading(path: str | Path) -> Iterator[None]:
    """Check a file, then let whatever a reader stumbles over in it be told as damage.

    Raises:
        DamagedFile: it is not what was written, or makes no sense.
        OSError: it is not there or not for us, and whatever else is no fault of its content.
        MemoryError: likewise.
    """
    check(path)
    try:
        yield
    except MemoryError:
        raise
    except OSError as error:
        if error.errno is not None and error.errno > 0:  # the system's own; those of netCDF are negative
            raise
        raise DamagedFile(path, error.strerror or error) from error
    except Exception as error:  # garbled headers fail in a dozen ways
        raise DamagedFile(path, error) from error


def _end(path: str | Path) -> int:
    """Length in bytes that a netCDF-4 file gives itself; -1 where it is none."""
    with open(path, "rb") as file:
        head = file.read(52)
    if len(head) < 52 or not head.startswith(SIGNATURE) or head[8] not in END_AT:
        return -1
    return struct.unpack_from("<Q", head, END_AT[head[8]])[0]

"""Files of runs that no study names any more: which they are, and away with them."""

import fcntl
from collections.abc import Collection, Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

SUFFIXES = {"runs": ".nc", "states": ".nc", "positions": ".nc", "clusters": ".nc", "checkpoints": ".npz"}
"""Folders of the results that hold files of runs, and the files' suffix."""


@contextmanager
def no_build(output: str | Path) -> Iterator[None]:
    """Keep builds out of a folder of results as long as this lasts.

    Raises:
        ValueError: a build is writing there, or there is no such folder.
    """
    if not Path(output).is_dir():
        raise ValueError(f"output = {str(output)!r}: no such folder, nothing was built here")
    with open(Path(output) / ".lock", "a") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise ValueError(f"output = {str(output)!r}: a build is writing there, wait for its end") from None
        yield


def leftovers(output: str | Path, named: Mapping[str, Collection[str]]) -> list[Path]:
    """The files of runs in a folder of results whose names (without suffix) nobody gives.

    Args:
        output: folder of the results; what is in it beside SUFFIXES (studies, figures, logs ...) is never listed.
        named: for each folder of SUFFIXES the names that studies give.

    Raises:
        KeyError: a folder about which `named` says nothing.
    """
    return [
        path
        for folder, suffix in SUFFIXES.items()
        for path in sorted((Path(output) / folder).glob(f"*{suffix}"))
        if path.stem not in named[folder] and not path.name.startswith(".")
    ]


def listing(paths: Iterable[Path]) -> str:
    """One line a file with its size in MB, and their number and size in all."""
    sizes = {path: path.stat().st_size / 1e6 for path in paths}
    return "\n".join(
        [*(f"{size:10.3f} MB  {path}" for path, size in sizes.items()), f"{sum(sizes.values()):10.3f} MB in {len(sizes)} files"]
    )


def remove(paths: Iterable[Path]) -> None:
    """Remove them; one that is gone already is no fault."""
    for path in paths:
        path.unlink(missing_ok=True)

"""Digests of source code: what a result depends on, blind to comments and docstrings.

A digest of the modules that a run uses is part of the run's parameters, so changed physics runs again and a changed
comment does not. The same digest names the folder of the compiled kernels: the compiler's own cache misses an edit in a
function that is called from another file, and would run the old physics.

Nothing is imported to take a digest; this module stands on the standard library alone.
"""

import ast
import hashlib
import os
import shutil
import stat
import sys
import tempfile
import time
from collections.abc import Iterable
from functools import cache, lru_cache
from pathlib import Path

SOURCES = Path(__file__).resolve().parent

EVENTS = (
    "granugas.geometry",
    "granugas.diameters",
    "granugas.arguments",
    "granugas.doubts",
    "granugas.lattices.*",
    "granugas.initial",
    "granugas.equilibrate",
    "granugas.sampling",
    "granugas.record",
    "granugas.progress",
    "granugas.interruption",
    "granugas.simulate",
    "granugas.analysis.observables",
    "granugas.analysis.enskog",
    "granugas.analysis.mixtures",
    "granugas.dynamics.state",
    "granugas.dynamics.on_walls",
    *(
        f"granugas.dynamics.events.{name}"
        for name in (
            *("memory", "composition", "state", "vectors", "cells", "flight", "boundary", "sizes", "calendar", "look_ahead"),
            *("predict", "collisions", "loop", "driving", "growth", "cast", "tables", "engine", "randomness"),
        )
    ),
)
"""Modules that decide the numbers of every event-driven run, its start state included.

A run's effects come on top (dynamics.events.effects.modules_of). What merely checks a scene or chooses effects for it is not
among them: the values of the scene are in the address of a run, and the chosen files in its digest.
"""

ANALYSIS = ("granugas.analysis.burning", "granugas.analysis.clusters")
"""Modules that decide the numbers of a cluster analysis."""

KERNELS = ("granugas.dynamics.*", "granugas.analysis.*")
"""Modules with compiled functions, and what these call."""

UNUSED_AFTER = 30 * 86400.0
"""Age in s at which the compiled kernels of another version of the sources are removed."""


ROOM = 2**25
"""Bytes that must be free where compiled kernels are kept: some times what they need."""


def digest(modules: Iterable[str]) -> str:
    """Hexadecimal SHA-256 of what the named modules do: their syntax trees without docstrings and comments.

    It stays in the environment, where a process started by this one finds it while no file differs: trees of all take 0.4 s.

    Args:
        modules: full names (`granugas.scene`); `package.*` means the package and everything below it. Neither order nor
            repetition counts.

    Raises:
        ModuleNotFoundError: a name without a source file.
    """
    texts = [(name, path.read_text("utf-8")) for name, path in sorted({item for of in modules for item in _source_files(of)})]
    known = f"GRANUGAS_DIGEST_{_sha256(texts)}"
    if known not in os.environ:
        os.environ[known] = _sha256((name, _code(text)) for name, text in texts)
    return os.environ[known]


def _sha256(texts: Iterable[tuple[str, str]]) -> str:
    total = hashlib.sha256()
    for name, text in texts:
        total.update(f"{name}\0{text}\0".encode())
    return total.hexdigest()


@cache
def physics(effects: tuple[str, ...] = ("granugas.dynamics.*",)) -> str:
    """The digest of the engine with these files of effects and other dynamics, of all of them unless named."""
    return digest((*EVENTS, *effects))


@cache
def experiment(name: str) -> str:
    """The digest of an experiment, of those that it takes scenes or functions from, and of what all of them may run."""
    return digest((*_with_imported(f"granugas.experiments.{name}"), *EVENTS, *KERNELS))


def use_kernel_cache() -> None:
    """Let compiled kernels be kept in `kernel_cache_directory()`; call it before functions are compiled.

    A NUMBA_CACHE_DIR that somebody chose is left alone; one that another version of these sources chose (in a parent
    process) is replaced.
    """
    chosen = os.environ.get("NUMBA_CACHE_DIR")
    if chosen and not _is_kernel_cache(Path(chosen)):
        return
    os.environ["NUMBA_CACHE_DIR"] = str(kernel_cache_directory())
    if "numba" in sys.modules:  # it has read the environment already
        sys.modules["numba"].config.CACHE_DIR = os.environ["NUMBA_CACHE_DIR"]


@lru_cache(maxsize=1)
def kernel_cache_directory() -> Path:
    """The folder of the compiled kernels of these sources, for the user alone (mode 0700).

    `granugas/kernels-<digest>` in the user's cache (XDG_CACHE_HOME or ~/.cache), or in the folder for temporary files
    where that cannot be written or is full. Folders of other versions that nobody used for 30 days are removed.
    """
    name = f"kernels-{digest(KERNELS)[:16]}"
    caches = [Path(os.environ.get("XDG_CACHE_HOME", "")), Path(os.path.expanduser("~/.cache"))]
    parents = [cache / "granugas" for cache in caches if cache.is_absolute()]
    for parent in [*parents, Path(tempfile.gettempdir()) / f"granugas-{os.getuid()}"]:
        folder = parent / name
        if _claim(folder):
            _remove_unused(folder)
            return folder
    folder = Path(tempfile.mkdtemp(prefix="granugas-")) / name
    folder.mkdir(mode=0o700)
    return folder


def forget_kernels() -> None:
    """Remove the compiled kernels of these sources; a folder that somebody chose (NUMBA_CACHE_DIR) is left alone."""
    chosen = os.environ.get("NUMBA_CACHE_DIR")
    if not chosen or _is_kernel_cache(Path(chosen)):
        shutil.rmtree(chosen or kernel_cache_directory(), ignore_errors=True)


def _with_imported(module: str) -> set[str]:
    """A module and those beside it in its package that it imports, directly or not."""
    package, found = module.rpartition(".")[0], set()
    waiting = [module]
    while waiting:
        name = waiting.pop()
        found.add(name)
        for _, path in _source_files(name):
            nodes = ast.walk(ast.parse(path.read_text(encoding="utf-8")))
            names = {node.module or "" for node in nodes if isinstance(node, ast.ImportFrom)}
            waiting += {name for name in names if name.startswith(f"{package}.")} - found
    return found


def _source_files(module: str) -> list[tuple[str, Path]]:
    """Pairs of module name and source file."""
    package, *parts = module.removesuffix(".*").split(".")
    place = SOURCES.joinpath(*parts)
    if package == SOURCES.name and module.endswith(".*"):
        paths = sorted(place.rglob("*.py"))
    elif package == SOURCES.name:
        paths = [path for path in (place.with_suffix(".py"), place / "__init__.py") if path.is_file()]
    else:
        paths = []
    if not paths:
        raise ModuleNotFoundError(f"{module}: no source file below {SOURCES}", name=module)
    return [(path.relative_to(SOURCES).as_posix(), path) for path in paths]


@cache
def _code(text: str) -> str:
    """The code of a source text in one canonical form."""
    tree = ast.parse(text)
    for node in ast.walk(tree):
        if isinstance(body := getattr(node, "body", None), list):
            node.body = [line for line in body if not _is_text(line)]  # type: ignore[attr-defined]  # it has one
    return ast.unparse(tree)


def _is_text(statement: ast.stmt) -> bool:
    """A docstring, of a function or of the value above it: a string that nothing uses."""
    value = getattr(statement, "value", None)
    return isinstance(statement, ast.Expr) and isinstance(value, ast.Constant) and isinstance(value.value, str)


def _is_kernel_cache(folder: Path) -> bool:
    return folder.parent.name.startswith("granugas") and folder.name.startswith("kernels-")


def _claim(folder: Path) -> bool:
    """Make the folder, or take it when it is the user's own and closed to others: cached kernels are code that runs."""
    try:
        folder.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        folder.mkdir(mode=0o700, exist_ok=True)
        own = all(path.lstat().st_uid == os.getuid() and path.is_dir() for path in (folder.parent, folder))
        if not own or folder.is_symlink() or stat.S_IMODE(folder.parent.stat().st_mode) & 0o022:
            return False
        folder.chmod(0o700)
        os.utime(folder)  # the time of its last use
        return os.access(folder, os.W_OK) and shutil.disk_usage(folder).free >= ROOM
    except OSError:
        return False


def _remove_unused(folder: Path) -> None:
    for other in folder.parent.glob("kernels-*"):
        try:
            unused = time.time() - other.stat().st_mtime > UNUSED_AFTER
        except OSError:  # another process removed it
            continue
        if unused and other != folder:
            shutil.rmtree(other, ignore_errors=True)

"""What the files of figures, tables, claims and experiments say of themselves, in lines like `STUDIES = ("...",)`.

The files are read, not run.
"""

import ast
from pathlib import Path

from granugas.configuration import MISSING, ConfigError

OVERVIEW = "overview"
"""Figure file that draws any study."""


def studies_in(folder: Path) -> dict[str, tuple[str, ...]]:
    """The files of a folder by name, and the studies that each needs: its line `STUDIES = (...)`.

    Raises:
        ConfigError: a file without that line.
    """
    return {path.stem: _names_in(path, "STUDIES") for path in _files_in(folder)}


def experiments_in(folder: Path) -> dict[str, tuple[str, ...]]:
    """The same files, and the experiments that each needs: its line `EXPERIMENTS = (...)`, if it has one."""
    return {path.stem: _names_in(path, "EXPERIMENTS", ()) for path in _files_in(folder)}


def tables_in(folder: Path) -> dict[str, tuple[str, ...]]:
    """The same files, and the tables that each needs: its line `TABLES = (...)`, if it has one."""
    return {path.stem: _names_in(path, "TABLES", ()) for path in _files_in(folder)}


def runs_alone(experiment: Path) -> bool:
    """Whether an experiment times something, so that nothing may run beside it: its line `ALONE = ("...",)` says what."""
    return bool(_names_in(experiment, "ALONE", ()))


def _files_in(folder: Path) -> list[Path]:
    return [path for path in sorted(folder.glob("*.py")) if path.stem != OVERVIEW and path.stem[0] != "_"]


def _names_in(path: Path, what: str, otherwise: tuple[str, ...] | None = None) -> tuple[str, ...]:
    """A tuple that is written out in a file."""
    for statement in ast.parse(path.read_text(encoding="utf-8"), str(path)).body:
        if isinstance(statement, ast.Assign) and getattr(statement.targets[0], "id", "") == what:
            return tuple(ast.literal_eval(statement.value))
    if otherwise is None:
        raise ConfigError(f"{path.name}: {what}", MISSING, "allowed is a tuple of names, written out")
    return otherwise

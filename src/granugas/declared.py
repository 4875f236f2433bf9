"""What the files of figures, tables, claims and experiments say of themselves, in lines like `STUDIES = ("...",)`.

The files are read, not run.
"""

import ast
from pathlib import Path

from granugas.configuration import MISSING, ConfigError, unknown

OVERVIEW = "overview"
"""Figure file that draws any study."""


def studies_in(folder: Path) -> dict[str, tuple[str, ...]]:
    """The files of a folder by name, and the studies that each needs: its line `STUDIES = (...)`.

    Raises:
        ConfigError: a file without that line.
    """
    return {path.stem: _names_in(path, "STUDIES") for path in _files_in(folder)}


def experiments_in(folder: Path, experiments: Path) -> dict[str, tuple[str, ...]]:
    """The same files, and the experiments that each needs: its line `EXPERIMENTS = (...)`, if it has one.

    Raises:
        ConfigError: a name of which there is no file in the folder `experiments`.
    """
    found = {path: _names_in(path, "EXPERIMENTS", ()) for path in _files_in(folder)}
    known = {path.stem for path in _files_in(experiments)}
    for path, names in found.items():
        for name in names:
            if name not in known:
                raise unknown(f"{path.name}: EXPERIMENTS", name, name, known, kind="experiment")
    return {path.stem: names for path, names in found.items()}


def check_captions(figures: Path, captions: Path) -> None:
    """Each figure has a caption for the report.

    Raises:
        ConfigError: it has none.
    """
    for path in _files_in(figures):
        if not (captions / f"{path.stem}.rst").is_file():
            where = f"{captions.parent.name}/{captions.name}/{path.stem}.rst"
            raise ConfigError(where, MISSING, f"allowed is a file with the caption of the figure {path.stem}.py")


def tables_in(folder: Path) -> dict[str, tuple[str, ...]]:
    """The same files, and the tables that each needs: its line `TABLES = (...)`, if it has one."""
    return {path.stem: _names_in(path, "TABLES", ()) for path in _files_in(folder)}


def runs_alone(experiment: Path) -> bool:
    """Whether an experiment times something, so that nothing may run beside it: its line `ALONE = ("...",)` says what."""
    return bool(_names_in(experiment, "ALONE", ()))


def _files_in(folder: Path) -> list[Path]:
    return [path for path in sorted(folder.glob("*.py")) if path.stem != OVERVIEW and path.stem[0] != "_"]


def _names_in(path: Path, what: str, otherwise: tuple[str, ...] | None = None) -> tuple[str, ...]:
    """A tuple that is written out in a file.

    Raises:
        ConfigError: there is none, or a single name without a comma.
    """
    for statement in ast.parse(path.read_text(encoding="utf-8"), str(path)).body:
        if isinstance(statement, ast.Assign) and getattr(statement.targets[0], "id", "") == what:
            found = ast.literal_eval(statement.value)
            if isinstance(found, str):
                raise ConfigError(f"{path.name}: {what}", found, f'allowed is a tuple of names, with a comma: ("{found}",)')
            return tuple(found)
    if otherwise is None:
        raise ConfigError(f"{path.name}: {what}", MISSING, "allowed is a tuple of names, written out")
    return otherwise

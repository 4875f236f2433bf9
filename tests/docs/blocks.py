"""Code blocks of Markdown pages, and how they are run: page by page, in order, in a copy of the project."""

import contextlib
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any, NamedTuple

from workflow.project import ROOT, copy_of_sources

TEXTS = [path.relative_to(ROOT) for path in sorted((ROOT / "docs").rglob("*.md")) if "_build" not in path.parts]
"""Of the documentation."""

PAGES = [Path("README.md"), *TEXTS]
COPIED = ("Makefile", "README.md", "pyproject.toml", "requirements.lock", "requirements-docs.lock")
"""Besides the sources of the workflow."""

DRY = {"make ": "make --dry-run ", "snakemake ": "snakemake --dry-run "}
"""What a dry run makes of commands."""

_MARK = r"(?:<!-- (?P<mark>dry run|only shown): (?P<reason>\S[^\n]*) -->\n)?"
_BLOCK = re.compile(rf"^{_MARK}```(?P<language>\w+|\{{code-cell\}} python)\n(?P<text>.*?)^```$", re.M | re.S)
_FILE = re.compile(r"(?:#|\.\.) (\S+\.\w+)\n")


class Block(NamedTuple):
    """A code block.

    Attributes:
        language: of its fence.
        text: what stands in it.
        line: of its page, on which it begins.
        mark: "", or "dry run" or "only shown", as a comment before the block says, with the reason.
    """

    language: str
    text: str
    line: int
    mark: str


def blocks_of(text: str) -> list[Block]:
    """The code blocks of a page; what Sphinx fills in (directives) is none."""
    return [
        Block(found["language"].split()[-1], found["text"], text.count("\n", 0, found.start("text")) + 1, found["mark"] or "")
        for found in _BLOCK.finditer(text)
    ]


def outside_of_fences(text: str) -> str:
    """What is left of a page without its blocks and directives."""
    return re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S)


def copy_of_project(folder: Path) -> Path:
    """The project as a clone has it, with the environment and the package of this one, whose kernels are compiled."""
    copy_of_sources(folder)
    for name in ("examples", "benchmarks"):
        shutil.copytree(ROOT / name, folder / name)
    for name in COPIED:
        shutil.copy2(ROOT / name, folder / name)
    (folder / ".venv").symlink_to(sys.prefix)
    return folder


def run_page(page: Path, folder: Path) -> dict[str, Any]:
    """Run the blocks of a page in a folder; the names that its Python blocks leave behind."""
    names: dict[str, Any] = {"__name__": page.stem}
    with contextlib.chdir(folder):
        for block in blocks_of((ROOT / page).read_text(encoding="utf-8")):
            if block.mark != "only shown":
                run_block(block, f"{page}:{block.line}", names)
    return names


def run_block(block: Block, where: str, names: dict[str, Any]) -> None:
    """Write what names its file in its first line; run Python here, commands in a shell that stops at the first failure."""
    if file := _FILE.match(block.text):
        Path(file[1]).write_text(block.text, encoding="utf-8")
    elif block.language == "python":
        exec(compile("\n" * block.line + block.text, where, "exec"), names)
    else:
        assert block.language == "bash", f"{where}: a block of {block.language} that names no file"
        command = dry(block.text) if block.mark == "dry run" else block.text
        done = subprocess.run(
            ["bash", "-euo", "pipefail", "-c", command],
            env=os.environ | {"SLURM_CONF": "/dev/null", "PYTHONPATH": str(ROOT / "src"), "MPLBACKEND": "Agg"},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            stdin=subprocess.DEVNULL,
            text=True,
        )
        assert done.returncode == 0, f"{where}: {done.stdout}"


def dry(command: str) -> str:
    """The command as a dry run."""
    changed = command
    for name, instead in DRY.items():
        changed = re.sub(rf"(?<!\S)(\S*/)?{name}", rf"\g<1>{instead}", changed)
    assert changed != command, f"no command that has a dry run: {command}"
    return changed

"""The workflow as people run it: the real command, in folders of its own, from the sources or from a copy of them."""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ("Snakefile", "config", "profiles", "src", "workflow")


@dataclass
class Project:
    """Sources of the workflow, and a folder to work in with a configuration of its own."""

    sources: Path
    folder: Path

    def configure(self, **config: object) -> None:
        """Write the folder's config/config.yaml, which is read instead of the sources' own."""
        file = self.folder / "config/config.yaml"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(yaml.safe_dump(config))

    def command(self, *words: object) -> list[str]:
        """The call of snakemake with these words."""
        place = ["--snakefile", self.sources / "Snakefile", "--directory", self.folder]
        return [str(word) for word in (sys.executable, "-m", "snakemake", "--cores", 2, *place, *words)]

    @property
    def environment(self) -> dict[str, str]:
        """The environment in which the package is the sources' one."""
        return os.environ | {"SLURM_CONF": "/dev/null", "PYTHONPATH": str(self.sources / "src")}

    def snakemake(self, *words: object) -> subprocess.CompletedProcess[str]:
        """Call it and wait; standard error is part of the output."""
        return subprocess.run(
            self.command(*words),
            env=self.environment,
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )

    def build(self, *words: object) -> str:
        """Build and expect success."""
        done = self.snakemake(*words)
        assert done.returncode == 0, done.stdout
        return done.stdout

    def jobs(self, *words: object) -> dict[str, int]:
        """How many jobs of each rule a dry run announces."""
        said = self.build("--dry-run", *words)
        table = said.partition("Job stats:")[2].partition("\n\n")[0]
        found = {match[1]: int(match[2]) for match in re.finditer(r"^(\w+) +(\d+)$", table, re.M)}
        return {rule: number for rule, number in found.items() if rule not in ("total", "all")}

    @contextmanager
    def edited(self, file: str, old: str, new: str) -> Iterator[None]:
        """One of the sources with another text in it, put back at the end."""
        path = self.sources / file
        text, times = path.read_text(), path.stat()
        assert old in text
        path.write_text(text.replace(old, new, 1))
        try:
            yield
        finally:
            path.write_text(text)
            os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))


def copy_of_sources(folder: Path) -> Path:
    """A copy that a test may edit."""
    for name in SOURCES:
        path = ROOT / name
        if path.is_dir():
            shutil.copytree(path, folder / name, ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"))
        else:
            shutil.copy2(path, folder / name)
    return folder

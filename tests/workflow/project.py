"""The workflow as people run it: the real command, in folders of its own, from the sources or from a copy of them."""

import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
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

    def start(self, *words: object) -> subprocess.Popen[bytes]:
        """Call it in a process group of its own and do not wait; what it says goes to the folder's said.txt."""
        with open(self.folder / "said.txt", "w") as said:
            return subprocess.Popen(
                self.command(*words),
                env=self.environment,
                cwd=self.folder,
                stdout=said,
                stderr=said,
                start_new_session=True,
            )

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
        return jobs_announced(self.build("--dry-run", *words))

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


def jobs_announced(said: str) -> dict[str, int]:
    """How many jobs of each rule a build said that it would run."""
    table = said.partition("Job stats:")[2].partition("\n\n")[0]
    found = {match[1]: int(match[2]) for match in re.finditer(r"^(\w+) +(\d+)$", table, re.M)}
    return {rule: number for rule, number in found.items() if rule not in ("total", "all")}


def jobs_of(pid: int) -> list[int]:
    """The processes that a process has started and that still run; none where it has ended."""
    try:
        return [int(job) for path in Path(f"/proc/{pid}/task").glob("*/children") for job in path.read_text().split()]
    except OSError:
        return []


def is_running(pid: int) -> bool:
    """Whether a process is there and is no zombie that nobody has asked for its end yet."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def wait_for(condition: Callable[[], object], seconds: float = 300.0) -> None:
    """Ask again and again; a test that waits in vain fails."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.02)


def run_logged(code: str, log: Path) -> subprocess.CompletedProcess[str]:
    """A line of Python as a job that logs."""
    text = f"from granugas.jobs import logged\nwith logged({str(log)!r}):\n    {code}\n"
    return subprocess.run([sys.executable, "-c", text], capture_output=True, text=True)

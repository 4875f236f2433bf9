"""The package as it is passed on: an archive of its sources, a wheel made from it, and that in an environment of its own."""

import shutil
import subprocess
import sys
import sysconfig
import tarfile
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SOURCES = ROOT / "src/granugas"
PARTS = ("pyproject.toml", "README.md", "LICENSE", "src")

SESSION = """
import sys
import granugas as gg
assert {folder!r} in gg.__file__, gg.__file__
run = gg.simulate(gg.Scene(n_particles=36, restitution=0.8), until=0.05, samples={{"count": 3}}, progress=False)
print(int(gg.find_clusters(run, distance_factors=[1.1])["cluster_count"][0, 0]))
assert "snakemake" not in sys.modules
"""


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """The archive, and the wheel that is made from what is in it."""
    folder = tmp_path_factory.mktemp("package")
    sources = folder / "sources"
    sources.mkdir()
    for part in PARTS:
        copy = shutil.copytree if (ROOT / part).is_dir() else shutil.copy2
        copy(ROOT / part, sources / part)
    for egg in sources.rglob("*.egg-info"):
        shutil.rmtree(egg)
    make = "from setuptools import build_meta; print(build_meta.build_sdist({!r}))"
    called("-c", make.format(str(folder)), cwd=sources)
    (archive,) = folder.glob("*.tar.gz")
    with tarfile.open(archive) as packed:
        packed.extractall(folder / "unpacked", filter="data")
    (unpacked,) = (folder / "unpacked").iterdir()
    called("-m", "pip", "wheel", "--no-deps", "--no-build-isolation", "--wheel-dir", folder, unpacked, cwd=folder)
    (wheel,) = folder.glob("*.whl")
    return archive, wheel


def test_the_wheel_holds_the_package_and_nothing_else(built):
    archive, wheel = built
    inside = {path.relative_to(SOURCES.parent).as_posix() for path in SOURCES.rglob("*") if path.is_file()}
    inside = {name for name in inside if "__pycache__" not in name}
    with zipfile.ZipFile(wheel) as packed:
        names = {*packed.namelist()}
        (licence,) = (name for name in names if name.endswith("LICENSE"))
        assert packed.read(licence) == (ROOT / "LICENSE").read_bytes()
    assert {name for name in names if ".dist-info/" not in name} == inside
    with tarfile.open(archive) as packed:
        assert {name.partition("/src/")[2] for name in packed.getnames()} >= inside


@pytest.mark.full
def test_the_wheel_works_in_an_environment_of_its_own(built, tmp_path):
    """All that it shares with this one are the libraries; where it runs there is no repository, and no workflow."""
    own = tmp_path / "own"
    called("-m", "venv", "--without-pip", own, cwd=tmp_path)
    python = own / "bin/python"
    called("-m", "pip", "--python", python, "install", "--no-deps", "--no-index", built[1], cwd=tmp_path)
    (site,) = own.glob("lib/python*/site-packages")
    (site / "libraries.pth").write_text(sysconfig.get_path("purelib") + "\n")
    words = ["run", "--n", "36", "--restitution", "0.8", "--time", "0.05", "--samples", "3", "--snapshots", "0.05"]
    said = called("-m", "granugas", *words, "--output", "run.nc", cwd=tmp_path, python=python)
    assert said.startswith("run.nc: 36 particles until t = 0.05 s (time)")
    assert "1 frame" in called("-m", "granugas", "export", "run.nc", "run.xyz", cwd=tmp_path, python=python)
    assert int(called("-c", SESSION.format(folder=str(own)), cwd=tmp_path, python=python)) > 1


def called(*words, cwd, python=sys.executable):
    """What a Python with these words says; it must end well, outside of the repository."""
    done = subprocess.run([str(word) for word in (python, *words)], cwd=cwd, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout

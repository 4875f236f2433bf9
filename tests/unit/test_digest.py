import ast
import os
import stat
import subprocess
import sys
import time
from pathlib import Path

import pytest

from granugas import digest as sources
from granugas.digest import digest, kernel_cache_directory, use_kernel_cache
from granugas.dynamics.events.effects import modules_of
from granugas.scene import Scene

SCENE = '''"""A module."""
WIDTH = 2.0
"""A number."""


class Scene:
    """A class."""

    def area(self):
        """A function."""
        return WIDTH * 3  # why


async def wait():
    """Nothing else."""
'''


@pytest.fixture
def package(tmp_path, monkeypatch):
    """A package of a few modules in place of this one."""
    root = tmp_path / "granugas"
    (root / "dynamics" / "events" / "effects").mkdir(parents=True)
    for name in ("scene", "initial", "dynamics/__init__", "dynamics/events/loop", "dynamics/events/effects/rule"):
        (root / f"{name}.py").write_text(SCENE)
    monkeypatch.setattr(sources, "SOURCES", root)
    return root


@pytest.fixture
def cache(tmp_path, monkeypatch):
    """A user's cache of its own, and nothing decided."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    monkeypatch.setenv("NUMBA_CACHE_DIR", "")
    monkeypatch.setattr(sources.tempfile, "gettempdir", lambda: str(tmp_path / "temporary"))
    numba = sys.modules.get("numba")
    if numba:
        monkeypatch.setattr(numba.config, "CACHE_DIR", numba.config.CACHE_DIR)
    kernel_cache_directory.cache_clear()
    yield tmp_path / "cache" / "granugas"
    kernel_cache_directory.cache_clear()


@pytest.mark.parametrize(
    "edit",
    [
        lambda text: text.replace('"""A module."""', '"""Another."""\n\n# and a comment\n'),
        lambda text: text.replace('"""A number."""\n', ""),
        lambda text: text.replace('    """A class."""\n', ""),
        lambda text: text.replace('"""A function."""', "'Computes.'"),
        lambda text: text.replace("  # why", ""),
        lambda text: text.replace("WIDTH * 3", "(WIDTH\n            * 3)"),
    ],
)
def test_words_and_layout_do_not_count(package, edit):
    before = digest(["granugas.scene"])
    assert edit(SCENE) != SCENE
    (package / "scene.py").write_text(edit(SCENE))
    assert digest(["granugas.scene"]) == before


@pytest.mark.parametrize(
    "edit",
    [
        lambda text: text.replace("2.0", "2.5"),
        lambda text: text.replace("* 3", "+ 3"),
        lambda text: text.replace("area", "side"),
        lambda text: text.replace("WIDTH = 2.0", 'WIDTH = "2.0"'),
        lambda text: text.replace("async ", ""),
    ],
)
def test_code_counts(package, edit):
    before = digest(["granugas.scene"])
    (package / "scene.py").write_text(edit(SCENE))
    assert digest(["granugas.scene"]) != before


def test_only_the_named_modules_count(package):
    before = digest(["granugas.scene", "granugas.dynamics.events.*"])
    assert digest(["granugas.dynamics.events.*", "granugas.scene", "granugas.scene"]) == before
    (package / "initial.py").write_text("x = 1")
    assert digest(["granugas.scene", "granugas.dynamics.events.*"]) == before
    (package / "dynamics/events/effects/rule.py").write_text("x = 1")
    after = digest(["granugas.scene", "granugas.dynamics.events.*"])
    assert after != before
    (package / "dynamics/events/effects/new.py").write_text("")
    assert digest(["granugas.scene", "granugas.dynamics.events.*"]) != after


def test_a_module_that_moves_its_code_counts(package):
    both = digest(["granugas.scene", "granugas.dynamics"])
    (package / "scene.py").write_text("x = 1")
    (package / "dynamics/__init__.py").write_text(SCENE)
    one = digest(["granugas.scene", "granugas.dynamics"])
    (package / "scene.py").write_text(SCENE)
    (package / "dynamics/__init__.py").write_text("x = 1")
    assert len({both, one, digest(["granugas.scene", "granugas.dynamics"])}) == 3
    assert digest(["granugas.scene"]) != digest(["granugas.initial"])


@pytest.mark.parametrize("name", ["granugas.nowhere", "granugas.nowhere.*", "numpy", "scene"])
def test_an_unknown_module_is_refused(name):
    with pytest.raises(ModuleNotFoundError, match=name.replace("*", r"\*")):
        digest([name])


LRV = (*sources.EVENTS, "granugas.dynamics.lrv")
SOFT = (*sources.EVENTS, *modules_of(Scene(dynamics="soft_spheres")))
DSMC = (*sources.EVENTS, *modules_of(Scene(dynamics="dsmc")))


@pytest.mark.parametrize(
    "modules", [(*sources.EVENTS, "granugas.dynamics.events.effects.*"), LRV, SOFT, DSMC, sources.ANALYSIS]
)
def test_what_decides_numbers_is_covered(modules):
    """Whatever a covered module imports of the package is covered too, or decides no number (scenes only check theirs)."""
    covered = {name for module in modules for name, _ in sources._source_files(module)}
    packages = ("", "analysis/", "dynamics/", "dynamics/events/", "dynamics/events/effects/")
    free = ("storage/", "digest.py", "scene.py", *(f"{package}__init__.py" for package in packages))
    imported = set().union(*(imports(sources.SOURCES / name) for name in covered))
    assert {name for name in imported - covered if not name.startswith(free)} == set()


def test_an_effect_counts_where_a_scene_calls_for_it():
    dissipative, elastic = Scene(), Scene(restitution=1.0, contact_time=0.0)
    called = modules_of(dissipative)
    assert any(name.endswith(".contact_time") for name in called)
    assert not any(name.endswith(".contact_time") for name in modules_of(elastic))
    assert set(modules_of(dissipative, elastic)) == {*called, *modules_of(elastic)}
    beads = Scene(dimensions=1, contact_time=0.0, lrv_velocity=0.1)
    assert modules_of(beads) == ("granugas.dynamics.lrv",) and "granugas.dynamics.lrv" not in modules_of(dissipative, elastic)
    soft = modules_of(Scene(dynamics="soft_spheres"))
    assert soft == tuple(f"granugas.dynamics.{name}" for name in ("neighbours", "soft_contact", "soft_steps", "softspheres"))
    assert not {*soft} & {*modules_of(dissipative, elastic, beads)}
    random = modules_of(Scene(dynamics="dsmc"))
    assert random == tuple(f"granugas.dynamics.{name}" for name in ("dsmc", "dsmc_collisions", "dsmc_steps"))
    assert not {*random} & {*modules_of(dissipative, elastic, beads)}
    assert len({sources.physics(called), sources.physics(modules_of(elastic)), sources.physics()}) == 3


def test_an_experiment_depends_on_those_that_it_draws_on():
    assert sources._with_imported("granugas.experiments.column") == {"granugas.experiments.column"}
    three = {f"granugas.experiments.{name}" for name in ("effects", "effects_checks", "effects_cost")}
    assert sources._with_imported("granugas.experiments.effects_cost") == three
    assert len({sources.experiment(name) for name in ("effects", "effects_cost", "column")}) == 3


def test_every_compiled_function_is_covered():
    compiled = {"numba", "granugas.dynamics.events.composition"}
    paths = [path for path in sources.SOURCES.rglob("*.py") if not compiled.isdisjoint(names_imported(path))]
    assert paths
    covered = {path for module in sources.KERNELS for _, path in sources._source_files(module)}
    assert set(paths) <= covered


def names_imported(path: Path) -> set[str]:
    """Full names that a module imports, of modules or of what is in them."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            names |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
    return names


def imports(path: Path) -> set[str]:
    """Files of the package that a module imports."""
    found = set()
    for name in names_imported(path):
        if name.split(".")[0] == "granugas":
            place = sources.SOURCES.joinpath(*name.split(".")[1:])
            found |= {p for p in (place.with_suffix(".py"), place / "__init__.py") if p.is_file()}
    return {p.relative_to(sources.SOURCES).as_posix() for p in found}


def test_importing_it_is_light():
    program = "import sys, granugas.digest; print([m for m in ('numpy', 'numba', 'xarray') if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_kernels_are_kept_in_a_folder_of_the_user_alone(cache):
    folder = kernel_cache_directory()
    assert folder == cache / f"kernels-{digest(sources.KERNELS)[:16]}"
    assert stat.S_IMODE(folder.stat().st_mode) == 0o700 and stat.S_IMODE(cache.stat().st_mode) == 0o700


def test_an_open_folder_is_closed_and_one_in_an_open_place_is_not_used(cache, tmp_path):
    folder = kernel_cache_directory()
    folder.chmod(0o777)
    kernel_cache_directory.cache_clear()
    assert stat.S_IMODE(kernel_cache_directory().stat().st_mode) == 0o700
    cache.chmod(0o777)
    kernel_cache_directory.cache_clear()
    assert kernel_cache_directory().parent == tmp_path / "home/.cache/granugas"


def test_where_nothing_can_be_written_the_folder_for_temporary_files_serves(cache, tmp_path):
    (tmp_path / "cache").write_text("no folder")
    (tmp_path / "home").write_text("no folder")
    assert kernel_cache_directory().parent == tmp_path / "temporary" / f"granugas-{os.getuid()}"
    (tmp_path / "temporary" / f"granugas-{os.getuid()}").chmod(0o777)
    kernel_cache_directory.cache_clear()
    folder = kernel_cache_directory()
    assert folder.is_dir() and folder.parent != tmp_path / "temporary" / f"granugas-{os.getuid()}"
    assert stat.S_IMODE(folder.parent.stat().st_mode) == 0o700


def test_a_link_is_not_followed(cache, tmp_path):
    (tmp_path / "elsewhere").mkdir()
    cache.mkdir(parents=True, mode=0o700)
    (cache / f"kernels-{digest(sources.KERNELS)[:16]}").symlink_to(tmp_path / "elsewhere")
    assert cache not in kernel_cache_directory().parents


def test_folders_that_nobody_used_for_long_are_removed(cache):
    for name, days in (("kernels-old", 31), ("kernels-recent", 29), ("results", 31)):
        (cache / name).mkdir(parents=True)
        then = time.time() - days * 86400
        os.utime(cache / name, (then, then))
    cache.chmod(0o700)
    used = kernel_cache_directory()
    assert {path.name for path in cache.iterdir()} == {used.name, "kernels-recent", "results"}


def test_a_use_renews_the_folder(cache):
    folder = kernel_cache_directory()
    os.utime(folder, (0, 0))
    kernel_cache_directory.cache_clear()
    assert kernel_cache_directory() == folder and time.time() - folder.stat().st_mtime < 60


def test_the_choice_of_the_user_is_respected(cache, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", "/somewhere/else")
    use_kernel_cache()
    assert os.environ["NUMBA_CACHE_DIR"] == "/somewhere/else"


@pytest.mark.parametrize("before", ["", "/home/somebody/.cache/granugas/kernels-0123456789abcdef"])
def test_the_kernels_of_these_sources_are_used(cache, monkeypatch, before):
    monkeypatch.setenv("NUMBA_CACHE_DIR", before)
    use_kernel_cache()
    assert os.environ["NUMBA_CACHE_DIR"] == str(kernel_cache_directory())


def test_a_process_takes_what_the_one_that_started_it_found_while_the_files_are_the_same(package, monkeypatch):
    found = {}
    for text in ("A = 1", "A = 1  # said differently", "A = 2"):
        (package / "initial.py").write_text(text)
        environment = {**os.environ}
        found[text] = digest(["granugas.initial"])
        (known,) = {*os.environ} - {*environment}
        monkeypatch.setenv(known, "from elsewhere")
        assert digest(["granugas.initial"]) == "from elsewhere"
    one, same, other = found.values()
    assert one == same != other


@pytest.mark.parametrize("first", ["import numba", ""])
def test_numba_takes_the_folder_even_when_it_was_imported_before(cache, first):
    program = f"{first}\nimport granugas.digest as d\nd.use_kernel_cache()\nimport numba\nprint(numba.config.CACHE_DIR)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == str(cache / f"kernels-{digest(sources.KERNELS)[:16]}")


def test_a_full_disk_is_passed_over(cache, tmp_path, monkeypatch):
    room = {cache.parent: sources.ROOM - 1}
    usage = sources.shutil.disk_usage(tmp_path)
    free = lambda path: next((size for at, size in room.items() if at in path.parents), usage.free)  # noqa: E731
    monkeypatch.setattr(sources.shutil, "disk_usage", lambda path: usage._replace(free=free(path)))
    assert kernel_cache_directory().parent == tmp_path / "home/.cache/granugas"

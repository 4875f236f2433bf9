"""make mutation: how many small mistakes in the collision and in the prediction the tests notice.

Each mutant is loaded in place of the module, in a process of its own that has everything else imported already, and meets the
tests with the kernels as plain Python (NUMBA_DISABLE_JIT=1), until one of them fails or does not end.

mutmut leaves decorated functions out, which all kernels are; cosmic-ray starts Python and numba anew for each of a
multiple of these mutants.
"""

import argparse
import contextlib
import importlib
import importlib.util
import io
import multiprocessing
import os
import signal
import sys
import time
from pathlib import Path
from types import ModuleType
from typing import NoReturn

TESTS = Path(__file__).parents[1]
SOURCES = TESTS.parent / "src"
EVENTS = "granugas.dynamics.events"

UNIT = tuple(
    f"unit/dynamics/test_{name}"
    for name in (
        *("collisions.py", "predict.py"),
        *(
            "rough.py::test_surfaces_slide_beyond_the_limit_of_coulomb",
            "rough.py::test_energy_of_both_kinds_and_losses_add_up",
            "rough.py::test_an_elastic_contact_of_the_tc_model_does_not_rub",
        ),
        *(
            "collision_models.py::test_partners_that_part_slowly_are_kicked",
            "collision_models.py::test_what_follows_a_collision_is_a_chain_of_any_length",
        ),
    )
)
BRUTE = tuple(
    f"validation/test_brute_force.py::{name}"
    for name in ("test_few_disks[0.25-0.4-0.001-3]", "test_few_disks[0.01-1.0-0.0-2]", "test_many_disks[0.7-0.4-1e-05-42]")
)
CHECKED = {f"{EVENTS}.collisions": UNIT + BRUTE, f"{EVENTS}.predict": UNIT[1:2] + BRUTE}
"""Tests of each module, those that take least first."""

LONGEST = 100.0
"""Processor seconds after which a mutant is said not to end; without a mutant the tests take about 15."""

WANTED = 0.9
"""Share of mutants that must be noticed."""


def is_noticed(mutant: tuple[str, str]) -> bool:
    """Whether a test fails, or does not end, with this text of the module."""
    module, text = mutant
    chosen = [str(TESTS / test) for test in CHECKED[module]]
    options = [
        "-x",
        "-q",
        "-p",
        "no:cacheprovider",
        "-p",
        "no:xdist",
        "-m",
        "",
        "--timeout=0",
        f"--rootdir={TESTS.parent}",
    ]
    import pytest

    signal.signal(signal.SIGPROF, _give_up)
    signal.setitimer(signal.ITIMER_PROF, LONGEST)
    with contextlib.redirect_stdout(io.StringIO()):
        try:
            _load(module, text)
        except Exception:
            return True
        return pytest.main([*options, *chosen]) != pytest.ExitCode.OK


def _give_up(*_) -> NoReturn:
    raise TimeoutError(f"more than {LONGEST} s")


def _load(name: str, text: str) -> None:
    """Import a module from this text."""
    place = _file_of(name)
    spec = importlib.util.spec_from_file_location(name, place)
    package = importlib.import_module(name.rpartition(".")[0])
    module = sys.modules[name] = ModuleType(name)
    module.__spec__, module.__file__, module.__package__ = spec, str(place), package.__name__
    exec(compile(text, str(place), "exec"), module.__dict__)
    setattr(package, name.rpartition(".")[2], module)


def _file_of(module: str) -> Path:
    return SOURCES.joinpath(*module.split(".")).with_suffix(".py")


def main() -> int:
    """Check all mutants, or every n-th; 1 where too few are noticed."""
    from mutants import mutants_of

    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--every", type=int, default=1, metavar="N", help="only every N-th mutant")
    parser.add_argument("--cores", type=int, default=2)
    chosen = parser.parse_args()
    began, good = time.monotonic(), True
    with multiprocessing.get_context("fork").Pool(chosen.cores, maxtasksperchild=1) as pool:
        for module in CHECKED:
            source = _file_of(module).read_text(encoding="utf-8")
            if pool.apply(is_noticed, [(module, source)]):
                raise SystemExit(f"{module}: the tests fail without a mutant")
            mutants = mutants_of(source)[:: chosen.every]
            noticed = []
            for mutant, seen in zip(mutants, pool.imap(is_noticed, [(module, mutant.text) for mutant in mutants]), strict=True):
                noticed.append(seen)
                if not seen:
                    print(f"{module}:{mutant.line}: not noticed: {mutant.was}  ->  {mutant.now}", flush=True)
            share = sum(noticed) / len(mutants)
            good = good and share >= WANTED
            print(f"{module}: {sum(noticed)} of {len(mutants)} mutants noticed ({share:.1%})", flush=True)
    print(f"{(time.monotonic() - began) / 60:.0f} minutes")
    return 0 if good else 1


if __name__ == "__main__":
    os.environ["NUMBA_DISABLE_JIT"] = "1"
    sys.path[:0] = [str(SOURCES), str(TESTS)]
    for heavy in ("numba", "numba.extending", "xarray", "pandas", "pytest", "hypothesis", "_pytest.pastebin"):
        importlib.import_module(heavy)
    raise SystemExit(main())

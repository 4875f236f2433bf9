"""A kernel holds the effects that its scene names, and nothing of the others."""

import math
import re
import subprocess
import sys
from typing import NamedTuple

import numba
import numpy as np
import pytest
from gases import lattice_gas

from granugas.dynamics.events import loop
from granugas.dynamics.events import state as layout
from granugas.dynamics.events.collisions import restitution
from granugas.dynamics.events.composition import implements
from granugas.dynamics.events.effects.constant import Constant, Elastic
from granugas.dynamics.events.effects.contact_time import ContactTime
from granugas.dynamics.events.engine import Engine
from granugas.dynamics.events.memory import COMPILED
from granugas.scene import Scene

MAGIC = 0.8311234567890123
"""A coefficient of restitution that no other code has."""

SCENE = Scene(16, 0.2, restitution=1.0, contact_time=0.0)

pytestmark = pytest.mark.skipif(not COMPILED, reason="looks at machine code")


class Marked(NamedTuple):
    """A rule whose answer is recognizable in the compiled kernel."""


@implements(restitution, Marked)
def _marked(rule, gas, i, j, u_n, since):
    return MAGIC


def compiled(rule) -> str:
    """LLVM code of the loop composed with a rule, without the cache, whose kernels cannot be inspected."""
    engine = Engine(SCENE, lattice_gas(SCENE))
    run = numba.njit(error_model="numpy")(loop.run.py_func)
    run(layout.bundle(engine.arrays, engine.effects | {"rule": rule}), 10, 1000)
    return next(iter(run.inspect_llvm().values()))


def magic_bits() -> str:
    """How LLVM writes (1 + r) / 2 or r itself: as the bits of the number."""
    both = (MAGIC, 1.0 + MAGIC, 0.5 * (1.0 + MAGIC), 1.0 - MAGIC * MAGIC, 0.25 * (1.0 - MAGIC * MAGIC))
    return "|".join(f"0x{np.float64(x).view(np.uint64):X}|0x{np.float64(x).view(np.uint64):x}" for x in both)


@pytest.fixture(scope="module")
def kernels() -> dict[str, str]:
    rules = {"elastic": Elastic(), "constant": Constant(0.5), "tc": ContactTime(Constant(0.5), 1e-3), "marked": Marked()}
    return {name: compiled(rule) for name, rule in rules.items()}


def test_an_effect_is_in_the_kernel_that_names_it_alone(kernels):
    bits = re.compile(magic_bits())
    assert bits.search(kernels["marked"])
    for name in ("elastic", "constant", "tc"):
        assert not bits.search(kernels[name])


def test_the_kernel_without_the_tc_rule_is_smaller(kernels):
    """With r = 1 known the loss is zero and folds away; the TC rule adds a comparison, a counter and a branch."""

    def comparisons(code):
        return len(re.findall(r"fcmp", code)) + len(re.findall(r"add nsw i64|add i64", code))

    assert comparisons(kernels["elastic"]) <= comparisons(kernels["constant"]) < comparisons(kernels["tc"])


def test_answers_of_a_kernel_follow_its_rule():
    """The same start, three rules: only TC counts elastic collisions, only r < 1 loses energy."""
    told = {}
    for name, rule in {"elastic": Elastic(), "constant": Constant(0.5), "tc": ContactTime(Constant(0.5), 10.0)}.items():
        engine = Engine(SCENE, lattice_gas(SCENE), rule=rule)
        engine.advance(math.inf, 50)
        tally = engine.take_tally()
        told[name] = (tally.loss > 0, int(tally.elastic.sum()))
    assert told["elastic"] == (False, 0)
    assert told["constant"] == (True, 0)
    assert told["tc"][1] > 0


def test_a_plain_kernel_is_the_same_with_and_without_the_files_of_other_effects():
    """Machine code of the elastic loop in two processes: one imports the rule alone, the other every effect first."""
    code = """
import sys, hashlib, re
{first}
import numba
from granugas.dynamics.events import loop, state as layout
from granugas.dynamics.events.cast import OTHERWISE
from granugas.dynamics.events.effects.constant import Elastic
from granugas.dynamics.events.effects.nobody import Nobody
from granugas.dynamics.events.memory import allocate
tables = {{name: allocate(1 if name in layout.RECORDS else 8, rows) for name, rows in layout.layouts(2).items()}}
effects = {{place: effect() for place, effect in OTHERWISE.items()}}
gas = layout.bundle(tables, effects | {{"rule": Elastic(), "watch": Nobody()}})
run = numba.njit(error_model="numpy")(loop.run.py_func)
run.compile((numba.typeof(gas), numba.int64, numba.int64))
text = next(iter(run.inspect_asm().values()))
text = re.sub(r"_ZN[A-Za-z0-9_$.]+|\\.const\\.[^\\s,]+|0x[0-9a-f]+", "name", text)
print(len(text), hashlib.sha256(text.encode()).hexdigest())
"""
    imports = """
import pkgutil
from importlib import import_module
from granugas.dynamics.events import effects
for module in pkgutil.iter_modules(effects.__path__, effects.__name__ + "."):
    import_module(module.name)
"""
    printed = [
        subprocess.run([sys.executable, "-c", code.format(first=first)], capture_output=True, text=True, check=True).stdout
        for first in ("", imports)
    ]
    assert printed[0] == printed[1]

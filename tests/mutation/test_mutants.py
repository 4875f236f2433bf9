"""The mutants themselves: each is another program, each kind of mistake is made, and what is no code is left alone."""

import ast

import pytest
from mutation.mutants import mutants_of

TEXT = '''
"""A docstring."""
import math

LIMIT = 2.0
"""Of everything."""

@decorated(1)
def f(x, y=1):
    """Another one."""
    total.sum += x * y
    if x < LIMIT and y != 0:
        return math.inf
    record(x)
    return max(x, -y)
'''


@pytest.fixture(scope="module")
def mutants():
    return mutants_of(TEXT)


def test_every_mutant_is_another_program(mutants):
    texts = {ast.unparse(ast.parse(TEXT)), *(mutant.text for mutant in mutants)}
    assert len(texts) == len(mutants) + 1


@pytest.mark.parametrize(
    ("line", "now"),
    [
        (5, "LIMIT = 3.0"),
        (11, "total.sum -= x * y"),
        (11, "total.sum += x / y"),
        (11, "pass"),
        (12, "if x <= LIMIT and y != 0:"),
        (12, "if x >= LIMIT and y != 0:"),
        (12, "if x < LIMIT or y != 0:"),
        (12, "if x < LIMIT and y == 0:"),
        (12, "if not (x < LIMIT and y != 0):"),
        (13, "return math.pi"),
        (14, "pass"),
        (15, "return min(x, -y)"),
        (15, "return max(x, y)"),
    ],
)
def test_mistakes_that_are_made(mutants, line, now):
    assert (line, now) in {(mutant.line, mutant.now) for mutant in mutants}


def test_what_is_no_code_of_a_function_stays(mutants):
    assert {mutant.line for mutant in mutants} <= {5, 11, 12, 13, 14, 15}
    for mutant in mutants:
        assert "@decorated(1)\ndef f(x, y=1):" in mutant.text
        assert '"""A docstring."""' in mutant.text

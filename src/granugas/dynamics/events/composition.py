"""How a kernel is put together from the effects that a scene names, and from nothing else.

An effect is a NamedTuple that holds its numbers (`ContactTime(restitution, contact_time)`). A generic function is a question
that the loop asks (`restitution(rule, gas, since)`); each effect answers it in a file of its own:

    @implements(restitution, ContactTime)
    def _contact_time(rule, gas, since): ...

The type of an effect is known when the kernel is compiled, so the call compiles to that one answer: the code of any other
effect is not in the kernel, and a function that answers with a constant leaves no trace. An effect may hold another one and ask
it in turn. In the same way a function of vectors has one answer for each number of dimensions (vectors.py). Without the
compiler (NUMBA_DISABLE_JIT=1) the same call looks the answer up by the class of the effect, or the length of the vector.
"""

from collections.abc import Callable
from functools import wraps
from typing import Any

from numba import njit, types
from numba.extending import overload

from granugas.dynamics.events.memory import COMPILED

PART: dict[str, Any] = {"error_model": "numpy", "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
"""Python cannot call a part (the process dies): without wrappers for it, kernels compile in 3/5 of the time."""

inline = njit(**PART, forceinline=True)
"""A part of a kernel: no function of its own in the machine code."""

outline = njit(**PART)
"""A part of a kernel that is called so seldom that it stays a function."""

kernel = njit(error_model="numpy", cache=True, no_cfunc_wrapper=True)
"""An entry from Python, kept in the cache of kernels."""

ANY = object
"""In place of a kind: the answer of all that have none of their own."""


def generic(question: Callable[..., Any]) -> Callable[..., Any]:
    """A function of kernels that is answered by the kind of its first argument (see `implements`)."""
    answers: dict[type | int, Callable[..., Any]] = {}

    @wraps(question)
    def ask(first: Any, *arguments: Any) -> Any:
        kind = len(first) if type(first) is tuple else type(first)
        return answers.get(kind, answers.get(ANY))(first, *arguments)

    def choose(first: types.Type, *arguments: types.Type) -> Callable[..., Any] | None:
        return answers.get(_kind_of(first), answers.get(ANY))

    ask.answers = answers
    if COMPILED:
        overload(ask, jit_options=PART | {"forceinline": True}, strict=False)(choose)
    return ask


def implements(question: Callable[..., Any], kind: type | int) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Register the decorated function as the answer to a generic function.

    Args:
        question: the generic function.
        kind: of its first argument that is answered: an effect (a NamedTuple class), vectors of so many components, or ANY.
    """

    def register(answer: Callable[..., Any]) -> Callable[..., Any]:
        question.answers[kind] = answer
        return answer

    return register


def _kind_of(argument: types.Type) -> type | int | None:
    if isinstance(argument, types.BaseNamedTuple):
        return argument.instance_class
    return len(argument) if isinstance(argument, types.BaseTuple) else None

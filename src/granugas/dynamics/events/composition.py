"""How a kernel is put together from the effects that a scene names, and from nothing else.

An effect is a NamedTuple that holds its numbers (`ContactTime(restitution, contact_time)`). A generic function is a question
that the loop asks (`restitution(rule, gas, since)`); each effect answers it in a file of its own:

    @implements(restitution, ContactTime)
    def _contact_time(rule, gas, since): ...

The type of an effect is known when the kernel is compiled, so the call compiles to that one answer: the code of any other
effect is not in the kernel, and a function that answers with a constant leaves no trace. Without the compiler
(NUMBA_DISABLE_JIT=1) the same call looks the answer up by the class of the effect.
"""

from collections.abc import Callable
from functools import wraps
from typing import Any

from numba import njit
from numba.extending import overload

from granugas.dynamics.events.memory import COMPILED

OPTIONS = {"error_model": "numpy", "forceinline": True}

inline = njit(**OPTIONS)
"""A part of a kernel: no function of its own in the machine code."""

outline = njit(error_model="numpy")
"""A part of a kernel that is called so seldom that it stays a function."""

kernel = njit(error_model="numpy", cache=True)
"""An entry from Python, kept in the cache of kernels."""


def generic(question: Callable[..., Any]) -> Callable[..., Any]:
    """A function of kernels that is answered by the class of its first argument (see `implements`)."""
    answers: dict[type, Callable[..., Any]] = {}

    @wraps(question)
    def ask(effect: Any, *arguments: Any) -> Any:
        return answers[type(effect)](effect, *arguments)

    ask.answers = answers
    return ask


def implements(question: Callable[..., Any], effect: type) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Register the decorated function as the answer of `effect` (a NamedTuple class) to a generic function."""

    def register(answer: Callable[..., Any]) -> Callable[..., Any]:
        question.answers[effect] = answer
        if COMPILED:

            def choose(first: Any, *arguments: Any) -> Callable[..., Any] | None:
                return answer if getattr(first, "instance_class", None) is effect else None

            overload(question, jit_options=OPTIONS, strict=False)(choose)
        return answer

    return register

"""Kernels as plain Python."""

from collections.abc import Callable
from typing import Any


def python_of(kernel: Callable[..., Any]) -> Callable[..., Any]:
    """The Python function of a compiled one; itself where NUMBA_DISABLE_JIT=1 compiles nothing."""
    return getattr(kernel, "py_func", kernel)

"""Looser arithmetic for a whole process, to see what it would gain: no run uses it."""

import numba

from granugas.dynamics.events import loop


def use(flags: set[str]) -> None:
    """From now on, and for the rest of this process, the loop is compiled with these flags; without any it stays.

    The flags of an entry go down to all functions that it calls and that are not compiled yet, so call it before the first
    engine is made. Nothing of it comes into the cache of kernels.

    Args:
        flags: LLVM's fast-math flags, such as contract, reassoc, fast.
    """
    for name in ("run", "start") if flags else ():
        setattr(loop, name, numba.njit(error_model="numpy", fastmath=flags)(getattr(loop, name).py_func))

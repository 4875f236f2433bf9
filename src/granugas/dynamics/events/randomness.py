"""Random numbers of kernels: a generator of 64 bits whose state is a record, so that a checkpoint goes on bit for bit.

Marsaglia's xorshift (J. Stat. Softw. 8 (14), 2003): three shifts, no sum and no product, so that it does the same with the
integers of compiled code, which wrap around, and with those of plain Python, which complain.
"""

import hashlib

import numpy as np

from granugas.dynamics.events.composition import inline
from granugas.dynamics.events.memory import Record
from granugas.dynamics.state import State

STREAM = np.dtype([("bits", "u8")])
"""The state of a generator: anything but 0."""

_A, _B, _C, _LOW = np.uint64(13), np.uint64(7), np.uint64(17), np.uint64(11)


def stream(state: State, name: str) -> Record:
    """A stream of random numbers that follows from a start state alone; effects with different names have different ones."""
    seed = hashlib.blake2b(np.ascontiguousarray(state.velocity).tobytes(), digest_size=8, person=name.encode()[:16]).digest()
    rows = np.zeros(1, STREAM)
    rows["bits"] = max(int.from_bytes(seed, "little"), 1)
    return Record(rows)


@inline
def uniform(stream):
    """The next random number, from 0 up to and without 1."""
    x = stream.bits
    x ^= x << _A
    x ^= x >> _B
    x ^= x << _C
    stream.bits = x
    return float(x >> _LOW) * 2.0**-53


@inline
def symmetric(stream):
    """The next random number from -1 up to and without 1."""
    return 2.0 * uniform(stream) - 1.0

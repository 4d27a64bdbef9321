"""FLINT's working precision and the length of its power series: the only place that sets them.

`flint.ctx` is global: a thread that changes it changes it for all others.  So each change is made under one lock, which is
held while it is in force, and always undone.  Threads wait for each other; processes don't.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from threading import RLock

from flint import ctx

_LOCK = RLock()


@contextmanager
def working_precision(bits: int) -> Iterator[None]:
    """FLINT's precision within the block, in bits."""
    with _LOCK, ctx.workprec(bits):
        yield


@contextmanager
def working_digits(digits: int) -> Iterator[None]:
    """FLINT's precision within the block, in decimal digits."""
    with _LOCK, ctx.workdps(digits):
        yield


@contextmanager
def series_length(terms: int) -> Iterator[None]:
    """The number of terms of FLINT's power series within the block."""
    with _LOCK:
        before = ctx.cap
        ctx.cap = terms
        try:
            yield
        finally:
            ctx.cap = before

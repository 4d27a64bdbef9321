"""The working precision, for one thread at a time.

`flint.ctx.prec` is global: a thread that sets it changes the precision of every other one.  So the enclosures set it here only,
under a lock that is held as long as the precision is in force.  Threads wait for each other; processes don't.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from threading import RLock

from flint import ctx

_LOCK = RLock()


@contextmanager
def working_precision(bits: int) -> Iterator[None]:
    """FLINT's precision within the block; it is what it was before afterwards, whatever happens."""
    with _LOCK, ctx.workprec(bits):
        yield

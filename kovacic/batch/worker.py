"""The child process of a batch: reads a job and then items, and writes a record for each of them, all of them pickled.

The first record says that it is ready.  It ends when its input ends.  What anything else prints goes to standard error, which
the parent keeps for the case that the process dies.  Unexpected exceptions aren't caught here: the process ends with its
traceback, and the parent replaces it.

The memory limit is the address space that the process may have beyond what it has when an equation begins, so that one
equation never pays for another.
"""

from __future__ import annotations

import gc
import os
import pickle
import signal
import sys
import threading
import time
from contextlib import suppress
from typing import Any

import kovacic
from kovacic.batch.records import Item, Job, Record, refused, solved
from kovacic.errors import KovacicError
from kovacic.limits import Limits

_ORPHAN_CHECK_SECONDS = 1.0


def main() -> None:
    """Serve until the end of the input."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the parent's affair
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    _leave_with_parent()
    job: Job = pickle.load(sys.stdin.buffer)
    limits, item = job.engine_limits, Item(0, "x**2 + 3")
    record = solve_item(item, job, limits)  # the modules are loaded before the clock of the first equation starts
    gc.freeze()  # what is loaded stays: the collector needn't look at it again
    with suppress(EOFError):
        while True:
            answers.write(pickle.dumps((record.number, record.label, record.seconds, record.json)))
            answers.flush()
            item = Item(*pickle.load(sys.stdin.buffer))
            if job.memory is not None:
                _limit_memory(job.memory)
            _set_alarm(0.0 if job.timeout is None else job.timeout + 5.0)
            record = solve_item(item, job, limits)
            _set_alarm(0.0)


def solve_item(item: Item, job: Job, limits: Limits) -> Record:
    """The record of one item, computed in this process; the limits are those of the job."""
    start = time.perf_counter()
    try:
        return solved(item, kovacic.solve(item.text, var=item.var, limits=limits), job)
    except KovacicError as error:
        return refused(item, error, time.perf_counter() - start)


def _leave_with_parent() -> None:
    """End this process soon after its parent is gone, even in the middle of a long equation."""
    parent = os.getppid()

    def watch() -> None:
        while os.getppid() == parent:
            time.sleep(_ORPHAN_CHECK_SECONDS)
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def _limit_memory(mebibytes: int) -> None:
    """Move the bound on the address space along with what the process has."""
    resource: Any = __import__("resource")  # not on every system; `Job` with `memory` needs it
    with open("/proc/self/statm", "rb") as statm:
        size = int(statm.readline().split()[0]) * resource.getpagesize()
    wanted, (_, hard) = size + (mebibytes << 20), resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (wanted if hard == resource.RLIM_INFINITY else min(wanted, hard), hard))


def _set_alarm(seconds: float) -> None:
    """Let the system end the process if the parent, which kills it earlier, can't: the default action isn't Python's."""
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_REAL, seconds)


if __name__ == "__main__":
    main()

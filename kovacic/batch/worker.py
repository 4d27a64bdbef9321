"""The child process of a batch: reads a job and then items, a line each, and writes a record for each of them.

It ends when its input ends.  Nothing but records is written to standard output: what anything else prints goes to standard
error, which the parent keeps for the case that the process dies.  Unexpected exceptions aren't caught here: the process
ends with its traceback, and the parent replaces it.

The memory limit is the address space that the process may have beyond what it has when an equation begins, so that one
equation never pays for another.
"""

from __future__ import annotations

import gc
import json
import os
import signal
import sys
import threading
import time
from collections.abc import Callable
from typing import Any

import kovacic
from kovacic.batch.records import Item, Job, Record, refused, solved
from kovacic.errors import KovacicError
from kovacic.limits import Limits

READY = "ready"
_ORPHAN_CHECK_SECONDS = 1.0


def main() -> None:
    """Serve until the end of the input."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the parent's affair
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8", errors="backslashreplace", newline="\n")
    os.dup2(2, 1)
    _leave_with_parent()
    job = Job.loads(sys.stdin.readline())
    limits = job.engine_limits
    solve_item(Item(0, "x**2 + 3"), job, limits)  # the modules are loaded before the clock of the first equation starts
    renew_memory = None if job.memory is None else _memory_limit(job.memory)
    gc.freeze()  # what is loaded stays: the collector needn't look at it again
    print(READY, file=answers, flush=True)
    for line in sys.stdin:
        item = decode_item(line)
        if renew_memory is not None:
            renew_memory()
        if job.timeout is not None:
            _set_alarm(job.timeout + 5.0)
        record = solve_item(item, job, limits)
        if job.timeout is not None:
            _set_alarm(0.0)
        print(encode_record(record), file=answers, flush=True)


def solve_item(item: Item, job: Job, limits: Limits) -> Record:
    """The record of one item, computed in this process; the limits are those of the job."""
    start = time.perf_counter()
    try:
        if item.error is not None:
            raise item.error
        return solved(item, kovacic.solve(item.text, var=item.var, limits=limits), job)
    except KovacicError as error:
        return refused(item, error, time.perf_counter() - start)


def encode_item(item: Item) -> str:
    """An item without error as a line of ASCII text."""
    return json.dumps([item.number, item.text, item.var, dict(item.extra)]) + "\n"


def decode_item(line: str) -> Item:
    return Item(*json.loads(line))


def encode_record(record: Record) -> str:
    """A record as a line: the JSON stays as it is, so that the parent needn't read it."""
    return f"{record.number}\t{record.label}\t{record.seconds:.6f}\t{record.json}"


def decode_record(line: str) -> Record:
    number, label, seconds, text = line.rstrip("\n").split("\t", 3)
    return Record(int(number), label, float(seconds), text)


def _leave_with_parent() -> None:
    """End this process soon after its parent is gone, even in the middle of a long equation."""
    parent = os.getppid()

    def watch() -> None:
        while os.getppid() == parent:
            time.sleep(_ORPHAN_CHECK_SECONDS)
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def _memory_limit(mebibytes: int) -> Callable[[], None]:
    """What moves the bound on the address space along with what the process has when an equation begins."""
    resource: Any = __import__("resource")  # not on every system; `Job` with `memory` needs it
    page, hard = resource.getpagesize(), resource.getrlimit(resource.RLIMIT_AS)[1]
    statm = os.open("/proc/self/statm", os.O_RDONLY)
    last = -1

    def renew() -> None:
        nonlocal last
        pages = int(os.pread(statm, 32, 0).split(maxsplit=1)[0])
        if pages != last:
            last = pages
            wanted = pages * page + (mebibytes << 20)
            resource.setrlimit(
                resource.RLIMIT_AS, (wanted if hard == resource.RLIM_INFINITY else min(wanted, hard), hard)
            )

    return renew


def _set_alarm(seconds: float) -> None:
    """Let the system end the process if the parent, which kills it earlier, can't: the default action isn't Python's."""
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_REAL, seconds)


if __name__ == "__main__":
    main()

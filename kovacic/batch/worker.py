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
from typing import IO, Any

import kovacic
from kovacic.batch.items import Item, Job, Record, refused, solved
from kovacic.errors import KovacicError
from kovacic.limits import Limits

READY = "ready"
_MIB = 1 << 20
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
    memory = None if job.memory is None else _MemoryLimit(job)
    gc.freeze()  # what is loaded stays: the collector needn't look at it again
    _write(answers, READY)
    for line in sys.stdin:
        item = decode_item(line)
        if memory is not None:
            memory.renew()
        _set_alarm(job)
        record = solve_item(item, job, limits)
        _clear_alarm(job)
        _write(answers, encode_record(record))


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
    number, text, var, extra = json.loads(line)
    return Item(number, text, var, extra)


def encode_record(record: Record) -> str:
    """A record as a line: the JSON stays as it is, so that the parent needn't read it."""
    return f"{record.number}\t{record.label}\t{record.seconds:.6f}\t{record.json}"


def decode_record(line: str) -> Record:
    number, label, seconds, text = line.rstrip("\n").split("\t", 3)
    return Record(int(number), label, float(seconds), text)


def _write(stream: IO[str], line: str) -> None:
    stream.write(line + "\n")
    stream.flush()


def _leave_with_parent() -> None:
    """End this process soon after its parent is gone, even in the middle of a long equation."""
    parent = os.getppid()

    def watch() -> None:
        while os.getppid() == parent:
            time.sleep(_ORPHAN_CHECK_SECONDS)
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


class _MemoryLimit:
    """The job's bound on the address space, moved along with what the process has when an equation begins."""

    def __init__(self, job: Job) -> None:
        assert job.memory is not None
        self._resource: Any = __import__("resource")  # not on every system; `Job` with `memory` needs it
        self._page = self._resource.getpagesize()
        self._allowed = job.memory * _MIB
        self._hard = self._resource.getrlimit(self._resource.RLIMIT_AS)[1]
        self._statm = os.open("/proc/self/statm", os.O_RDONLY)
        self._pages = -1

    def renew(self) -> None:
        pages = int(os.pread(self._statm, 32, 0).split(maxsplit=1)[0])
        if pages == self._pages:
            return
        self._pages = pages
        wanted = pages * self._page + self._allowed
        wanted = wanted if self._hard == self._resource.RLIM_INFINITY else min(wanted, self._hard)
        self._resource.setrlimit(self._resource.RLIMIT_AS, (wanted, self._hard))


def _set_alarm(job: Job) -> None:
    """Let the system end the process if the parent, which kills it earlier, can't: the default action isn't Python's."""
    if job.timeout is not None and hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_REAL, job.timeout + 5.0)


def _clear_alarm(job: Job) -> None:
    if job.timeout is not None and hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_REAL, 0.0)


if __name__ == "__main__":
    main()

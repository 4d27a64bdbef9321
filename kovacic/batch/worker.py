"""The worker processes of a batch: each receives a job and then items, and sends a record for each item.

The first record says that the process is ready.  Unexpected exceptions aren't caught here: the process ends with its
traceback, and the parent replaces it.

The memory limit is the address space that the process may have beyond its size when an equation begins, so that one equation
never pays for another.
"""

from __future__ import annotations

import gc
import time
from typing import Any

import kovacic
from kovacic.batch.records import Item, Job, Record, record_of, refused
from kovacic.errors import KovacicError
from kovacic.limits import Budget, Limits
from kovacic.process import Channel, set_alarm


def serve(channel: Channel) -> None:
    """Answer until the end of the input."""
    job: Job = channel.receive()
    limits = job.engine_limits
    # The modules are loaded before the clock of the first equation starts.
    record = solve_item(Item(0, "x**2 + 3"), job, limits)
    gc.freeze()  # modules stay: the collector needn't visit them again
    while True:
        channel.send(record)
        item: Item = channel.receive()
        if job.memory is not None:
            _limit_memory(job.memory)
        if job.timeout is not None:
            set_alarm(job.timeout + 5.0)
        record = solve_item(item, job, limits)
        set_alarm(0.0)


def solve_item(item: Item, job: Job, limits: Limits) -> Record:
    """The record of one item, found and written within the time limit, or written after it if undecided."""
    start = time.perf_counter()
    budget = Budget(limits)
    try:
        answer = kovacic.solve(item.text, var=item.var, parameters=(*job.parameters, *item.names), limits=limits)
        if answer.reason:
            return record_of(item, answer, job)
        with budget.watched():
            return record_of(item, answer, job)
    except KovacicError as error:
        return refused(item, error, time.perf_counter() - start)


def _limit_memory(mebibytes: int) -> None:
    """Move the bound on the address space along with the size of the process."""
    resource: Any = __import__("resource")  # not on every system; `Job` with `memory` needs it
    with open("/proc/self/statm", "rb") as statm:
        size = int(statm.readline().split()[0]) * resource.getpagesize()
    wanted = size + (mebibytes << 20)
    (_, hard) = resource.getrlimit(resource.RLIMIT_AS)
    if hard != resource.RLIM_INFINITY:
        wanted = min(wanted, hard)
    resource.setrlimit(resource.RLIMIT_AS, (wanted, hard))

"""A pool of worker processes that can be killed: every item gets exactly one record.

One loop in the caller's thread gives each process that has nothing to do some items, as many as take about 20 ms, and waits for
events (a record, the end of a process, an item from a stream) and for the next deadline.

A process that is over its time is killed, and its item gets a record.  So does the item of a process that has ended with an
exception; one whose process was killed by somebody else gets another one, up to three times.  What waited behind the item
goes back to the front.

A separate interpreter is started instead of a fork or of `multiprocessing`: it works in programs with threads, in notebooks
and in scripts without a main guard, and it can be killed at any moment without harm to the parent.
"""

from __future__ import annotations

import json
import math
import pickle
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter, deque
from collections.abc import Iterable, Iterator, Sequence
from contextlib import AbstractContextManager, suppress
from queue import Empty, Queue, SimpleQueue
from typing import IO, Any, cast

from kovacic.batch.records import Item, Job, ProcessLost, Record, refused, stopped
from kovacic.errors import InputError, KovacicError

# The interpreter looks for modules where this one does, and not in the current directory.
_START = "import json, sys; sys.path[:] = json.loads(sys.argv[1]); from kovacic.batch.worker import main; main()"
_SHOWN_ERROR_BYTES = 20_000

# A process has so many seconds beyond the timeout to end by itself, with an answer that says what it has excluded.
GRACE_SECONDS = 0.25
_START_SECONDS = 120.0

# A signal may come from somebody else: so many starts in a row, or processes of one item, may end by one.
_ATTEMPTS = 4

# In order of the input, at most so many items are read beyond the first one that has no answer.
ORDERED_WINDOW = 10_000

# Items that are read from a stream before they are needed.
_AHEAD = 256

# A process gets items for so many seconds at once, so that it needn't wait for the parent after each of them; but one item
# where they take longer, and no more text than fits into a pipe, since the parent would wait for a process that is busy.
_SECONDS_AT_ONCE = 0.02
_ITEMS_AT_ONCE = 32
_CHARACTERS_AT_ONCE = 30_000

# The last words of Python, GMP, flint and the C++ library.
_OUT_OF_MEMORY = re.compile(r"MemoryError|(cannot|unable to) (re)?allocate|bad_alloc", re.IGNORECASE)


# A record of a child, or None at its end; in place of the pair None, where an item of a stream has arrived.
Event = tuple["Child", Record | None] | None


class Child:
    """A worker process, and the items that it hasn't answered; it works on the first one."""

    def __init__(self, job: Job, events: SimpleQueue[Event]) -> None:
        self.items: deque[Item] = deque()
        self.ready = False
        self.busy_since = time.monotonic()
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115 - closed by kill()
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-c", _START, json.dumps(sys.path)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._errors,
        )
        self.pid = self._process.pid
        self._to, self._from = cast("IO[bytes]", self._process.stdin), cast("IO[bytes]", self._process.stdout)
        self._reader = threading.Thread(target=self._read, args=(events,), daemon=True)
        self._reader.start()
        self._send(job)

    def give(self, items: Sequence[Item]) -> None:
        """What the process has to do next."""
        self.items.extend(items)
        self.busy_since = time.monotonic()
        self._send(*[(item.number, item.text, item.var, item.extra) for item in items])

    def kill(self) -> None:
        """End the process at once and wait for it; its reader thread ends as well."""
        self._process.kill()
        self._process.wait()
        self._reader.join()
        self._from.close()
        with suppress(OSError):  # something was still waiting to be written
            self._to.close()
        self._errors.close()

    def last_words(self) -> tuple[int, str]:
        """The exit status (negative: a signal) and the end of the standard error of a process that has ended."""
        status = self._process.wait()
        size = self._errors.seek(0, 2)
        self._errors.seek(max(0, size - _SHOWN_ERROR_BYTES))
        return status, self._errors.read().decode("utf-8", errors="replace").strip()

    def _send(self, *data: Any) -> None:
        with suppress(OSError):  # a broken pipe: the end of the process arrives as an event
            self._to.write(b"".join(map(pickle.dumps, data)))
            self._to.flush()

    def _read(self, events: SimpleQueue[Event]) -> None:
        try:
            while True:
                events.put((self, Record(*pickle.load(self._from))))
        except (EOFError, pickle.UnpicklingError):  # the end of the process, perhaps while it wrote
            pass
        finally:
            events.put((self, None))


class Pool(AbstractContextManager["Pool"]):
    """`jobs` worker processes for one job; a context manager, which kills them at the end.

    >>> from kovacic.batch.records import Item, Job
    >>> with Pool(1, Job(timeout=60)) as pool:
    ...     [record.label for record in pool.run([Item(1, "x^2 + 3"), Item(2, "x"), Item(3, "x+")])]
    ['case 1', 'none', 'bad input']
    """

    def __init__(self, jobs: int, job: Job) -> None:
        self.job, self._jobs = job, jobs
        self._events: SimpleQueue[Event] = SimpleQueue()
        self._children: list[Child] = []
        self._again: deque[Item] = deque()
        self._losses: Counter[int] = Counter()
        self._failed_starts = 0
        self._pace = 1.0  # seconds for an item, lately
        self.replaced = 0

    def __exit__(self, *error: object) -> None:
        self.close()

    def close(self) -> None:
        """Kill the processes; `run` would start new ones."""
        for child in self._children:
            child.kill()
        for kept in (self._children, self._again, self._losses):
            kept.clear()
        self._failed_starts = 0

    def pids(self) -> list[int]:
        """The identifiers of the worker processes."""
        return [child.pid for child in self._children]

    def run(self, items: Iterable[Item], *, ordered: bool = True, stream: bool = False) -> Iterator[Record]:
        """One record for each item, in the order of the items or as they finish.

        The numbers of the items must differ.  `stream` says that the items may be long in coming.
        """
        feed = _read_ahead(items, self._events) if stream else iter(items)
        if not ordered:
            yield from self._records(feed)
            return
        order: deque[int] = deque()
        ready: dict[int, Record] = {}

        def noted() -> Iterator[Item | None]:
            for item in feed:
                while len(order) >= ORDERED_WINDOW:
                    yield None
                if item is not None:
                    order.append(item.number)
                yield item

        for record in self._records(noted()):
            ready[record.number] = record
            while order and order[0] in ready:
                yield ready.pop(order.popleft())

    def _records(self, feed: Iterator[Item | None]) -> Iterator[Record]:
        """The records as they come; the feed gives None where there is no item for the moment."""
        while len(self._children) < self._jobs:
            self._children.append(Child(self.job, self._events))
        exhausted = False
        while True:
            for child in self._children:
                given, room = list[Item](), _CHARACTERS_AT_ONCE
                most = min(_SECONDS_AT_ONCE / self._pace, _ITEMS_AT_ONCE) if child.ready and not child.items else 0
                while len(given) < most and room > 0:
                    try:
                        item = self._again.popleft() if self._again else None if exhausted else next(feed)
                    except StopIteration:
                        exhausted = True
                        break
                    if item is None:
                        break
                    room -= len(item.text)
                    if item.error is not None:
                        yield refused(item, item.error)
                    elif given and room < 0:
                        self._again.appendleft(item)
                    else:
                        given.append(item)
                if given:
                    child.give(given)
            if exhausted and not self._again and not any(child.items for child in self._children):
                return
            yield from self._handle(self._wait())

    def _wait(self) -> list[Event]:
        """The events that have arrived, at least one unless a deadline comes first."""
        deadline = min(map(self._deadline, self._children))
        events: list[Event] = []
        try:
            wait = None if deadline == math.inf else max(0.0, deadline - time.monotonic())
            events.append(self._events.get(timeout=wait))
            while True:
                events.append(self._events.get_nowait())
        except Empty:
            return events

    def _deadline(self, child: Child) -> float:
        if not child.ready:
            return child.busy_since + _START_SECONDS
        if self.job.timeout is None or not child.items:
            return math.inf
        return child.busy_since + self.job.timeout + GRACE_SECONDS

    def _handle(self, events: list[Event]) -> Iterator[Record]:
        for event in events:
            if event is None or event[0] not in self._children:
                continue
            child, record = event
            if record is None:
                yield from self._died(child)
            elif not child.ready:  # with a record of nothing, by which it says so
                child.ready = True
                self._failed_starts = 0
            else:
                before, child.busy_since = child.busy_since, time.monotonic()
                child.items.popleft()
                self._pace += (child.busy_since - before - self._pace) / 8
                yield record
        if not events:
            now = time.monotonic()
            for child in [child for child in self._children if self._deadline(child) <= now]:
                yield self._over_time(child)

    def _over_time(self, child: Child) -> Record:
        if not child.items:
            raise KovacicError(f"a worker process hasn't started within {_START_SECONDS:g} s")
        reason = f"the time limit of {self.job.timeout:g} s is used up (process killed)"
        item = child.items.popleft()
        self._replace(child)
        return stopped(item, reason, time.monotonic() - child.busy_since)

    def _died(self, child: Child) -> Iterator[Record]:
        status, words = child.last_words()
        if not child.ready:
            self._failed_starts += 1
            if self._failed_starts >= _ATTEMPTS:
                raise KovacicError(f"worker processes can't be started: {_cause(status, words)}\n{words}")
        item = child.items.popleft() if child.items else None
        self._replace(child)
        if item is not None:
            seconds, limit = time.monotonic() - child.busy_since, self._limit_behind(status, words)
            self._losses[item.number] += 1
            if limit is not None:
                yield stopped(item, limit, seconds)
            elif self._losses[item.number] >= (_ATTEMPTS if status < 0 else 1):  # an exception repeats itself
                yield refused(item, ProcessLost(_cause(status, words)), seconds)
            else:
                self._again.appendleft(item)

    def _limit_behind(self, status: int, words: str) -> str | None:
        """Which limit the end of a process means; None for another reason."""
        if self.job.memory is not None and _OUT_OF_MEMORY.search(words):
            return f"the memory limit of {self.job.memory} MiB is used up (process ended)"
        if self.job.timeout is not None and _signal_name(status) == "SIGALRM":
            return f"the time limit of {self.job.timeout:g} s is used up (process ended)"
        return None

    def _replace(self, child: Child) -> None:
        """Kill a process, take back what it hasn't begun, and start another one."""
        self._again.extendleft(reversed(child.items))
        child.kill()
        self._children[self._children.index(child)] = Child(self.job, self._events)
        self.replaced += 1


def _read_ahead(items: Iterable[Item], events: SimpleQueue[Event]) -> Iterator[Item | None]:
    """The items of a stream, read by a thread, so that answers come out while it is silent; None where there is none yet."""
    queue: Queue[Item | InputError | None] = Queue(_AHEAD)

    def read() -> None:
        end = None
        try:
            for item in items:
                queue.put(item)
                events.put(None)
        except InputError as error:  # a broken compressed stream, for example
            end = error
        queue.put(end)
        events.put(None)

    threading.Thread(target=read, daemon=True).start()
    while True:
        try:
            item = queue.get_nowait()
        except Empty:
            yield None
            continue
        if isinstance(item, InputError):
            raise item
        if item is None:
            return
        yield item


def _cause(status: int, words: str) -> str:
    end = f"signal {_signal_name(status)}" if status < 0 else f"exit status {status}"
    last_line = words.splitlines()[-1].strip() if words else ""
    return f"the worker process ended with {end}" + (f": {last_line}" if last_line else "")


def _signal_name(status: int) -> str:
    """The name of the signal that ended a process, or its number; not every system knows all of them."""
    return next((known.name for known in signal.Signals if known == -status), str(-status))

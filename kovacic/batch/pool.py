"""A pool of worker processes that can be killed: every item gets exactly one record.

One loop in the caller's thread goes round in four steps.  Each idle process gets an item, and an item that is refused without
a process its record.  If none was refused, the loop waits for an event: a record, the end of a process, an item from a stream,
or the deadline of a process.  Events are taken up.  Processes that are over their time are killed.

A process that is over its time is killed, and its item gets a record.  So does the item of a process that has ended with an
exception; one whose process was killed by somebody else gets another one, up to three times.

The processes are those of `kovacic.process`, and run `kovacic.batch.worker.serve`.
"""

from __future__ import annotations

import math
import re
import signal
import threading
import time
from collections import Counter, deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, suppress
from queue import Empty, Queue, SimpleQueue

from kovacic.batch import worker
from kovacic.batch.records import Item, Job, ProcessLost, Record, refused, stopped
from kovacic.errors import KovacicError
from kovacic.process import Channel, Process

# Seconds beyond the timeout in which a process may end by itself, with an answer that has the exclusions so far.
GRACE_SECONDS = 0.25
# Seconds for the start of a process, which takes less than one on an idle machine.
_START_SECONDS = 120.0

# A signal may come from somebody else: starts in a row, or processes of one item or chunk, that may end by one.
MOST_LOSSES = 4

# Items read ahead: in order of the input, beyond the first one without an answer; from a stream, before they are needed.
_AHEAD = 10_000

# The last words of Python, GMP, flint and the C++ library.
_OUT_OF_MEMORY = re.compile(r"MemoryError|(cannot|unable to) (re)?allocate|bad_alloc", re.IGNORECASE)


# The function that a worker process runs.
Serve = Callable[[Channel], None]

# A record of a child, or None at its end; in place of the pair None, where an item of a stream has arrived.
Event = tuple["Child", Record | None] | None


class ItemSource:
    """The source of items: first those that a lost process has left, then the input, which may be silent for the moment."""

    def __init__(self, feed: Iterator[Item | None]) -> None:
        self._feed = feed
        self.ended = False
        self.returned: list[Item] = []
        self.failure: Exception | None = None  # that has ended the input, unless it came to its end

    def next(self) -> Item | None:
        """The next item, or None if there is none: for the moment, or at the end."""
        if self.returned:
            return self.returned.pop()
        if not self.ended:
            try:
                return next(self._feed)
            except StopIteration:
                self.ended = True
            except Exception as error:  # raised by the pool, when what came before it is answered
                self.ended = True
                self.failure = error
        return None


class Child:
    """A worker process, and the item that it works on; `since` is the time at which it got this, or was started."""

    def __init__(self, job: Job, serve: Serve, events: SimpleQueue[Event]) -> None:
        self.item: Item | None = None
        self.ready = False
        self.since = time.monotonic()
        self.process = Process(serve)
        self.pid = self.process.pid
        self._reader = threading.Thread(target=self._read, args=(events,), daemon=True)
        self._reader.start()
        self.process.send(job)

    def give(self, item: Item) -> None:
        self.item = item
        self.since = time.monotonic()
        self.process.send(item)

    def kill(self) -> None:
        """End the process at once and wait for it; its reader thread ends as well."""
        self.process.kill()
        self._reader.join()
        self.process.close()

    def _read(self, events: SimpleQueue[Event]) -> None:
        try:
            with suppress(EOFError):
                while True:
                    events.put((self, self.process.receive()))
        finally:
            events.put((self, None))


class Pool(AbstractContextManager["Pool"]):
    """`jobs` worker processes for one job, which `serve` it; a context manager, which kills them at the end.

    with Pool(1, Job(timeout=60)) as pool:
        labels = [record.label for record in pool.run([Item(1, "x^2 + 3"), Item(2, "x+")])]  # 'case 1', 'bad input'
    """

    def __init__(self, jobs: int, job: Job, serve: Serve = worker.serve) -> None:
        self.job = job
        self._serve = serve
        self._jobs = jobs
        self._events: SimpleQueue[Event] = SimpleQueue()
        self._children: list[Child] = []
        self._losses: Counter[int] = Counter()
        self._failed_starts = 0
        self.replaced = 0

    def __exit__(self, *error: object) -> None:
        self.close()

    def close(self) -> None:
        """Kill the processes; `run` would start new ones."""
        for child in self._children:
            child.kill()
        self._children.clear()
        self._losses.clear()
        self._failed_starts = 0

    def pids(self) -> list[int]:
        """The identifiers of the worker processes."""
        return [child.pid for child in self._children]

    def run(self, items: Iterable[Item], *, ordered: bool = True, stream: bool = False) -> Iterator[Record]:
        """One record for each item, in the order of the items or as they finish.

        The numbers of the items must differ.  `stream` says that the items may be slow to arrive.
        """
        feed = _read_ahead(items, self._events) if stream else iter(items)
        if not ordered:
            yield from self._records(feed)
            return
        order: deque[int] = deque()
        ready: dict[int, Record] = {}

        def noted() -> Iterator[Item | None]:
            for item in feed:
                while len(order) >= _AHEAD:
                    yield None
                if item is not None:
                    order.append(item.number)
                yield item

        for record in self._records(noted()):
            ready[record.number] = record
            while order and order[0] in ready:
                yield ready.pop(order.popleft())

    def _records(self, feed: Iterator[Item | None]) -> Iterator[Record]:
        """The records as they come; the feed yields None if there is no item for the moment."""
        source = ItemSource(feed)
        while len(self._children) < self._jobs:
            self._children.append(Child(self.job, self._serve, self._events))
        while True:
            refusals: list[Record] = []
            for child in self._children:
                if child.ready and child.item is None and (item := source.next()) is not None:
                    if item.error is None:
                        child.give(item)
                    else:
                        refusals.append(refused(item, item.error))
            yield from refusals
            if source.ended and not source.returned and not any(child.item for child in self._children):
                if source.failure is not None:
                    raise source.failure
                return
            events = self._arrived(wait=not refusals)
            # Processes that are over their time, and have sent nothing.
            now = time.monotonic()
            heard = [event[0] for event in events if event is not None]
            late = [child for child in self._children if child not in heard and self._deadline(child) <= now]
            for event in events:
                # None announces an item of a stream; a replaced process isn't among the children any more.
                if event is not None and event[0] in self._children:
                    yield from self._take_up(*event, source)
            for child in late:
                if child.item is None:
                    raise KovacicError(f"a worker process hasn't started within {_START_SECONDS:g} s")
                self._replace(child)
                reason = f"the time limit of {self.job.timeout:g} s is exceeded (process killed)"
                yield stopped(child.item, reason, time.monotonic() - child.since)

    def _arrived(self, *, wait: bool) -> list[Event]:
        """The events that have arrived; with `wait`, at least one unless a deadline comes first."""
        events: list[Event] = []
        with suppress(Empty):
            if wait:
                deadline = min(map(self._deadline, self._children))
                patience = None if deadline == math.inf else max(0.0, deadline - time.monotonic())
                events.append(self._events.get(timeout=patience))
            while True:
                events.append(self._events.get_nowait())
        return events

    def _deadline(self, child: Child) -> float:
        if not child.ready:
            return child.since + _START_SECONDS
        if self.job.timeout is None or child.item is None:
            return math.inf
        return child.since + self.job.timeout + GRACE_SECONDS

    def _take_up(self, child: Child, record: Record | None, source: ItemSource) -> Iterator[Record]:
        """The record of a child's item, or what its end brings."""
        if record is None:
            yield from self._died(child, source)
        elif child.ready:
            child.item = None
            yield record
        else:  # the first record says that the process is ready
            child.ready = True
            self._failed_starts = 0

    def _died(self, child: Child, source: ItemSource) -> Iterator[Record]:
        """Replace a process that has ended; a record for its item, unless there is another attempt."""
        status, words = child.process.last_words()  # a negative status is a signal
        name = next((known.name for known in signal.Signals if known == -status), str(-status))
        cause = f"the worker process ended with {f'signal {name}' if status < 0 else f'exit status {status}'}"
        if words:
            cause += f": {words.splitlines()[-1].strip()}"
        if not child.ready:
            self._failed_starts += 1
        if self._failed_starts >= MOST_LOSSES:
            raise KovacicError(f"worker processes can't be started: {cause}\n{words}")
        self._replace(child)
        item = child.item
        if item is None:
            return
        seconds = time.monotonic() - child.since
        if self.job.memory is not None and _OUT_OF_MEMORY.search(words):
            yield stopped(item, f"the memory limit of {self.job.memory} MiB is exceeded (process ended)", seconds)
            return
        if self.job.timeout is not None and name == "SIGALRM":
            yield stopped(item, f"the time limit of {self.job.timeout:g} s is exceeded (process ended)", seconds)
            return
        self._losses[item.number] += 1
        attempts = MOST_LOSSES if status < 0 else 1  # an exception repeats itself
        if self._losses[item.number] >= attempts:
            yield refused(item, ProcessLost(cause), seconds)
        else:
            source.returned.append(item)

    def _replace(self, child: Child) -> None:
        """Kill a process, and start another one."""
        child.kill()
        self._children[self._children.index(child)] = Child(self.job, self._serve, self._events)
        self.replaced += 1


def _read_ahead(items: Iterable[Item], events: SimpleQueue[Event]) -> Iterator[Item | None]:
    """The items of a stream, read by a thread, so that answers come out while it is silent; None if there is none yet."""
    queue: Queue[Item | BaseException | None] = Queue(_AHEAD)

    def read() -> None:
        end = None
        try:
            for item in items:
                queue.put(item)
                events.put(None)
        except BaseException as error:  # whatever it is, the caller gets it: a broken compressed stream, a failing disk
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
        if isinstance(item, BaseException):
            raise item
        if item is None:
            return
        yield item

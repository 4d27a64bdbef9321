"""A pool of worker processes that can be killed: every item gets exactly one record.

One loop in the caller's thread goes round in four steps.  Each process that has nothing to do gets a lot of items, as many as
take about 20 ms.  Items that are refused without a process get their records.  Events are taken up: a record, the end of a
process, an item from a stream.  Processes that are over their time are killed.  The loop waits for events only where a round
has found nothing to hand out: then every process works or starts, or the input is silent, and each of these ends with an event.

A process that is over its time is killed, and its item gets a record.  So does the item of a process that has ended with an
exception; one whose process was killed by somebody else gets another one, up to three times.  What waited behind the item
goes back to the front.

The processes are those of `kovacic.process`, and run `kovacic.batch.worker.serve`.
"""

from __future__ import annotations

import math
import pickle
import re
import signal
import threading
import time
from collections import Counter, deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import AbstractContextManager
from queue import Empty, Queue, SimpleQueue
from typing import NamedTuple

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

# In order of the input, items that are read beyond the first one that has no answer.
ORDERED_WINDOW = 10_000

# Items that are read from a stream before they are needed.
_AHEAD = 256

# Seconds of work that a process gets at once, so that it needn't wait for the parent after each item; a longer item comes
# alone.  Everything behind the first item must fit into the pipe: the process reads the first one before it works,
# and writing to a full pipe of a process that is busy would stop the parent, its deadlines included.
_SECONDS_AT_ONCE = 0.02
_ITEMS_AT_ONCE = 32
_BYTES_AT_ONCE = 30_000

# The last words of Python, GMP, flint and the C++ library.
_OUT_OF_MEMORY = re.compile(r"MemoryError|(cannot|unable to) (re)?allocate|bad_alloc", re.IGNORECASE)


# The function that a worker process runs.
Serve = Callable[[Channel], None]

# A record of a child, or None at its end; in place of the pair None, where an item of a stream has arrived.
Event = tuple["Child", Record | None] | None


class Lot(NamedTuple):
    """Items for one process, handed out at once, and the records of items that need none, since their line was wrong."""

    items: list[Item]
    refusals: list[Record]


class ItemSource:
    """The source of items: first those that a lost process has left, then the input, which may be silent for the moment."""

    def __init__(self, feed: Iterator[Item | None]) -> None:
        self._feed = feed
        self._returned: deque[Item] = deque()
        self._ended = False
        self.failure: Exception | None = None  # that has ended the input, unless it came to its end

    @property
    def exhausted(self) -> bool:
        """True if the end of the input is known, and nothing was given back."""
        return self._ended and not self._returned

    def give_back(self, items: Sequence[Item]) -> None:
        """Put items back to be handed out next, in this order."""
        self._returned.extendleft(reversed(items))

    def next(self) -> Item | None:
        """The next item, or None if there is none: for the moment, or at the end."""
        if self._returned:
            return self._returned.popleft()
        if self._ended:
            return None
        try:
            return next(self._feed)
        except StopIteration:
            self._ended = True
        except Exception as error:  # raised by the pool, when what came before it is answered
            self._ended = True
            self.failure = error
        return None

    def lot(self, most: int) -> Lot:
        """Up to `most` items, and at least one if any is available."""
        lot = Lot([], [])
        size = 0
        while len(lot.items) + len(lot.refusals) < most:
            item = self.next()
            if item is None:
                break
            if item.error is not None:
                lot.refusals.append(refused(item, item.error))
                continue
            size += len(_packed(item))
            if lot.items and size > _BYTES_AT_ONCE:
                self.give_back([item])
                break
            lot.items.append(item)
        return lot


class Child:
    """A worker process, and the items that it hasn't answered; it works on the first one."""

    def __init__(self, job: Job, serve: Serve, events: SimpleQueue[Event]) -> None:
        self.items: deque[Item] = deque()
        self.ready = False
        self.busy_since = time.monotonic()
        self.process = Process(serve)
        self.pid = self.process.pid
        self._reader = threading.Thread(target=self._read, args=(events,), daemon=True)
        self._reader.start()
        self.process.send(job)

    def give(self, items: Sequence[Item]) -> None:
        """Queue items for the process."""
        self.items.extend(items)
        self.busy_since = time.monotonic()
        self.process.write(b"".join(map(_packed, items)))

    def kill(self) -> None:
        """End the process at once and wait for it; its reader thread ends as well."""
        self.process.kill()
        self._reader.join()
        self.process.close()

    def _read(self, events: SimpleQueue[Event]) -> None:
        try:
            while True:
                events.put((self, Record(*self.process.receive())))
        except EOFError:
            pass
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
        self._pace = 1.0  # seconds for an item, lately
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
        """The records as they come; the feed yields None if there is no item for the moment."""
        source = ItemSource(feed)
        while len(self._children) < self._jobs:
            self._children.append(Child(self.job, self._serve, self._events))
        while True:
            lots = self._hand_out(source)
            for lot in lots:
                yield from lot.refusals
            working = any(child.items for child in self._children)
            if source.exhausted and not working:
                if source.failure is not None:
                    raise source.failure
                return
            events = self._arrived(wait=not lots)
            # Processes that are over their time, and have sent nothing.
            now = time.monotonic()
            heard = [event[0] for event in events if event is not None]
            late = [child for child in self._children if child not in heard and self._deadline(child) <= now]
            yield from self._take_up(events, source)
            yield from self._end(late, source)

    def _hand_out(self, source: ItemSource) -> list[Lot]:
        """Give each process that has nothing to do a lot, as long as there are items; the lots."""
        lots: list[Lot] = []
        for child in self._children:
            if not child.ready or child.items:
                continue
            lot = source.lot(max(1, int(min(_SECONDS_AT_ONCE / self._pace, _ITEMS_AT_ONCE))))
            if lot.items:
                child.give(lot.items)
            if lot.items or lot.refusals:
                lots.append(lot)
        return lots

    def _arrived(self, *, wait: bool) -> list[Event]:
        """The events that have arrived; with `wait`, at least one unless a deadline comes first."""
        events: list[Event] = []
        try:
            if wait:
                deadline = min(map(self._deadline, self._children))
                patience = None if deadline == math.inf else max(0.0, deadline - time.monotonic())
                events.append(self._events.get(timeout=patience))
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

    def _take_up(self, events: list[Event], source: ItemSource) -> Iterator[Record]:
        """The records that these events bring.  An item of a stream brings none, nor does a process that was replaced."""
        for event in events:
            if event is None:
                continue
            child, record = event
            if child not in self._children:
                continue
            if record is None:
                yield from self._died(child, source)
            elif child.ready:
                # The answer to its first item; it has turned to the next one.
                now = time.monotonic()
                self._pace += (now - child.busy_since - self._pace) / 8
                child.busy_since = now
                child.items.popleft()
                yield record
            else:  # with a record of nothing, by which it says so
                child.ready = True
                self._failed_starts = 0

    def _end(self, late: list[Child], source: ItemSource) -> Iterator[Record]:
        """Kill processes that are over their time; the records of the items that they worked on."""
        for child in late:
            if not child.items:
                raise KovacicError(f"a worker process hasn't started within {_START_SECONDS:g} s")
            item = child.items.popleft()
            self._replace(child, source)
            reason = f"the time limit of {self.job.timeout:g} s is exceeded (process killed)"
            yield stopped(item, reason, time.monotonic() - child.busy_since)

    def _died(self, child: Child, source: ItemSource) -> Iterator[Record]:
        """Replace a process that has ended; a record for its item, unless there is another attempt."""
        status, words = child.process.last_words()  # a negative status is a signal
        if not child.ready:
            self._failed_starts += 1
        if self._failed_starts >= MOST_LOSSES:
            raise KovacicError(f"worker processes can't be started: {_cause(status, words)}\n{words}")
        item = child.items.popleft() if child.items else None
        self._replace(child, source)
        if item is None:
            return
        seconds = time.monotonic() - child.busy_since
        if self.job.memory is not None and _OUT_OF_MEMORY.search(words):
            yield stopped(item, f"the memory limit of {self.job.memory} MiB is exceeded (process ended)", seconds)
            return
        if self.job.timeout is not None and _signal_name(status) == "SIGALRM":
            yield stopped(item, f"the time limit of {self.job.timeout:g} s is exceeded (process ended)", seconds)
            return
        self._losses[item.number] += 1
        attempts = MOST_LOSSES if status < 0 else 1  # an exception repeats itself
        if self._losses[item.number] >= attempts:
            yield refused(item, ProcessLost(_cause(status, words)), seconds)
        else:
            source.give_back([item])

    def _replace(self, child: Child, source: ItemSource) -> None:
        """Kill a process, give back the items that it hasn't begun, and start another one."""
        source.give_back(child.items)
        child.kill()
        place = self._children.index(child)
        self._children[place] = Child(self.job, self._serve, self._events)
        self.replaced += 1


def _packed(item: Item) -> bytes:
    """An item in the form in which it is sent to a process."""
    return pickle.dumps((item.number, item.text, item.var, item.extra, None, item.names))


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


def _cause(status: int, words: str) -> str:
    end = f"signal {_signal_name(status)}" if status < 0 else f"exit status {status}"
    last_line = words.splitlines()[-1].strip() if words else ""
    cause = f"the worker process ended with {end}"
    return f"{cause}: {last_line}" if last_line else cause


def _signal_name(status: int) -> str:
    """The name of the signal that ended a process, or its number if this system has no name for it."""
    return next((known.name for known in signal.Signals if known == -status), str(-status))

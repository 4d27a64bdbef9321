"""Where the pool takes its items from: an iterable that answers at once, or a stream on which one may have to wait."""

from __future__ import annotations

import threading
from collections.abc import Iterable
from queue import Empty, Queue
from typing import Protocol

from kovacic.batch.child import Event
from kovacic.batch.items import Item
from kovacic.errors import InputError

# Items that are read from a stream before they are needed.
_AHEAD = 256


class EventQueue(Protocol):
    """What a feed needs of the pool's queue."""

    def put(self, event: Event | None) -> None: ...


class Feed(Protocol):
    """`take` gives the next item, or None where there is none now; then `exhausted` says whether there will be more."""

    exhausted: bool

    def take(self) -> Item | None: ...


class DirectFeed:
    """Items of an iterable, taken in the caller's thread when they are needed."""

    def __init__(self, items: Iterable[Item]) -> None:
        self._items = iter(items)
        self.exhausted = False

    def take(self) -> Item | None:
        item = next(self._items, None)
        self.exhausted = item is None
        return item


class StreamFeed:
    """Items of a stream, read by a thread, so that answers come out while the stream is silent."""

    def __init__(self, items: Iterable[Item], events: EventQueue) -> None:
        self._queue: Queue[Item | InputError | None] = Queue(_AHEAD)
        self._events = events
        self.exhausted = False
        threading.Thread(target=self._read, args=(items,), daemon=True).start()

    def take(self) -> Item | None:
        if self.exhausted:
            return None
        try:
            item = self._queue.get_nowait()
        except Empty:
            return None
        if isinstance(item, InputError):
            raise item
        self.exhausted = item is None
        return item

    def _read(self, items: Iterable[Item]) -> None:
        try:
            for item in items:
                self._queue.put(item)
                self._events.put(None)
        except InputError as error:  # a broken compressed stream, for example
            self._queue.put(error)
        self._queue.put(None)
        self._events.put(None)

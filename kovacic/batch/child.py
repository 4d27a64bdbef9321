"""The parent's end of one worker process: it is started, fed, read by a thread, and killed.

A separate interpreter is started instead of a fork or of `multiprocessing`: it works in programs with threads, in notebooks
and in scripts without a main guard, and it can be killed at any moment without harm to the parent.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import threading
import time
from collections import deque
from contextlib import suppress
from queue import SimpleQueue

from kovacic.batch.records import Item, Job
from kovacic.batch.worker import encode_item

# The interpreter looks for modules where this one does, and not in the current directory.
_START = "import json, sys; sys.path[:] = json.loads(sys.argv[1]); from kovacic.batch.worker import main; main()"
_SHOWN_ERROR_BYTES = 20_000

#: A process has so many items, that it works on included, so that it needn't wait for the parent.
ITEMS_AHEAD = 32

# Its answers are fetched once in so many seconds at most: to wake up for each one costs more than to read it.
_SECONDS_BETWEEN_READS = 0.005

_PIPE_BYTES = 1 << 16

# (child, line), the line None at the end of the process
Event = tuple["Child", str | None]


class Child:
    """A worker process.  `assigned` are the items that it hasn't answered, the one that it works on first."""

    def __init__(self, job: Job, events: SimpleQueue[Event | None]) -> None:
        self.assigned: deque[Item] = deque()
        self.ready = False
        self.busy_since = time.monotonic()
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115 - closed by kill()
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-c", _START, json.dumps(sys.path)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._errors,
        )
        self._reader = threading.Thread(target=self._read, args=(events,), daemon=True)
        self._reader.start()
        self._send(job.dumps() + "\n")

    @property
    def pid(self) -> int:
        return self._process.pid

    def give(self, item: Item) -> None:
        """Append an item to what the process has to do; a process that is gone reports itself through its events."""
        if not self.assigned:
            self.busy_since = time.monotonic()
        self.assigned.append(item)
        self._send(encode_item(item))

    def finished_one(self) -> Item:
        """The item that the process has just answered."""
        self.busy_since = time.monotonic()
        return self.assigned.popleft()

    def kill(self) -> None:
        """End the process at once and wait for it; its reader thread ends as well."""
        self._process.kill()
        self._process.wait()
        self._reader.join()
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdout.close()
        with suppress(OSError):  # something was still waiting to be written
            self._process.stdin.close()
        self._errors.close()

    def last_words(self) -> tuple[int, str]:
        """The exit status (negative: a signal) and the end of the standard error of a process that has ended."""
        status = self._process.wait()
        size = self._errors.seek(0, 2)
        self._errors.seek(max(0, size - _SHOWN_ERROR_BYTES))
        return status, self._errors.read().decode("utf-8", errors="replace").strip()

    def _send(self, line: str) -> None:
        assert self._process.stdin is not None
        with suppress(OSError):  # a broken pipe: the end of the process arrives as an event
            self._process.stdin.write(line.encode())
            self._process.stdin.flush()

    def _read(self, events: SimpleQueue[Event | None]) -> None:
        assert self._process.stdout is not None
        descriptor, unfinished = self._process.stdout.fileno(), list[bytes]()
        while data := os.read(descriptor, _PIPE_BYTES):
            start = time.monotonic()
            *lines, rest = data.split(b"\n")
            if lines:
                lines[0] = b"".join([*unfinished, lines[0]])
                unfinished.clear()
            for line in lines:
                events.put((self, line.decode()))
            if rest:
                unfinished.append(rest)  # of a long answer, which the process is waiting to write
            elif len(self.assigned) > 1:
                time.sleep(max(0.0, start + _SECONDS_BETWEEN_READS - time.monotonic()))
        events.put((self, None))

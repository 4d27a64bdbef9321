"""The parent's end of one worker process: it is started, fed, read by a thread, and killed.

A separate interpreter is started instead of a fork or of `multiprocessing`: it works in programs with threads, in notebooks
and in scripts without a main guard, and it can be killed at any moment without harm to the parent.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import threading
import time
from collections import deque
from collections.abc import Sequence
from contextlib import suppress
from queue import SimpleQueue
from typing import IO, cast

from kovacic.batch.records import Item, Job
from kovacic.batch.worker import encode_item

# The interpreter looks for modules where this one does, and not in the current directory.
_START = "import json, sys; sys.path[:] = json.loads(sys.argv[1]); from kovacic.batch.worker import main; main()"
_SHOWN_ERROR_BYTES = 20_000

# (child, line), the line None at the end of the process; None where an item of a stream has arrived
Event = tuple["Child", bytes | None] | None


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
        self._send(job.dumps() + "\n")

    def give(self, items: Sequence[Item]) -> None:
        """What the process has to do next; a process that is gone reports itself through its events."""
        self.items.extend(items)
        self.busy_since = time.monotonic()
        self._send("".join(map(encode_item, items)))

    def finished_one(self) -> float:
        """The process has answered its first item; returns the seconds that this took."""
        before, self.busy_since = self.busy_since, time.monotonic()
        self.items.popleft()
        return self.busy_since - before

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

    def _send(self, line: str) -> None:
        with suppress(OSError):  # a broken pipe: the end of the process arrives as an event
            self._to.write(line.encode())
            self._to.flush()

    def _read(self, events: SimpleQueue[Event]) -> None:
        for line in self._from:
            if line.endswith(b"\n"):  # else the process ended while it wrote
                events.put((self, line))
        events.put((self, None))

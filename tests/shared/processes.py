"""Processes for tests, which end with the test, whatever becomes of it, and what some of them do.

A process imports the module of what it does: this one imports nothing that takes a while.
"""

from __future__ import annotations

import os
import subprocess
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeVar

T = TypeVar("T")

#: A test that waits for ever says nothing; this is many times what the slowest of them takes.
_FOR_EVER = 300.0


@contextmanager
def started(arguments: Sequence[str], **options: Any) -> Iterator[subprocess.Popen[Any]]:
    """A running process with text streams; it is killed at the end if it is still there."""
    with subprocess.Popen(arguments, text=True, **options) as process:
        try:
            yield process
        finally:
            process.kill()


def finished(work: Callable[[], T]) -> T:
    """What `work` returns; a failure where it doesn't come back."""
    results: list[T] = []
    thread = threading.Thread(target=lambda: results.append(work()), daemon=True)
    thread.start()
    thread.join(_FOR_EVER)
    assert results, "the batch has stopped, or failed"
    return results[0]


def answered(how: str, value: Any) -> Any:
    """The value; an exception, an end without a word, or a file that says that it goes on for ever."""
    if how == "an exception":
        raise ZeroDivisionError
    if how == "an end":
        os._exit(0)
    if how != "a value":
        Path(how).touch()
        while True:
            time.sleep(1)
    return value


def talks(channel: Any) -> None:
    """One answer, one more than what it gets, between words that are none."""
    print("something that isn't meant for the parent", flush=True)
    channel.send(channel.receive() + 1)
    raise ArithmeticError("after that")

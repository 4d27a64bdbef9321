"""What worker processes do in tests: the usual, but for one equation at which they end."""

from __future__ import annotations

import os
import signal
import sys
import time
from functools import partial
from typing import Any

import kovacic
from kovacic.batch import worker
from kovacic.batch.records import Record
from kovacic.process import Channel

FATAL = "x^7"
MISSING_SIGNALS = ("SIGALRM", "SIGKILL", "setitimer", "ITIMER_REAL")


def divides_by_zero(channel: Channel) -> None:
    _serve(lambda: 1 / 0, channel)


def without_signals(end: str, channel: Channel) -> None:
    """As on Windows, and it ends in one of several ways."""
    for name in MISSING_SIGNALS:
        delattr(signal, name)
    sys.modules["resource"] = None  # type: ignore[assignment]
    ends: dict[str, Any] = {
        "exception": lambda: 1 / 0,
        "exit": partial(os._exit, 1),
        "signal 15": partial(os.kill, os.getpid(), 15),
        "signal 40": partial(os.kill, os.getpid(), 40),
    }
    _serve(ends[end], channel)


def late(seconds: float, channel: Channel) -> None:
    """Sleeps at the fatal item."""
    _answer_all(partial(time.sleep, seconds), channel)


def leaves(channel: Channel) -> None:
    """Ends without an exception at the fatal item."""
    _answer_all(partial(os._exit, 0), channel)


def is_killed(channel: Channel) -> None:
    """Ends by a signal of somebody else at the fatal item, each time."""
    _answer_all(partial(os.kill, os.getpid(), signal.SIGKILL), channel)


def cannot_start(_: Channel) -> None:
    sys.exit("no such module")


def _answer_all(at_the_fatal_item: Any, channel: Channel) -> None:
    """Ready at once, without the engine; answers every other item."""
    channel.receive()
    channel.send(Record(0, "none", 0.0, "{}"))
    while True:
        item = channel.receive()
        if item.text == FATAL:
            at_the_fatal_item()
        channel.send(Record(item.number, "none", 0.0, "{}"))


def _serve(end: Any, channel: Channel) -> None:
    solve = kovacic.solve
    kovacic.solve = lambda S, **options: solve(S, **options) if S != FATAL else end()  # type: ignore[misc,assignment]
    worker.serve(channel)

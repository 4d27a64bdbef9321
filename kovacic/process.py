"""The one way to run what must be killed: a separate interpreter, with which one talks in pickles.

    process = Process(serve)          serve(channel) runs there, a function of a module
    process.send(3)                   channel.receive() is 3
    process.receive()                 the argument of channel.send(); EOFError at its end

It is an interpreter of its own instead of a fork or of `multiprocessing`: that works in programs with threads, in notebooks and
in scripts without a main guard, and it can be killed at any moment without harm to the parent.  It ends when `serve` returns,
and soon after its parent is gone.  What anything prints there goes to its error stream, which is kept for `last_words`.
"""

from __future__ import annotations

import json
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from functools import lru_cache
from typing import IO, Any, cast

from kovacic.errors import LimitExceeded
from kovacic.limits import check_time, watched_seconds

# The interpreter finds modules on this one's path, and not in the current directory.
_INTERPRETER_SOURCE = (
    "import json, sys; sys.path[:] = json.loads(sys.argv[1]); from kovacic.process import serve_parent; serve_parent()"
)
# The end of the error stream that `last_words` reads: a traceback of some hundred lines.
_SHOWN_ERROR_BYTES = 20_000
_PARENT_CHECK_SECONDS = 1.0
# Three years: timers overflow for longer times, math.inf among them.
LONGEST_SECONDS = 1e8


class Channel:
    """The child's end: objects that pickle, in their order."""

    def __init__(self, source: IO[bytes], target: IO[bytes]) -> None:
        self._source = source
        self._target = target

    def receive(self) -> Any:
        """The parent's next object; raises EOFError once it sends no more."""
        return pickle.load(self._source)

    def send(self, value: object) -> None:
        """An answer, which arrives at once."""
        self._target.write(pickle.dumps(value))
        self._target.flush()


class Process:
    """The parent's end.  Raises OSError if no process can be started.

    >>> from kovacic.process import Process, echo
    >>> process = Process(echo)
    >>> process.send("x^2 + 3")
    >>> process.receive()
    'x^2 + 3'
    >>> process.close()
    """

    def __init__(self, serve: Callable[[Channel], None]) -> None:
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115 - closed by close()
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-c", _INTERPRETER_SOURCE, json.dumps(sys.path)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._errors,
        )
        self.pid = self._process.pid
        self._to = cast("IO[bytes]", self._process.stdin)
        self._from = cast("IO[bytes]", self._process.stdout)
        self.send(serve)

    def send(self, value: object) -> None:
        """Send an object.  A broken pipe is no error here: `receive` reports the end."""
        pickled = pickle.dumps(value)
        with suppress(OSError):
            self._to.write(pickled)
            self._to.flush()

    def receive(self) -> Any:
        """The next answer; raises EOFError at the end of the process, perhaps in the middle of one."""
        try:
            return pickle.load(self._from)
        except pickle.UnpicklingError:
            raise EOFError from None

    def kill(self) -> None:
        """End the process at once, and wait for it."""
        self._process.kill()
        self._process.wait()

    def close(self) -> None:
        """Kill the process, and close the pipes, from which nobody may be reading."""
        self.kill()
        self._from.close()
        with suppress(OSError):  # something was still waiting to be written
            self._to.close()
        self._errors.close()

    def last_words(self) -> tuple[int, str]:
        """The exit status (negative: a signal) and the end of the error stream of a process that has ended."""
        status = self._process.wait()
        size = self._errors.seek(0, 2)
        self._errors.seek(max(0, size - _SHOWN_ERROR_BYTES))
        return status, self._errors.read().decode("utf-8", errors="replace").strip()


@lru_cache(maxsize=32)
def computed_apart(what: str, function: Callable[..., Any], *arguments: Any) -> Any:
    """The value of a function of a module, computed in a process that is killed when the watched time is over.

    The last values are kept, since the kernel and the views ask for them again.  Arguments and value must be picklable.
    Raises `LimitExceeded`, with `what` was computed, if there is no value for lack of time, memory or a process; in this
    process the computation might never end.
    """
    check_time()
    seconds = watched_seconds(LONGEST_SECONDS)
    missing = LimitExceeded(f"a process of its own gave no {what}; with seconds=inf none is started", limit="seconds")
    try:
        process = Process(_compute)
    except OSError:
        raise missing from None
    timer = threading.Timer(seconds, process.kill)
    timer.daemon = True
    timer.start()
    try:
        process.send((function, arguments, seconds))
        return process.receive()
    except EOFError:
        check_time()
        raise missing from None
    finally:
        timer.cancel()
        process.close()


def _compute(channel: Channel) -> None:
    function, arguments, seconds = channel.receive()
    set_alarm(seconds + 1)
    channel.send(function(*arguments))


def echo(channel: Channel) -> None:
    """Send back every object that arrives."""
    while True:
        channel.send(channel.receive())


def set_alarm(seconds: float) -> None:
    """Let the system end this process if its parent can't kill it before, even within a call of C; 0 takes it back."""
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_REAL, seconds)


def serve_parent() -> None:
    """The entry point of the interpreter that `Process` starts."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the parent's affair
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    parent = os.getppid()

    def leave_with_parent() -> None:
        """End this process soon after its parent is gone, even in the middle of a long computation."""
        while os.getppid() == parent:
            time.sleep(_PARENT_CHECK_SECONDS)
        os._exit(1)

    threading.Thread(target=leave_with_parent, daemon=True).start()
    channel = Channel(sys.stdin.buffer, answers)
    with suppress(EOFError):
        serve = channel.receive()
        serve(channel)

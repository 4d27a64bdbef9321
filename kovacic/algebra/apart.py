"""Work that can't be interrupted from inside, in a process that is killed when its time is over."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from io import BytesIO
from typing import Any

_LONGEST = 1e8
# The interpreter looks for modules where this one does, and not in the current directory.
_START = "import json, sys; sys.path[:] = json.loads(sys.argv[1]); from kovacic.algebra.apart import main; main()"


def last_of(function: Callable[..., Iterator[Any]], *arguments: Any, seconds: float) -> Any:
    """The last value that a generator function of a module yields within so many seconds; None without one.

    A separate interpreter is started instead of a fork, which works in programs with threads, and on every system.
    Arguments and values must be picklable.  An exception of the function ends it.
    """
    import json  # a start without these takes a tenth less time
    import pickle
    import subprocess

    if seconds <= 0:
        return None
    seconds = min(seconds, _LONGEST)
    command = [sys.executable, "-P", "-c", _START, json.dumps(sys.path)]
    given = pickle.dumps((function, arguments, seconds))
    try:
        output = subprocess.run(
            command, input=given, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, timeout=seconds
        ).stdout
    except subprocess.TimeoutExpired as late:
        output = late.stdout or b""
    except OSError:  # no process can be started here
        return None
    value, stream = None, BytesIO(output)
    while True:
        try:
            value = pickle.load(stream)
        except (EOFError, pickle.UnpicklingError):
            return value


def main() -> None:
    """The other end: each value is written at once.  The system ends it, if the process that waits for it was killed."""
    import pickle
    import signal

    function, arguments, seconds = pickle.load(sys.stdin.buffer)
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_REAL, seconds + 1)
    for value in function(*arguments):
        pickle.dump(value, sys.stdout.buffer)
        sys.stdout.buffer.flush()

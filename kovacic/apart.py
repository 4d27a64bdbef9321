"""Work that can't be interrupted from inside, in a process that is killed when its time is over."""

from __future__ import annotations

import json
import pickle
import subprocess
import sys
from collections.abc import Callable, Iterator
from io import BytesIO
from typing import Any

# The interpreter looks for modules where this one does, and not in the current directory.
_START = "import json, sys; sys.path[:] = json.loads(sys.argv[1]); from kovacic.apart import main; main()"


def last_of(function: Callable[..., Iterator[Any]], *arguments: Any, seconds: float) -> Any:
    """The last value that a generator function of a module yields within so many seconds; None without one.

    A separate interpreter is started instead of a fork, which works in programs with threads, and on every system.
    Arguments and values must be picklable.  An exception of the function ends it.
    """
    if seconds <= 0:
        return None
    command = [sys.executable, "-P", "-c", _START, json.dumps(sys.path)]
    given = pickle.dumps((function, arguments))
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
    """The other end: each value is written at once."""
    function, arguments = pickle.load(sys.stdin.buffer)
    for value in function(*arguments):
        pickle.dump(value, sys.stdout.buffer)
        sys.stdout.buffer.flush()

"""Processes for tests, which end with the test, whatever becomes of it."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any


@contextmanager
def started(arguments: Sequence[str], **options: Any) -> Iterator[subprocess.Popen[Any]]:
    """A running process with text streams; it is killed at the end if it is still there."""
    with subprocess.Popen(arguments, text=True, **options) as process:
        try:
            yield process
        finally:
            process.kill()

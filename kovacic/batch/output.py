"""The file of answers: appended to line by line, and taken up again after an interruption.

Whatever an interruption leaves behind (half a line, a block of zero bytes after a power cut) is recognised by not being a
whole line of JSON with a line number, and is removed before anything is appended.
"""

from __future__ import annotations

import json
import os
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType
from typing import IO, Any
from zlib import crc32

from kovacic.batch.items import Item, Record
from kovacic.errors import InputError

_SYNC_SECONDS = 2.0


class Answers:
    """A file of records, one JSON object a line; a context manager.

    Every line is flushed to the system at once, and to the disk every two seconds and at the end.
    """

    def __init__(self, path: Path) -> None:
        self._stream: IO[str] = path.open("a", encoding="utf-8", errors="backslashreplace", newline="\n")
        self._synced = time.monotonic()

    def write(self, record: Record) -> None:
        self._stream.write(record.json + "\n")
        self._stream.flush()
        if time.monotonic() - self._synced > _SYNC_SECONDS:
            self._sync()

    def _sync(self) -> None:
        os.fsync(self._stream.fileno())
        self._synced = time.monotonic()

    def __enter__(self) -> Answers:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._stream.flush()
        self._sync()
        self._stream.close()


class Done:
    """What a file of answers has already: for each line number a checksum of the input it answers."""

    def __init__(self, checksums: dict[int, int]) -> None:
        self._checksums = checksums

    def __len__(self) -> int:
        return len(self._checksums)

    def __contains__(self, item: Item) -> bool:
        """Has the item been answered?  Raises `InputError` if its line number belongs to another input."""
        known = self._checksums.get(item.number)
        if known is None:
            return False
        if known != _checksum(item.text):
            raise InputError(
                f"line {item.number} of the input isn't what the answers in the output file belong to",
                hint="give the input file of the interrupted run, or another output file",
            )
        return True


def take_up(path: Path) -> Done:
    """Read a file of answers, if there is one, and remove what isn't a whole answer and what occurs twice.

    The file is replaced by the repaired one in a single step, and not touched if there is nothing to repair.
    """
    checksums: dict[int, int] = {}
    if not path.exists():
        return Done(checksums)
    broken = 0
    for number, checksum, _ in _answers(path):
        if number is None or number in checksums:
            broken += 1
        else:
            checksums[number] = checksum
    if broken:
        _rewrite(path)
    return Done(checksums)


def stored(path: Path) -> Iterator[dict[str, Any]]:
    """The answers of a file that `take_up` has repaired, if there is one."""
    if path.exists():
        with path.open("rb") as stream:
            yield from map(json.loads, stream)


def _answers(path: Path) -> Iterator[tuple[int | None, int, bytes]]:
    """Number, checksum of the input and bytes of each line; the number None for what isn't a whole answer."""
    with path.open("rb") as stream:
        for line in stream:
            number, checksum = None, 0
            if line.endswith(b"\n"):
                try:
                    data = json.loads(line)
                    number, checksum = int(data["line"]), _checksum(data["input"])
                except (ValueError, KeyError, TypeError, AttributeError):
                    pass  # not an answer: reported by the number None
            yield number, checksum, line


def _rewrite(path: Path) -> None:
    seen: set[int] = set()
    with tempfile.NamedTemporaryFile(dir=path.parent, prefix=path.name, suffix=".tmp", delete=False) as copy:
        for number, _, line in _answers(path):
            if number is not None and number not in seen:
                seen.add(number)
                copy.write(line)
        copy.flush()
        os.fsync(copy.fileno())
    os.chmod(copy.name, path.stat().st_mode)
    os.replace(copy.name, path)


def _checksum(text: str) -> int:
    return crc32(text.encode("utf-8", errors="backslashreplace"))


__all__ = ["Answers", "Done", "stored", "take_up"]

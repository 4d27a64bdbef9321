"""Items from files: JSONL, CSV, or an expression a line, compressed with gzip or not; and the file of answers.

A line that can't be read becomes an item with its error, never an exception.  Items are numbered by the line on which they
begin, so that a number names the place in the file.  Empty lines, and lines of plain files that begin with `#`, are no items.

Answers are appended line by line, and taken up again after an interruption: whatever that leaves behind (half a line, a block
of zero bytes after a power cut) is recognised by not being a whole line of JSON with a line number, and is removed first.
"""

from __future__ import annotations

import csv
import gzip
import io
import itertools
import json
import os
import sys
import tempfile
import zlib
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple, TextIO

from kovacic.batch.records import Item, Record, label_of
from kovacic.errors import InputError, LimitExceeded, ParseError
from kovacic.limits import DEFAULT_LIMITS, Limits

# Names of the column or key with the expression, in the order in which they are looked for.
_EXPRESSION_KEYS = ("S", "input", "expression")

# Bytes of a line for each character that an expression may have: UTF-8, and escapes of JSON.
_BYTES_PER_CHARACTER = 6


def guess_format(name: str) -> str | None:
    """The format that belongs to a file name; None where it says nothing ("-", "data.txt").

    >>> guess_format("cases.jsonl.gz"), guess_format("table.CSV"), guess_format("-")
    ('jsonl', 'csv', None)
    """
    suffix = Path(name.lower().removesuffix(".gz")).suffix
    return {".jsonl": "jsonl", ".ndjson": "jsonl", ".csv": "csv"}.get(suffix)


def read_items(
    stream: BinaryIO, *, form: str | None = None, var: str | None = None, limits: Limits = DEFAULT_LIMITS
) -> Iterator[Item]:
    """The items of "lines", "jsonl" or "csv"; by default JSONL if the first item begins with `{` or `"`, else lines.

    A line of JSONL is a string, or an object with the key "S" (or "input", "expression"), and perhaps "id" and "var".  A CSV
    file has such columns, or no header and the expressions in its first column.  `var` names the variable of all items
    that don't name one.  What begins like a gzip file is decompressed.  Raises `InputError` where that fails, after the
    items up to there.
    """
    lines = _lines(stream, limits.text_length * _BYTES_PER_CHARACTER, var)
    seen = [*_to_first_with_content(lines)]
    if form is None and seen and seen[-1].text.lstrip()[:1] in ("{", '"'):
        form = "jsonl"
    lines = itertools.chain(seen, lines)
    if form == "csv":
        yield from _csv_items(lines, var)
        return
    for line in lines:
        text = line.text.strip()
        if line.error is not None:
            yield Item(line.number, text, var, error=line.error)
        elif text and form == "jsonl":
            yield _json_item(line.number, text, var)
        elif text and not text.startswith("#"):
            yield Item(line.number, text, var)


def count_items(name: str, *, form: str | None = None) -> int:
    """How many items a file has, for the progress bar."""
    with open(name, "rb") as stream:
        return sum(1 for _ in read_items(stream, form=form or guess_format(name)))


def item_from(number: int, value: Any, *, var: str | None = None, limits: Limits = DEFAULT_LIMITS) -> Item:
    """The item for whatever `kovacic.solve` takes, or for a mapping with the keys of a line of JSONL."""
    if isinstance(value, Item):
        return value
    if isinstance(value, str | Mapping):
        return _plain_item(number, value, str(value), var)
    from kovacic.reading.read import read_input

    try:
        parsed = read_input(value, var=var, limits=limits)
    except (InputError, LimitExceeded) as error:
        return Item(number, str(value), var, error=error)
    return Item(number, parsed.S.to_str(parsed.variable), parsed.variable)


def _lines(stream: BinaryIO, longest: int, var: str | None) -> Iterator[Item]:
    """The lines as items, with an error where one is too long, and then nothing of it is kept, or isn't text."""
    number = 0
    try:
        raw = stream if isinstance(stream, io.BufferedReader) else io.BufferedReader(stream)  # type: ignore[type-var]
        plain: Any = gzip.GzipFile(fileobj=raw) if raw.peek(2)[:2] == b"\x1f\x8b" else raw
        while line := plain.readline(longest + 1):
            number += 1
            error: InputError | LimitExceeded | None = None
            if len(line) > longest:
                error = LimitExceeded(f"the line has more than {longest} bytes, the limit", limit="text_length")
                while line and not line.endswith(b"\n"):
                    line = plain.readline(longest)
                line = b"\n"
            encoding = "utf-8-sig" if number == 1 else "utf-8"
            try:
                text = line.decode(encoding)
            except UnicodeDecodeError as wrong:
                text = line.decode("utf-8", errors="backslashreplace")
                error = ParseError(f"the line isn't UTF-8 text: byte {wrong.start} is {wrong.reason}")
            yield Item(number, text, var, error=error)
    except (OSError, EOFError, zlib.error) as broken:
        raise InputError(f"the input can't be read beyond line {number}: {broken}") from None


def _to_first_with_content(lines: Iterator[Item]) -> Iterator[Item]:
    for line in lines:
        yield line
        if line.error is not None or line.text.strip():
            return


def _json_item(number: int, text: str, var: str | None) -> Item:
    try:
        return _plain_item(number, json.loads(text), text, var)
    except (ValueError, RecursionError) as error:
        return Item(number, text, var, error=ParseError(f"the line isn't JSON: {error}"))


def _plain_item(number: int, value: Any, text: str, var: str | None) -> Item:
    """The item of a string or an object; of anything else, that it is neither."""
    if isinstance(value, str):
        return Item(number, value, var)
    if not isinstance(value, Mapping):
        hint = 'a string, or an object like {"S": "x^2 + 3"}'
        return Item(number, text, var, error=ParseError("the line is neither a string nor an object", hint=hint))
    extra = {"id": value["id"]} if "id" in value else {}
    try:
        json.dumps(extra)
    except (TypeError, ValueError, RecursionError):
        wrong = type(extra["id"]).__name__
        return Item(number, text, var, error=InputError(f"the id is a {wrong}, which JSON doesn't have", hint="a text"))
    key = next((key for key in _EXPRESSION_KEYS if key in value), None)
    if key is None:
        error = InputError(f"there is no key {_EXPRESSION_KEYS[0]!r} with the expression", hint='{"S": "x^2 + 3"}')
        return Item(number, text, var, extra, error)
    own = value.get("var") or var
    if not isinstance(value[key], str) or not (own is None or isinstance(own, str)):
        return Item(number, text, None, extra, InputError(f"the values of {key!r} and 'var' are strings"))
    return Item(number, value[key], own, extra)


def _csv_items(lines: Iterable[Item], var: str | None) -> Iterator[Item]:
    """The rows of a CSV file, which may have several lines."""
    wrong: list[InputError | LimitExceeded] = []

    def texts() -> Iterator[str]:
        for line in lines:
            if line.error is not None:
                wrong.append(line.error)
            yield line.text

    reader = csv.reader(texts())
    header = None
    first = True
    while True:
        number = reader.line_num + 1
        row = [""]
        wrong.clear()
        try:
            row = next(reader)
        except StopIteration:
            return
        except csv.Error as error:
            wrong.append(ParseError(f"the row isn't CSV: {error}"))
        cells = [cell.strip() for cell in row]
        if wrong:
            yield Item(number, ",".join(row), var, error=wrong[0])
        elif first and any(cell in _EXPRESSION_KEYS for cell in cells):
            header = cells
        elif any(cells):
            yield _csv_item(number, cells, header, var)
        first = first and not (wrong or any(cells))


def _csv_item(number: int, cells: list[str], header: list[str] | None, var: str | None) -> Item:
    shown = ",".join(cells)
    if header is None:
        return Item(number, cells[0], var)
    if len(cells) != len(header):
        return Item(number, shown, var, error=ParseError(f"{len(cells)} cells in a table of {len(header)} columns"))
    return _plain_item(number, dict(zip(header, cells, strict=True)), shown, var)


@contextmanager
def answers(path: Path | None) -> Iterator[Callable[[Record], None]]:
    """What appends a record to this file, or to standard output: one JSON object a line, given to the system at once."""

    def write(record: Record) -> None:
        stream.write(record.json + "\n")
        stream.flush()

    opened: AbstractContextManager[TextIO] = nullcontext(sys.stdout)
    if path:
        opened = path.open("a", encoding="utf-8", errors="backslashreplace", newline="\n")
    with opened as stream:
        yield write


@dataclass(frozen=True)
class Done:
    """What a file of answers has already: by line number, a checksum of the input that is answered, and the label."""

    checksums: dict[int, int] = field(default_factory=dict)
    labels: dict[int, str] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.checksums)

    def __contains__(self, item: Item) -> bool:
        """Has the item been answered?  Raises `InputError` if its line number belongs to another input."""
        known = self.checksums.get(item.number)
        if known is not None and known != _checksum(item.text):
            raise InputError(
                f"line {item.number} of the input isn't what the answers in the output file belong to",
                hint="give the input file of the interrupted run, or another output file",
            )
        return known is not None


def take_up(path: Path) -> Done:
    """Read a file of answers, if there is one, and remove what isn't a whole answer and what occurs twice.

    The file is replaced by the repaired one in a single step, and not touched if there is nothing to repair.  Raises
    `InputError` for a file with whole lines, none of which is an answer: somebody needs it for something else.
    """
    done = Done()
    broken = False
    foreign = False
    if not path.is_file():
        return done
    repaired = tempfile.NamedTemporaryFile(dir=path.parent, prefix=path.name, delete=False)  # noqa: SIM115 - below
    try:
        with path.open("rb") as stream, repaired:
            for line in stream:
                answer = _answer(line)
                if answer is None or answer.number in done.checksums:
                    broken = True
                    foreign = foreign or (line.endswith(b"\n") and line.strip(b"\0\n") != b"")
                    continue
                done.checksums[answer.number] = answer.checksum
                done.labels[answer.number] = answer.label
                repaired.write(line)
            repaired.flush()
            os.fsync(repaired.fileno())
        if foreign and not done:
            raise InputError(f"{path} has no answers", hint="--resume continues what kovacic batch or scan has written")
        if broken:
            os.chmod(repaired.name, path.stat().st_mode)
            os.replace(repaired.name, path)
    finally:
        Path(repaired.name).unlink(missing_ok=True)
    return done


class _Answer(NamedTuple):
    """The number of a line, a checksum of the input and the label."""

    number: int
    checksum: int
    label: str


def _answer(line: bytes) -> _Answer | None:
    """That of a line; None for what isn't a whole answer."""
    if not line.endswith(b"\n"):
        return None
    try:
        data = json.loads(line)
        return _Answer(int(data["line"]), _checksum(data["input"]), label_of(data))
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return None


def _checksum(text: str) -> int:
    return zlib.crc32(text.encode("utf-8", errors="backslashreplace"))

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
import json
import os
import sys
import tempfile
import zlib
from collections import Counter, deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, BinaryIO, TextIO

from kovacic.batch.records import Item, Record, label_of
from kovacic.errors import InputError, LimitExceeded, ParseError
from kovacic.limits import DEFAULT_LIMITS, Limits
from kovacic.writing.escaped import strict_json

#: Names of the key or column with the expression; and all names that mean something.
_EXPRESSION_KEYS = ("S", "input", "expression")
_ITEM_KEYS = (*_EXPRESSION_KEYS, "id", "var", "names")


def guess_format(name: str) -> str | None:
    """The format that a file name implies; None if it implies none ("-", "data.txt").

    >>> guess_format("cases.jsonl.gz"), guess_format("table.CSV"), guess_format("-")
    ('jsonl', 'csv', None)
    """
    suffix = Path(name.lower().removesuffix(".gz")).suffix
    return {".jsonl": "jsonl", ".ndjson": "jsonl", ".csv": "csv"}.get(suffix)


def read_items(
    stream: BinaryIO, *, form: str | None = None, var: str | None = None, limits: Limits = DEFAULT_LIMITS
) -> Iterator[Item]:
    """The items of "lines", "jsonl" or "csv"; by default JSONL if the first item begins with `{` or `"`, else lines.

    A line of JSONL is a string, or an object with the key "S" (or "input", "expression"), optionally "id", "var" and "names",
    a list of declared parameters, and no other.  A CSV file has such columns (the names separated by spaces) and any others,
    which are carried along, or no header and the expressions in its first column.  `var` is the variable of all items that
    don't name one.  Gzip files are recognised and decompressed.  Raises `InputError` at damaged ones, after the items before.
    """
    longest = limits.text_length * len(r"\u0041")  # bytes: a character as UTF-8 or as an escape of JSON
    lines = _text_lines(stream, longest, var)
    if form == "csv":
        yield from _csv_items(lines, longest, var)
        return
    for line in lines:
        text = line.text.strip()
        if form is None and (text or line.error is not None):
            form = "jsonl" if text[:1] in ("{", '"') else "lines"
        if line.error is not None:
            yield Item(line.number, text, var, error=line.error)
        elif text and form == "jsonl":
            try:
                yield _item_of(line.number, strict_json(text), text, var)
            except (ValueError, RecursionError) as error:
                yield Item(line.number, text, var, error=ParseError(f"the line isn't JSON: {error}"))
        elif text and not text.startswith("#"):
            yield Item(line.number, text, var)


def count_items(name: str, *, form: str | None = None) -> int:
    """The number of items in a file, for the progress bar."""
    with open(name, "rb") as stream:
        return sum(1 for _ in read_items(stream, form=form or guess_format(name)))


def item_from(number: int, value: Any, *, var: str | None = None, limits: Limits = DEFAULT_LIMITS) -> Item:
    """The item of anything that `kovacic.solve` takes, or of a mapping with the keys of a line of JSONL."""
    if isinstance(value, Item):  # as `scan_items` gives them
        return value
    if isinstance(value, str | Mapping):
        return _item_of(number, value, str(value), var)
    from kovacic.reading.read import read_input

    try:
        parsed = read_input(value, var=var, limits=limits)
    except (InputError, LimitExceeded) as error:
        return Item(number, str(value), var, error=error)
    return Item(number, parsed.S.to_str(parsed.variable), parsed.variable)


def _text_lines(stream: BinaryIO, longest: int, var: str | None) -> Iterator[Item]:
    """The lines as items; one that is too long, of which nothing is kept, or isn't text has an error."""
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


def _item_of(number: int, value: Any, text: str, var: str | None) -> Item:
    """The item of a string or an object; a refused line is shown as `text`."""
    if isinstance(value, str):
        return Item(number, value, var)
    extra: dict[str, Any] = {}
    try:
        if not isinstance(value, Mapping):
            hint = 'a string, or an object like {"S": "x^2 + 3"}'
            raise ParseError("the line is neither a string nor an object", hint=hint)
        if "id" in value:
            try:
                json.dumps(value["id"], allow_nan=False)
            except (TypeError, ValueError, RecursionError):
                raise InputError(
                    f"an id is a JSON value, not a {type(value['id']).__name__}", hint="use text"
                ) from None
            extra = {"id": value["id"]}
        key = _expression_key(list(value))
        own = value.get("var") or var
        if not isinstance(value[key], str) or not isinstance(own, str | None):
            raise InputError(f"the values of {key!r} and 'var' are strings")
        names = value.get("names") or ()
        names = names.split() if isinstance(names, str) else names
        if not isinstance(names, list | tuple) or not all(isinstance(name, str) for name in names):
            raise InputError("the value of 'names' is a list of strings")
        return Item(number, value[key], own, extra, names=tuple(names))
    except InputError as error:
        return Item(number, text, var, extra, error)


def _expression_key(names: Sequence[str], *, others: bool = False) -> str:
    """The key with the expression, among those of an object, or of a table, which may have `others`.

    Raises `InputError` for a repeated or an unknown key, and unless there is one expression.
    """
    for name, count in Counter(names).items():
        if count > 1:
            raise InputError(f"two columns have the name {name!r}")
        if name not in _ITEM_KEYS and not others:
            hint = f"the keys are {', '.join(_ITEM_KEYS)}; an id may be any JSON value"
            raise InputError(f"unknown key {name!r}", hint=hint)
    match [name for name in _EXPRESSION_KEYS if name in names]:
        case [key]:
            return key
        case [first, second, *_]:
            raise InputError(f"{first!r} and {second!r} both name the expression", hint="keep one of them")
    raise InputError(f"there is no {_EXPRESSION_KEYS[0]!r} with the expression", hint='{"S": "x^2 + 3"}')


def _csv_items(lines: Iterator[Item], longest: int, var: str | None) -> Iterator[Item]:
    """The rows of a CSV file.  Without a header the expressions are in the first column, and the others have numbers."""
    rows = _Rows(lines, longest)
    header: Sequence[str] | None = None  # the names of the columns; none without a header
    flaw: InputError | None = None  # of the header, after which no row can be read
    while (row := rows.next(len(header or ()))) is not None:
        line, cells = row
        text = ",".join(cells) or line.text.strip()
        is_first = header is None and line.error is None and any(cells)
        if is_first:
            try:
                header = _header(cells, text, line.number)
            except InputError as error:
                header, flaw = (), error
        if line.error is not None or (flaw is not None and any(cells)):
            yield Item(line.number, text, var, error=line.error or flaw)
        elif any(cells) and not (is_first and header):
            yield _row_item(header or (), line.number, cells, text, var)


def _header(cells: list[str], text: str, number: int) -> Sequence[str]:
    """The first row as a header, if it has a key or consists of words; else empty.  Raises `InputError` for errors in it."""
    if any(cell.strip() in _ITEM_KEYS for cell in text.split(";")) and ";" in text:
        raise InputError("semicolons between cells", hint="write commas there, and points in decimals")
    is_of_words = all(map(str.isidentifier, cells)) and max(map(len, cells)) > 1
    if not is_of_words and set(_ITEM_KEYS).isdisjoint(cells):
        return ()
    try:
        _expression_key(cells, others=True)
    except InputError as error:
        hint = "name the column of the expressions S; if the file has no header, put S as its first line"
        raise InputError(f"line {number} as a header: {error.message}", hint=hint) from None
    return cells


def _row_item(header: Sequence[str], number: int, cells: list[str], text: str, var: str | None) -> Item:
    """The item of a row; columns that mean nothing are carried along."""
    if header:
        named = dict(zip(header, cells, strict=True))
        others = {name: named.pop(name) for name in header if name not in _ITEM_KEYS}
        item = _item_of(number, named, text, var)
    else:
        item = Item(number, cells[0], var)
        others = {str(k): cell for k, cell in enumerate(cells[1:], 2) if cell}
    return replace(item, extra={**item.extra, "columns": others}) if others else item


class _Rows:
    """The rows of a CSV file, in which a quoted cell may have several lines.

    If that gives no row, a quotation mark is unclosed: its line is refused, and the following lines are read separately.
    """

    def __init__(self, lines: Iterator[Item], longest: int) -> None:
        self._lines = lines
        self._longest = longest
        self._again: deque[Item] = deque()

    def next(self, columns: int) -> tuple[Item, list[str]] | None:
        """The first line of the next row, with its error, and the cells; None at the end.  0 columns are any number."""
        taken: list[Item] = []
        try:
            cells = [cell.strip() for cell in next(csv.reader(self._texts(taken), strict=True), [])]
            error = None
        except csv.Error as wrong:
            cells = []
            error = ParseError(f"the row isn't CSV: {wrong}")
        if not taken:
            return None
        line = taken[0]
        if columns and any(cells) and len(cells) != columns:
            error = ParseError(f"a row of length {len(cells)} in a table of {columns} columns")
        # An even number of quotation marks leaves none open.
        if error is not None and line.text.count('"') % 2:
            error = ParseError("a quotation mark isn't closed", hint='write "" for a quotation mark within quoted text')
        if error is None:
            return line, cells
        self._again.extendleft(reversed(taken[1:]))
        return replace(line, error=error), cells if len(taken) == 1 else []

    def _texts(self, taken: list[Item]) -> Iterator[str]:
        """Lines for one row; one with an error, or too much text for an expression, ends it."""
        size = 0
        while size <= self._longest:
            line = self._again.popleft() if self._again else next(self._lines, None)
            if line is None:
                return
            taken.append(line)
            if line.error is not None:
                return
            size += len(line.text)
            yield line.text


@contextmanager
def answers(
    path: Path | None, line_of: Callable[[Record], str] = lambda record: record.json + "\n", *, head: str = ""
) -> Iterator[Callable[[Record], None]]:
    """A function that appends the line of a record to a file or to standard output, and flushes it; `head` comes first."""

    def write(record: Record) -> None:
        stream.write(line_of(record))
        stream.flush()

    opened: AbstractContextManager[TextIO] = nullcontext(sys.stdout)
    if path:
        opened = path.open("a", encoding="utf-8", errors="backslashreplace", newline="\n")
    with opened as stream:
        stream.write(head)
        yield write


@dataclass(frozen=True)
class Done:
    """The contents of a file of answers: by line number, a checksum of the input, and the label of its answer."""

    checksums: dict[int, int] = field(default_factory=dict)
    labels: dict[int, str] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.checksums)

    def __contains__(self, item: Item) -> bool:
        """True if the item has been answered.  Raises `InputError` if its line number belongs to another input."""
        known = self.checksums.get(item.number)
        if known is not None and known != _checksum(item.text):
            raise InputError(
                f"line {item.number} of the input differs from the line that the output file answers",
                hint="give the input file of the interrupted run, or another output file",
            )
        return known is not None


def take_up(path: Path) -> Done:
    """Read a file of answers, if there is one, and remove incomplete and repeated lines.

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
                try:
                    if not line.endswith(b"\n"):
                        raise ValueError("the line is incomplete")
                    data = json.loads(line)
                    number, checksum, label = int(data["line"]), _checksum(data["input"]), label_of(data)
                    if number in done.checksums:
                        raise ValueError("the line was answered before")
                except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
                    broken = True
                    foreign = foreign or (line.endswith(b"\n") and line.strip(b"\0\n") != b"")
                    continue
                done.checksums[number] = checksum
                done.labels[number] = label
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


def _checksum(text: str) -> int:
    return zlib.crc32(text.encode("utf-8", errors="backslashreplace"))

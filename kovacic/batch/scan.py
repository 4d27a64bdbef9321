"""Scans: exact values of parameters, substituted into the text of S; the points as a batch, its records as a table or a map."""

from __future__ import annotations

import csv
import os
import re
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from io import StringIO
from itertools import pairwise
from math import lcm
from typing import Any

from kovacic.batch.records import Item, Record
from kovacic.errors import InputError, LimitExceeded, needs
from kovacic.numbers.numerals import as_text
from kovacic.reading.read import read_input
from kovacic.reading.substitution import Template, number_text
from kovacic.writing.maps import CellKind, check_size, draw_cells, new_axes

# Okabe and Ito's palette, which colour-blind readers can tell apart; "none" is light, so that the solvable values stand out.
_COLOURS_AND_NAMES = {
    "case 1": ("#0072b2", "case 1"),
    "case 2": ("#e69f00", "case 2"),
    "case 3 (4)": ("#009e73", "case 3, tetrahedral"),
    "case 3 (6)": ("#cc79a7", "case 3, octahedral"),
    "case 3 (12)": ("#d55e00", "case 3, icosahedral"),
    "none": ("#eeeeee", "no Liouvillian solution"),
    "undecided": ("#f0e442", "undecided"),
    "bad input": ("#777777", "not defined"),
    "failed": ("#000000", "failed"),
}


@dataclass(frozen=True, slots=True)
class Grid:
    """The values of one parameter, in the order in which they are taken: numbers over one denominator, or texts."""

    name: str
    numerators: Sequence[Fraction | int | str]
    denominator: int = 1

    def __len__(self) -> int:
        return len(self.numerators)

    def __iter__(self) -> Iterator[Fraction | str]:
        for k in self.numerators:
            yield k if isinstance(k, str) else Fraction(k, self.denominator)


def parse_grid(text: str) -> Grid:
    """The grid that `NAME=START:STOP:STEP` (STOP included, STEP 1 by default) or `NAME=VALUE,VALUE,...` denotes.

    Numbers are integers, fractions or decimals, taken exactly, and VALUE can be algebraic: n=sqrt(2).  Raises `InputError` for
    anything else, and `LimitExceeded` for more values than a sequence can have.

    >>> grid = parse_grid("n=0:1:1/4")
    >>> grid.name, [str(value) for value in grid]
    ('n', ['0', '1/4', '1/2', '3/4', '1'])
    >>> [str(value) for value in parse_grid("mu=1,5/2,-0.75")]
    ['1', '5/2', '-3/4']
    """
    name, separator, rest = text.partition("=")
    name = name.strip()
    if not separator or not name.isidentifier():
        raise InputError(f"{text!r} isn't a grid", hint="NAME=START:STOP:STEP or NAME=VALUE,VALUE: n=0:10:1/4")
    if ":" not in rest:
        return Grid(name, [_grid_value(part, text) for part in rest.split(",")])
    values = [_grid_value(part, text) for part in re.split("[:,]", rest)]
    if "," in text or len(values) > 3 or not all(isinstance(value, Fraction) for value in values):
        raise InputError(f"{text!r} isn't START:STOP:STEP with rational numbers", hint="n=0:10:1/4")
    start, stop, step = (Fraction(value) for value in (*values, 1)[:3])
    if not step or (stop - start) / step < 0:
        raise InputError(f"{text!r}: no value lies between {start} and {stop} in steps of {step}")
    count = int((stop - start) / step) + 1
    if count > sys.maxsize:  # which is the longest `len` of a sequence
        raise LimitExceeded(f"{text!r} has {count} values, above the limit of {sys.maxsize}", limit="text_length")
    denominator = lcm(start.denominator, step.denominator)
    first = int(start * denominator)
    difference = int(step * denominator)
    return Grid(name, range(first, first + count * difference, difference), denominator)


def _grid_value(part: str, text: str) -> Fraction | str:
    """The value of a rational number, the text of an algebraic one."""
    try:
        number = number_text(part)
    except InputError as error:
        hint = "integers, fractions, decimals, algebraic numbers: n=0:10:1/4, n=sqrt(2)"
        raise InputError(f"{text!r}: {part.strip()[:40]!r} isn't a number", hint=hint) from error
    constant = read_input(number, var="x_").S.num
    rational = constant.field.rational_value(constant)
    return number if rational is None else rational


def grid_points(grids: Sequence[Grid]) -> Iterator[dict[str, Fraction | str]]:
    """Every combination of values, the last parameter changing fastest."""
    if not grids:
        yield {}
        return
    for value in grids[0]:
        for rest in grid_points(grids[1:]):
            yield {grids[0].name: value, **rest}


def scan_items(expression: Any, grids: Sequence[Grid], *, var: str | None = None) -> Iterator[Item]:
    """An item for each point of the grids, the last parameter changing fastest; `extra` has the values.

    `expression` is a text or a SymPy expression.  Raises `InputError` at once if a parameter doesn't occur.
    """
    names = [grid.name for grid in grids]
    if not names:
        raise InputError("a scan needs a parameter", hint="n=0:10:1/4")
    if len(set(names)) < len(names) or var in names:
        raise InputError(f"the names of parameters must be distinct: {', '.join(names)}")
    template = Template(as_text(expression).strip(), names, var)  # as the answers have it
    return (
        Item(
            number,
            template.filled(values),
            var,
            {"parameters": {name: as_text(value) for name, value in values.items()}},
        )
        for number, values in enumerate(grid_points(grids), start=1)
    )


def columns(grids: Sequence[Grid]) -> str:
    """The column names of the table, as a line of CSV."""
    return _csv_line(
        [*(grid.name for grid in grids), "status", "case", "degree", "group", "order", "seconds", "remark"]
    )


def row(record: Record) -> str:
    """A record as a line of CSV: the degree is that of omega, the remark the reason of an undecided point or the error."""
    data = record.data
    riccati = data.get("riccati") or {}
    group = data.get("group") or {}
    remark = data["error"]["message"] if "error" in data else data["proof"]["undecided"]
    cells = (data["status"], data.get("case"), riccati.get("degree"), group.get("name"), group.get("order"),
             data.get("seconds"), remark)  # fmt: skip
    shown = ["" if cell is None else str(cell) for cell in cells]
    return _csv_line([*data["parameters"].values(), *shown])


def _csv_line(cells: Sequence[str]) -> str:
    csv.writer(line := StringIO(), lineterminator="\n").writerow(cells)
    return line.getvalue()


def draw_map(
    expression: str, grids: tuple[Grid, Grid], labels: Mapping[int, str], path: str | os.PathLike[str]
) -> None:
    """Write the map to `path` (png, pdf, svg): the first parameter upwards, the second to the right.

    `labels` are those of the records by their numbers.  A cell reaches half-way to the neighbouring values, and a missing
    number leaves it white.  Raises `InputError` for a grid that isn't increasing or decreasing, or too large for a picture.
    """
    upwards, rightwards = grids
    height = len(upwards)
    width = len(rightwards)
    check_size(height, width)
    right = _monotonic(rightwards)
    up = _monotonic(upwards)
    code = {label: number for number, label in enumerate(_COLOURS_AND_NAMES, start=1)}
    cells = [[code.get(labels.get(1 + i * width + k, ""), 0) for k in range(width)] for i in range(height)]
    kinds = [CellKind("", "white"), *(CellKind(name, colour) for colour, name in _COLOURS_AND_NAMES.values())]
    with needs("plot", "a map"):
        axes = new_axes(7.5, 5.0)
        handles = draw_cells(axes, right, up, cells, kinds)
    axes.set_xlabel(rightwards.name)
    axes.set_ylabel(upwards.name)
    shown = expression if len(expression) <= 70 else expression[:67] + "..."
    axes.set_title(f"y'' = S y,  S = {shown}", fontsize=10)
    axes.figure.legend(handles=handles, loc="outside right upper", fontsize=9, frameon=False)
    axes.figure.savefig(path, dpi=150)


def _monotonic(grid: Grid) -> list[Fraction]:
    """The values, which are rational, and increase or decrease."""
    values = [value for value in grid if isinstance(value, Fraction)]
    if len(values) < len(grid):
        raise InputError(f"the values of {grid.name} must be rational for a map")
    steps = [b - a for a, b in pairwise(values)]
    if not (all(step > 0 for step in steps) or all(step < 0 for step in steps)):
        raise InputError(f"the values of {grid.name} must be in increasing or decreasing order for a map")
    return values

"""Exact values of a parameter, and their substitution into the text of S.

A value takes the place of the parameter's name as a number in parentheses, which is what a name is to the grammar: an atom.
So the result means what the text meant, no arithmetic is done here, and the text of each point can be given to
`kovacic solve` as it is.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Protocol

from kovacic.errors import InputError, LimitExceeded
from kovacic.reading.lexer import tokenize

_NUMBER = re.compile(r"[+-]?(\d+(/\d+)?|\d*\.\d+|\d+\.)")
_NUMBER_LENGTH = 1000
_LARGEST_GRID = 10**9


class Values(Protocol):
    """A number of values that can be gone through again and again."""

    def __len__(self) -> int: ...

    def __iter__(self) -> Iterator[Fraction]: ...


@dataclass(frozen=True, slots=True)
class Progression:
    """start, start + step, ... (`count` values)."""

    start: Fraction
    step: Fraction
    count: int

    def __len__(self) -> int:
        return self.count

    def __iter__(self) -> Iterator[Fraction]:
        return (self.start + self.step * k for k in range(self.count))


@dataclass(frozen=True, slots=True)
class Grid:
    """The values of one parameter: a progression, or a list.

    `values` are in the order in which they are taken; a progression isn't expanded.
    """

    name: str
    values: Values


def parse_grid(text: str) -> Grid:
    """The grid that `NAME=START:STOP:STEP` (STOP included, STEP 1 by default) or `NAME=VALUE,VALUE,...` denotes.

    Numbers are integers, fractions or decimals, taken exactly.  Raises `InputError` for anything else, and `LimitExceeded`
    for more than 10^9 values.

    >>> grid = parse_grid("n=0:1:1/4")
    >>> grid.name, [str(value) for value in grid.values]
    ('n', ['0', '1/4', '1/2', '3/4', '1'])
    >>> [str(value) for value in parse_grid("mu=1,5/2,-0.75").values]
    ['1', '5/2', '-3/4']
    """
    name, separator, rest = text.partition("=")
    name = name.strip()
    if not separator or not name.isidentifier():
        raise InputError(f"{text!r} isn't a grid", hint="NAME=START:STOP:STEP or NAME=VALUE,VALUE: n=0:10:1/4")
    if ":" not in rest:
        return Grid(name, tuple(_number(part, text) for part in rest.split(",")))
    bounds = [_number(part, text) for part in rest.split(":")]
    if len(bounds) > 3:
        raise InputError(f"{text!r} has more than START:STOP:STEP", hint="n=0:10:1/4")
    start, stop, step = (*bounds, Fraction(1))[:3]
    if not step or (stop - start) / step < 0:
        raise InputError(f"{text!r}: no value lies between {start} and {stop} in steps of {step}")
    count = int((stop - start) / step) + 1
    if count > _LARGEST_GRID:
        raise LimitExceeded(f"{text!r} has {count} values, above the limit of {_LARGEST_GRID}", limit="text_length")
    return Grid(name, Progression(start, step, count))


def substitute(text: str, values: Mapping[str, Fraction]) -> str:
    """`text` with exact values for the names of parameters.

    Raises `InputError` where the text has no such name, or uses one as a function.

    >>> from fractions import Fraction
    >>> substitute("(4*n^2 - 1)/(4*x^2) - n", {"n": Fraction(-1, 2)})
    '(4*(-1/2)^2 - 1)/(4*x^2) - (-1/2)'
    """
    return Template(text, tuple(values)).filled(values)


class Template:
    """A text whose parameters have been found, to be filled with many values."""

    def __init__(self, text: str, names: Sequence[str]) -> None:
        tokens = tokenize(text)
        pieces: list[tuple[str, str]] = []
        found = set()
        end = 0
        for kind, start, stop in zip(tokens.kinds, tokens.starts, tokens.ends, strict=True):
            token = text[start:stop]
            if token not in names:
                continue
            if kind != "NAME":
                raise InputError(
                    f"the parameter {token} is followed by a parenthesis like a function",
                    text=text,
                    position=start,
                    length=stop - start,
                    hint=f"for a product write {token}*(...)",
                )
            found.add(token)
            pieces.append((text[end:start], token))
            end = stop
        for name in names:
            if name not in found:
                raise InputError(f"the expression has no parameter {name}", text=text)
        self._pieces = pieces
        self._rest = text[end:]

    def filled(self, values: Mapping[str, Fraction]) -> str:
        """The text with these values."""
        return "".join(f"{before}({values[name]})" for before, name in self._pieces) + self._rest


def points(grids: Sequence[Grid]) -> Iterator[dict[str, Fraction]]:
    """Every combination of values, the last parameter changing fastest."""
    if not grids:
        yield {}
        return
    first, *others = grids
    for value in first.values:
        for rest in points(others):
            yield {first.name: value, **rest}


def _number(part: str, text: str) -> Fraction:
    part = part.strip()
    if len(part) > _NUMBER_LENGTH or _NUMBER.fullmatch(part) is None:
        raise InputError(f"{text!r}: {part[:40]!r} isn't a number", hint="integers, fractions, decimals: n=0:10:1/4")
    try:
        return Fraction(part)
    except ZeroDivisionError:
        raise InputError(f"{text!r}: {part!r} has the denominator 0") from None

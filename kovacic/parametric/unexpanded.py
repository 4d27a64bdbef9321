"""A text as a formula, with its sums and products as they stand in it: what the user wrote, in one spelling, and as LaTeX.

It is a reader for the parser, as those are that calculate: so what is printed has the structure that was read.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from kovacic.errors import InputError
from kovacic.reading.lexer import PRIMES
from kovacic.reading.names import is_function
from kovacic.reading.source import Source
from kovacic.writing.formula import Math, latex_text

#: Characters of a text above which nobody prints it unexpanded; strings are joined anew at each operation.
_LONGEST = 1000
#: How strongly the outermost operation of a formula binds.
_SUM, _NEGATED, _PRODUCT, _POWER, _ATOM = range(5)


@dataclass(frozen=True)
class _Written:
    text: str
    strength: int = _ATOM
    #: Of what this is the negative.
    opposite: _Written | None = None

    def within(self, strength: int) -> str:
        """As an operand of an operation that needs at least this strength: in parentheses, where it binds less."""
        return self.text if self.strength >= strength else f"({self.text})"


class _Operations:
    """What the parser calculates with."""

    def negate(self, value: _Written) -> _Written:
        return _Written(f"-{value.within(_PRODUCT)}", _NEGATED, value)

    def sum(self, terms: Sequence[_Written]) -> _Written:
        if len(terms) == 1:
            return terms[0]
        text = terms[0].within(_NEGATED)
        for term in terms[1:]:
            if term.opposite is None:
                text += f" + {term.within(_NEGATED)}"
            else:
                text += f" - {term.opposite.within(_PRODUCT)}"
        return _Written(text, _SUM)

    def multiply(self, left: _Written, right: _Written) -> _Written:
        if left.opposite is not None:  # (-x) y = -(x y)
            return self.negate(self.multiply(left.opposite, right))
        return _Written(f"{left.within(_PRODUCT)}*{right.within(_PRODUCT)}", _PRODUCT)

    def divide(self, left: _Written, right: _Written) -> _Written:
        if left.opposite is not None:
            return self.negate(self.divide(left.opposite, right))
        return _Written(f"{left.within(_PRODUCT)}/{right.within(_POWER)}", _PRODUCT)

    def signed_integer(self, text: str) -> int:
        return int(text)

    def constant(self, value: int) -> _Written:
        number = _Written(str(abs(value)))
        return self.negate(number) if value < 0 else number


class _Writer:
    """The reader.

    Raises `InputError` for what it can't write: derivatives as calls, several arguments, and 1e-3.
    """

    def __init__(self, unknown: str) -> None:
        self.unknown = unknown
        self.arithmetic = _Operations()

    def number(self, text: str) -> _Written:
        if not text.replace(".", "", 1).isdigit():
            raise InputError(f"{text} has an exponent")
        return _Written(text)

    def name(self, name: str) -> _Written:
        return _Written(name)

    derivative = name

    def equation(self, left: _Written, right: _Written) -> _Written:
        return _Written(f"{left.text} = {right.text}", _SUM)

    def follows_without_sign(self, _: str) -> bool:
        return True

    def power(self, base: _Written, exponent: _Written, _: Any) -> _Written:
        return _Written(f"{base.within(_ATOM)}^{exponent.within(_ATOM)}", _POWER)

    def call(self, head: str, arguments: list[Any], _: Any) -> _Written:
        if len(arguments) != 1 or isinstance(arguments[0], tuple):
            raise InputError(f"{head} has several arguments")
        if head.rstrip(PRIMES) != self.unknown and not (is_function(head) and head.isalpha()):
            raise InputError(f"{head} isn't a function that is written here")
        return _Written(f"{head}({arguments[0].text})")


def unexpanded(source: Source) -> Math | None:
    """The equation, or y'' = S y for S alone; None where there is no text, a long one, or one that isn't written like this."""
    if source.tokens is None or source.has_operator or len(source.text or "") > _LONGEST:
        return None
    writer = _Writer(source.unknown)
    try:
        value = source.walk(writer)
        if source.unknown:
            return Math(value.text, latex_text(value.text))
        S = value.within(_PRODUCT)
        return Math("y''", "y''").equals(Math(f"{S} y", f"{latex_text(S)} y"))
    except InputError:
        return None

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
#: Functions that have a command in LaTeX.
_COMMANDS = frozenset("sin cos tan cot sec csc sinh cosh tanh coth exp log ln arcsin arccos arctan".split())  # noqa: SIM905


@dataclass(frozen=True)
class _Written:
    text: str
    latex: str
    strength: int = _ATOM
    #: Of what this is the negative.
    opposite: _Written | None = None

    def within(self, strength: int) -> _Written:
        """As an operand of an operation that needs at least this strength: in parentheses, where it binds less."""
        if self.strength >= strength:
            return self
        return _Written(f"({self.text})", rf"\left({self.latex}\right)")


class _Operations:
    """What the parser calculates with."""

    def negate(self, value: _Written) -> _Written:
        inside = value.within(_PRODUCT)
        return _Written(f"-{inside.text}", f"-{inside.latex}", _NEGATED, value)

    def sum(self, terms: Sequence[_Written]) -> _Written:
        first = terms[0].within(_NEGATED)
        text, latex = first.text, first.latex
        for term in terms[1:]:
            sign, inside = "+", term.within(_NEGATED)
            if term.opposite is not None:
                sign, inside = "-", term.opposite.within(_PRODUCT)
            text += f" {sign} {inside.text}"
            latex += f" {sign} {inside.latex}"
        return _Written(text, latex, _SUM) if len(terms) > 1 else terms[0]

    def multiply(self, left: _Written, right: _Written) -> _Written:
        if left.opposite is not None:  # (-x) y = -(x y)
            return self.negate(self.multiply(left.opposite, right))
        first, second = left.within(_PRODUCT), right.within(_PRODUCT)
        is_mixed = first.text[-1].isdigit() and second.latex.startswith(r"\frac")  # 2 times 1/2, not two and a half
        sign = r" \cdot " if second.latex[0].isdigit() or is_mixed else " "
        return _Written(f"{first.text}*{second.text}", f"{first.latex}{sign}{second.latex}", _PRODUCT)

    def divide(self, left: _Written, right: _Written) -> _Written:
        if left.opposite is not None:
            return self.negate(self.divide(left.opposite, right))
        text = f"{left.within(_PRODUCT).text}/{right.within(_POWER).text}"
        return _Written(text, rf"\frac{{{left.latex}}}{{{right.latex}}}", _PRODUCT)

    def signed_integer(self, text: str) -> int:
        return int(text)

    def constant(self, value: int) -> _Written:
        number = _Written(str(abs(value)), str(abs(value)))
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
        return _Written(text, text)

    def name(self, name: str) -> _Written:
        return _Written(name, latex_text(name))

    def derivative(self, text: str) -> _Written:
        name = text.rstrip(PRIMES)
        return _Written(text, latex_text(name) + text[len(name) :])

    def equation(self, left: _Written, right: _Written) -> _Written:
        return _Written(f"{left.text} = {right.text}", f"{left.latex} = {right.latex}", _SUM)

    def follows_without_sign(self, _: str) -> bool:
        return True

    def power(self, base: _Written, exponent: _Written, _: Any) -> _Written:
        inside = base.within(_ATOM)
        text = f"{inside.text}^{exponent.within(_ATOM).text}"
        return _Written(text, f"{inside.latex}^{{{exponent.latex}}}", _POWER)

    def call(self, head: str, arguments: list[Any], _: Any) -> _Written:
        name = head.rstrip(PRIMES)
        if len(arguments) != 1 or isinstance(arguments[0], tuple):
            raise InputError(f"{head} has several arguments")
        (argument,) = arguments
        text = f"{head}({argument.text})"
        if head == "sqrt":
            return _Written(text, rf"\sqrt{{{argument.latex}}}")
        if name == self.unknown:
            called = self.derivative(head).latex
        elif is_function(head) and head.isalpha():
            called = rf"\{head}" if head in _COMMANDS else rf"\operatorname{{{head}}}"
        else:
            raise InputError(f"{head} isn't a function that is written here")
        return _Written(text, rf"{called}\left({argument.latex}\right)")


def unexpanded(source: Source) -> Math | None:
    """The equation, or y'' = S y for S alone; None where there is no text, a long one, or one that isn't written like this."""
    if source.tokens is None or source.has_operator or len(source.text or "") > _LONGEST:
        return None
    writer = _Writer(source.unknown)
    try:
        value = source.walk(writer)
        if source.unknown:
            return Math(value.text, value.latex)
        S = value.within(_PRODUCT)
        return Math("y''", "y''").equals(Math(f"{S.text} y", f"{S.latex} y"))
    except InputError:
        return None

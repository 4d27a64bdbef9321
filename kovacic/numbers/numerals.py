"""Integers, fractions and SymPy expressions as text, with numbers of any length.

Python refuses to convert integers of more than 4,300 digits, and takes time that grows with the square of their length where it
is allowed to.  FLINT does neither.  SymPy's printers use Python's conversion; ours replace it.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from typing import Any

from flint import fmpq, fmpz

#: Above this, Python's readers of JSON refuse an integer by default; it is written as a text.
_TOO_LONG_FOR_JSON = 10**4300
#: Bits of a number above which a message has its size in place of its digits.
_BITS_IN_A_MESSAGE = 128
#: Bits of a number which SymPy's printers can sort by its digits, whatever limit Python has been set to.
_SORTED_BITS = 2000


def digits(number: int) -> str:
    """The decimal digits of an integer, with its sign.

    >>> len(digits(10**5000))
    5001
    """
    return str(fmpz(number))


def fraction(text: str | int) -> Fraction:
    """The fraction p/q that a text denotes, or the integer.  Raises `ValueError` for any other text.

    >>> fraction("-1/2"), fraction(3)
    (Fraction(-1, 2), Fraction(3, 1))
    """
    number = fmpq(text)
    return Fraction(int(number.p), int(number.q))


def in_a_message(number: int) -> str:
    """A number within a sentence: its digits, or its size if there are many.

    >>> in_a_message(17), in_a_message(10**5000)
    ('17', 'of 16610 bits')
    """
    bits = number.bit_length()
    return digits(number) if bits <= _BITS_IN_A_MESSAGE else f"of {bits} bits"


def as_text(value: Any, first: Any = None) -> str:
    """`str` for an integer, a `Fraction` or a SymPy expression, with numbers of any length.

    Polynomials in the symbol `first`, if there is one, begin with its highest power: x - c, not -c + x.

    >>> as_text(Fraction(-1, 2))
    '-1/2'
    >>> import sympy
    >>> len(as_text(sympy.Symbol("x") ** 2 + 10**5000))
    5008
    """
    if isinstance(value, int | Fraction):
        return str(fmpq(value.numerator, value.denominator))
    text, _ = _printers()
    printer = text(_settings(value))
    printer.first = first
    return printer.doprint(value)  # type: ignore[no-any-return]


def plain_text(value: Any) -> str:
    """`as_text` of a number or an expression, and `str` of anything else.

    >>> len(plain_text(10**5000)), plain_text("x")
    (5001, 'x')
    """
    if isinstance(value, int | Fraction) or hasattr(value, "free_symbols"):
        return as_text(value)
    try:
        return str(value)
    except ValueError:  # long integers inside of a list, for instance
        return type(value).__name__


def as_latex(expression: Any, first: Any = None) -> str:
    """`sympy.latex` for an expression, with numbers of any length; `first` as for `as_text`."""
    _, latex = _printers()
    printer = latex(_settings(expression))
    printer.first = first
    return printer.doprint(expression)  # type: ignore[no-any-return]


def _powers_first(terms: list[Any], first: Any) -> list[Any]:
    """The terms of a sum by falling powers of a symbol, if each is c x^k; else in their order, as where a minus would lead."""
    if first is None:
        return terms
    degrees: dict[Any, Any] = {}
    for term in terms:
        _, dependent = term.as_independent(first, as_Add=False)
        base, exponent = dependent.as_base_exp()
        if dependent != 1 and not (base == first and exponent.is_Rational):
            return terms
        degrees[term] = 0 if dependent == 1 else exponent
    by_power = sorted(terms, key=lambda term: degrees[term], reverse=True)
    return terms if by_power[0].could_extract_minus_sign() else by_power


def for_json(number: int) -> int | str:
    """An integer for JSON: as a text where it has more than 4,300 digits.

    >>> for_json(12), len(for_json(10**5000))
    (12, 5001)
    """
    if abs(number) < _TOO_LONG_FOR_JSON:
        return number
    return digits(number)


def _settings(expression: Any) -> dict[str, Any]:
    """Settings for SymPy's printers, which sort roots of numbers by their decimal digits: long ones keep their order."""
    import sympy

    parts = sympy.preorder_traversal(expression)
    numbers = (part for part in parts if isinstance(part, sympy.Rational))
    is_long = any(int(number.p).bit_length() > _SORTED_BITS for number in numbers)
    return {"order": "none"} if is_long else {}


class _LongIntegers:
    """Methods for printers of SymPy: integers of any length, and an order of terms that begins with powers of `first`."""

    first: Any = None

    def _as_ordered_terms(self, expr: Any, order: Any = None) -> list[Any]:
        terms = super()._as_ordered_terms(expr, order)  # type: ignore[misc]
        return _powers_first(terms, self.first)

    def _print_int(self, number: int) -> str:
        return digits(number)

    def _print_Integer(self, number: Any) -> str:
        return digits(int(number.p))


@cache
def _printers() -> tuple[type[Any], type[Any]]:
    """The classes that print text and LaTeX; SymPy is imported when they are needed."""
    from sympy.printing.latex import LatexPrinter
    from sympy.printing.str import StrPrinter

    class Text(_LongIntegers, StrPrinter):  # type: ignore[misc]
        def _print_Rational(self, number: Any) -> str:
            return as_text(Fraction(int(number.p), int(number.q)))

        def _print_Exp1(self, _: Any) -> str:
            return "exp(1)"  # E is an energy in texts, and e may be a letter

    class Latex(_LongIntegers, LatexPrinter):  # type: ignore[misc]
        def _print_Rational(self, number: Any) -> str:
            sign = "- " if number < 0 else ""
            above = digits(abs(int(number.p)))
            return rf"{sign}\frac{{{above}}}{{{digits(int(number.q))}}}"

        def _print_Pow(self, power: Any) -> str:
            exponent = power.exp
            if not exponent.is_Rational or int(exponent.q).bit_length() <= _BITS_IN_A_MESSAGE:
                return super()._print_Pow(power)  # type: ignore[no-any-return]
            # SymPy would write a root, whose index it converts itself.
            return self._helper_print_standard_power(power, "%s^{%s}")  # type: ignore[no-any-return]

    return Text, Latex

"""Coefficient sequences into a rational function."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from numbers import Rational
from operator import index
from typing import Any

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.errors import InputError, LimitExceeded, NotRational
from kovacic.limits import DEFAULT_LIMITS, Limits
from kovacic.reading.parsed import DEFAULT_VARIABLE, Parsed


def parse_coefficients(
    num: Sequence[Any], den: Sequence[Any], *, variable: str | None = None, limits: Limits = DEFAULT_LIMITS
) -> Parsed:
    """The quotient of two polynomials, given by their coefficients from low to high powers.

    Coefficients are integers, fractions, SymPy rationals and numpy integers.  Raises `NotRational` for others, floats
    among them (a float is rarely the number that was meant), and for a zero denominator; `LimitExceeded`.

    >>> str(parse_coefficients([3, 0, 1], [1]).S)
    'x**2 + 3'
    """
    above, below = _polynomial(num, "numerator", limits), _polynomial(den, "denominator", limits)
    if not below:
        raise NotRational("the denominator is zero", hint="give the pair (numerator, denominator), low powers first")
    return Parsed(RatFunc(above, below), variable or DEFAULT_VARIABLE)


def _polynomial(coefficients: Sequence[Any], what: str, limits: Limits) -> Poly:
    if isinstance(coefficients, str | bytes) or not hasattr(coefficients, "__iter__"):
        raise InputError(
            f"the {what} is {type(coefficients).__name__!r}, not a sequence of coefficients",
            hint="give two sequences of numbers, low powers first: ([3, 0, 1], [1]) is x^2 + 3",
        )
    if len(coefficients) > limits.degree + 1:
        raise LimitExceeded(
            f"the {what} has {len(coefficients)} coefficients, above the limit of degree {limits.degree}",
            limit="degree",
        )
    numbers = [_rational(value, power, what) for power, value in enumerate(coefficients)]
    bits = max((max(q.numerator.bit_length(), q.denominator.bit_length()) for q in numbers), default=0)
    if bits > limits.bits:
        raise LimitExceeded(
            f"the {what} has coefficients of {bits} bits, above the limit of {limits.bits}", limit="bits"
        )
    return QQ.poly(numbers)


def _rational(value: Any, power: int, what: str) -> Fraction | int:
    if isinstance(value, Rational):  # int, Fraction, numpy's integers; SymPy registers its rationals
        above, below = index(value.numerator), index(value.denominator)
        return above if below == 1 else Fraction(above, below)
    hint = "give integers, Fraction(1, 2) or sympy.Rational(1, 2)"
    if isinstance(value, float):
        hint = f"give Fraction({value!r}) if exactly this float is meant, or Fraction({str(value)!r}) for the decimal"
    raise NotRational(
        f"the coefficient of power {power} in the {what} is {str(value)[:40]!r}, not a rational number", hint=hint
    )

"""Exact points of the complex plane: Gaussian rationals, read from every kind of number that users have.

Floats are taken at their exact binary value and decimal text at its exact decimal value ("0.1" is 1/10, 0.1 is
3602879701896397/36028797018963968): nothing is rounded on the way in.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from functools import lru_cache
from numbers import Rational
from typing import Any

from flint import acb, arb, fmpq, fmpz

from kovacic.algebra.rationals import to_fmpq, to_fraction
from kovacic.errors import InputError

_NUMBER = re.compile(r"\s*([+-]?\d+)\s*/\s*(\d+)\s*|\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*")
_MAX_EXPONENT = 100_000
_MAX_TEXT = 200_000


@dataclass(frozen=True, slots=True)
class Point:
    """The Gaussian rational re + i im."""

    re: Fraction
    im: Fraction = Fraction(0)

    def __add__(self, other: Point) -> Point:
        return Point(self.re + other.re, self.im + other.im if self.im or other.im else self.im)

    def __sub__(self, other: Point) -> Point:
        return Point(self.re - other.re, self.im - other.im if self.im or other.im else self.im)

    def __mul__(self, other: Point) -> Point:
        return Point(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)

    def scaled(self, factor: Fraction) -> Point:
        """The point times a rational number."""
        return Point(self.re * factor, self.im * factor if self.im else self.im)

    def rounded(self, e: int) -> Point:
        """The nearest multiple of 2^e, in both parts."""
        unit = power_of_two(e)
        return Point(round(self.re / unit) * unit, round(self.im / unit) * unit if self.im else self.im)

    def norm_squared(self) -> Fraction:
        """|z|^2, exactly."""
        return self.re * self.re + self.im * self.im if self.im else self.re * self.re

    def __complex__(self) -> complex:
        return complex(float(self.re), float(self.im))

    def is_real(self) -> bool:
        """True if the imaginary part is zero."""
        return self.im == 0

    def __str__(self) -> str:
        if self.im == 0:
            return _short(self.re)
        sign = "-" if self.im < 0 else "+"
        return f"{_short(self.re)} {sign} {_short(abs(self.im))}i"


@lru_cache(maxsize=1024)
def power_of_two(e: int) -> Fraction:
    """2^e."""
    return Fraction(1 << e) if e >= 0 else Fraction(1, 1 << -e)


def _short(value: Fraction) -> str:
    text = str(value)
    return text if len(text) <= 24 else f"{float(value):.15g}"


def as_point(value: object, name: str) -> Point:
    """The exact Gaussian rational that `value` stands for.

    Accepted: int, Fraction and other rationals, float, complex, Decimal, decimal or p/q text, mpmath mpf and mpc, SymPy
    numbers a + b I with rational or floating parts, an exact Ball, a Point.  Raises InputError for what isn't a finite
    number of these kinds (`name` says in the message which argument it was).

    >>> as_point("0.1", "x"), as_point(1 + 2j, "x")
    (Point(re=Fraction(1, 10), im=Fraction(0, 1)), Point(re=Fraction(1, 1), im=Fraction(2, 1)))
    """
    if isinstance(value, Point):
        return value
    if isinstance(value, bool):
        raise InputError(f"{name} is a truth value ({value}), not a number")
    if isinstance(value, complex):
        return Point(_real(value.real, name), _real(value.imag, name))
    if isinstance(value, str):
        return Point(_text(value, name))
    if isinstance(value, int | float | Decimal | Rational):
        return Point(_real(value, name))
    return _foreign(value, name)


def _real(value: float | Decimal | Rational, name: str) -> Fraction:
    if isinstance(value, Decimal) and value.is_finite() and abs(value.adjusted()) > _MAX_EXPONENT:
        raise InputError(f"{name} = {value} has an exponent beyond {_MAX_EXPONENT}")
    try:
        return Fraction(value)
    except (OverflowError, ValueError):
        raise InputError(f"{name} = {value} isn't a finite number") from None


def _text(text: str, name: str) -> Fraction:
    match = _NUMBER.fullmatch(text) if len(text) <= _MAX_TEXT else None
    if match is None:
        raise InputError(f"{name} isn't a decimal number or a fraction p/q: {text[:60]!r}", hint="e.g. '0.1' or '1/3'")
    if match[1] is not None:
        if int(match[2]) == 0:
            raise InputError(f"{name} = {text[:60]} divides by zero")
        return Fraction(int(match[1]), int(match[2]))
    return _real(Decimal(match[3]), name)


def _foreign(value: Any, name: str) -> Point:
    """Numbers of mpmath, SymPy, NumPy, flint and our own balls, recognised without importing any of these libraries."""
    if hasattr(value, "is_exact") and hasattr(value, "midpoint"):
        if not value.is_exact():
            raise InputError(f"{name} is a ball of positive radius; an exact point is needed", hint="use ball.midpoint")
        return Point(*value.midpoint)
    module = type(value).__module__.split(".")[0]
    if module == "numpy" and hasattr(value, "item") and getattr(value, "ndim", 1) == 0:
        return as_point(value.item(), name)
    if isinstance(value, fmpz | fmpq):
        return Point(to_fraction(fmpq(value)))
    if module == "mpmath" and (hasattr(value, "_mpf_") or hasattr(value, "_mpc_")):
        return Point(*(_mpf(part, name) for part in getattr(value, "_mpc_", None) or (value._mpf_,)))
    if module == "sympy" and hasattr(value, "as_real_imag"):
        parts = value.as_real_imag()
        if all(part.is_Rational for part in parts):
            return Point(*(Fraction(int(part.p), int(part.q)) for part in parts))
        if all(part.is_Rational or part.is_Float for part in parts):
            return Point(*(Fraction(int(p.p), int(p.q)) if p.is_Rational else _mpf(p._mpf_, name) for p in parts))
    raise InputError(f"{name} isn't a number that is known exactly: {str(value)[:60]!r} ({type(value).__name__})")


def _mpf(parts: tuple[int, int, int, int], name: str) -> Fraction:
    sign, mantissa, exponent, _ = parts
    if not mantissa and exponent:
        raise InputError(f"{name} isn't a finite number")
    if abs(exponent) > 4 * _MAX_EXPONENT:
        raise InputError(f"{name} has a binary exponent beyond {4 * _MAX_EXPONENT}")
    signed = -int(mantissa) if sign else int(mantissa)
    return Fraction(signed) * Fraction(2) ** int(exponent)


def to_acb(point: Point) -> acb:
    """A ball around the point at the working precision in force (exact where the precision allows)."""
    if point.im == 0:
        return acb(arb(to_fmpq(point.re)))
    return acb(*(arb(to_fmpq(part)) for part in (point.re, point.im)))


def midpoint(ball: acb) -> Point:
    """The midpoint of a finite ball."""
    return Point(*(_exact(part.mid()) for part in (ball.real, ball.imag)))


def floor(number: arb) -> int:
    """The integer below a number that is known exactly."""
    return math.floor(_exact(number))


def _exact(number: arb) -> Fraction:
    mantissa, exponent = map(int, number.man_exp())
    return Fraction(mantissa << exponent) if exponent >= 0 else Fraction(mantissa, 1 << -exponent)

"""Exact points of the complex plane: Gaussian rationals, read from every kind of number; and the precision of balls.

Floats are taken at their exact binary value and decimal text at its exact decimal value ("0.1" is 1/10, 0.1 is
3602879701896397/36028797018963968): nothing is rounded on the way in.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from functools import lru_cache
from numbers import Rational
from threading import RLock
from typing import Any

from flint import acb, arb, ctx, fmpq, fmpz

from kovacic.algebra.rationals import to_fmpq, to_fraction
from kovacic.errors import InputError

_NUMBER = re.compile(r"\s*([+-]?\d+)\s*/\s*(\d+)\s*|\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*")
_MAX_EXPONENT = 100_000
_MAX_TEXT = 200_000
_LOCK = RLock()


@contextmanager
def working_precision(bits: int) -> Iterator[None]:
    """FLINT's precision within the block; it is what it was before afterwards, whatever happens.

    `flint.ctx.prec` is global: a thread that sets it changes the precision of every other one.  So it is set here only, under a
    lock that is held as long as the precision is in force.  Threads wait for each other; processes don't.
    """
    with _LOCK, ctx.workprec(bits):
        yield


@dataclass(frozen=True, init=False, repr=False, slots=True)
class Point:
    """The Gaussian rational re + i im; `x` and `y` are its parts as FLINT's rationals, many times as fast as fractions.

    >>> Point(Fraction(1, 2)) + Point(0, 1)
    Point(1/2 + 1i)
    """

    x: Any
    y: Any

    def __init__(self, re: Any, im: Any = 0) -> None:
        _set_x(self, re if type(re) is fmpq else to_fmpq(re))
        _set_y(self, im if type(im) is fmpq else to_fmpq(im))

    def __hash__(self) -> int:  # that of FLINT's rationals goes by way of fractions
        return hash((self.x.p, self.x.q, self.y.p, self.y.q))

    @property
    def re(self) -> Fraction:
        """The real part."""
        return to_fraction(self.x)

    @property
    def im(self) -> Fraction:
        """The imaginary part."""
        return to_fraction(self.y)

    def __add__(self, other: Point) -> Point:
        return Point(self.x + other.x, self.y + other.y)

    def __sub__(self, other: Point) -> Point:
        return Point(self.x - other.x, self.y - other.y)

    def __mul__(self, other: Point) -> Point:
        return Point(self.x * other.x - self.y * other.y, self.x * other.y + self.y * other.x)

    def scaled(self, factor: Any) -> Point:
        """The point times a rational number."""
        factor = factor if type(factor) is fmpq else to_fmpq(factor)
        return Point(self.x * factor, self.y * factor)

    def rounded(self, e: int) -> Point:
        """The nearest multiple of 2^e, in both parts."""
        unit = power_of_two(e)
        return Point(*((part / unit + _HALF).floor() * unit for part in (self.x, self.y)))

    def norm_squared(self) -> Any:
        """|z|^2, exactly."""
        return self.x * self.x + self.y * self.y

    def __complex__(self) -> complex:
        return complex(float(self.x), float(self.y))

    def is_real(self) -> bool:
        """True if the imaginary part is zero."""
        return bool(self.y == 0)

    def __str__(self) -> str:
        if self.is_real():
            return _short(self.re)
        return f"{_short(self.re)} {'-' if self.im < 0 else '+'} {_short(abs(self.im))}i"

    def __repr__(self) -> str:
        return f"Point({self})"


_set_x, _set_y = (Point.__dict__[part].__set__ for part in "xy")
_HALF = fmpq(1, 2)


@lru_cache(maxsize=1024)
def power_of_two(e: int) -> Any:
    """2^e, FLINT's rational."""
    return fmpq(1 << e) if e >= 0 else fmpq(1, 1 << -e)


def _short(value: Fraction) -> str:
    text = str(value) if value.numerator.bit_length() + value.denominator.bit_length() < 100 else ""
    if 0 < len(text) <= 24:
        return text
    try:
        return f"{float(value):.15g}"
    except OverflowError:
        return f"{Decimal(value.numerator) / value.denominator:.15g}"


def as_point(value: Any, name: str) -> Point:
    """The exact Gaussian rational that `value` stands for.

    Accepted: int, Fraction and other rationals, float, complex, Decimal, decimal or p/q text, mpmath mpf and mpc, SymPy
    numbers a + b I with rational or floating parts, an exact Ball, a Point.  Raises InputError for what isn't a finite
    number of these kinds (`name` says in the message which argument it was).

    >>> as_point("0.1", "x"), as_point(1 + 2j, "x")
    (Point(1/10), Point(1 + 2i))
    """
    if isinstance(value, Point):
        return value
    if type(value) is int:
        return Point(fmpq(value))
    if isinstance(value, bool):
        raise InputError(f"{name} is a truth value ({value}), not a number")
    if isinstance(value, complex):
        return Point(_real(value.real, name), _real(value.imag, name))
    if isinstance(value, str):
        return Point(_text(value, name))
    if isinstance(value, int | float | Decimal | Rational):
        return Point(_real(value, name))
    if isinstance(value, fmpz | fmpq):
        return Point(fmpq(value))
    # numbers of mpmath, SymPy, NumPy and our own balls, recognised without importing any of these libraries
    if hasattr(value, "is_exact") and hasattr(value, "midpoint"):
        if not value.is_exact():
            raise InputError(f"{name} is a ball of positive radius; an exact point is needed", hint="use ball.midpoint")
        return Point(*value.midpoint)
    module = type(value).__module__.split(".")[0]
    if module == "numpy" and hasattr(value, "item") and getattr(value, "ndim", 1) == 0:
        return as_point(value.item(), name)
    if module == "mpmath" and (hasattr(value, "_mpf_") or hasattr(value, "_mpc_")):
        return Point(*(_mpf(part, name) for part in getattr(value, "_mpc_", None) or (value._mpf_,)))
    if module == "sympy" and hasattr(value, "as_real_imag"):
        parts = value.as_real_imag()
        if all(part.is_Rational or part.is_Float for part in parts):
            return Point(*(fmpq(int(p.p), int(p.q)) if p.is_Rational else _mpf(p._mpf_, name) for p in parts))
    raise InputError(f"{name} isn't a number that is known exactly: {str(value)[:60]!r} ({type(value).__name__})")


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
    if match[3] is not None:
        return _real(Decimal(match[3]), name)
    if int(match[2]) == 0:
        raise InputError(f"{name} = {text[:60]} divides by zero")
    return Fraction(int(match[1]), int(match[2]))


def _mpf(parts: tuple[int, int, int, int], name: str) -> Fraction:
    sign, mantissa, exponent, _ = parts
    if not mantissa and exponent:
        raise InputError(f"{name} isn't a finite number")
    if abs(exponent) > 4 * _MAX_EXPONENT:
        raise InputError(f"{name} has a binary exponent beyond {4 * _MAX_EXPONENT}")
    return Fraction(-int(mantissa) if sign else int(mantissa)) * Fraction(2) ** int(exponent)


def to_acb(point: Point) -> acb:
    """A ball around the point at the working precision in force (exact where the precision allows)."""
    return acb(point.x) if point.y == 0 else acb(arb(point.x), arb(point.y))


def to_double(point: Point) -> complex:
    """The nearest complex double, infinite where it is out of range."""
    try:
        return complex(point)
    except OverflowError:
        return complex(math.inf)


def midpoint(ball: acb) -> Point:
    """The midpoint of a finite ball."""
    return Point(*(_exact(part.mid()) for part in (ball.real, ball.imag)))


def floor(number: arb) -> int:
    """The integer below a number that is known exactly."""
    return int(_exact(number).floor())


def _exact(number: arb) -> Any:
    mantissa, exponent = number.man_exp()
    return fmpq(mantissa) * power_of_two(int(exponent))

"""Exact points of the complex plane: Gaussian rationals, read from every kind of number."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from functools import lru_cache, wraps
from typing import Any, ParamSpec, TypeVar

from flint import acb, arb, ctx, fmpq

from kovacic.algebra.rationals import to_fmpq, to_fraction
from kovacic.numbers.exact import exact

P = ParamSpec("P")
R = TypeVar("R")


def kept_at_precision(maxsize: int) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """A cache for a function of exact arguments that computes at the precision in force, which is part of the key."""

    def decorated(compute: Callable[P, R]) -> Callable[P, R]:
        @lru_cache(maxsize=maxsize)
        def kept(_bits: int, *arguments: Any) -> R:
            return compute(*arguments)  # type: ignore[call-arg]

        @wraps(compute)
        def called(*arguments: P.args, **keywords: P.kwargs) -> R:
            assert not keywords
            return kept(ctx.prec, *arguments)

        called.cache_clear = kept.cache_clear  # type: ignore[attr-defined]  # as of every cache
        return called

    return decorated


@dataclass(frozen=True, init=False, repr=False, slots=True)
class ExactPoint:
    """The Gaussian rational re + i im; `x` and `y` are its parts as FLINT's rationals, many times as fast as fractions.

    >>> ExactPoint(Fraction(1, 2)) + ExactPoint(0, 1)
    ExactPoint(1/2 + 1i)
    """

    x: Any
    y: Any

    def __init__(self, re: Any, im: Any = 0) -> None:
        if type(re) is not fmpq:
            re = to_fmpq(re)
        if type(im) is not fmpq:
            im = to_fmpq(im)
        _set_x(self, re)
        _set_y(self, im)

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

    def __add__(self, other: ExactPoint) -> ExactPoint:
        return ExactPoint(self.x + other.x, self.y + other.y)

    def __sub__(self, other: ExactPoint) -> ExactPoint:
        return ExactPoint(self.x - other.x, self.y - other.y)

    def __mul__(self, other: ExactPoint) -> ExactPoint:
        return ExactPoint(self.x * other.x - self.y * other.y, self.x * other.y + self.y * other.x)

    def scaled(self, factor: Any) -> ExactPoint:
        """The point times a rational number."""
        factor = factor if type(factor) is fmpq else to_fmpq(factor)
        return ExactPoint(self.x * factor, self.y * factor)

    def rounded(self, e: int) -> ExactPoint:
        """The nearest multiple of 2^e, in both parts."""
        unit = power_of_two(e)
        return ExactPoint(*((part / unit + _HALF).floor() * unit for part in (self.x, self.y)))

    def norm_squared(self) -> Any:
        """|z|^2, exactly."""
        return self.x * self.x + self.y * self.y

    def height_bits(self) -> int:
        """The length of the longest of the integers that it is made of."""
        return max(int(self.x.height_bits()), int(self.y.height_bits()))

    def __complex__(self) -> complex:
        return complex(float(self.x), float(self.y))

    def is_real(self) -> bool:
        """True if the imaginary part is zero."""
        return bool(self.y == 0)

    def __str__(self) -> str:
        if self.is_real():
            return _short(self.re)
        sign = "-" if self.im < 0 else "+"
        return f"{_short(self.re)} {sign} {_short(abs(self.im))}i"

    def __repr__(self) -> str:
        return f"ExactPoint({self})"


_set_x, _set_y = (ExactPoint.__dict__[part].__set__ for part in "xy")
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


def as_point(value: Any, name: str) -> ExactPoint:
    """The exact point that `value` stands for: an `ExactPoint`, or whatever `numbers.exact` takes; raises as that.

    >>> as_point("0.1", "x"), as_point(1 + 2j, "x")
    (ExactPoint(1/10), ExactPoint(1 + 2i))
    """
    return value if isinstance(value, ExactPoint) else ExactPoint(*exact(value, name))


def to_acb(point: ExactPoint) -> acb:
    """A ball around the point at the working precision in force (exact where the precision allows)."""
    return acb(point.x) if point.y == 0 else acb(arb(point.x), arb(point.y))


def to_double(point: ExactPoint) -> complex:
    """The nearest complex double, infinite where it is out of range."""
    try:
        return complex(point)
    except OverflowError:
        return complex(math.inf)


def midpoint(ball: acb) -> ExactPoint:
    """The midpoint of a finite ball."""
    return ExactPoint(*(_exact(part.mid()) for part in (ball.real, ball.imag)))


def are_real(values: Iterable[Any]) -> bool:
    """True if the imaginary part of every ball is exactly zero: then all numbers in them are proven to be real.

    Realness is a property of such data, and nothing else decides it.  Where the values of a function on a real ball are real,
    the function is real on that interval, and by the identity theorem wherever it is analytic on the real axis around it.
    """
    return all(value.imag.is_zero() for value in values)


def around_zero(radius: arb, *, real: bool) -> acb:
    """The ball of all errors up to this radius; of the real ones only, if `real`."""
    error = arb(0, radius)
    return acb(error) if real else acb(error, error)


def _exact(number: arb) -> Any:
    mantissa, exponent = number.man_exp()
    return fmpq(mantissa) * power_of_two(int(exponent))

"""Exact points of the complex plane: Gaussian rationals, read from every kind of number.

Others are known by balls: constants such as sqrt(2) and pi to every precision, and the users' own balls.  SymPy
expressions of numbers, and of numbers and x, are computed by FLINT's balls, operation by operation, without SymPy's own
numerical evaluation, whose digits aren't proven.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from functools import lru_cache, wraps
from typing import Any, ClassVar, ParamSpec, TypeVar

from flint import acb, arb, ctx, fmpq

from kovacic.algebra.rationals import to_fmpq, to_fraction
from kovacic.errors import InputError
from kovacic.numbers.exact import exact
from kovacic.numbers.numerals import plain_text

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
            assert not keywords  # they would make two keys of one call
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
    fixed: ClassVar[bool] = False  # known to every precision, unlike a `Constant` that is a user's ball

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
        # floor(x/unit + 1/2): a point in the middle goes to the larger multiple.
        unit = power_of_two(e)
        return ExactPoint(*((part / unit + _HALF).floor() * unit for part in (self.x, self.y)))

    def norm_squared(self) -> Any:
        """|z|^2, exactly."""
        return self.x * self.x + self.y * self.y

    def height_bits(self) -> int:
        """The length of the longest integer in it."""
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


Points = Sequence[ExactPoint]
# The class is frozen and has slots: these descriptors fill them.
_set_x, _set_y = (ExactPoint.__dict__[part].__set__ for part in "xy")
_HALF = fmpq(1, 2)


@lru_cache(maxsize=1024)
def power_of_two(e: int) -> Any:
    """2^e, FLINT's rational."""
    return fmpq(1 << e) if e >= 0 else fmpq(1, 1 << -e)


def binary_exponent(value: Any) -> int:
    """An integer e with 2^(e - 1) < value < 2^(e + 1), for a positive rational number of FLINT's."""
    return int(value.p.bit_length() - value.q.bit_length())


def root_below(square: Any, bits: int) -> Any:
    """The root rounded down to about `bits` bits: floor(2^(bits - k) root) 2^(k - bits), where 2^k is about the root."""
    # 2^(2k - 1) < square < 2^(2k + 2) for k = binary_exponent(square) // 2: the integer has up to bits + 1 bits.
    grain = binary_exponent(square) // 2 - bits
    return fmpq((square / power_of_two(2 * grain)).floor().isqrt()) * power_of_two(grain)


def _short(value: Fraction) -> str:
    """The exact value in at most 24 characters, else 15 digits."""
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


def middle(number: Number) -> ExactPoint:
    """The point, or the midpoint of its ball."""
    return number if isinstance(number, ExactPoint) else number.point()


def midpoint(ball: acb) -> ExactPoint:
    """The midpoint of a finite ball."""
    return ExactPoint(ball.real.mid().fmpq(), ball.imag.mid().fmpq())


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


@dataclass(frozen=True)
class Constant:
    """A number in a ball: `value()` at the working precision in force, or always the same if `fixed`."""

    text: str
    value: Callable[[], acb]
    fixed: bool = False

    def point(self) -> ExactPoint:
        """The midpoint, an exact point."""
        ball = self.value()
        if not ball.is_finite():
            raise InputError(f"{self.text} isn't a finite number")
        return midpoint(ball)

    def __str__(self) -> str:
        return self.text


Number = ExactPoint | Constant


def as_number(value: Any, name: str) -> Number:
    """The exact point, or the number known by balls, that `value` stands for.

    Beside what `as_point` accepts: balls (ours, python-flint's arb and acb, mpmath's intervals), SymPy constants and text
    such as "sqrt(2)" or "1 + 2*I".  Raises InputError for anything else (`name` says which argument it was).

    >>> print(as_number("1 + 2*I", "x"), as_number("sqrt(2)", "x"))
    1 + 2i sqrt(2)
    """
    if isinstance(value, ExactPoint | Constant):
        return value
    fixed = _given_ball(value)
    if fixed is not None:
        if not fixed.is_finite():
            raise InputError(f"{name} isn't a finite ball: {value}")
        # An exact ball is a point, known to every precision.
        return midpoint(fixed) if fixed.is_exact() else Constant(str(value), lambda: fixed, True)
    try:
        return as_point(value, name)
    except InputError:
        if (found := _symbolic(value, name)) is None:
            raise
        return found


def _symbolic(value: Any, name: str) -> Number | None:
    """The number that a SymPy expression or a text stands for; None for anything else."""
    expression = value
    if isinstance(value, str):
        from kovacic.reading.symbolic import read_expression

        expression = read_expression(value, names={}, what=name)
        # Such as "1/3 + I/2": a point, exactly.
        if expression.is_number and all(part.is_Rational for part in expression.expand().as_real_imag()):
            return as_point(expression.expand(), name)
    if not getattr(expression, "is_number", False) or getattr(expression, "is_finite", None) is False:
        return None
    number = Constant(plain_text(value), lambda: in_balls(expression, {}))
    number.value()  # raises for functions that aren't known
    return number


def _given_ball(value: Any) -> acb | None:
    """A ball of the user's: ours (without importing it), python-flint's or mpmath's; None for anything else."""
    if hasattr(value, "to_flint") and not value.is_exact():
        return acb(value.to_flint())
    if isinstance(value, arb | acb):
        return acb(value)
    # mpmath's intervals, complex and real ones.
    intervals = getattr(value, "_mpci_", None) or ([value._mpi_] if hasattr(value, "_mpi_") else None)
    return None if intervals is None else acb(*map(_ball_of_interval, intervals))


def _ball_of_interval(interval: Any) -> arb:
    """The ball with the ends of an mpmath interval, (sign, mantissa, exponent, bits) each."""
    # In mpmath zero has the exponent 0, and infinity another one, both without a mantissa.
    if any(not mantissa and exponent for _, mantissa, exponent, _ in interval):
        raise InputError("an interval isn't finite")
    e = min(exponent for _, _, exponent, _ in interval)
    # Both ends over 2^-e; the midpoint (low + high)/2 and the radius (high - low)/2 are exact.
    low, high = ((-1) ** sign * (int(mantissa) << (exponent - e)) for sign, mantissa, exponent, _ in interval)
    return arb((low + high, e - 1), (high - low, e - 1))


def to_ball(number: Number) -> acb:
    """The ball of the working precision in force."""
    return to_acb(number) if isinstance(number, ExactPoint) else number.value()


def in_balls(expression: Any, values: Mapping[Any, Any]) -> acb:
    """A SymPy expression at these values of its symbols, at the working precision in force.

    Values may be power series, too: then the result is one, or a ball where it is a number.  Raises InputError for functions
    that aren't known here.
    """
    from kovacic.closed_form.jets import BallEvaluator  # imports SymPy

    value: acb = BallEvaluator(values)(expression)
    return value

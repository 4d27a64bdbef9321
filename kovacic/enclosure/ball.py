"""Balls: complex or real numbers known up to a proven error.

The guarantee: the exact value lies within `radius` of the midpoint (a disc in the complex plane, an interval when
`real` is true).  Midpoint and radius are dyadic rationals m 2^e kept as pairs of integers, so a ball is immutable,
hashable, comparable, picklable, and as precise as the computation that made it.

Not guaranteed: that the radius is the smallest possible one, and that two different balls stand for different numbers
(`overlaps` answers whether they can be equal).

Reference: J. van der Hoeven, "Ball arithmetic", in: Logical Approaches to Barriers in Computing and Complexity (2010).
F. Johansson, "Arb: efficient arbitrary-precision midpoint-radius interval arithmetic", IEEE Trans. Comp. 66 (2017).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from flint import acb, arb

Dyadic = tuple[int, int]
"""A dyadic rational (m, e), the number m 2^e; m is odd, or (0, 0) stands for zero."""

_FRACTION_BITS = 10_000_000
"""Largest |exponent| that is written out as a fraction: 2^(10^12) would fill the memory."""


def dyadic(mantissa: int, exponent: int) -> Dyadic:
    """The pair (m, e) with m odd that stands for mantissa * 2^exponent.

    >>> dyadic(12, -3), dyadic(0, 5)
    ((3, -1), (0, 0))
    """
    if mantissa == 0:
        return (0, 0)
    shift = (mantissa & -mantissa).bit_length() - 1
    return (mantissa >> shift, exponent + shift)


def _to_float(number: Dyadic) -> float:
    """The double nearest to m 2^e (ties to even; results below 2^-1022 may be rounded twice)."""
    mantissa, exponent = number
    excess = abs(mantissa).bit_length() - 70
    if excess > 0:
        sticky = (abs(mantissa) & ((1 << excess) - 1)) != 0
        kept = (abs(mantissa) >> excess) | int(sticky)
        mantissa, exponent = (kept if mantissa > 0 else -kept), exponent + excess
    return math.ldexp(float(mantissa), exponent)


def _to_fraction(number: Dyadic) -> Fraction:
    mantissa, exponent = number
    if abs(exponent) > _FRACTION_BITS:
        raise OverflowError(f"a number near 2^{exponent} isn't written out as a fraction")
    return Fraction(mantissa << exponent) if exponent >= 0 else Fraction(mantissa, 1 << -exponent)


def _log10(number: Dyadic) -> float:
    mantissa, exponent = number
    size = abs(mantissa).bit_length()
    top = abs(mantissa) >> max(0, size - 60)
    return (math.log2(top) + max(0, size - 60) + exponent) * math.log10(2)


@dataclass(frozen=True, slots=True)
class Ball:
    """A number known up to a proven error: the exact value z satisfies |z - midpoint| <= radius.

    `re`, `im`, `rad` are dyadic rationals (m, e), m 2^e; `real` says that the exact value is certainly real.  A ball
    whose radius isn't finite (nothing is known) doesn't exist: what would make one raises.

    >>> b = Ball.exact(3, -1)
    >>> float(b), complex(b), b.radius
    (1.5, (1.5+0j), 0.0)
    >>> b.contains(1.5), b.contains(1)
    (True, False)
    """

    re: Dyadic
    im: Dyadic = (0, 0)
    rad: Dyadic = (0, 0)
    real: bool = True

    @classmethod
    def exact(cls, mantissa: int, exponent: int = 0) -> Ball:
        """The exact real number mantissa * 2^exponent."""
        return cls(dyadic(mantissa, exponent))

    @property
    def radius(self) -> float:
        """An upper bound of the radius as a double (inf beyond their range); `rad` is the radius itself."""
        try:
            value = _to_float(self.rad)
        except OverflowError:
            return math.inf
        return value if _to_fraction_cheap(self.rad, value) else math.nextafter(value, math.inf)

    @property
    def mid(self) -> complex:
        """The midpoint as the nearest complex double; raises OverflowError beyond 1.8e308."""
        return complex(_to_float(self.re), _to_float(self.im))

    @property
    def midpoint(self) -> tuple[Fraction, Fraction]:
        """Real and imaginary part of the midpoint, exactly."""
        return _to_fraction(self.re), _to_fraction(self.im)

    def is_exact(self) -> bool:
        """True if the radius is zero."""
        return self.rad[0] == 0

    def contains_zero(self) -> bool:
        """True if the exact value may be zero."""
        return _contains_zero(self)

    def contains(self, number: object) -> bool:
        """True if the number (int, Fraction, float, complex, Decimal, decimal text, mpmath or SymPy rational) lies in
        the ball.

        A Ball is accepted as well: True if it lies in this one as a whole.
        """
        from kovacic.enclosure.points import as_point

        if isinstance(number, Ball):
            x, y, inner = _to_fraction(number.re), _to_fraction(number.im), _to_fraction(number.rad)
        else:
            point = as_point(number, "the number")
            x, y, inner = point.re, point.im, Fraction(0)
        slack = _to_fraction(self.rad) - inner
        dx, dy = x - _to_fraction(self.re), y - _to_fraction(self.im)
        return slack >= 0 and dx * dx + dy * dy <= slack * slack

    def overlaps(self, other: Ball) -> bool:
        """True if the two exact values can be equal; False proves that they differ."""
        dx = _to_fraction(self.re) - _to_fraction(other.re)
        dy = _to_fraction(self.im) - _to_fraction(other.im)
        reach = _to_fraction(self.rad) + _to_fraction(other.rad)
        return dx * dx + dy * dy <= reach * reach

    @property
    def digits(self) -> float:
        """Correct decimal digits, -log10(radius / |midpoint|): inf for an exact ball, 0 or less where nothing is known.

        >>> Ball((1, 0), rad=(1, -10)).digits > 3
        True
        """
        if self.rad[0] == 0:
            return math.inf
        sizes = [_log10(part) for part in (self.re, self.im) if part[0] != 0]
        if not sizes:
            return -math.inf
        return max(sizes) - _log10(self.rad)

    def __float__(self) -> float:
        if not self.real:
            raise TypeError("the ball isn't known to be real: use complex(), or .mid")
        return _to_float(self.re)

    def __complex__(self) -> complex:
        return self.mid

    def to_mpmath(self) -> Any:
        """The midpoint as an mpmath number, exactly (mpf where `real`, else mpc)."""
        import mpmath

        parts = [mpmath.mp.make_mpf(mpmath.libmp.from_man_exp(m, e)) for m, e in (self.re, self.im)]
        return parts[0] if self.real else mpmath.mpc(*parts)

    def __str__(self) -> str:
        from flint import arb, ctx

        shown = 3 if self.digits == -math.inf else max(3, min(int(min(self.digits, 1e6)) + 2, 40))
        with ctx.workprec(int(shown * 3.33) + 40):
            text = _decimal(arb(self.re), shown)
            if not self.real:
                imaginary = _decimal(arb(self.im), shown)
                text = f"({text} {'-' if imaginary.startswith('-') else '+'} {imaginary.lstrip('-')}j)"
            if self.rad[0] == 0:
                return text
            return f"{text} ± {_decimal(arb(self.rad) * arb(1 + 2.0**-7), 2)}"

    def __repr__(self) -> str:
        return f"<Ball {self}>"


def _decimal(value: arb, digits: int) -> str:
    text: str = value.mid().str(digits, radius=False)
    return text


def _to_fraction_cheap(number: Dyadic, value: float) -> bool:
    """True if the double `value` is certainly not below m 2^e."""
    mantissa, exponent = number
    if mantissa == 0:
        return True
    if abs(mantissa).bit_length() <= 53 and value != 0.0:
        return True
    return abs(exponent) < _FRACTION_BITS and Fraction(value) >= _to_fraction(number)


def _contains_zero(ball: Ball) -> bool:
    if ball.rad[0] == 0:
        return ball.re[0] == 0 and ball.im[0] == 0
    x, y, r = _to_fraction(ball.re), _to_fraction(ball.im), _to_fraction(ball.rad)
    return x * x + y * y <= r * r


def ball_from_flint(value: acb | arb) -> Ball | None:
    """The ball around a flint ball (a disc around the rectangle of an acb); None where nothing is known (not
    finite)."""
    from flint import acb, arb, ctx

    if isinstance(value, arb):
        value = acb(value)
    if not value.is_finite():
        return None
    real_part, imag_part = value.real, value.imag
    real = imag_part.is_zero()
    with ctx.workprec(60):
        if real:
            rad = real_part.rad()
        elif real_part.rad().is_zero() or imag_part.rad().is_zero():
            rad = real_part.rad() + imag_part.rad()
        else:
            rad = (real_part.rad() * real_part.rad() + imag_part.rad() * imag_part.rad()).sqrt().upper()
        rad = rad.upper()
    return Ball(_man_exp(real_part.mid()), _man_exp(imag_part.mid()), _man_exp(rad), bool(real))


def _man_exp(value: arb) -> Dyadic:
    mantissa, exponent = value.man_exp()
    return dyadic(int(mantissa), int(exponent))


def ball_to_flint(ball: Ball) -> acb:
    """The flint ball that contains `ball` (a square around the disc), exactly in its midpoint."""
    from flint import acb, arb

    if ball.real:
        return acb(arb(ball.re, ball.rad))
    return acb(arb(ball.re, ball.rad), arb(ball.im, ball.rad))

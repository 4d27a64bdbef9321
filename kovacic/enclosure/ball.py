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
from typing import Any

from flint import acb, arb

from kovacic.enclosure.points import Point, as_point
from kovacic.enclosure.working import working_precision

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
    """The double nearest to m 2^e; raises OverflowError beyond their range."""
    value = float(arb(number))
    if math.isinf(value):
        raise OverflowError("a number beyond the range of doubles")
    return value


def _to_fraction(number: Dyadic) -> Fraction:
    mantissa, exponent = number
    if abs(exponent) > _FRACTION_BITS:
        raise OverflowError(f"a number near 2^{exponent} isn't written out as a fraction")
    return Fraction(mantissa) * Fraction(2) ** exponent


def _log10(number: Dyadic) -> float:
    return (math.log2(abs(number[0])) + number[1]) * math.log10(2)


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
        value = float(arb(self.rad))
        return value if arb(value) >= arb(self.rad) else math.nextafter(value, math.inf)

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
        return self.overlaps(Ball.exact(0))

    def contains(self, number: object) -> bool:
        """True if the number (int, Fraction, float, complex, Decimal, decimal text, mpmath or SymPy rational) lies in
        the ball.

        A Ball is accepted as well: True if it lies in this one as a whole.
        """
        if isinstance(number, Ball):
            return _reaches(self, number, -1)
        point, (re, im) = as_point(number, "the number"), self.midpoint
        return (point - Point(re, im)).norm_squared() <= _to_fraction(self.rad) ** 2

    def overlaps(self, other: Ball) -> bool:
        """True if the two exact values can be equal; False proves that they differ."""
        return _reaches(self, other, 1)

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
        shown = 3 if self.digits == -math.inf else max(3, min(int(min(self.digits, 1e6)) + 2, 40))
        with working_precision(int(shown * 3.33) + 40):
            text, imaginary = (arb(part).str(shown, radius=False) for part in (self.re, self.im))
            if not self.real:
                text = f"({text} {'-' if imaginary.startswith('-') else '+'} {imaginary.lstrip('-')}j)"
            radius = (arb(self.rad) * arb(1 + 2.0**-7)).mid().str(2, radius=False)
            return text if self.rad[0] == 0 else f"{text} ± {radius}"

    def __repr__(self) -> str:
        return f"<Ball {self}>"


def _reaches(a: Ball, b: Ball, sign: int) -> bool:
    """True if the distance of the midpoints is at most the radius of a plus `sign` times that of b, decided exactly.

    First with a few hundred bits, which tell where the exponents are too far apart for fractions.
    """
    with working_precision(256):
        reach = arb(a.rad) + sign * arb(b.rad)
        distance = (arb(a.re) - arb(b.re)) ** 2 + (arb(a.im) - arb(b.im)) ** 2
        if reach < 0 or distance > reach * reach:
            return False
        if reach >= 0 and distance <= reach * reach:
            return True
    rest = _to_fraction(a.rad) + sign * _to_fraction(b.rad)
    step = [_to_fraction(x) - _to_fraction(y) for x, y in ((a.re, b.re), (a.im, b.im))]
    return rest >= 0 and step[0] ** 2 + step[1] ** 2 <= rest**2


def ball_from_flint(value: acb | arb) -> Ball | None:
    """The ball around a flint ball (a disc around the rectangle of an acb); None where nothing is known (not finite)."""
    value = acb(value)
    if not value.is_finite():
        return None
    real_part, imag_part = value.real, value.imag
    real = imag_part.is_zero()
    with working_precision(60):
        a, b = real_part.rad(), imag_part.rad()
        rad = (a + b if a.is_zero() or b.is_zero() else (a * a + b * b).sqrt()).upper()
    return Ball(_man_exp(real_part.mid()), _man_exp(imag_part.mid()), _man_exp(rad), bool(real))


def _man_exp(value: arb) -> Dyadic:
    mantissa, exponent = value.man_exp()
    return dyadic(int(mantissa), int(exponent))


def ball_to_flint(ball: Ball) -> acb:
    """The flint ball that contains `ball` (a square around the disc), exactly in its midpoint."""
    if ball.real:
        return acb(arb(ball.re, ball.rad))
    return acb(arb(ball.re, ball.rad), arb(ball.im, ball.rad))

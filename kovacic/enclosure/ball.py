"""Balls: complex or real numbers known up to a proven error.

The guarantee: the exact value lies within `radius` of the midpoint (a disc in the complex plane, an interval when
`real` is true).  Midpoint and radius are dyadic rationals m 2^e kept as pairs of integers, so a ball is immutable,
hashable, comparable, picklable, and as precise as the computation that made it.

Not guaranteed: that the radius is the smallest possible one, and that two different balls stand for different numbers
(`overlaps` tells whether they can be equal).

Reference: J. van der Hoeven, "Ball arithmetic", in: Logical Approaches to Barriers in Computing and Complexity (2010).
F. Johansson, "Arb: efficient arbitrary-precision midpoint-radius interval arithmetic", IEEE Trans. Comp. 66 (2017).
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from decimal import Decimal
from fractions import Fraction
from operator import add, le, lt, mul, sub, truediv
from typing import Any, Literal

from flint import acb, arb, fmpz

from kovacic.algebra.precision import working_precision
from kovacic.algebra.rationals import to_fmpq
from kovacic.enclosure.points import ExactPoint, as_number, as_point, to_ball
from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import DEFAULT_LIMITS
from kovacic.numbers.exact import whole

Dyadic = tuple[int, int]  # a dyadic rational (m, e), the number m 2^e; m is odd, or (0, 0) stands for zero
_SHOWN_DIGITS = 40  # digits in the representation, and of exact numbers


def _to_float(number: Dyadic) -> float:
    """The double nearest to m 2^e; raises OverflowError beyond their range."""
    value = float(arb(number))
    if math.isinf(value):
        raise OverflowError("a number beyond the range of doubles")
    return value


def _above(number: arb) -> float:
    """The double at or next above an exact number."""
    value = float(number)
    # float() rounds to nearest; both numbers are exact, and so is their comparison.
    return value if arb(value) >= number else math.nextafter(value, math.inf)


def _check_exponent(exponent: int) -> None:
    # A number such as 2^(10^12) would fill the memory.
    if abs(exponent) > DEFAULT_LIMITS.bits:
        raise OverflowError(f"a number near 2^{exponent} isn't written out")


def _to_fraction(number: Dyadic) -> Fraction:
    mantissa, exponent = number
    _check_exponent(exponent)
    return Fraction(mantissa) * Fraction(2) ** exponent


def _operator(compute: Callable[[acb, acb], acb]) -> Callable[[Ball, object], Ball]:
    return lambda ball, other: ball._combined(other, compute)


@dataclass(frozen=True, slots=True)
class Route:
    """How a value was computed.

    Attributes
    ----------
    digits : int
        The number of digits that was requested.
    method : str
        "taylor" or "closed form".
    bits : int
        The working precision of the last run.
    runs : int
        The number of runs, each with a higher precision.
    """

    digits: int
    method: Literal["taylor", "closed form"]
    bits: int
    runs: int

    def __str__(self) -> str:
        way = "Taylor's method" if self.method == "taylor" else "a closed form"
        runs = "run" if self.runs == 1 else "runs"
        return f"{way}, {self.bits} bits, {self.runs} {runs}"


@dataclass(frozen=True, slots=True)
class Ball:
    """A number known up to a proven error: the exact value z satisfies |z - midpoint| <= radius.

    The radius is always finite: an operation that would leave nothing known raises.  Balls are immutable and hashable, with
    `+ - * / **` and comparisons that return True, False, or None if neither is certain.  `str` has all known digits and a
    radius that covers the rounding; `format` takes the formats of a Decimal.

    Attributes
    ----------
    re, im, rad : pair of int
        Midpoint and radius, dyadic rationals (m, e), m 2^e.
    real : bool
        True if the exact value is certainly real.
    route : Route or None
        How a value of a solution was computed; None for other balls.

    Examples
    --------
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
    route: Route | None = field(default=None, compare=False)

    @classmethod
    def exact(cls, mantissa: int, exponent: int = 0) -> Ball:
        """The exact real number mantissa * 2^exponent.

        Parameters
        ----------
        mantissa, exponent : int
            Any integers.

        Examples
        --------
        >>> float(Ball.exact(3, -2))
        0.75
        """
        m = whole(mantissa, "the mantissa", least=None)
        e = whole(exponent, "the exponent", least=None)
        return cls(_as_dyadic(arb((m, e))))

    @classmethod
    def of(cls, value: object) -> Ball:
        """The ball of a number; a ball is returned unchanged.

        Parameters
        ----------
        value : number
            A number or a ball of any kind that `kovacic.evaluate` takes; constants such as "pi" are taken to 100 digits.

        Raises
        ------
        InputError
            For anything but a finite number.

        Examples
        --------
        >>> Ball.of("1/3").contains("0.3333333333"), Ball.of("1/3").contains("1/3")
        (False, True)
        >>> Ball.of(0.5).is_exact(), Ball.of("pi").digits > 100, Ball.of(Ball.exact(2)) == Ball.exact(2)
        (True, True, True)
        """
        number = as_number(value, "the number")
        # Constants to 100 digits and some more; a long integer exactly.
        with working_precision(400 + (number.height_bits() if isinstance(number, ExactPoint) else 0)):
            found = ball_from_flint(to_ball(number))
        if found is None:
            raise InputError(f"{value} isn't finite")
        return found

    @property
    def radius(self) -> float:
        """An upper bound of the radius as a double (inf beyond their range); `rad` is the radius itself."""
        return _above(arb(self.rad))

    @property
    def mid(self) -> complex:
        """The midpoint as the nearest complex double; raises OverflowError beyond 1.8e308."""
        return complex(_to_float(self.re), _to_float(self.im))

    @property
    def midpoint(self) -> tuple[Fraction, Fraction]:
        """Real and imaginary part of the midpoint, exactly."""
        return _to_fraction(self.re), _to_fraction(self.im)

    def is_exact(self) -> bool:
        """True if the radius is zero.

        Examples
        --------
        >>> Ball.of("1/2").is_exact(), Ball.of("1/3").is_exact()
        (True, False)
        """
        return self.rad[0] == 0

    def contains_zero(self) -> bool:
        """True if the exact value may be zero; False proves that it isn't.

        Examples
        --------
        >>> Ball.of("pi").contains_zero(), (Ball.of("pi") - Ball.of("pi")).contains_zero()
        (False, True)
        """
        return self.overlaps(Ball.exact(0))

    def contains(self, number: object) -> bool:
        """True if the number is proven to lie in the ball.

        Parameters
        ----------
        number : number or Ball
            int, Fraction, float, complex, Decimal, decimal text, mpmath or SymPy rational; or a ball, all of it.

        Examples
        --------
        >>> Ball.of("pi").contains(3), Ball.exact(1).contains("1.0"), Ball.of("pi").contains(Ball.of("pi"))
        (False, True, True)
        """
        if isinstance(number, Ball):
            return _reaches(self, number, -1)
        point = as_point(number, "the number")
        return bool((point - ExactPoint(*self.midpoint)).norm_squared() <= to_fmpq(_to_fraction(self.rad) ** 2))

    def overlaps(self, other: object) -> bool:
        """True if the two exact values may be equal; False proves that they differ.

        Parameters
        ----------
        other : number or Ball
            The other value.

        Examples
        --------
        >>> Ball.of("pi").overlaps("22/7"), Ball.of("sqrt(2)").overlaps(Ball.of("2^(1/2)"))
        (False, True)
        """
        return _reaches(self, _as_ball(other), 1)

    @property
    def digits(self) -> float:
        """Correct decimal digits, -log10(radius / |midpoint|); inf for an exact ball, 0 or less if none is known.

        >>> Ball((1, 0), rad=(1, -10)).digits > 3
        True
        """
        if self.is_exact():
            return math.inf
        with working_precision(64):
            share = abs(arb(self.re)).max(abs(arb(self.im))) / arb(self.rad)
            return float(share.log() / arb(10).log()) if share > 0 else -math.inf

    def __float__(self) -> float:
        if not self.real:
            raise TypeError("the ball isn't known to be real: use complex(), or .mid")
        return _to_float(self.re)

    def __complex__(self) -> complex:
        return self.mid

    def to_mpmath(self) -> Any:
        """The exact midpoint as an mpmath number, mpf if `real`, else mpc.

        Examples
        --------
        >>> print(Ball.of("1/4").to_mpmath(), Ball.of("1 + I").to_mpmath())
        0.25 (1.0 + 1.0j)
        """
        import mpmath

        parts = [mpmath.mp.make_mpf(mpmath.libmp.from_man_exp(m, e)) for m, e in (self.re, self.im)]
        return parts[0] if self.real else mpmath.mpc(*parts)

    def to_interval(self) -> Any:
        """An mpmath interval, real or complex, at mpmath's working precision, that contains the ball.

        Examples
        --------
        >>> 2 in Ball.of("sqrt(2)").to_interval() ** 2
        True
        """
        import mpmath

        def interval(middle: Dyadic) -> Any:
            ends = map(_as_dyadic, _ends(middle, self.rad))
            return mpmath.iv.make_mpf(tuple(mpmath.libmp.from_man_exp(m, e) for m, e in ends))

        return interval(self.re) if self.real else mpmath.iv.mpc(interval(self.re), interval(self.im))

    def to_flint(self) -> arb | acb:
        """The ball as python-flint's: arb if `real`, else an acb that contains it; the radius may be larger by its rounding.

        Examples
        --------
        >>> type(Ball.of("1/3").to_flint()).__name__, type(Ball.of("I").to_flint()).__name__
        ('arb', 'acb')
        """
        value = ball_to_flint(self)
        return value.real if self.real else value

    def to_dict(self) -> dict[str, str]:
        """A disc in which the exact value lies, as decimal text: "re" and "im" of its midpoint, and "radius".

        The midpoint is rounded to some digits more than are known, and the radius covers the rounding.
        `kovacic evaluate --json` prints it.

        Examples
        --------
        >>> Ball((3, -1), rad=(1, -30)).to_dict()
        {'re': '1.500000000000', 'im': '0', 'radius': '9.4e-10'}
        """
        return dict(zip(("re", "im", "radius"), self._decimal_disc(self._shown_digits(4)), strict=True))

    @property
    def lower(self) -> float:
        """The largest double that isn't above any number of a real ball."""
        return -(-self).upper

    @property
    def upper(self) -> float:
        """The smallest double that isn't below any number of a real ball."""
        self._demand_real()
        return _above(_ends(self.re, self.rad)[1])

    def _demand_real(self) -> None:
        if not self.real:
            raise TypeError("the ball isn't known to be real, and complex numbers have no order")

    def _combined(self, other: object, compute: Callable[[acb, acb], acb]) -> Ball:
        """The ball of `compute(self, other)`, with as many bits as the operands have, and 32 more."""
        try:
            second = _as_ball(other)
        except InputError:
            return NotImplemented  # type: ignore[no-any-return]
        # 32 bits more than the longer operand: results of short exact numbers are exact, or nearly so.
        bits = max(part[0].bit_length() for ball in (self, second) for part in (ball.re, ball.im))
        with working_precision(max(64, bits) + 32):
            found = ball_from_flint(compute(ball_to_flint(self), ball_to_flint(second)))
        if found is None:
            raise ZeroDivisionError("nothing is known about the result: an operand may be zero")
        return found

    def __neg__(self) -> Ball:
        return Ball((-self.re[0], self.re[1]), (-self.im[0], self.im[1]), self.rad, self.real)

    def __abs__(self) -> Ball:
        return self._combined(0, lambda z, _: acb(abs(z)))

    __add__ = __radd__ = _operator(add)
    __sub__ = _operator(sub)
    __rsub__ = _operator(lambda x, y: y - x)
    __mul__ = __rmul__ = _operator(mul)
    __truediv__ = _operator(truediv)
    __rtruediv__ = _operator(lambda x, y: y / x)

    def __pow__(self, other: object) -> Ball:
        """Principal powers; integer powers of any ball."""
        return self._combined(other, lambda x, y: x ** (other if isinstance(other, int) else y))

    def __lt__(self, other: object) -> bool | None:
        """True or False if that is certain for all numbers of the balls, else None; likewise <=, > and >=."""
        return self._compared(other, lt)

    def __le__(self, other: object) -> bool | None:
        return self._compared(other, le)

    def __ge__(self, other: object) -> bool | None:
        return _as_ball(other)._compared(self, le)

    def __gt__(self, other: object) -> bool | None:
        return _as_ball(other)._compared(self, lt)

    def _compared(self, other: object, relation: Callable[[arb, arb], bool]) -> bool | None:
        second = _as_ball(other)
        self._demand_real()
        second._demand_real()
        low, high = _ends(self.re, self.rad)
        other_low, other_high = _ends(second.re, second.rad)
        # Ends are exact, and so are these comparisons: certain for all numbers, or for none.
        if relation(high, other_low):
            return True
        return None if relation(low, other_high) else False

    def equals(self, other: object) -> bool | None:
        """True if the exact value is certainly this number.

        Parameters
        ----------
        other : number or Ball
            The other value.

        Returns
        -------
        bool or None
            False if the balls are apart, True if both are exact and the same, else None.

        Examples
        --------
        >>> Ball.exact(1, -1).equals("1/2"), Ball.of("pi").equals(3), Ball.of("pi").equals("pi")
        (True, False, None)
        """
        second = _as_ball(other)
        if not self.overlaps(second):
            return False
        return True if self.is_exact() and second.is_exact() else None

    def __format__(self, spec: str) -> str:
        """The midpoint in the format of a Decimal (".30f"), real and imaginary part; without a format as `str`."""
        return self._as_number(*(format(_decimal(part), spec) for part in (self.re, self.im))) if spec else str(self)

    def __str__(self) -> str:
        """All known digits and a radius that covers the rounding; 40 digits of an exact number."""
        re, im, radius = self._decimal_disc(self._shown_digits(2))
        middle = self._as_number(re, im)
        return middle if radius == "0" else f"{middle} ± {radius}"

    def __repr__(self) -> str:
        """The first digits, and the radius of the ball itself."""
        if self.is_exact() or self.digits + 2 <= _SHOWN_DIGITS:
            return f"<Ball {self}>"
        re, im, _ = self._decimal_disc(_SHOWN_DIGITS)
        return f"<Ball {self._as_number(re, im)}... ± {_rounded_up(arb(self.rad))}>"

    def _repr_latex_(self) -> str:
        text = str(self).replace("±", r"\pm").replace("j", r"\,i")
        return "$" + re.sub(r"e([+-]?\d+)", lambda power: rf" \cdot 10^{{{int(power[1])}}}", text) + "$"

    def _as_number(self, re: str, im: str) -> str:
        if self.real:
            return re
        sign = "-" if im.startswith("-") else "+"
        return f"({re} {sign} {im.lstrip('-')}j)"

    def _shown_digits(self, more: int) -> int:
        """The known digits and `more`, three at least; 40 of an exact number."""
        return _SHOWN_DIGITS if self.is_exact() else int(max(3.0, self.digits + more))

    def _decimal_disc(self, digits: int) -> tuple[str, str, str]:
        """A disc around this one in decimals: its midpoint to this number of digits, and a radius that covers the error."""
        with working_precision(int(digits * 3.33) + 100):
            re, im = (arb(part).str(digits, radius=False) for part in (self.re, self.im))
            # Reading the decimals back shows the rounding error.
            radius = arb(self.rad) + abs(arb(re) - arb(self.re)) + abs(arb(im) - arb(self.im))
            return re, im, _rounded_up(radius.upper())


def _as_ball(number: object) -> Ball:
    return number if isinstance(number, Ball) else Ball.of(number)


def _rounded_up(radius: arb) -> str:
    """The smallest decimal number of two digits that isn't below this one."""
    # A percent of it is at most a unit of the second digit, so that none is left out.
    nearby: list[str] = [(radius * (100 + k) / 100).str(2, radius=False) for k in range(12)]
    return next(text for text in nearby if arb(text).lower() >= radius)


def _ends(middle: Dyadic, rad: Dyadic) -> tuple[arb, arb]:
    """middle - rad and middle + rad, exactly, or rounded outwards if their exponents are extremely far apart."""
    with working_precision(4 * DEFAULT_LIMITS.bits):
        return (arb(middle) - arb(rad)).lower(), (arb(middle) + arb(rad)).upper()


def _decimal(number: Dyadic) -> Decimal:
    """The exact decimal number."""
    mantissa, exponent = number
    _check_exponent(exponent)
    # m 2^e = (m 5^-e) 10^e for negative e; FLINT writes integers of any length.
    scaled = fmpz(mantissa) * (fmpz(5) ** -exponent if exponent < 0 else fmpz(2) ** exponent)
    return Decimal(f"{scaled}e{min(exponent, 0)}")


def _reaches(a: Ball, b: Ball, sign: int) -> bool:
    """True if the distance of the midpoints is at most the radius of a plus `sign` times that of b, decided exactly."""
    with working_precision(4 * DEFAULT_LIMITS.bits):  # exact, unless the exponents are huge
        reach = arb(a.rad) + sign * arb(b.rad)
        distance = (arb(a.re) - arb(b.re)) ** 2 + (arb(a.im) - arb(b.im)) ** 2
        if reach < 0 or distance > reach * reach:
            return False
        if reach >= 0 and distance <= reach * reach:
            return True
    raise OverflowError("the balls can't be compared: their exponents are too far apart")


def ball_from_flint(value: acb | arb, route: Route | None = None) -> Ball | None:
    """The ball around a flint ball (a disc around the rectangle of an acb); None if nothing is known (not finite)."""
    if not value.is_finite():
        return None
    z = acb(value)
    a = z.real.rad()
    b = z.imag.rad()
    # The disc around a rectangle: its radius is half the diagonal, rounded up.
    with working_precision(60):
        half_diagonal = a + b if a.is_zero() or b.is_zero() else (a * a + b * b).sqrt()
        re, im, rad = map(_as_dyadic, (z.real.mid(), z.imag.mid(), half_diagonal.upper()))
    return Ball(re, im, rad, bool(z.imag.is_zero()), route)


def finite_ball(value: acb | arb, route: Route | None = None) -> Ball:
    """The ball around a finite flint ball; raises LimitExceeded where nothing is known."""
    ball = ball_from_flint(value, route)
    if ball is None:
        raise LimitExceeded("a value has no finite enclosure at this precision", limit="digits")
    return ball


def _as_dyadic(value: arb) -> Dyadic:
    """The pair (m, e) of an exact number."""
    mantissa, exponent = value.man_exp()  # odd, or (0, 0)
    return int(mantissa), int(exponent)


def ball_to_flint(ball: Ball) -> acb:
    """The flint ball that contains `ball` (a square around the disc), exactly in its midpoint."""
    if ball.real:
        return acb(arb(ball.re, ball.rad))
    return acb(arb(ball.re, ball.rad), arb(ball.im, ball.rad))

"""Double-double numbers hi + lo, good to about 100 bits, and complex numbers of them or of plain arrays.

One piece of code serves both arithmetics: its variable and its results are NumPy arrays of doubles, or `Pair`s of such arrays.
Constants are Pairs of floats; with an array they count as doubles, but for differences, which subtract both halves and so keep
their digits near a zero.

Nothing is proven here: the errors are those of the usual analyses (a few units of 2^-104 relative to the result of each
operation), if no product leaves the range of a double; `split` brings numbers to size 1 before they are squared.

- log(v): v = 2^e m with m in [sqrt(1/2), sqrt(2)), t the multiple of 1/64 next to m, s = (m - t)/(m + t), |s| < 0.006:
  log(v) = e log 2 + log t + 2 (s + s^3/3 + ... + s^13/13).
- angle(y, x): t the multiple of 1/64 next to arctan2, s = (y cos t - x sin t)/(x cos t + y sin t), |s| < 0.008:
  angle = t + s - s^3/3 + ... + s^13/13.

References: T. J. Dekker, "A floating-point technique for extending the available precision", Numer. Math. 18 (1971).
Y. Hida, X. Li and D. Bailey, "Algorithms for quad-double precision floating point arithmetic", ARITH 15 (2001).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from flint import acb, arb

from kovacic.algebra.precision import working_precision

#: Binary exponents up to here stay in the numbers: doubles have 1023, and products need room.
ROOM = 900


def two_sum(a: Any, b: Any) -> Pair:
    """a + b exactly."""
    # Knuth: t is the part of b that is in s; what a and b have lost are s - t and t.
    s = a + b
    t = s - a
    return Pair(s, (a - (s - t)) + (b - t))


def two_product(a: Any, b: Any) -> Pair:
    """a b exactly, unless it over- or underflows."""
    # Dekker: halves of 26 bits, whose products are exact.
    p = a * b
    x = (2.0**27 + 1) * a
    y = (2.0**27 + 1) * b
    ah = x - (x - a)
    bh = y - (y - b)
    al = a - ah
    bl = b - bh
    return Pair(p, ((ah * bh - p) + ah * bl + al * bh) + al * bl)


@dataclass(frozen=True, slots=True)
class Pair:
    """hi + lo, arrays or floats; an array as the other operand makes the result an array."""

    hi: Any
    lo: Any = 0.0
    __array_ufunc__: ClassVar[None] = None  # so that arrays leave operators to this class

    @classmethod
    def of(cls, value: arb) -> Pair:
        """The one next to the midpoint of a ball."""
        hi = float(value.mid())
        return cls(hi, float((value - arb(hi)).mid()))

    def __getitem__(self, index: Any) -> Pair:
        return Pair(self.hi[index], self.lo[index])

    def __add__(self, other: Any) -> Any:
        # The low half is below the last place of an array.
        if isinstance(other, np.ndarray):
            return other + self.hi
        s = two_sum(self.hi, other.hi)
        t = two_sum(self.lo, other.lo)
        s = two_sum(s.hi, s.lo + t.hi)
        return two_sum(s.hi, s.lo + t.lo)

    def __neg__(self) -> Pair:
        return Pair(-self.hi, -self.lo)

    def __sub__(self, other: Any) -> Any:
        return (self.hi - other) + self.lo if isinstance(other, np.ndarray) else self + -other

    def __rsub__(self, other: Any) -> Any:
        return (other - self.hi) - self.lo

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, np.ndarray):
            return other * self.hi
        p = two_product(self.hi, other.hi)
        return two_sum(p.hi, p.lo + (self.hi * other.lo + self.lo * other.hi))

    __radd__ = __add__
    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Any:
        if isinstance(other, np.ndarray):
            return self.hi / other
        # Long division: each quotient is that of the rest by doubles.
        q = self.hi / other.hi
        rest = self - other * Pair(q, 0.0 * q)
        c = rest.hi / other.hi
        rest -= other * Pair(c, 0.0 * c)
        q = two_sum(q, c)
        return two_sum(q.hi, q.lo + rest.hi / other.hi)


@dataclass(frozen=True, slots=True)
class Complex:
    """re + i im, of Pairs or arrays; im is None if it is 0."""

    re: Any
    im: Any = None

    @classmethod
    def of(cls, value: acb) -> Complex:
        """The number next to the midpoint of a ball; real, if the ball meets the real axis."""
        return cls(Pair.of(value.real), None if value.imag.contains(0) else Pair.of(value.imag))

    def ball(self) -> acb:
        """The number, of Pairs of floats, exactly."""
        return acb(*(arb(part.hi) + arb(part.lo) for part in (self.re, self.im or Pair(0.0))))

    def __add__(self, other: Complex) -> Complex:
        re = self.re + other.re
        if other.im is None:
            return Complex(re, self.im)
        if self.im is None:
            return Complex(re, other.im)
        return Complex(re, self.im + other.im)

    def __sub__(self, other: Complex) -> Complex:
        re = self.re - other.re
        if other.im is None:
            return Complex(re, self.im)
        if self.im is None:
            return Complex(re, -other.im)
        return Complex(re, self.im - other.im)

    def __mul__(self, other: Complex) -> Complex:
        if other.im is None:
            return self.each(lambda part: part * other.re)
        if self.im is None:
            return other.each(lambda part: self.re * part)
        return Complex(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)

    def each(self, function: Callable[[Any], Any]) -> Complex:
        """The function of both parts; of the real one where the other is 0."""
        return Complex(function(self.re), None if self.im is None else function(self.im))

    def conjugate(self) -> Complex:
        """re - i im."""
        return self if self.im is None else Complex(self.re, -self.im)

    def reciprocal(self) -> Complex:
        """1/self."""
        if self.im is None:
            return Complex(Pair(1.0) / self.re)
        # 1/z = conj(z)/|z|^2.
        square = self.re * self.re + self.im * self.im
        return Complex(self.re / square, -self.im / square)


def scaled(a: Any, e: Any) -> Any:
    """a 2^e, exactly; e is an array of integers."""
    return Pair(np.ldexp(a.hi, e), np.ldexp(a.lo, e)) if isinstance(a, Pair) else np.ldexp(a, e)


def split(z: Complex) -> tuple[Complex, Any]:
    """(z 2^-e, e), where 2^e is about |z|."""
    size = np.abs(double(z.re))
    if z.im is not None:
        size = np.maximum(size, np.abs(double(z.im)))
    _, e = np.frexp(size)
    return z.each(lambda part: scaled(part, -e)), e


def double(a: Any) -> Any:
    """The nearest doubles."""
    return a.hi + a.lo if isinstance(a, Pair) else a


def complex_array(z: Complex) -> Any:
    """The nearest doubles, complex unless z is real."""
    if z.im is None:
        return double(z.re)
    result = np.empty(np.broadcast_shapes(np.shape(z.re), np.shape(z.im)), dtype=complex)
    result.real = double(z.re)  # 1j times an infinite part would be NaN
    result.imag = double(z.im)
    return result


def absolute(a: Any) -> Any:
    """|a|."""
    if isinstance(a, np.ndarray):
        return np.abs(a)
    # The high half decides: the low one is smaller than its last place.
    sign = np.where(a.hi < 0, -1.0, 1.0)
    return Pair(sign * a.hi, sign * a.lo)


def horner(coefficients: Iterable[Any], x: Any) -> Any:
    """A polynomial (coefficients high to low) at x, of numbers of any kind here."""
    first, *rest = coefficients
    for c in rest:
        first = first * x + c
    return first


def folded(a: Pair) -> Pair:
    """The sum over the first axis."""
    while len(a.hi) > 1:
        # Halves are added, and an odd last one is kept.
        half = len(a.hi) // 2
        rest = a[2 * half :]
        a = a[:half] + a[half : 2 * half]
        a = Pair(np.concatenate([a.hi, rest.hi]), np.concatenate([a.lo, rest.lo])) if len(rest.hi) else a
    return a[0]


def halves(values: list[arb]) -> Any:
    """The high and low halves of the numbers next to the midpoints."""
    pairs = [Pair.of(v) for v in values]
    return np.array([[p.hi for p in pairs], [p.lo for p in pairs]])


with working_precision(160):
    LOG_2 = Pair.of(arb(2).log())
    _RECIPROCALS = tuple(Pair.of(arb(1) / (2 * k + 1)) for k in reversed(range(7)))
    _ALTERNATING = tuple(Pair.of(arb((-1) ** k) / (2 * k + 1)) for k in reversed(range(7)))
    _LOGARITHMS = Pair(*halves([(arb(max(k, 1)) / 64).log() for k in range(93)]))  # log(k/64), and 0 in place of log 0
    # Of k/64 from -202/64 to 202/64: all angles from -pi to pi, k = 0 at the index 202.
    _COSINES = Pair(*halves([(arb(k) / 64).cos() for k in range(-202, 203)]))
    _SINES = Pair(*halves([(arb(k) / 64).sin() for k in range(-202, 203)]))


def log(a: Any) -> Any:
    """log(a) for a > 0; -inf for 0."""
    if isinstance(a, np.ndarray):
        return np.log(a)
    zero = a.hi == 0
    m, e = np.frexp(np.where(zero, 1.0, a.hi))
    # m in [sqrt(1/2), sqrt(2)), so that the logarithm is small where the number is about 1.
    low = m < 0.7071067811865476
    m = np.where(low, 2 * m, m)
    # frexp gives m in [1/2, 1).
    e = np.where(low, e - 1, e)
    rest = np.ldexp(np.where(zero, 0.0, a.lo), -e)
    k = np.rint(64 * m)
    t = k / 64
    index = k.astype(np.int64)
    nothing = 0.0 * m
    table = Pair(_LOGARITHMS.hi[index], _LOGARITHMS.lo[index])
    s = (Pair(m - t, nothing) + Pair(rest, nothing)) / (two_sum(m, t) + Pair(rest, nothing))
    series = Pair(2 * s.hi, 2 * s.lo) * horner(_RECIPROCALS, s * s)
    total = LOG_2 * Pair(e.astype(float), nothing) + table + series
    return Pair(np.where(zero, -np.inf, total.hi), np.where(zero, 0.0, total.lo))


def angle(z: Complex) -> Any:
    """The argument in (-pi, pi], for numbers of moderate size; 0 at the origin."""
    if isinstance(z.re, np.ndarray):
        return np.arctan2(double(z.im), z.re)
    k = np.rint(64 * np.arctan2(z.im.hi, z.re.hi))
    index = k.astype(np.int64) + 202
    c, s = (Pair(part.hi[index], part.lo[index]) for part in (_COSINES, _SINES))
    # z exp(-i t), whose angle is small: its tangent is im/re.
    turned = z * Complex(c, -s)
    origin = turned.re.hi == 0
    tangent = turned.im / Pair(np.where(origin, 1.0, turned.re.hi), np.where(origin, 0.0, turned.re.lo))
    return Pair(k / 64, 0.0 * k) + tangent * horner(_ALTERNATING, tangent * tangent)

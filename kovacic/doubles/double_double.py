"""Double-double arithmetic on NumPy arrays: a number is an unevaluated sum hi + lo, good to about 100 bits.

Nothing is proven here: the errors are those of the usual analyses (a few units of 2^-104 relative to the result of each
operation), as long as no product leaves the range of a double; `scaled` brings numbers to size 1 before they are squared.

- log(v): v = 2^e m with m in [sqrt(1/2), sqrt(2)), t the multiple of 1/64 next to m, s = (m - t)/(m + t), |s| < 0.006:
  log(v) = e log 2 + log t + 2 (s + s^3/3 + ... + s^13/13).
- angle(y, x): t = arctan2 in double precision, corrected by (y cos t - x sin t)/(x cos t + y sin t); cos t and sin t by
  their Taylor series at the multiple of 1/32 next to t.

References: T. J. Dekker, "A floating-point technique for extending the available precision", Numer. Math. 18 (1971).
Y. Hida, X. Li and D. Bailey, "Algorithms for quad-double precision floating point arithmetic", ARITH 15 (2001).
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from typing import Any

import numpy as np
from flint import arb

from kovacic.enclosure.working import working_precision

Pair = tuple[Any, Any]
"""(hi, lo): arrays or floats."""

Complex = tuple[Pair, Pair]
"""Real and imaginary part."""

_SPLIT = 134217729.0  # 2^27 + 1
_WORKING_BITS = 160


def pair_of(value: arb) -> tuple[float, float]:
    """The double-double next to the midpoint of a ball."""
    hi = float(value.mid())
    return hi, float((value - arb(hi)).mid())


def two_sum(a: Any, b: Any) -> Pair:
    """a + b exactly."""
    s = a + b
    t = s - a
    return s, (a - (s - t)) + (b - t)


def two_product(a: Any, b: Any) -> Pair:
    """a b exactly, unless it over- or underflows."""
    p = a * b
    x, y = _SPLIT * a, _SPLIT * b
    ah, bh = x - (x - a), y - (y - b)
    al, bl = a - ah, b - bh
    return p, ((ah * bh - p) + ah * bl + al * bh) + al * bl


def add(a: Pair, b: Pair) -> Pair:
    """The sum of two pairs, accurate relative to the result (both halves are added exactly first)."""
    s, e = two_sum(a[0], b[0])
    t, f = two_sum(a[1], b[1])
    s, e = two_sum(s, e + t)
    return two_sum(s, e + f)


def negative(a: Pair) -> Pair:
    """-a."""
    return -a[0], -a[1]


def subtract(a: Pair, b: Pair) -> Pair:
    """The difference of two pairs."""
    return add(a, negative(b))


def multiply(a: Pair, b: Pair) -> Pair:
    """The product of two pairs."""
    p, e = two_product(a[0], b[0])
    return two_sum(p, e + (a[0] * b[1] + a[1] * b[0]))


def divide(a: Pair, b: Pair) -> Pair:
    """The quotient of two pairs, by one step of Newton's method and a correction."""
    q = a[0] / b[0]
    r = subtract(a, multiply(b, (q, 0.0 * q)))
    c = r[0] / b[0]
    r = subtract(r, multiply(b, (c, 0.0 * c)))
    q, c = two_sum(q, c)
    return two_sum(q, c + r[0] / b[0])


def square_root(a: Pair) -> Pair:
    """sqrt(a) for a > 0."""
    s = np.sqrt(a[0])
    rest = subtract(a, two_product(s, s))
    return two_sum(s, rest[0] / (2 * s))


def scaled(a: Pair, e: Any) -> Pair:
    """a 2^e, exactly; e is an array of integers."""
    return np.ldexp(a[0], e), np.ldexp(a[1], e)


def complex_add(a: Complex, b: Complex) -> Complex:
    """The sum of two complex numbers."""
    return add(a[0], b[0]), add(a[1], b[1])


def complex_multiply(a: Complex, b: Complex) -> Complex:
    """The product of two complex numbers."""
    real = subtract(multiply(a[0], b[0]), multiply(a[1], b[1]))
    return real, add(multiply(a[0], b[1]), multiply(a[1], b[0]))


def complex_reciprocal(a: Complex) -> Complex:
    """1/a."""
    norm = add(multiply(a[0], a[0]), multiply(a[1], a[1]))
    return divide(a[0], norm), negative(divide(a[1], norm))


def horner(coefficients: Iterable[Pair], x: Pair) -> Pair:
    """A real polynomial (coefficients high to low, as pairs) at x."""
    total: Pair = (0.0 * x[0], 0.0 * x[0])
    for c in coefficients:
        total = add(multiply(total, x), c)
    return total


def complex_horner(coefficients: tuple[Complex, ...], x: Complex) -> Complex:
    """A polynomial (coefficients high to low) at x."""
    zero = 0.0 * x[0][0]
    total: Complex = ((zero, zero), (zero, zero))
    for c in coefficients:
        total = complex_add(complex_multiply(total, x), c)
    return total


@cache
def log_2() -> tuple[float, float]:
    """log 2."""
    with working_precision(_WORKING_BITS):
        return pair_of(arb(2).log())


def _table(values: list[arb]) -> Pair:
    """Numbers as a pair of arrays."""
    high, low = zip(*map(pair_of, values), strict=True)
    return np.array(high), np.array(low)


@cache
def _logarithms() -> Pair:
    """log(k/64) for k = 0, ..., 92 (0 in place of log 0)."""
    with working_precision(_WORKING_BITS):
        return _table([(arb(max(k, 1)) / 64).log() for k in range(93)])


@cache
def _circle() -> tuple[Pair, Pair]:
    """cos(k/32) and sin(k/32) for k = -101, ..., 101."""
    angles = [arb(k) / 32 for k in range(-101, 102)]
    with working_precision(_WORKING_BITS):
        return _table([t.cos() for t in angles]), _table([t.sin() for t in angles])


@cache
def _inverse_factorials(start: int) -> tuple[tuple[float, float], ...]:
    """(-1)^k/(start + 2k)! for k = 6, ..., 0."""
    from math import factorial

    with working_precision(_WORKING_BITS):
        return tuple(pair_of(arb((-1) ** k) / factorial(start + 2 * k)) for k in reversed(range(7)))


@cache
def _odd_reciprocals() -> tuple[tuple[float, float], ...]:
    """1/(2k + 1) for k = 6, ..., 0."""
    with working_precision(_WORKING_BITS):
        return tuple(pair_of(arb(1) / (2 * k + 1)) for k in reversed(range(7)))


def log(a: Pair) -> Pair:
    """log(a) for a > 0; -inf for 0."""
    a = (np.asarray(a[0], dtype=float), np.asarray(a[1], dtype=float))
    zero = a[0] == 0
    m, e = np.frexp(np.where(zero, 1.0, a[0]))
    low = m < 0.7071067811865476
    m, e = np.where(low, 2 * m, m), np.where(low, e - 1, e)
    rest = np.ldexp(np.where(zero, 0.0, a[1]), -e)
    k = np.rint(64 * m)
    t = k / 64
    table = _logarithms()
    index = k.astype(np.int64)
    s = divide(add((m - t, 0.0 * m), (rest, 0.0 * m)), add(two_sum(m, t), (rest, 0.0 * m)))
    series = multiply((2 * s[0], 2 * s[1]), horner(_odd_reciprocals(), multiply(s, s)))
    binary = multiply(log_2(), (e.astype(float), 0.0 * m))
    total = add(add(binary, (table[0][index], table[1][index])), series)
    return np.where(zero, -np.inf, total[0]), np.where(zero, 0.0, total[1])


def cos_sin(t: Any) -> tuple[Pair, Pair]:
    """cos(t) and sin(t) of doubles |t| <= pi."""
    k = np.rint(32 * t)
    h = (t - k / 32, 0.0 * t)  # exact
    square = multiply(h, h)
    c, s = horner(_inverse_factorials(0), square), multiply(h, horner(_inverse_factorials(1), square))
    (cos_hi, cos_lo), (sin_hi, sin_lo) = _circle()
    index = k.astype(np.int64) + 101
    turn: Complex = ((cos_hi[index], cos_lo[index]), (sin_hi[index], sin_lo[index]))
    return complex_multiply(turn, (c, s))


def angle(y: Pair, x: Pair) -> Pair:
    """The argument of x + i y in (-pi, pi], for numbers of moderate size; 0 at the origin."""
    t = np.arctan2(y[0], x[0])
    c, s = cos_sin(t)
    cross = subtract(multiply(y, c), multiply(x, s))[0]
    dot = x[0] * c[0] + y[0] * s[0]
    return two_sum(t, np.divide(cross, dot, out=np.zeros_like(dot), where=dot != 0))

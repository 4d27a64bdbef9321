"""Local data, computed anew for the checks: orders, exponent differences, logarithms, and bounds.

Written independently of the search: plain recurrences, bounds that are weaker but simpler.  The formulas are those of
Kovacic 1986, section 2.1; at infinity they are applied to S(1/z)/z^4 at z = 0.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import isqrt
from typing import Any

from kovacic.algebra.fields import BadPrimeError, Homomorphism
from kovacic.algebra.modular import simple_roots, translate
from kovacic.algebra.poly import Poly, to_fraction
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.traces import is_provably_not_a_square, largest_integer_total, trace_of_square_root


@dataclass(frozen=True)
class Point:
    """All roots of an irreducible factor of den, with S = num/den; or infinity, with S(1/z)/z^4 for S."""

    name: str
    factor: Poly
    num: Poly
    den: Poly
    order: int

    @cached_property
    def difference_squared(self) -> Poly | None:
        """1 + 4b at a pole of order at most 2 where that is constant, else None."""
        if self.order <= 1:
            return self.factor.field.poly([1])
        slope = self.factor.derivative()
        top, bottom = self.num % self.factor, self.den // self.factor**2 % self.factor * slope * slope % self.factor
        ratio = top[bottom.degree] / bottom.lc
        return 1 + 4 * ratio if top == ratio * bottom else None

    @cached_property
    def difference(self) -> Fraction | None:
        """The exponent difference at a regular point where it is rational (1 for an ordinary point), else None."""
        square = self.difference_squared if self.order <= 2 else None
        value = None if square is None else square.field.rational_value(square)
        if value is None or value < 0:
            return None
        p, q = isqrt(value.numerator), isqrt(value.denominator)
        return Fraction(p, q) if Fraction(p, q) ** 2 == value else None


def points(S: RatFunc) -> list[Point]:
    """Every singular place, and infinity even if it is ordinary."""
    factors = S.field.factor(S.den) if S.den.degree else []
    return [*(Point(str(p), p, S.num, S.den, k) for p, k in factors), _infinity(S)]


def _infinity(S: RatFunc) -> Point:
    z, one = S.field.poly([0, 1]), S.field.poly([1])
    # z^deg times the polynomial at 1/z; S(1/z)/z^4 = z^(b - a - 4) num/den for the degrees a and b.
    num, den = (S.field.poly(list(f)[::-1]) for f in (S.num, S.den))
    order = S.num.degree - S.den.degree + 4
    if not num:
        return Point("infinity", z, num, one, 0)
    if order < 0:
        return Point("infinity", z, num * z**-order, den, 0)
    return Point("infinity", z, num, den * z**order, order)


def least_valuation(point: Point, m: int, logarithm: bool) -> int | None:
    """The least integer among the valuations that a rational form of degree m can have at the point; None if there is none.

    m k/4 at an irregular point of order k; m (1 + Delta)/2 with a logarithm; m/2 + (i - m/2) Delta, i = 0, ..., m, else,
    with 0 for an irrational Delta.
    """
    if point.order > 2:
        return None if m * point.order % 4 else m * point.order // 4
    difference = point.difference or Fraction(0)
    n, d = difference.numerator, difference.denominator
    steps = [m] if logarithm else range(-m, m + 1, 2)
    possible = [m * d + i * n for i in steps]  # in units of 1/(2 d)
    return min((value // (2 * d) for value in possible if value % (2 * d) == 0), default=None)


def logarithm_at(point: Point, homomorphisms: Iterator[Homomorphism]) -> bool:
    """Is there a logarithm?  True is proven: for Delta = n a positive integer by an obstruction modulo a prime."""
    if point.order == 1 or point.difference == 0:
        return True
    difference = point.difference
    if point.order != 2 or difference is None or difference.denominator != 1:
        return False
    n = int(difference)
    for h in homomorphisms:
        try:
            root = next(simple_roots(h.keeping_degree(point.factor)), None)
            if root is None:
                continue
            series = laurent_numerators(point, h, root, n + 1)
        except BadPrimeError:
            continue
        # y = t^((1-n)/2) sum a_k t^k: k (k - n) a_k = sum_(j=1..k) s_j a_(k-j), with S = sum s_j t^(j-2).
        a = [1]
        for k in range(1, n + 1):
            total = sum(s * value for s, value in zip(series[1 : k + 1], reversed(a), strict=True)) % h.p
            if k == n:
                return total != 0
            a.append(total * pow(k * (k - n), -1, h.p) % h.p)
    raise AssertionError("the sequence of primes is infinite")


def laurent_numerators(point: Point, h: Homomorphism, root: int, count: int) -> list[int]:
    """s_0, ..., s_(count-1) with S = t^(-k) sum s_j t^j at a root modulo p, k the order of the pole (2 for order 1)."""
    k = max(point.order, 2)
    den = translate(h.keeping_degree(point.den), root)
    num = translate(h(point.num), root).left_shift(k - point.order)
    if any(int(den[i]) for i in range(point.order)) or not int(den[point.order]):
        raise BadPrimeError("the order of a pole changes")
    series: Any = num.mul_low(den.right_shift(point.order).inverse_series_trunc(count), count)
    return [int(series[j]) for j in range(count)]


def largest_degree(all_points: list[Point], logarithmic: set[str]) -> int | None:
    """The largest number of zeros at ordinary points that a solution with rational omega over K can have.

    1 minus the sum of its exponents, which at a point of order k are (1 +- Delta)/2 or, for even k >= 4,
    (k/2 +- b/a)/2.  None if they can't be conjugate over K at some point, so that omega isn't rational over K.
    """
    total, choices = Fraction(1), []
    for point in all_points:
        if point.order == 0:
            continue
        difference, n = point.difference, point.factor.degree
        if point.name in logarithmic and difference is not None:
            total -= n * (1 + difference) / 2
            continue
        total -= Fraction(n * max(point.order // 2, 1), 2)
        if difference is not None:
            choices.append(n * difference / 2)
            continue
        if is_provably_not_a_square(_square_class(point), point.factor):
            return None
        trace = trace_of_square_root(_difference_squared(point), point.factor)
        if trace is None:
            return None
        choices.append((to_fraction(trace.rational_coefficients()[0]) if trace else Fraction(0)) / 2)
    return max(largest_integer_total(total, choices), -1)


def _square_class(point: Point) -> Poly:
    """Delta^2 at a regular point, a^2 at an irregular one, up to a square in K[x]/p."""
    p, k = point.factor, point.order
    lead = point.den // p**k % p * p.derivative() ** k
    return lead * (point.num if k > 2 else lead + 4 * point.num) % p


def _difference_squared(point: Point) -> Poly:
    """Delta^2, or (b/a)^2 at an irregular point, in K[x]/p.

    With S = t^(-2 nu) s(t), a^2 = s_0, and sqrt(s) = a sum rho_i t^i, b/a = 2 a rho_(nu-1).
    """
    p, nu = point.factor, max(point.order, 2) // 2
    num, den = (_expansion(f, p, nu + point.order) for f in (point.num, point.den))
    den = den[point.order :]
    inverse, s = den[0].inverse_modulo(p), list[Poly]()
    for i in range(nu):
        known = sum((den[j] * s[i - j] for j in range(1, i + 1)), 0 * p)
        s.append((num[i] - known) * inverse % p)
    if nu == 1:
        return (1 + 4 * s[0]) % p
    scale, rho = s[0].inverse_modulo(p), [p.field.poly([1])]
    for i in range(1, nu):
        cross = sum((rho[j] * rho[i - j] for j in range(1, i)), 0 * p)
        rho.append((s[i] * scale - cross) / 2 % p)
    return 4 * s[0] * rho[nu - 1] * rho[nu - 1] % p


def _expansion(polynomial: Poly, p: Poly, count: int) -> list[Poly]:
    """Taylor coefficients at the class of x in K[x]/p."""
    terms = []
    for i in range(count):
        terms.append(polynomial % p)
        polynomial = polynomial.derivative() / (i + 1)
    return terms

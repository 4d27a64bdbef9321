"""Power series and polynomial solutions of linear differential equations from their recurrences, exactly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import lcm
from operator import mul
from typing import Any, NamedTuple

from flint import fmpq, fmpq_poly, fmpz, fmpz_poly

from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.rationals import QQ, RationalPoly
from kovacic.limits import check_time


class RationalSeries:
    """Rational numbers u_0 = 1, u_1, u_2, ..., extended by `pivot u_n = -sum_(h>0) factors_(h-1) u_(n-h)` in integers.

    The last terms are kept as integers over a common denominator, which grows only by what a division really needs.
    """

    def __init__(self, width: int) -> None:
        self._width = width
        self._window = [fmpz(1)]  # the last terms times the denominator, the latest first
        self._denominator = fmpz(1)
        self._terms = [(fmpz(1), fmpz(1))]
        self._scales = [fmpz(1)]  # of the denominator, from each term's predecessor to the term

    def term(self, n: int) -> Any:
        return fmpq(*self._terms[n])

    def polynomial(self, count: int) -> RationalPoly:
        """`sum_(n < count) u_n t^n`."""
        if not count:
            return RationalPoly(fmpq_poly([]))
        numerators = list[Any]()
        scale = fmpz(1)
        for k in range(count - 1, -1, -1):
            if k % 64 == 0:
                check_time()
            numerators.append(self._terms[k][0] * scale)
            scale *= self._scales[k]
        return RationalPoly(fmpq_poly(fmpz_poly(numerators[::-1]), self._terms[count - 1][1]))

    def extend(self, pivot: Any, factors: Sequence[Any]) -> Any:
        """Append the next term; where the pivot is 0, append 0 and return the sum, which ought to vanish; else return 0."""
        total = -sum(map(mul, factors, self._window), fmpz(0))
        scale = fmpz(1)
        if not pivot:
            value = fmpz(0)
            obstruction = fmpq(-total, self._denominator)
        else:
            obstruction = fmpq(0)
            common = (total % pivot).gcd(pivot)
            scale = pivot // common
            if scale < 0:
                common = -common
                scale = -scale
            value = total // common
            if scale != 1:
                self._window = [scale * w for w in self._window]
                self._denominator *= scale
        self._terms.append((value, self._denominator))
        self._scales.append(scale)
        self._window = [value, *self._window[: self._width - 1]]
        return obstruction


class FieldSeries:
    """A series as `RationalSeries`, over any field, in its scalars."""

    def __init__(self, field: Field, width: int) -> None:
        self._field = field
        self._width = width
        self._terms = [field.one]
        self._zero = field.zero

    def polynomial(self, count: int) -> Poly:
        return self._field.poly(self._terms[:count])

    def extend(self, pivot: Any, factors: Sequence[Any]) -> Any:
        window = self._terms[: -self._width - 1 : -1]
        total = -sum((factor * value for factor, value in zip(factors, window, strict=False) if value), self._zero)
        self._terms.append(total / pivot if pivot else self._zero)
        return self._zero if pivot else -total


@dataclass(frozen=True)
class TwoTerms:
    """An operator that takes t^k to upper(k) t^(k+s) + lower(k) t^(k+s-step): its polynomial solutions are hypergeometric.

    The coefficients of a solution satisfy upper(k) p_k = -lower(k + step) p_(k+step), so that one that begins with
    t^degree is there exactly if upper vanishes at the degree and the chain of powers degree, degree - step, ... comes to
    a root of lower, where it ends, before it meets another root of upper.
    """

    step: int
    upper: Poly
    lower: Poly

    @classmethod
    def of(cls, second: Poly, first: Poly, zeroth: Poly) -> TwoTerms | None:
        """`second P'' + first P' + zeroth P` as such an operator; None if x^k is taken to another number of powers."""
        parts = [second, first, zeroth]
        rows = []
        for j, (a, b, c) in enumerate(_rows(parts, _shift(*parts))):
            if a or b or c:
                rows.append((j, first.field.poly([c, b - a, a])))
        if len(rows) != 2:
            return None
        (start, upper), (end, lower) = rows
        return cls(end - start, upper, lower)

    def lowest(self, degree: int) -> int | None:
        """The last power of the solution t^degree + ...; None if there is none."""
        if self.upper(degree):
            return None
        ends = self._met(self.lower, degree)
        if not ends or max(self._met(self.upper, degree - self.step), default=-1) >= max(ends):
            return None
        return max(ends)

    def _met(self, factor: Poly, first: int) -> list[int]:
        """The roots of upper or lower among first, first - step, ..., 0."""
        return [k for k in _natural_roots(factor) if k <= first and (first - k) % self.step == 0]

    def solutions(self, degree: int, lowest: int) -> list[Hypergeometric]:
        """The solution t^degree + ... + c t^lowest, and the one that begins at the other root f of lower, if there is one
        without a logarithm.

        With n = (degree - lowest)/step and the other root e of upper, at k = lowest + step i the quotient of p_(k+step) and
        p_k, -upper(k)/lower(k + step), is a multiple of (i - n)(i + (lowest - e)/step)/((i + 1)(i + 1 + (lowest - f)/step)).
        Where a parameter below is an integer <= 0 the sum is taken from the top, where it is the reciprocal.
        """
        found = self._from(self.lower, lowest, self.upper, degree)
        if found.is_singular:
            downwards = TwoTerms(-self.step, self.lower, self.upper)
            reverse = downwards._from(self.upper, degree, self.lower, lowest)
            found = found if reverse.is_singular else reverse
        if self.lower.degree < 2:
            return [found]
        other = -self.lower[1] / self.lower[2] - lowest
        second = self._from(self.lower, other, self.upper, degree)
        return [found] if not other - lowest or second.is_singular else [found, second]

    def _from(self, first: Poly, start: Poly | int, last: Poly, end: int) -> Hypergeometric:
        """The series whose first power is a root of `first`, and whose terms vanish beyond roots of `last`, as `end` may be."""
        zero = first * 0
        above = [zero + end, *_other_roots(last, zero + end)]
        below = _other_roots(first, zero + start)
        top = [(start - root) / self.step for root in above]
        bottom = [(start - root) / self.step + 1 for root in below]
        factor = -last.lc * self.step**last.degree / (first.lc * self.step**first.degree)
        return Hypergeometric(zero + start, self.step, (*top,), (*bottom,), factor)


@dataclass(frozen=True)
class Hypergeometric:
    """t^start pFq(top; bottom; factor t^step), with constants of the field for the numbers."""

    start: Poly
    step: int
    top: tuple[Poly, ...]
    bottom: tuple[Poly, ...]
    factor: Poly

    @property
    def is_singular(self) -> bool:
        """True if a parameter below is 0, -1, -2, ..."""
        return any(_natural_roots(value.field.poly([value, 1])) for value in self.bottom)


def _natural_roots(factor: Poly) -> list[int]:
    """The roots 0, 1, 2, ... of a polynomial of degree 2 at most."""
    field = factor.field
    roots = [-factor[0] / factor[1]] if factor.degree == 1 else []
    if factor.degree == 2:
        root = field.sqrt(factor[1] ** 2 - 4 * factor[0] * factor[2])
        roots = [] if root is None else [(sign * root - factor[1]) / (2 * factor[2]) for sign in (1, -1)]
    values = [field.rational_value(root) for root in roots]
    return [int(value) for value in values if value is not None and value >= 0 and value.denominator == 1]


def _other_roots(factor: Poly, root: Poly) -> list[Poly]:
    """The other root of a quadratic factor; a linear one has none."""
    return [-factor[1] / factor[2] - root] if factor.degree == 2 else []


def _rows(parts: Sequence[Any], shift: int) -> list[tuple[Any, ...]]:
    """The (a_j, b_j, c_j) of L_j(k) = a_j k (k-1) + b_j k + c_j: the operator takes x^k to sum_j L_j(k) x^(k+shift-j)."""
    return [tuple(f[shift + 2 - i - j] for i, f in enumerate(parts)) for j in range(shift + 3)]


def _shift(second: Any, first: Any, zeroth: Any) -> int:
    """The most by which the operator raises a power."""
    return int(max(second.degree - 2, first.degree - 1, zeroth.degree))


def _operator_value(coefficients: tuple[Any, ...], k: int) -> Any:
    """L(k) = a k (k-1) + b k + c."""
    a, b, c = coefficients
    return a * (k * (k - 1)) + b * k + c


class Descended(NamedTuple):
    """P = x^d + ..., whose coefficients follow from the top, what an operator leaves of it, and the power that was free."""

    P: Poly
    rest: Poly
    free: int | None


def polynomial_solution(second: Poly, first: Poly, zeroth: Poly, degree: int) -> Poly | None:
    """The monic P of the given degree with `second P'' + first P' + zeroth P = 0`, or None if there is none.

    The coefficients follow from the top: L_0(k) p_k = -sum_(j>0) L_j(k+j) p_(k+j).  L_0 vanishes at the degree and at no
    more than one other k; if that is a smaller natural number, a multiple of the solution that begins there may have to
    be added.
    """
    found = descended(second, first, zeroth, degree)
    if found is None or not found.rest:
        return found and found.P
    other = None if found.free is None else descended(second, first, zeroth, found.free)
    if other is None or other.rest.degree != found.rest.degree:
        return None
    factor = -found.rest.lc / other.rest.lc
    return None if found.rest + factor * other.rest else found.P + factor * other.P


def descended(second: Poly, first: Poly, zeroth: Poly, degree: int) -> Descended | None:
    """The P of the given degree of which the operator leaves low powers alone; a free coefficient is set to 0.

    None if the degree isn't possible, or the free coefficient meets an obstruction.
    """
    field = first.field
    parts = list[Any]([second, first, zeroth])
    shift = _shift(*parts)
    if field == QQ:  # in integers
        scale = lcm(*(f.content()[1] for f in parts))
        parts = [(f * scale).rep.numer() for f in parts]
    lowest, *others = _rows(parts, shift)
    if _operator_value(lowest, degree):
        return None
    free = None
    series = RationalSeries(len(others)) if field == QQ else FieldSeries(field, len(others))
    for k in range(degree - 1, -1, -1):
        if k % 64 == 0:
            check_time()
        pivot = _operator_value(lowest, k)
        obstruction = series.extend(
            pivot, [_operator_value(row, k + j) for j, row in enumerate(others[: degree - k], 1)]
        )
        if obstruction:
            return None
        if not pivot:
            free = k
    # The term number n of the series is the coefficient of x^(degree - n).
    downwards = series.polynomial(degree + 1)
    P = downwards.reversed(degree - downwards.degree)
    return Descended(P, _remainder(second, first, zeroth, P), free)


def _remainder(second: Poly, first: Poly, zeroth: Poly, P: Poly) -> Poly:
    """second P'' + first P' + zeroth P for a P whose coefficients satisfy the recurrence: all terms are below x^shift.

    By products, which stay fast where the operator is long; of P they need no more than the low powers.
    """
    shift = _shift(second, first, zeroth)
    x = P.field.x
    low = P if P.degree < shift + 2 else P % x ** (shift + 2)
    slope = low.derivative()
    return (second * slope.derivative() + first * slope + zeroth * low) % x ** max(shift, 0)

"""Solutions a u + b u' with u'' = T u a pull-back by a power of x: equations that are gauge-equivalent to one of these.

S has one irregular place, infinity, at most one other place c where solutions aren't apparent, and apparent ones.  With x for
x - c, T = Q x^(2n-2) + R x^(n-2) + (D^2 - 1)/(4 x^2).  Q, and R where Q = 0, are read off from S at infinity.  For Q != 0 the
quotient R/sqrt(Q), and D always, agree with those of S up to integers, and a few values near to them are tried.

y = a u + b u' solves y'' = S y exactly if

    a'' + 2 b' T + b T' + (T - S) a = 0,        2 a' + b'' + (T - S) b = 0.                                         (1)

With a = h A, b = h B, h = x^e prod p^((1 - D_p)/2) over the apparent places, these are linear equations for polynomials A, B.

Reference: Q. Yuan, M. van Hoeij, ISSAC 2010, 37-43, for the exponents.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import gcd

from flint import fmpq_mat

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.engine.places import Kind, Place, Problem, rational_square_root
from kovacic.special.pullback import Airy, Confluent, Pullback

#: How far the exponents of T may be from those of S, the degrees of A and B, and that of the denominators at most.
_NEAR, _DEGREE, _LARGEST = 2, 6, 40


@dataclass(frozen=True)
class Gauge:
    """y = h (A u + B u') with h'/h = `rate`."""

    A: Poly
    B: Poly
    rate: RatFunc

    def gives(self, S: RatFunc, T: RatFunc) -> bool:
        """Do a = h A and b = h B satisfy (1) exactly, and is a u + b u' zero for no solution u?"""
        A, B = RatFunc(self.A), RatFunc(self.B)
        first, second = self._slope(A), self._slope(B)
        D = T - S
        u = self._slope(first) + 2 * second * T + B * T.derivative() + D * A
        independent = A * (A + second) - B * (first + B * T)  # the quotient of the Wronskians, over h^2
        return bool(independent) and not u and not 2 * first + self._slope(second) + D * B

    def _slope(self, P: RatFunc) -> RatFunc:
        """(h P)'/h."""
        return P.derivative() + self.rate * P


def gauged(problem: Problem) -> Iterator[tuple[Pullback, Gauge]]:
    """Pull-backs with gauges that should satisfy (1), the exponents nearest to those of S first; over Q only."""
    regular = [place for place in problem.finite_places if place.kind is Kind.REGULAR]
    apparent = [place for place in regular if place.is_apparent]
    others = [place for place in regular if not place.is_apparent]
    if problem.field != QQ or not apparent or len(regular) < len(problem.finite_places) or len(others) > 1:
        return
    if problem.infinity.kind not in (Kind.UNRAMIFIED, Kind.RAMIFIED) or any(place.degree > 1 for place in others):
        return
    for center, difference in _centers(others, apparent, problem):
        moved = QQ.poly([center, 1])
        S, back = problem.S(RatFunc(moved)), RatFunc(QQ.poly([-center, 1]))
        rest = [(place.factor(moved), place.delta) for place in apparent if place.factor(center)]
        for pullback in _near(S, difference):
            problem.budget.check()
            if (found := _solved(S, pullback.S, rest)) is not None:
                gauge = Gauge(found.A(back.num), found.B(back.num), found.rate(back))
                yield Pullback(pullback.equation, pullback.f(back)), gauge


def _centers(others: list[Place], apparent: list[Place], problem: Problem) -> Iterator[tuple[Fraction, Fraction]]:
    """c, and the exponent difference of S there."""
    if others:
        if others[0].delta is not None:
            yield QQ.rational_value(-others[0].factor[0]) or Fraction(0), others[0].delta
        return
    S = problem.S
    growth, polynomial = S.degree, S.num // S.den
    if growth >= 1:  # T has no term x^(growth - 1)
        c = QQ.rational_value(-polynomial[growth - 1] / (polynomial.lc * growth)) or Fraction(0)
        yield c, next((place.delta for place in apparent if place.delta and not place.factor(c)), Fraction(1))


def _near(S: RatFunc, difference: Fraction) -> Iterator[Pullback]:
    """T with exponents near to those of S, as pull-backs of (1)."""
    growth, x = S.degree, RatFunc(QQ.poly([0, 1]))
    n = growth + 2 if growth % 2 else growth // 2 + 1
    lead = QQ.rational_value(S.num.lc) or Fraction(0)  # the denominator is monic
    Q, R = (Fraction(0), lead) if growth % 2 else (lead, _coefficient(S, n - 2))
    step = rational_square_root(QQ.poly([Q])) or 0
    shifts = product(range(-_NEAR, _NEAR + 1), range(-2 * _NEAR, 2 * _NEAR + 1) if step else (0,))
    for j, i in sorted(shifts, key=lambda shift: abs(shift[0]) + abs(shift[1])):
        q, r, square = Q / n**2, -(R + i * step) / n**2, (difference + j) ** 2 / n**2
        if not q and n == 3 and square == Fraction(1, 9):
            yield Pullback(Airy(QQ.poly([lead])), x)
        else:
            yield Pullback(Confluent(QQ.poly([q]), QQ.poly([r]), QQ.poly([(square - 1) / 4])), x**n)


def _coefficient(S: RatFunc, power: int) -> Fraction:
    """Of x^power at infinity, power >= -1."""
    shifted = S.num * QQ.poly([0, 1]) // S.den
    return QQ.rational_value(shifted[power + 1]) or Fraction(0)


def _solved(S: RatFunc, T: RatFunc, apparent: list[tuple[Poly, Fraction | None]]) -> Gauge | None:
    """A and B that solve (2), for a few powers of x in h."""
    x, one = QQ.poly([0, 1]), QQ.poly([1])
    rate, radical = RatFunc(one * 0), x**3 * S.den
    for p, delta in apparent:
        rate = rate + RatFunc(p.derivative(), p) * ((1 - (delta or Fraction(1))) * Fraction(1, 2))
        radical = radical * p * p
    if radical.degree > _LARGEST:
        return None
    for e in (Fraction(0), Fraction(-1), Fraction(-1, 2), Fraction(-3, 2)):
        found = _null_vector(S, T, rate + RatFunc(one, x) * e, radical)
        if found is not None:
            return found
    return None


def _null_vector(S: RatFunc, T: RatFunc, rate: RatFunc, radical: Poly) -> Gauge | None:
    """The linear system for the coefficients of A and B; `radical` clears all denominators."""
    size, D, slope_of_T = _DEGREE + (radical.degree - 3) // 2, T - S, T.derivative()

    def slope(P: RatFunc) -> RatFunc:
        return P.derivative() + rate * P

    columns = []
    for i in range(size):
        P = RatFunc(QQ.poly([0] * i + [1]))
        first = slope(P)
        second = slope(first) + D * P
        columns += [(second, 2 * first), (2 * first * T + slope_of_T * P, second)]
    cleared = [[function * radical for function in column] for column in columns]
    height = 1 + max(function.num.degree for column in cleared for function in column)
    rows = [[column[m].num.rational_coefficients() for column in cleared] for m in (0, 1)]
    entries = [[c[k] if k < len(c) else 0 for c in row] for row in rows for k in range(height)]
    kernel, nullity = fmpq_mat(entries).numer_denom()[0].nullspace()
    if not nullity:
        return None
    vector = [int(kernel[k, 0]) for k in range(2 * size)]
    common = gcd(*vector)
    return Gauge(QQ.poly([c // common for c in vector[::2]]), QQ.poly([c // common for c in vector[1::2]]), rate)

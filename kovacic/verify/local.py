"""Local data, computed anew for the checks: orders, exponent differences, logarithms, and bounds.

Written independently of the search: bounds that are weaker but simpler.  The formulas are those of
Kovacic 1986, section 2.1; at infinity they are applied to S(1/z)/z^4 at z = 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import isqrt
from typing import Any

from flint import nmod_poly

from kovacic.algebra.factors import expansions
from kovacic.algebra.modular import BadPrimeError, Homomorphism, series_solution, simple_roots, translate
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ, to_fraction
from kovacic.algebra.traces import is_provably_not_a_square, largest_integer_total, trace_of_square_root
from kovacic.limits import Budget
from kovacic.verify.residue import exponent_difference_squared


@dataclass(frozen=True)
class Point:
    """All roots of an irreducible factor p of den, of multiplicity `order`, with S = num/den; or infinity, with S(1/z)/z^4.

    `expansion` has N and q modulo p^nu with S = N/(p^order q), nu = order/2 or 1.
    """

    factor: Poly
    order: int
    num: Poly
    den: Poly
    budget: Budget
    expansion: tuple[Poly, Poly]
    at_infinity: bool = False

    @cached_property
    def near(self) -> tuple[Poly, Poly]:
        """N and q; for a double pole N and p'^2 q modulo p."""
        p, (N, q) = self.factor, self.expansion
        return (N, p.derivative() ** 2 * q % p) if self.order == 2 and p.degree > 1 else (N, q)

    @cached_property
    def name(self) -> str:
        return "infinity" if self.at_infinity else str(self.factor)

    @property
    def can_branch(self) -> bool:
        """Can the square root of an invariant branch here?"""
        difference = self.difference
        return self.order % 2 == 1 if self.order > 2 else difference is not None and difference.denominator == 2

    @property
    def tells_solutions_apart(self) -> bool:
        """Is a solution with a rational omega one of finitely many local ones?"""
        if self.order > 2:
            return self.order % 2 == 0
        difference = self.difference
        return self.order > 0 and (difference is None or difference.denominator != 1 or self.logarithm)

    @cached_property
    def difference(self) -> Fraction | None:
        """The exponent difference at a regular point where it is rational (1 for an ordinary point), else None."""
        if self.order != 2:
            return Fraction(1) if self.order < 2 else None
        # S = b/(x - c)^2 + ... with b = N/(p'^2 q), and Delta^2 = 1 + 4b.
        top, bottom = self.near
        ratio = top[bottom.degree] / bottom.lc
        if top != ratio * bottom:
            return None
        square = ratio.field.rational_value(4 * ratio + 1)
        if square is None or square < 0:
            return None
        root = Fraction(isqrt(square.numerator), isqrt(square.denominator))
        return root if root * root == square else None

    @cached_property
    def logarithm(self) -> bool:
        """Is there provably a logarithm?  For Delta = n > 0, up to the limit of degrees, by an obstruction modulo a prime."""
        difference = self.difference
        if self.order == 1 or difference == 0:
            return True
        if self.order != 2 or difference is None or difference.denominator != 1:
            return False
        n = difference.numerator
        if n > self.budget.limits.unknown_degree:
            return False
        for h in self.factor.field.homomorphisms():
            self.budget.check()
            try:
                root = next(simple_roots(h.keeping_degree(self.factor)), None)
                if root is not None:
                    return _is_obstructed(*self.localised(h, root), n)
            except BadPrimeError:
                pass
        raise AssertionError("the sequence of primes is infinite")

    def localised(self, h: Homomorphism, root: int) -> tuple[Any, Any]:
        """M and E with S = M/(t^k E) at a root modulo p, k the order of the pole (2 for order 1)."""
        den = translate(h.keeping_degree(self.den), root)
        if not den[self.order]:
            raise BadPrimeError("the order of a pole changes")
        return translate(h(self.num), root).left_shift(max(2 - self.order, 0)), den.right_shift(self.order)


def points(S: RatFunc, budget: Budget) -> list[Point]:
    """Every singular place, and infinity even if it is ordinary."""
    factors = S.field.factor(S.den) if S.den.degree else []
    near = expansions(S.num, S.den, factors)
    found = [Point(p, k, S.num, S.den, budget, terms) for (p, k), terms in zip(factors, near, strict=True)]
    # S(1/z)/z^4 = z^-order num/den, where num and den have the coefficients of S.num and S.den in reversed order.
    order = S.num.degree - S.den.degree + 4 if S.num else 0
    num, den = S.num.reversed(max(-order, 0)), S.den.reversed(max(order, 0))
    z, k = S.field.poly([0, 1]), max(order, 0)
    return [*found, Point(z, k, num, den, budget, expansions(num, den, [(z, k)])[0], at_infinity=True)]


def least_valuation(point: Point, m: int) -> int | None:
    """The least integer among the valuations that a rational form of degree m can have at the point; None if there is none.

    m k/4 at an irregular point of order k; m (1 + Delta)/2 with a logarithm; m/2 + (i - m/2) Delta, i = 0, ..., m, else,
    with 0 for an irrational Delta.
    """
    if point.order > 2:
        return None if m * point.order % 4 else m * point.order // 4
    n, d = (0, 1) if point.difference is None else point.difference.as_integer_ratio()
    for i in [m] if point.logarithm else range(-m, m + 1, 2):  # m/2 + i Delta/2, increasing
        valuation, rest = divmod(m * d + i * n, 2 * d)
        if not rest:
            return valuation
    return None


def _is_obstructed(M: Any, E: Any, n: int) -> bool:
    """Is there no y = t^e (1 + O(t)), e = (1-n)/2, with t^2 E y'' = M y?  Its terms below t^n exist; that one has no pivot."""
    e = (1 - n) * pow(2, -1, E.modulus())
    u = correction(M, E, nmod_poly([e], E.modulus()), 1, n)
    slope = u.derivative().left_shift(1)
    rest = (E * (e * (e - 1))) * u + E * (2 * e * slope + u.derivative().derivative().left_shift(2)) - M * u
    return bool(rest[n])


def correction(M: Any, E: Any, start: Any, nu: int, count: int) -> Any:
    """u = 1 + O(t), to `count` terms, with u exp(int t^-nu start) a solution of t^(2 nu) E y'' = M y, where there is one."""
    if 6 * E.degree() > count:  # one scalar product a term instead of three short ones
        M, E = M.mul_low(E.inverse_series_trunc(count + nu), count + nu), E**0
    rate = start.derivative().left_shift(nu) - (nu * start).left_shift(nu - 1) + start * start
    return series_solution(E.left_shift(nu), 2 * start * E, (rate * E - M).right_shift(nu), count)


@dataclass(frozen=True)
class ZeroCounts:
    """The numbers of zeros at ordinary points that a solution with rational omega over K can have.

    1 minus the sum of its exponents, which at a point of order k are (1 +- Delta)/2 or, for even k >= 4, (k/2 +- b/a)/2:
    `total` plus or minus each of the `choices`, half the sum of these differences over the roots of a factor.
    """

    total: Fraction
    choices: tuple[tuple[Point, Fraction], ...]

    @cached_property
    def largest(self) -> int:
        """The largest one; -1 if there is none."""
        return max(largest_integer_total(self.total, [half for _, half in self.choices]), -1)

    def by_exponent(self, point: Point) -> list[tuple[Fraction, int]] | None:
        """The exponents that omega can have at a point with a choice, each with the largest number; None elsewhere."""
        halves = [half for other, half in self.choices if other is point]
        if not halves or point.factor.degree > 1 or (point.difference is None and point.factor.field != QQ):
            return None
        others = [half for other, half in self.choices if other is not point]
        bounds = [(half, largest_integer_total(self.total - half, others)) for half in (halves[0], -halves[0])]
        return [(Fraction(max(point.order // 2, 1), 2) + half, bound) for half, bound in bounds if bound >= 0]


def zero_counts(all_points: list[Point]) -> ZeroCounts | None:
    """None if the exponents can't be conjugate over K at some point, so that omega isn't rational over K."""
    twice, choices = 2, list[tuple[Point, Fraction]]()
    for point in all_points:
        if point.order == 0:
            continue
        difference, n = point.difference, point.factor.degree
        twice -= n * max(point.order // 2, 1)
        if difference is None:
            trace = _trace_of_difference(point)
            if trace is None:
                return None
            choices.append((point, trace / 2))
        elif point.logarithm:  # then Delta is an integer
            twice -= n * difference.numerator
        else:
            choices.append((point, Fraction(n * difference.numerator, 2 * difference.denominator)))
    return ZeroCounts(Fraction(twice, 2), tuple(choices))


def _trace_of_difference(point: Point) -> Fraction | None:
    """The trace over K, up to sign, of Delta, or of b/a at an irregular point; of an irrational trace the first coordinate.
    None if it can be seen that Delta, or a, doesn't lie in K[x]/p."""
    p, k = point.factor, point.order
    num, bottom = point.near
    # Delta^2 = 1 + 4b with b = N/(p'^2 q), up to a square; or a^2 = N/q, up to the squares of q and of powers of p'
    square = bottom * (bottom + 4 * num if k == 2 else num) % p
    if is_provably_not_a_square(square, p):
        return None
    if k == 2:
        squared = square * (bottom * bottom).inverse_modulo(p) % p
    else:
        squared = exponent_difference_squared(num, bottom, p, k // 2)
    trace = trace_of_square_root(squared, p)
    if trace is None:
        return None
    return to_fraction(trace.rational_coefficients()[0]) if trace else Fraction(0)

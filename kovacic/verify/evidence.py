"""The negative claims: each piece of evidence is recomputed from S alone.

Conditions: at an irregular point of odd order no solution has a rational logarithmic derivative; a logarithm makes the local
monodromy unipotent of infinite order, which an imprimitive or finite group hasn't; the square root of an invariant of degree
4 that isn't a square branches at two points at least; an irregular point makes the group infinite; in a finite primitive
group the local monodromy has an order from a short list, the denominator of Delta.  [Kovacic 1986, theorem of section 2.1]

Forms: their dimension modulo a prime is an upper bound for that over the field.  A rational form F of degree m in a
fundamental system has, at each singular point, a valuation from a short list; so F is the product of the p^v, v the least of
these, and of a polynomial of a bounded degree.  At an ordinary point, F is a combination of y1^(m-i) y2^i, i = 0, ..., m, and
modulo a prime the rank of the equations which say that the terms beyond that degree vanish is at most that over the field.
[van Hoeij & Weil, J. Pure Appl. Algebra 117-118 (1997)]
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import count, islice
from typing import Any

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.compatibility import cached_property
from kovacic.decision import (
    Evidence,
    NecessaryCondition,
    NoInvariant,
    NoRationalOmega,
    NoTerminatingSeries,
    Rule,
    Structure,
)
from kovacic.limits import Budget
from kovacic.verify.local import Point, points
from kovacic.verify.omega import chart, no_expansion_is_rational
from kovacic.verify.primes import (
    BadPrimeError,
    Homomorphism,
    homomorphisms,
    homomorphisms_modulo,
    is_usable_prime,
    roots_modulo,
    translated,
)
from kovacic.verify.series import nullity, product_of_powers, solutions_at_ordinary_point
from kovacic.verify.terminating import numbers_of_series
from kovacic.verify.zeros import ZeroCounts, is_proven_irrational, zero_counts

#: Equations beyond the number of unknowns.
_MORE_EQUATIONS = 7


def least_valuation(point: Point, m: int) -> int | None:
    """The least integer among the valuations that a rational form of degree m can have at the point; None if there is none.

    With the exponents (1 +- Delta)/2 a form has the valuations m/2 + i Delta/2, i = -m, -m + 2, ..., m; the middle one alone
    for an irrational Delta (i = 0), the largest alone with a logarithm, since such a form is a power of the solution without
    it.  At an irregular point of order k a rational form is a multiple of (y+ y-)^(m/2), of the valuation m k/4.
    """
    if point.order > 2:
        quarter, rest = divmod(m * point.order, 4)
        return None if rest else quarter
    if point.difference is None:
        return None if m % 2 else m // 2
    numerator, denominator = point.difference.as_integer_ratio()
    signs = [m] if point.logarithm else range(-m, m + 1, 2)
    for i in signs:
        valuation, rest = divmod(m * denominator + i * numerator, 2 * denominator)
        if not rest:
            return valuation
    return None


def room(points: list[Point], m: int) -> tuple[list[int], int] | None:
    """The least valuations at the finite points, and the largest degree of the polynomial factor; None if no form exists.

    The valuations at all points of the sphere, as those of a form in solutions of y'' = S y, add up to m.
    """
    valuations = []
    degree = m
    for point in points:
        valuation = least_valuation(point, m)
        if valuation is None:
            return None
        valuations.append(valuation)
        degree -= valuation * point.factor.degree
    return None if degree < 0 else (valuations[:-1], degree)


def dimension_modulo(
    h: Homomorphism, S: RatFunc, at: int, m: int, *, factors: list[tuple[Poly, int]], degree: int
) -> int:
    """The dimension modulo a prime of the forms of degree m whose quotient by prod p^v is a polynomial of at most this degree.

    They are expanded at the integer `at`, to some terms more than there are unknowns.  Raises `BadPrimeError` if the point is
    singular, or the series would be longer than the prime allows.
    """
    count = degree + m + 1 + _MORE_EQUATIONS
    bottom = translated(h.keeping_degree(S.den), at)
    if h.p <= 2 * count or not int(bottom[0]):
        raise BadPrimeError("the point is singular, or the prime is small")
    y1, y2 = solutions_at_ordinary_point(translated(h(S.num), at), bottom, count)
    images = [(translated(h.keeping_degree(p), at), -v) for p, v in factors]
    form = product_of_powers(images, count, h.p).mul_low(y1.pow_trunc(m, count), count)
    ratio = y2.mul_low(y1.inverse_series_trunc(count), count)
    forms = [form]  # the quotients of y1^(m-i) y2^i, i = 0, ..., m
    for _ in range(m):
        forms.append(forms[-1].mul_low(ratio, count))
    return nullity(forms, degree + 1, count)


def least_ordinary_point(den: Any) -> int:
    """The least natural number at which a polynomial modulo a prime doesn't vanish."""
    return next(at for at in count() if int(den(at)))


#: The denominators of exponent differences in the finite primitive groups, modulo +-1.
_LOCAL_ORDERS = {
    Structure.TETRAHEDRAL: {1, 2, 3},
    Structure.OCTAHEDRAL: {1, 2, 3, 4},
    Structure.ICOSAHEDRAL: {1, 2, 3, 5},
}


def condition_fails(item: NecessaryCondition, structure: Structure, points: list[Point]) -> bool:
    """True if the structure implies the condition, and the condition fails at each of the places that are named."""
    named = [point for point in points if point.name in item.places]
    if len(named) < len(item.places):  # a name is that of no point, or occurs twice
        return False
    if item.rule is Rule.TOO_FEW_BRANCH_POINTS:
        # The square root of an invariant of degree 4 can branch at these places alone, and they are fewer than two points.
        are_all = named == [point for point in points if point.can_branch]
        return structure is Structure.IMPRIMITIVE and are_all and sum(point.factor.degree for point in named) < 2
    return (
        structure in _IMPLIED_BY[item.rule] and bool(named) and all(_fails_at(p, item.rule, structure) for p in named)
    )


def _fails_at(point: Point, rule: Rule, structure: Structure) -> bool:
    """True if the condition of a rule fails at the point."""
    k = point.order
    if rule is Rule.RAMIFIED:
        return k > 2 and k % 2 == 1
    if rule is Rule.NOT_A_SQUARE:
        return k % 2 == 0 and is_proven_irrational(point)
    if rule is Rule.LOGARITHM:
        return point.logarithm
    if rule is Rule.IRREGULAR:
        return k > 2
    # EXPONENTS, which speaks of regular points only
    return k <= 2 and (point.difference is None or point.difference.denominator not in _LOCAL_ORDERS[structure])


#: The structures that imply the condition of each rule.
_IMPLIED_BY = {
    Rule.RAMIFIED: {Structure.REDUCIBLE},
    Rule.NOT_A_SQUARE: {Structure.REDUCIBLE},
    Rule.LOGARITHM: {Structure.IMPRIMITIVE, *_LOCAL_ORDERS},
    Rule.IRREGULAR: {*_LOCAL_ORDERS},
    Rule.EXPONENTS: {*_LOCAL_ORDERS},
}


#: The degree of the invariant that the structure would have; together with the uniqueness of omega for reducible groups.
INVARIANT_DEGREE = dict(zip(Structure, (2, 4, 6, 8, 12), strict=True))
#: Homomorphisms under which a dimension is bounded where no record names a prime.
_TRIED_FOR_A_DIMENSION = 3


@dataclass(frozen=True)
class Inspector:
    """Recomputes evidence about y'' = S y."""

    S: RatFunc
    budget: Budget

    @cached_property
    def points(self) -> list[Point]:
        """All singular places, and infinity."""
        return points(self.S, self.budget)

    @cached_property
    def zero_counts(self) -> ZeroCounts | None:
        """The possible numbers of zeros of a solution with a unique rational omega; None if there provably is none."""
        return zero_counts(self.points)

    @cached_property
    def numbers_of_series(self) -> tuple[int, int] | None:
        """The number of possible theta, and of those with a P, by recurrences of two terms; None if these don't decide."""
        return numbers_of_series(self.S, self.points)

    @property
    def factors(self) -> list[Poly]:
        """The irreducible factors of the denominator of S."""
        return [point.factor for point in self.points[:-1]]

    def excludes(self, structure: Structure, evidence: tuple[Evidence, ...]) -> bool:
        """True if the evidence, recomputed, proves that the group doesn't have this structure.

        A necessary condition that fails does, or the absence of the invariant; but a reducible group has one only where
        omega isn't unique, so that for it the absence of a unique omega is needed as well.
        """
        fails = no_invariant = False
        no_unique_omega = structure is not Structure.REDUCIBLE
        for item in evidence:
            if not self.holds(item, structure):
                return False
            if isinstance(item, NoInvariant):
                no_invariant |= item.invariant_degree == INVARIANT_DEGREE[structure]
            elif isinstance(item, NoTerminatingSeries):
                fails = True
            elif isinstance(item, NoRationalOmega) or item.rule is Rule.NOT_A_SQUARE:
                no_unique_omega = True  # and no more
            else:
                fails = True
        return fails or (no_invariant and no_unique_omega)

    def holds(self, item: Evidence, structure: Structure) -> bool:
        """True if one item of evidence is right, and concerns this structure."""
        self.budget.check()
        if isinstance(item, NecessaryCondition):
            return condition_fails(item, structure, self.points)
        if isinstance(item, NoInvariant):
            return self._no_invariant(item)
        if isinstance(item, NoTerminatingSeries):
            return structure is Structure.REDUCIBLE and self.numbers_of_series == (item.count, 0)
        return self._no_rational_omega(item)

    def _no_invariant(self, item: NoInvariant) -> bool:
        """True if there is no rational form of degree m: no room for one, or dimension 0 modulo the prime that is named."""
        m = item.invariant_degree
        if m not in INVARIANT_DEGREE.values():
            return False
        bounds = room(self.points, m)
        if bounds is None or item.prime is None:
            return bounds is None and item == NoInvariant(m)
        valuations, degree = bounds

        def is_zero(h: Homomorphism) -> bool:
            return self._dimension(h, item.point, m, valuations, degree) == 0

        return item.degree == degree and _under_some(self._at(item.prime), is_zero)

    def dimension_is_at_most(self, bound: int, m: int) -> bool:
        """True if the rational forms of degree m have at most this dimension, as one of the first primes proves."""
        bounds = room(self.points, m)
        if bounds is None:
            return True
        valuations, degree = bounds
        self.budget.check_degree(degree, f"an invariant of degree {m}")

        def is_small(h: Homomorphism) -> bool:
            at = least_ordinary_point(h.keeping_degree(self.S.den))
            return self._dimension(h, at, m, valuations, degree) <= bound

        return _under_some(islice(homomorphisms(self.S.field), _TRIED_FOR_A_DIMENSION), is_small)

    def _dimension(self, h: Homomorphism, at: int, m: int, valuations: list[int], degree: int) -> int:
        self.budget.check()
        factors = [*zip(self.factors, valuations, strict=True)]
        return dimension_modulo(h, self.S, at, m, factors=factors, degree=degree)

    def _no_rational_omega(self, item: NoRationalOmega) -> bool:
        """True if there is no unique rational omega.

        Either no number of zeros is possible, or modulo the prime no expansion of omega at the place is that of a rational
        function.
        """
        counts = self.zero_counts
        if counts is None or counts.largest < 0:
            return item == NoRationalOmega(-1)
        if item.degree != counts.largest or item.prime is None:
            return False
        telling = [point for point in self.points if point.name == item.place and point.tells_solutions_apart]

        def has_none(h: Homomorphism) -> bool:
            for place in telling:
                self.budget.check()
                for root in roots_modulo(place.factor, h)[:1]:  # the least one, if there is any
                    if no_expansion_is_rational(chart(place, self.points, h, root), counts):
                        return True
            return False

        return _under_some(self._at(item.prime), has_none)

    def _at(self, p: int) -> Iterator[Homomorphism]:
        """Homomorphisms of the field modulo a prime that a record names."""
        return homomorphisms_modulo(self.S.field, p) if is_usable_prime(p) else iter(())


def _under_some(homomorphisms: Iterator[Homomorphism], claim: Callable[[Homomorphism], bool]) -> bool:
    """True if the claim holds under one of the homomorphisms; those at bad primes are passed over."""
    for h in homomorphisms:
        try:
            if claim(h):
                return True
        except BadPrimeError:
            continue
    return False

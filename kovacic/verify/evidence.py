"""The negative claims: each piece of evidence is recomputed from S alone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import islice, zip_longest
from typing import Any

from flint import nmod_poly

from kovacic.algebra.modular import (
    BadPrimeError,
    Homomorphism,
    fundamental_system,
    null_space,
    ordinary_point,
    power_series,
    rational_function_from_series,
    simple_roots,
    square_root,
    square_root_series,
    translate,
)
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.decision import Evidence, NecessaryCondition, NoInvariant, NoRationalOmega, Rule, Structure
from kovacic.limits import Budget
from kovacic.verify.local import Point, ZeroCounts, correction, least_valuation, points, zero_counts

_ORDERS = {Structure.TETRAHEDRAL: {1, 2, 3}, Structure.OCTAHEDRAL: {1, 2, 3, 4}, Structure.ICOSAHEDRAL: {1, 2, 3, 5}}
#: The degree of the invariant that the structure would have; together with the uniqueness of omega for reducible groups.
INVARIANT_DEGREE = dict(zip(Structure, (2, 4, 6, 8, 12), strict=True))
#: How far down the sequence of primes a record may lie.
_PRIMES = 4096
#: Primes modulo which a dimension is bounded where no record names one.
_PRIMES_FOR_A_DIMENSION = 3


@dataclass(frozen=True)
class Inspector:
    """Recomputes evidence about y'' = S y."""

    S: RatFunc
    budget: Budget

    @cached_property
    def points(self) -> list[Point]:
        """All singular places, and infinity."""
        return points(self.S, self.budget)

    @property
    def factors(self) -> list[Poly]:
        """The irreducible factors of the denominator of S."""
        return [point.factor for point in self.points[:-1]]

    def excludes(self, structure: Structure, evidence: tuple[Evidence, ...]) -> bool:
        """Does the evidence, recomputed, prove that the group doesn't have this structure?

        A necessary condition that fails does, or the absence of the invariant; but a reducible group has one only where
        omega isn't unique, and NOT_A_SQUARE, like NoRationalOmega, says no more than that there is no unique omega.
        """
        condition, no_invariant, no_unique_omega = False, False, structure is not Structure.REDUCIBLE
        for item in evidence:
            self.budget.check()
            if not self._holds(item, structure):
                return False
            if isinstance(item, NoInvariant):
                no_invariant |= item.invariant_degree == INVARIANT_DEGREE[structure]
            elif isinstance(item, NoRationalOmega) or item.rule is Rule.NOT_A_SQUARE:
                no_unique_omega = True
            else:
                condition = True
        return condition or (no_invariant and no_unique_omega)

    def _holds(self, item: Evidence, structure: Structure) -> bool:
        try:
            if isinstance(item, NecessaryCondition):
                return self._condition_fails(item, structure)
            return self._no_invariant(item) if isinstance(item, NoInvariant) else self._no_rational_omega(item)
        except BadPrimeError:
            return False

    def _condition_fails(self, item: NecessaryCondition, structure: Structure) -> bool:
        rule, reducible = item.rule, structure is Structure.REDUCIBLE
        if rule is Rule.TOO_FEW_BRANCH_POINTS:
            branches = sum(point.factor.degree for point in self.points if point.can_branch)
            return structure is Structure.IMPRIMITIVE and branches < 2
        named = [point for point in self.points if point.name in item.places]
        if not named or len(named) != len(item.places):
            return False
        if rule is Rule.NOT_A_SQUARE:
            return reducible and zero_counts(named) is None
        if rule is Rule.RAMIFIED:
            return reducible and any(point.order > 2 and point.order % 2 for point in named)
        if rule is Rule.LOGARITHM:
            return not reducible and any(point.logarithm for point in named)
        if rule is Rule.IRREGULAR:
            return structure.case == 3 and any(point.order > 2 for point in named)
        differences = [point.difference for point in named]
        return structure.case == 3 and any(d is None or d.denominator not in _ORDERS[structure] for d in differences)

    def _at_prime(self, p: int, claim: Callable[[Homomorphism], bool]) -> bool:
        """Does the claim hold under any homomorphism to F_p among the first ones (over Q(t), several for one prime)?"""
        ground = self.S.field.ground
        for h in islice(self.S.field.homomorphisms(), _PRIMES):
            try:
                if h.p == p and claim(h):
                    return True
            except BadPrimeError:
                continue
            if h.p < p and ground == QQ:
                break
        return False

    def room(self, m: int) -> tuple[list[int], int]:
        """The least valuations of a rational form of degree m at the finite places, and the largest degree of its other factor,
        negative if there is no such form."""
        valuations = [least_valuation(point, m) for point in self.points]
        known = [v for v in valuations if v is not None]
        if len(known) < len(valuations):
            return known, -1
        return known[:-1], m - sum(v * point.factor.degree for v, point in zip(known, self.points, strict=True))

    def _no_invariant(self, item: NoInvariant) -> bool:
        """No rational form of degree m: no room for one, or nullity 0 of the linear system modulo the prime."""
        m = item.invariant_degree
        if m not in INVARIANT_DEGREE.values():
            return False
        valuations, room = self.room(m)
        if room < 0 or item.prime is None:
            return room < 0 and item.prime is None
        return item.degree == room and self._at_prime(
            item.prime, lambda h: self._nullity(h, item.point, m, valuations, room) == 0
        )

    def dimension_is_at_most(self, bound: int, m: int) -> bool:
        """Have the rational forms of degree m at most this dimension, as the nullity modulo one of the first primes proves?"""
        valuations, room = self.room(m)
        if room < 0:
            return True
        self.budget.check_degree(room, f"an invariant of degree {m}")
        for h in islice(self.S.field.homomorphisms(), _PRIMES_FOR_A_DIMENSION):
            try:
                if self._nullity(h, ordinary_point(h.keeping_degree(self.S.den)), m, valuations, room) <= bound:
                    return True
            except BadPrimeError:
                continue
        return False

    def _nullity(self, h: Homomorphism, point: int, m: int, valuations: list[int], room: int) -> int:
        """The dimension modulo p of the forms whose quotient by prod p^v is a polynomial of degree <= room, to some terms."""
        self.budget.check()
        order = room + m + 8
        den = h.keeping_degree(self.S.den)
        if not int(den(point)):
            raise BadPrimeError("the point is singular")
        y1, y2 = fundamental_system(translate(h(self.S.num), point), translate(den, point), order)
        factors = [
            (translate(h.keeping_degree(place.factor), point), -v)
            for place, v in zip(self.points[:-1], valuations, strict=True)
        ]
        scale = power_series([*factors, (nmod_poly([1], h.p), 1)], order)
        # scale * y1^(m-i) y2^i for i = 0, ..., m; their combinations are looked at from the term t^(room+1) on.
        ratio = y2.mul_low(y1.inverse_series_trunc(order), order)
        forms = [scale.mul_low(y1.pow_trunc(m, order), order)]
        for _ in range(m):
            forms.append(forms[-1].mul_low(ratio, order))
        rows = list(zip_longest(*(form.right_shift(room + 1).coeffs() for form in forms), fillvalue=0))
        return len(null_space(rows, m + 1, h.p))

    def _no_rational_omega(self, item: NoRationalOmega) -> bool:
        """No rational omega with the local expansions at the recorded place (invariants of degree 2 excluded elsewhere)."""
        counts = zero_counts(self.points)
        if counts is None:
            return True
        if item.prime is None or item.degree != counts.largest:
            return counts.largest < 0 and item.degree == counts.largest
        place = next((point for point in self.points if point.name == item.place), None)
        if place is None or not place.tells_solutions_apart:
            return False
        return self._at_prime(item.prime, lambda h: self._no_omega_at(place, h, counts))

    def _no_omega_at(self, place: Point, h: Homomorphism, counts: ZeroCounts) -> bool:
        """None of the expansions at the place is that of a rational omega modulo p."""
        root = next(simple_roots(h.keeping_degree(place.factor)), None)
        if root is None:
            return False
        # In the coordinate t of this place; the other end of the chart is x = infinity, or x = 0 for the place at infinity.
        num, den = translate(h(place.num), root), translate(h.keeping_degree(place.den), root)
        M, E = place.localised(h, root)
        origin = self.S.field.poly([0, 1])
        ends = [q.order for q in self.points if q.at_infinity != place.at_infinity and q.factor == origin]
        growth = den.degree() + max([1, *((order + 1) // 2 for order in ends)]) - 2
        p, nu = h.p, max(place.order, 2) // 2
        bounds = counts.by_exponent(place)
        for start in _first_terms(place, M, E):
            self.budget.check()
            degree = counts.largest
            if bounds is not None:
                possible = [n for e, n in bounds if (int(start[nu - 1]) * e.denominator - e.numerator) % p == 0]
                if not possible:
                    continue
                degree = max(possible)
            count = 2 * degree + growth + 2
            u = correction(M, E, start, nu, count)
            series = start + u.derivative().mul_low(u.inverse_series_trunc(count), count).left_shift(nu)
            if _is_rational(series.truncate(count), num, den, nu, degree, growth):
                return False
        return True


def _first_terms(place: Point, M: Any, E: Any) -> list[Any]:
    """The first nu terms of t^nu omega, the last of them the exponent, for every local solution with a rational omega."""
    nu, p, difference = max(place.order, 2) // 2, E.modulus(), place.difference
    s, half = M.mul_low(E.inverse_series_trunc(nu), nu), pow(2, -1, p)
    if nu > 1 and not s[0]:
        raise BadPrimeError("the leading coefficient at an irregular place vanishes")
    root = square_root(int(s[0]) if nu > 1 else 1 + 4 * int(s[0]), p)
    if root is None:
        return []
    if nu > 1:
        middle = nmod_poly([nu * half], p).left_shift(nu - 1)
        return [square_root_series(s, nu, r) + middle for r in (root, -root % p)]
    if difference is not None:
        root = difference.numerator * pow(difference.denominator, -1, p)
    return [nmod_poly([(1 + sign * root) * half], p) for sign in ((1,) if place.logarithm else (1, -1))]


def _is_rational(series: Any, num: Any, den: Any, nu: int, degree: int, growth: int) -> bool:
    """Is there omega = A/(den P) with this expansion of t^nu omega, deg P <= degree and deg A <= degree + growth?

    The only candidate must solve the Riccati equation of num/den.
    """
    top = degree + growth
    order = top + degree + 2
    found = rational_function_from_series(den.right_shift(nu).mul_low(series, order), order, top)
    if found is None:
        return False
    A, B = found[0], den * found[1]
    return found[1].degree() <= degree and bool(den * (A.derivative() * B - A * B.derivative() + A * A) == num * B * B)

"""The negative claims: each piece of evidence is recomputed from S alone."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import islice

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import Evidence, NecessaryCondition, NoInvariant, NoRationalOmega, Rule, Structure
from kovacic.limits import Budget
from kovacic.verify.conditions import condition_fails
from kovacic.verify.forms import dimension_modulo, ordinary_point, room
from kovacic.verify.local import Point, points
from kovacic.verify.omega import chart, no_expansion_is_rational
from kovacic.verify.primes import (
    BadPrimeError,
    Homomorphism,
    homomorphisms,
    homomorphisms_modulo,
    is_usable_prime,
    roots_modulo,
)
from kovacic.verify.zeros import ZeroCounts, zero_counts

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

    @property
    def factors(self) -> list[Poly]:
        """The irreducible factors of the denominator of S."""
        return [point.factor for point in self.points[:-1]]

    def excludes(self, structure: Structure, evidence: tuple[Evidence, ...]) -> bool:
        """True if the evidence, recomputed, proves that the group doesn't have this structure.

        A necessary condition that fails does, or the absence of the invariant; but a reducible group has one only where
        omega isn't unique, so that for it the absence of a unique omega is needed as well.
        """
        if not all(self.holds(item, structure) for item in evidence):
            return False
        rules = {item.rule for item in evidence if isinstance(item, NecessaryCondition)}
        if rules - {Rule.NOT_A_SQUARE}:
            return True
        # NOT_A_SQUARE, like NoRationalOmega, says no more than that there is no unique omega
        no_unique_omega = bool(rules) or any(isinstance(item, NoRationalOmega) for item in evidence)
        m = INVARIANT_DEGREE[structure]
        no_invariant = any(isinstance(item, NoInvariant) and item.invariant_degree == m for item in evidence)
        return no_invariant and (no_unique_omega or structure is not Structure.REDUCIBLE)

    def holds(self, item: Evidence, structure: Structure) -> bool:
        """True if one item of evidence is right, and concerns this structure."""
        self.budget.check()
        if isinstance(item, NecessaryCondition):
            return condition_fails(item, structure, self.points)
        if isinstance(item, NoInvariant):
            return self._no_invariant(item)
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
            at = ordinary_point(h.keeping_degree(self.S.den))
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

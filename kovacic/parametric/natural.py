"""Statements with a natural number in them: "b = 2 d + 2 for a natural number d, and Delta_d(a, c) = 0".

The exponents leave finitely many polynomials over Q(t), and d, the degree of P (or the number of zeros of an invariant), is a
natural root of one of them.  Where d is given, P exists exactly where a determinant Delta_d vanishes: that of a banded system
for its coefficients.  There are infinitely many of them; each is computed on demand, and at a point with a natural root the
equation itself is decided.

References: P. Acosta-Humanez & D. Blazquez-Sanz, DCDS-B 10 (2008); A. V. Turbiner, Comm. Math. Phys. 118 (1988) 467.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Collection, Iterator
from contextlib import suppress
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property, lru_cache
from random import Random

from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.decision import Status, Structure
from kovacic.engine.decide import decide
from kovacic.engine.places import analyse
from kovacic.errors import LimitExceeded
from kovacic.limits import Budget, Limits
from kovacic.parametric.assumptions import Assumptions
from kovacic.parametric.exponents import PolynomialSolution, form_conditions, solution_of_degree, with_degree
from kovacic.parametric.formulas import equation_written, shown, text_of, written
from kovacic.parametric.functions import (
    Coset,
    Point,
    degrees,
    irreducible_factors,
    over_parameters,
    union,
)
from kovacic.parametric.integers import LETTERS, free_letter, rational_roots
from kovacic.parametric.ranks import RankConditions
from kovacic.parametric.restriction import Hypersurface, hypersurface
from kovacic.parametric.spectra import Notation, alternatives
from kovacic.parametric.statements import Statement

#: The largest number that is tried for an example.
_EXAMPLES = 3
#: For the decision at one point.
_SECONDS = 60.0
#: Characters up to which the equations for d are written out.
_WRITTEN_OUT = 300


@dataclass(frozen=True)
class Determinant:
    """Delta_d where the exponents give d: P exists exactly where it vanishes.

    `exponents` vanishes where d is the degree.  `factors` are the irreducible factors of Delta_d: none where it is 1, and P
    exists nowhere.  Where there are more equations than unknowns, `system` has the polynomials that all have to vanish.  Both
    are None where they weren't computed.
    """

    exponents: FunctionPoly
    factors: tuple[FunctionPoly, ...] | None = None
    system: tuple[FunctionPoly, ...] | None = None

    def rewritten(self, change: Callable[[FunctionPoly], FunctionPoly]) -> Determinant:
        """The same about other parameters, which `change` puts into its polynomials."""
        factors, system = (
            functions and tuple(g for f in functions for g in (irreducible_factors(change(f)) if f else [f]))
            for functions in (self.factors, self.system)
        )
        return replace(self, factors=factors, system=system)

    def __str__(self) -> str:
        if self.factors is None:
            return "not computed" if self.system is None else f"({', '.join(map(shown, self.system))})"
        return " * ".join(f"({shown(f)})" if len(self.factors) > 1 else shown(f) for f in self.factors) or "1"


@dataclass(frozen=True)
class Natural(Statement):
    """For a natural number that the exponents allow, an invariant of degree m with so many zeros exists.

    The number is a root of one of the `factors`.  m = 1 is a solution with a rational omega, whose zeros are those of P.
    `structure` is that of the group where the invariant exists, tetrahedral standing for every primitive finite one.
    """

    S: RatFunc
    m: int
    factors: tuple[FunctionPoly, ...]
    structure: Structure
    letter: str = field(default="d", compare=False)
    fixed: tuple[str, ...] = field(default=(), compare=False)

    def avoiding(self, names: Collection[str], fixed: Collection[str] = ()) -> Statement:
        return replace(self, letter=free_letter(names, f"d{LETTERS}"), fixed=tuple(fixed))

    def rewritten(self, change: Callable[[FunctionPoly], FunctionPoly]) -> Statement:
        S = RatFunc(change(over_parameters(self.S.num)), change(over_parameters(self.S.den)))
        return replace(self, S=S, factors=tuple(map(change, self.factors)))

    def numbers_at(self, point: Point) -> list[int]:
        """The natural numbers that the exponents allow at a point."""
        roots = {root for factor in self.factors for root in rational_roots(point.at(factor))}
        return sorted(int(root) for root in roots if root.denominator == 1 and root >= 0)

    def _holds(self, point: Point) -> bool:
        """Decided by the engine where the exponents allow a natural number: `LimitExceeded` where that takes too long."""
        if not self.numbers_at(point):
            return False
        return self._is_shown_by(_structure_at(self.S, point))

    def _is_shown_by(self, structure: Structure | None) -> bool:
        return structure is self.structure or (structure is not None and structure.case == self.structure.case == 3)

    def _given(self, number: int) -> Iterator[tuple[FunctionPoly, Hypersurface, RatFunc]]:
        """Where the exponents give the number: a polynomial, its zeros, and S there."""
        for exponents in union(irreducible_factors(factor(Fraction(number))) for factor in self.factors):
            surface = hypersurface(exponents)
            with suppress(ZeroDivisionError):
                yield exponents, surface, surface.restricted(self.S)

    def determinants(self, number: int) -> list[Determinant]:
        """Delta for one natural number, for each way in which the exponents give it."""
        determinants: list[Determinant] = []
        for exponents, surface, S in self._given(number):
            zero, m, found = exponents - exponents, self.m, [RankConditions(complete=False)]
            if S.field == QQ:
                exists = self._is_shown_by(decide(S, Budget(), certify=False).structure)
                found = [RankConditions((zero,) if exists else ())]
            elif isinstance(S.num, FunctionPoly):
                problem = analyse(S, Budget())
                of_degree = with_degree(problem, number) if m == 1 else [(None, form_conditions(problem, m))]
                found = found if of_degree is None else [c for _, c in of_degree]
            for c in found:
                factors = (zero,) if c.deficient and m == 1 else c.polynomials if c.complete else None
                determinant = Determinant(exponents, factors, c.system or None if factors is None else None)
                determinants.append(determinant.rewritten(surface.back) if surface.curve else determinant)
        return determinants

    def solutions(self, variable: str, number: int | None) -> tuple[PolynomialSolution, ...]:
        """Solutions with a P of this degree, for each way in which the exponents give it and P can exist."""
        found: list[PolynomialSolution | None] = []
        if number is None or self.m > 1:
            return ()
        for exponents, surface, S in self._given(number):
            if not isinstance(S.num, FunctionPoly) or surface.curve:
                continue
            problem = analyse(S, Budget())
            for choice, c in with_degree(problem, number) or ():
                one_of = " = 0 or ".join(map(shown, c.polynomials))
                conditions = [*map(shown, c.system)] if c.system and not c.complete else [one_of] if one_of else []
                if c.deficient or conditions:
                    zero = [] if c.deficient else [f"{condition} = 0" for condition in conditions]
                    where = ", ".join([equation_written(exponents), *zero])
                    found.append(solution_of_degree(problem, choice, number, variable, where))
        return tuple(solution for solution in found if solution is not None)

    def shown_determinant(self, number: int) -> str:
        """In one line: one polynomial where it is the same for all exponents that give the number."""
        found, places = defaultdict[str, dict[str, None]](dict), defaultdict[str, list[str]](list)
        for determinant in self.determinants(number):
            found[equation_written(determinant.exponents)][str(determinant)] = None
        for where, texts in found.items():
            places[" or ".join(texts)].append(where)
        values = [f"{value} where {' or '.join(where)}" for value, where in places.items()]
        text = ", ".join(values if len(values) > 1 else places)
        return f"Delta_{number} = {text if len(text) <= _WRITTEN_OUT else text[:_WRITTEN_OUT] + '...'}"

    def sample(self, random: Random) -> list[FunctionPoly]:
        factor = random.choice(self.factors)
        if not any(degrees(factor)):
            return []
        number = random.randint(0, _EXAMPLES)
        found = [d for d in self.determinants(number) if d.factors or d.system] if self.m == 1 else []
        if not found:
            return [over_parameters(factor(Fraction(number)))]
        chosen = random.choice(found)
        return [chosen.exponents, *([random.choice(chosen.factors)] if chosen.factors else chosen.system or ())]

    def decided(self, assumptions: Assumptions) -> bool | None:
        return None if self._possible(assumptions) else False

    def narrowed(self, assumptions: Assumptions) -> Statement:
        return replace(self, factors=self._possible(assumptions))

    def _possible(self, assumptions: Assumptions) -> tuple[FunctionPoly, ...]:
        """The equations for d that can have a natural root: not those that are positive for all d >= 0."""
        natural = [Coset(Fraction(0), Fraction(1))]
        return tuple(
            factor
            for factor in self.factors
            if not (factor.degree == 1 and assumptions.meets_classes(-factor[0] / factor[1], natural) is False)
            and not (
                assumptions.is_positive(over_parameters(factor[0]))
                and all(assumptions.is_positive(over_parameters(c), or_zero=True) for c in factor if c)
            )
        )

    @cached_property
    def written(self) -> str:
        m, factors, d = self.m, self.factors, self.letter
        if not any(k for factor in factors for k in degrees(factor)):
            numbers = " or ".join(written(-f[0] / f[1]) for f in factors)
            what = "a solution" if m == 1 else f"an invariant of degree {m}"
            return f"{what} with {numbers} zero{'s' * (numbers != '1')} exists"
        which = alternatives(factors, Notation(d, self.fixed))
        if len(text_of(which)) > _WRITTEN_OUT:
            which = f"the exponents allow a natural number `{d}` of zeros"
        return f"{which}, `{d} in N`, and `Delta_{d} = 0`{'' if m == 1 else f' for an invariant of degree {m}'}"


@lru_cache(maxsize=64)
def _structure_at(S: RatFunc, point: Point) -> Structure | None:
    """What the engine says at a point, which several statements ask for."""
    decision = decide(point.restricted(S), Budget(Limits(seconds=_SECONDS)), certify=False)
    if decision.status is Status.UNDECIDED:
        raise LimitExceeded(str(decision.undecided), limit="seconds")
    return decision.structure

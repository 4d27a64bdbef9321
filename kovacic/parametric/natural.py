"""Statements with a natural number in them: "b = 2 d + 2 for a natural number d, and Delta_d(a, c) = 0".

The exponents leave finitely many polynomials over Q(t), and d, the degree of P (or the number of zeros of an invariant), is a
natural root of one of them.  For a given d, P exists exactly where the determinant Delta_d of a banded system for its
coefficients vanishes.  Each of these infinitely many determinants is computed on demand; at a point with a natural root the
entries are numbers, and the rank decides.

References: P. Acosta-Humanez & D. Blazquez-Sanz, DCDS-B 10 (2008); A. V. Turbiner, Comm. Math. Phys. 118 (1988) 467.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property, lru_cache
from itertools import chain
from random import Random

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.algebra.recurrence import polynomial_solution
from kovacic.decision import NoInvariant, Structure
from kovacic.engine.invariants import invariants
from kovacic.engine.places import analyse
from kovacic.errors import LimitExceeded
from kovacic.limits import Budget
from kovacic.parametric import prose
from kovacic.parametric.assumptions import Assumptions
from kovacic.parametric.claims import (
    INTEGERS,
    NATURALS,
    NO_CONSTANT,
    AnyOf,
    Claim,
    DegreeBySum,
    DegreeExists,
    EquationFor,
    IsZero,
    ParameterPoint,
    degrees,
    irreducible_factors,
    over_parameters,
    polynomial_factors,
    union,
    without_parameters,
)
from kovacic.parametric.exponents import (
    NOT_COMPUTED,
    NOWHERE,
    RankConditions,
    choices_of_degree,
    conditions_of_degree,
    degrees_of_solutions,
    form_conditions,
    zeros_of_forms,
)
from kovacic.parametric.formulas import expanded_form, in_sum
from kovacic.parametric.integers import natural_root
from kovacic.parametric.prose import Words
from kovacic.parametric.restriction import Hypersurface, everywhere, hypersurface, in_lowest_powers
from kovacic.parametric.solutions import PolynomialSolution, solution_of_degree
from kovacic.parametric.statements import NEVER, Setting, Statement
from kovacic.writing.formula import free_name

#: The largest d for which the determinants of conditions with a natural number d are computed unasked, and sampled.
DEFAULT_DEGREE = 2
#: What is said of a Delta_d that would need too large an extension, or too much work.
WITHOUT_FORMULA = "not written out (at given values of the parameters its linear system decides)"


@dataclass(frozen=True)
class Determinant:
    """Delta_d where the exponents give d: P exists exactly where it vanishes.

    `exponents` vanishes where d is the degree.  `factors` are the irreducible factors of Delta_d.  There are none if it is 1,
    and P exists nowhere, or, with more equations than unknowns, only where all polynomials in `system` vanish.  `factors` is
    None without a formula in the parameters.
    """

    exponents: FunctionPoly
    factors: tuple[FunctionPoly, ...] | None = None
    system: tuple[FunctionPoly, ...] = ()

    @property
    def is_zero(self) -> bool:
        """True if P exists wherever d is its degree."""
        return self.factors is not None and not all(self.factors)

    def __str__(self) -> str:
        if self.factors is None:
            return WITHOUT_FORMULA
        parts = sorted(map(expanded_form, self.factors), key=len)
        if self.system:
            parts.append(f"({', '.join(map(expanded_form, self.system))})")
        return "*".join(map(in_sum, parts) if len(parts) > 1 else parts) or "1"


@dataclass(frozen=True)
class Natural(Statement):
    """For a natural number that the exponents allow, an invariant of degree m with that number of zeros exists.

    The number is a root of one of the `factors`, None if there are too many sums of exponents to list them.  m = 1 stands for
    a solution with a rational omega, whose zeros are those of P.
    """

    S: RatFunc
    m: int
    factors: tuple[FunctionPoly, ...] | None
    setting: Setting = field(default=Setting(), compare=False)
    #: The algebraic number among the parameters, if there is one: that of the setting, but compared.
    constant: ParameterPoint = NO_CONSTANT

    @property
    def structure(self) -> Structure:
        """The structure of the group where the invariant exists and no earlier region contains the point."""
        return {4: Structure.IMPRIMITIVE, 12: Structure.TETRAHEDRAL}.get(self.m, Structure.REDUCIBLE)

    def avoiding(self, setting: Setting) -> Statement:
        return replace(self, setting=setting, constant=setting.assumptions.constant)

    @property
    def letter(self) -> str:
        return free_name(self.setting.names, *"dnmkjl")  # no N, the set

    @property
    def equations(self) -> tuple[FunctionPoly, ...]:
        """The factors; 0, which says nothing, if they aren't listed."""
        return (0 * over_parameters(self.S.num),) if self.factors is None else self.factors

    def rewritten(self, change: Callable[[FunctionPoly], FunctionPoly]) -> Statement:
        den = change(over_parameters(self.S.den))
        # A change within the field reduces by a relation, under which S stays the same, but with a free constant no square.
        S = self.S if den.field == self.S.field else RatFunc(change(over_parameters(self.S.num)), den)
        if self.factors is None:
            return replace(self, S=S)
        return replace(self, S=S, factors=tuple(union(map(polynomial_factors, map(change, self.factors)))))

    def numbers_at(self, point: ParameterPoint) -> list[int]:
        """The natural numbers that the listed exponents allow at a point."""
        roots = chain.from_iterable(NATURALS.roots_of(point.at(factor)) for factor in self.factors or ())
        return sorted(map(int, {*roots}))

    def _holds(self, point: ParameterPoint) -> bool:
        """True if the rank of a system at the point says so."""
        if point.field.ground != QQ:
            return False
        numbers = self.numbers_at(point)
        return (self.factors is None or len(numbers) > 0) and self.exists(point, numbers)

    def exists(self, point: ParameterPoint, numbers: Sequence[int]) -> bool:
        """True if P has one of these degrees at the point, or an invariant of degree m exists there."""
        return _exists(point.restricted(self.S), self.m, () if self.m > 1 else tuple(numbers))

    def determinants(self, number: int) -> tuple[Determinant, ...]:
        """Delta_d for one natural number d, for each way in which the exponents give it."""
        return _determinants(self, number)

    def given(self, number: int) -> Iterator[tuple[FunctionPoly, Hypersurface, RatFunc]]:
        """Each function at whose zeros the exponents give the number, its zeros (all values for 0), and S there."""
        fixed = self.constant.names
        equations = [over_parameters(factor(Fraction(number))) for factor in self.factors or ()]
        for exponents in union(irreducible_factors(value) if value else [value] for value in equations):
            if exponents and not any(degrees(exponents)[: len(exponents.field.names) - len(fixed)]):
                continue  # a number other than 0
            surface = hypersurface(exponents, fixed) if exponents else everywhere(exponents.field, self.constant)
            with suppress(ZeroDivisionError):
                S = surface.restricted(self.S)
                if isinstance(S.field, FunctionField) and S.field.names[-1:] == self.constant.names:
                    S = everywhere(S.field, self.constant).restricted(S)
                yield exponents, surface, S

    def solutions(self, variable: str, number: int | None) -> tuple[PolynomialSolution, ...]:
        """Solutions with a P of this degree, for each way in which the exponents give it and P can exist."""
        if number is None:
            return ()
        found: dict[PolynomialSolution | None, None] = {}
        for exponents, surface, S in self.given(number):
            if surface.curve:
                continue
            for choice in choices_of_degree(analyse(S, Budget()), number) or ():
                # The equations for P may exclude one another: b = 6 and b = 9/2.
                if S.field.ground == QQ or choice.conditions(number, S.field) != NOWHERE:
                    found[solution_of_degree(choice, number, variable, exponents)] = None
        return tuple(filter(None, found))

    def values(self, number: int) -> dict[str, Words]:
        """The values of Delta_d for a number d, each with the equations for the exponents under which it has this value.

        There are no equations if it has this value everywhere.  If one Delta_d is 0, no other one says more.
        """
        found: dict[str, dict[IsZero, None]] = {}
        determinants = self.determinants(number)
        where_zero = {one.exponents for one in determinants if one.is_zero}
        for determinant in determinants:
            if determinant.exponents in where_zero and not determinant.is_zero:
                continue
            places = found.setdefault(str(determinant), {})
            if determinant.exponents:
                places[IsZero(determinant.exponents)] = None
        return {value: prose.sentence(AnyOf(tuple(places))) for value, places in found.items()}

    def sample(self, random: Random) -> list[FunctionPoly]:
        if not self.factors:
            return []
        factor = random.choice(self.factors)
        constant = without_parameters(factor)
        known = [] if constant is None else NATURALS.roots_of(constant)
        number = int(next(iter(known), random.randint(0, DEFAULT_DEGREE)))
        # For invariants the numbers of zeros are enough.
        found = [one for one in self.determinants(number) if one.factors or one.system] if self.m == 1 else []
        if not found:
            return [*filter(None, [over_parameters(factor(Fraction(number)))])]
        chosen = random.choice(found)
        zeros = [random.choice(chosen.factors)] if chosen.factors else chosen.system
        return [*filter(None, [chosen.exponents, *zeros])]

    def under(self, assumptions: Assumptions) -> Statement:
        """The statement with those equations for d that can have a natural root."""
        if self.factors is None:
            return self
        found: list[FunctionPoly] = []
        for factor in self.factors:
            if factor.degree == 1 and assumptions.meets_classes(-factor[0] / factor[1], INTEGERS) is False:
                continue
            # A polynomial with a positive constant term and no negative coefficient is positive for all d >= 0.
            if not all(assumptions.is_positive(c, or_zero=k > 0) for k, c in enumerate(factor)):
                found.append(factor)
        return replace(self, factors=tuple(found)) if found else NEVER

    @cached_property
    def claim(self) -> Claim:
        # Equations for the number, each solved for a parameter, or sums of exponents if one with parameters can't be.
        listed = natural_root(self.factors or (), self.letter, self.setting)
        unsolved = [part.equation for part in listed.parts if isinstance(part, EquationFor)]
        degree: Claim = listed
        numbers = None
        if self.factors is None or any(any(degrees(equation)) for equation in unsolved):
            problem = analyse(self.S, Budget())
            numbers = degrees_of_solutions(problem) if self.m == 1 else zeros_of_forms(problem, self.m)
        # d + 1 = +-sqrt(b)/2 +- c, or d = 6 + j*a + k*b with integers j and k.
        if numbers is not None and numbers.roots:
            has_zero = self.factors is None or problem.field.poly([-numbers.constant, 1]) in self.factors
            if numbers.field == problem.field:
                squares = (in_lowest_powers(over_parameters(root.square), self.constant) for root in numbers.roots)
                pairs = zip(squares, numbers.roots, strict=True)
                numbers = replace(numbers, roots=tuple(root._replace(square=square) for square, root in pairs))
            letters = list[str]()
            for _ in () if numbers.only_signs else numbers.roots:
                letters.append(free_name([self.letter, *self.setting.names, *letters], *"jkmnl"))
            degree = DegreeBySum(self.letter, numbers, tuple(letters), has_zero)
        return DegreeExists(self.letter, degree, self.m, self.exists)


@lru_cache(maxsize=64)
def _determinants(statement: Natural, number: int) -> tuple[Determinant, ...]:
    """The determinants for one number, computed once for samples, lists and theorems."""
    found: dict[Determinant, None] = {}
    for exponents, surface, S in statement.given(number):
        has_free_constant = bool(statement.constant.names and exponents) and isinstance(surface.field, AlgebraicField)
        if S.field.ground == QQ:  # no parameter is left
            choices = [RankConditions(deficient=_exists(S, statement.m, (number,)))]
        elif statement.m > 1:
            choices = [form_conditions(analyse(S, Budget()), statement.m)]
        elif has_free_constant:
            choices = [NOT_COMPUTED]
        else:
            choices = conditions_of_degree(analyse(S, Budget()), number)
        for conditions in choices:
            determinant = Determinant(exponents)
            if conditions.deficient:
                determinant = Determinant(exponents, (0 * exponents,))
            elif conditions.system is not None:  # in the parameters that were given
                factors, system = (
                    [in_lowest_powers(surface.back(one, exponents.field), statement.constant) for one in several]
                    for several in (conditions.polynomials, conditions.system)
                )
                irreducible = tuple(chain.from_iterable(map(irreducible_factors, factors)))
                determinant = Determinant(exponents, irreducible, tuple(system))
            found[determinant] = None
    return tuple(found)


@lru_cache(maxsize=256)
def _exists(S: RatFunc, m: int, numbers: tuple[int, ...]) -> bool:
    """True if P can have one of these degrees, or an invariant of degree m > 1 exists; cached for several statements."""
    problem = analyse(S, Budget())
    if m > 1:
        return not isinstance(invariants(problem, m), NoInvariant)
    for number in numbers:
        chosen = choices_of_degree(problem, number)
        if chosen is None:
            raise LimitExceeded(f"the exponents of y'' = ({S}) y need too large an extension", limit="degree")
        if any(polynomial_solution(*exponents.operator, number) is not None for exponents in chosen):
            return True
    return False

"""Statements with a natural number in them: "b = 2 d + 2 for a natural number d, and Delta_d(a, c) = 0".

The exponents leave finitely many polynomials over Q(t), and d, the degree of P (or the number of zeros of an invariant), is a
natural root of one of them.  Where d is given, P exists exactly where a determinant Delta_d vanishes: that of a banded system
for its coefficients.  There are infinitely many of them; each is computed on demand, and at a point with a natural root the
system has numbers for entries, and its rank decides.

References: P. Acosta-Humanez & D. Blazquez-Sanz, DCDS-B 10 (2008); A. V. Turbiner, Comm. Math. Phys. 118 (1988) 467.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property, lru_cache
from random import Random
from typing import NamedTuple

from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.decision import Structure
from kovacic.engine.places import Problem, analyse
from kovacic.equation import parameters_of
from kovacic.errors import LimitExceeded
from kovacic.limits import Budget
from kovacic.parametric.assumptions import Assumptions
from kovacic.parametric.exponents import (
    Numbers,
    choices_of_degree,
    conditions_of_degree,
    degrees_of_solutions,
    form_conditions,
    has_form,
    has_solution,
    is_too_large,
    zeros_of_forms,
)
from kovacic.parametric.formulas import equation_written, root_written, shown, text_of, written
from kovacic.parametric.functions import (
    Coset,
    ParameterPoint,
    degrees,
    irreducible_factors,
    over_parameters,
    union,
)
from kovacic.parametric.integers import LETTERS, free_letter, rational_roots
from kovacic.parametric.ranks import RankConditions
from kovacic.parametric.restriction import Hypersurface, hypersurface
from kovacic.parametric.solutions import PolynomialSolution, solution_of_degree
from kovacic.parametric.spectra import Notation, alternatives, families
from kovacic.parametric.statements import Statement

#: The largest number that is tried for an example.
_EXAMPLES = 3
#: Characters up to which Delta_d and the equations for d are written out, and those for the zeros of an invariant.
_WRITTEN_OUT = 300
_EQUATIONS = 100
#: What is said of Delta_d where the exponents need too large an extension.
NO_FORMULA = "no polynomial, as the exponents are irrational: at each point the rank of its linear system decides"


@dataclass(frozen=True)
class Determinant:
    """Delta_d where the exponents give d: P exists exactly where it vanishes.

    `exponents` vanishes where d is the degree.  `factors` are the irreducible factors of Delta_d: none where it is 1, and P
    exists nowhere, or only where all of the polynomials in `system` vanish, since there are more equations than unknowns.
    `factors` is None where it has no formula in the parameters: the exponents need too large an extension of their field.
    """

    exponents: FunctionPoly
    factors: tuple[FunctionPoly, ...] | None = None
    system: tuple[FunctionPoly, ...] = ()

    def rewritten(self, change: Callable[[FunctionPoly], FunctionPoly]) -> Determinant:
        """With other functions in the place of the parameters."""
        if self.factors is None:
            return self
        factors: list[FunctionPoly] = []
        for factor in self.factors:
            if factor:
                factors += irreducible_factors(change(factor))
            else:
                factors.append(factor)
        return replace(self, factors=tuple(factors), system=tuple(map(change, self.system)))

    def holds(self, point: ParameterPoint) -> bool:
        """Is d the degree at the point, and does P exist there?

        Parameters
        ----------
        point : ParameterPoint
            What `Conditions.point` returned.

        Returns
        -------
        bool
            True where both hold.
        """
        if self.factors is None or point.at(self.exponents):
            return False
        in_system = bool(self.system) and not any(point.at(function) for function in self.system)
        return in_system or any(not point.at(factor) for factor in self.factors)

    def __str__(self) -> str:
        if self.factors is None:
            return NO_FORMULA
        parts = sorted(map(shown, self.factors), key=len)
        if len(parts) > 1 or self.system:
            parts = [_in_parentheses(part) for part in parts]
        if self.system:
            parts.append(f"({', '.join(map(shown, self.system))})")
        return "*".join(parts) or "1"


@dataclass(frozen=True)
class Natural(Statement):
    """For a natural number that the exponents allow, an invariant of degree m with so many zeros exists.

    The number is a root of one of the `factors`, None where there are too many sums of exponents to list them.  m = 1 is a
    solution with a rational omega, whose zeros are those of P.  `structure` is that of the group where the invariant exists
    and no structure before it has been found.
    """

    S: RatFunc
    m: int
    factors: tuple[FunctionPoly, ...] | None
    structure: Structure
    letter: str = field(default="d", compare=False)
    fixed: tuple[str, ...] = field(default=(), compare=False)

    def avoiding(self, names: Collection[str], fixed: Collection[str] = ()) -> Statement:
        return replace(self, letter=free_letter(names, f"d{LETTERS}"), fixed=tuple(fixed))

    def rewritten(self, change: Callable[[FunctionPoly], FunctionPoly]) -> Statement:
        S = RatFunc(change(over_parameters(self.S.num)), change(over_parameters(self.S.den)))
        if self.factors is None:
            return replace(self, S=S)
        return replace(self, S=S, factors=tuple(map(change, self.factors)))

    def numbers_at(self, point: ParameterPoint) -> list[int]:
        """The natural numbers that the exponents allow at a point, as far as they are listed."""
        roots: set[Fraction] = set()
        for factor in self.factors or ():
            roots.update(rational_roots(point.at(factor)))
        return sorted(int(root) for root in roots if root.denominator == 1 and root >= 0)

    def _holds(self, point: ParameterPoint) -> bool:
        """Decided by the rank of the systems at the point."""
        numbers = self.numbers_at(point)
        if self.factors is not None and not numbers:
            return False
        S = point.restricted(self.S)
        if self.m > 1:
            return _has_form(S, self.m)
        return any(_has_solution(S, number) for number in numbers)

    def _given(self, number: int) -> Iterator[_Given]:
        """Where the exponents give the number."""
        for exponents in union(irreducible_factors(factor(Fraction(number))) for factor in self.factors or ()):
            surface = hypersurface(exponents)
            with suppress(ZeroDivisionError):
                yield _Given(exponents, surface, surface.restricted(self.S))

    def determinants(self, number: int) -> list[Determinant]:
        """Delta for one natural number, for each way in which the exponents give it."""
        found: list[Determinant] = []
        for exponents, surface, S in self._given(number):
            if self.m == 1 and is_too_large(S.field):
                found.append(Determinant(exponents))
                continue
            problem = analyse(S, Budget())
            for conditions in self._conditions(problem, number):
                determinant = _determinant(exponents, conditions, deficient=conditions.deficient and self.m == 1)
                determinant = determinant.rewritten(_back(surface, exponents.field))
                if determinant not in found:
                    found.append(determinant)
        return found

    def _conditions(self, problem: Problem, number: int) -> list[RankConditions]:
        """One for each choice of exponents."""
        if self.m > 1:
            return [form_conditions(problem, self.m)]
        if problem.field.ground == QQ:  # no parameter is left
            return [RankConditions(deficient=_has_solution(problem.S, number))]
        found = conditions_of_degree(problem, number)
        if found is None:
            return [RankConditions(system=None)]
        return found

    def solutions(self, variable: str, number: int | None) -> tuple[PolynomialSolution, ...]:
        """Solutions with a P of this degree, for each way in which the exponents give it and P can exist."""
        if number is None or self.m > 1:
            return ()
        found: dict[PolynomialSolution, None] = {}
        for exponents, surface, S in self._given(number):
            if surface.curve or is_too_large(S.field):
                continue
            for choice in choices_of_degree(analyse(S, Budget()), number) or ():
                solution = solution_of_degree(choice, number, variable, exponents)
                if solution is not None:
                    found[solution] = None
        return tuple(found)

    def shown_determinant(self, number: int) -> str:
        """In one line: one polynomial where it is the same for all exponents that give the number."""
        values = self._values_of_determinants(number)
        texts = [*values]
        if len(values) > 1:
            texts = [f"{value} where {' or '.join(wheres)}" for value, wheres in values.items()]
        text = ", ".join(texts)
        if len(text) > _WRITTEN_OUT:
            text = f"{text[:_WRITTEN_OUT]}..."
        return f"Delta_{number} = {text}"

    def _values_of_determinants(self, number: int) -> dict[str, list[str]]:
        """What Delta is, each with the equations for the exponents where it is that."""
        at_exponents: dict[str, dict[str, None]] = {}
        for determinant in self.determinants(number):
            where = equation_written(determinant.exponents)
            at_exponents.setdefault(where, {})[str(determinant)] = None
        values: dict[str, list[str]] = {}
        for where, texts in at_exponents.items():
            values.setdefault(" or ".join(texts), []).append(where)
        return values

    def sample(self, random: Random) -> list[FunctionPoly]:
        if not self.factors:
            return []
        factor = random.choice(self.factors)
        if not any(degrees(factor)):
            return []
        number = random.randint(0, _EXAMPLES)
        found = self._that_can_vanish(number)
        if not found:
            return [over_parameters(factor(Fraction(number)))]
        chosen = random.choice(found)
        if chosen.factors:
            return [chosen.exponents, random.choice(chosen.factors)]
        return [chosen.exponents, *chosen.system]

    def _that_can_vanish(self, number: int) -> list[Determinant]:
        """The determinants that aren't 1, and have a formula; none for invariants, of which the numbers of zeros say enough."""
        if self.m > 1:
            return []
        return [determinant for determinant in self.determinants(number) if determinant.factors or determinant.system]

    def decided(self, assumptions: Assumptions) -> bool | None:
        if self._possible(assumptions) == ():
            return False
        return None

    def narrowed(self, assumptions: Assumptions) -> Statement:
        return replace(self, factors=self._possible(assumptions))

    def _possible(self, assumptions: Assumptions) -> tuple[FunctionPoly, ...] | None:
        """The equations for d that can have a natural root."""
        if self.factors is None:
            return None
        return tuple(factor for factor in self.factors if not _has_no_natural_root(factor, assumptions))

    @cached_property
    def written(self) -> str:
        factors = self.factors
        if factors is not None and not any(any(degrees(factor)) for factor in factors):
            return self._with_these_numbers([-f[0] / f[1] for f in factors])
        text = f"{self._numbers_written()}, `{self.letter} in N`, and `Delta_{self.letter} = 0`"
        if self.m == 1:
            return text
        return f"{text} for an invariant of degree {self.m}"

    def _with_these_numbers(self, zeros: Sequence[Poly]) -> str:
        """That P, or an invariant, with so many zeros exists, where there are no parameters in the equations."""
        numbers = " or ".join(written(over_parameters(number)) for number in zeros)
        what = "a solution" if self.m == 1 else f"an invariant of degree {self.m}"
        noun = "zero" if numbers == "1" else "zeros"
        return f"{what} with {numbers} {noun} exists"

    def _numbers_written(self) -> str:
        """The equations for the number; sums of exponents where these are shorter, or the equations aren't listed."""
        found: list[str] = []
        if self.factors is not None:
            listed = alternatives(self.factors, Notation(self.letter, self.fixed))
            longest = _WRITTEN_OUT if self.m == 1 else _EQUATIONS
            is_solved = "= 0" not in listed
            if is_solved and len(text_of(listed)) <= longest:
                return listed
            found.append(listed)
        sums = self._by_exponents()
        if sums is not None:
            found.append(sums)
        return min(found, key=len)

    def _by_exponents(self) -> str | None:
        """The same numbers as sums of exponents: `d + 1 = +-sqrt(b)/2 +- c`, or `d = 6 + j*a + k*b` with integers j and k."""
        problem = analyse(self.S, Budget())
        numbers = self._allowed(problem)
        if numbers is None:
            return None
        roots = [_in_parentheses(root_written(root.square)) for root in numbers.roots]
        distance = over_parameters(problem.field.poly([-numbers.constant, 1]))
        if numbers.only_signs:
            return f"`{written(distance, self.letter)} = +-{' +- '.join(roots)}`"
        has_constant = self.factors is None or distance in self.factors
        letters = self._letters_beside(parameters_of(problem.field), len(roots))
        if len(letters) == 1:
            solved = self._solved_for_a_parameter(numbers, letters[0], has_zero=has_constant)
            if solved is not None:
                return solved
        said = self._as_sum(numbers, roots, letters)
        if has_constant:
            return said
        which = "0" if len(letters) == 1 else "all 0"
        return f"{said}, not {which}"

    def _allowed(self, problem: Problem) -> Numbers | None:
        """What the exponents allow as degrees of P, or as numbers of zeros of an invariant."""
        if self.m == 1:
            return degrees_of_solutions(problem)
        return zeros_of_forms(problem, self.m)

    def _as_sum(self, numbers: Numbers, roots: Sequence[str], letters: Sequence[str]) -> str:
        """The number as a constant plus integers times roots, with the bounds of the integers."""
        terms = [str(numbers.constant)]
        bounds = []
        for k, root, exponent in zip(letters, roots, numbers.roots, strict=True):
            # a factor comes first: 2*k*sqrt(a) for k*2*sqrt(a)
            terms.append(re.sub(r"^(\w+)\*(\d+)\*", r"\2*\1*", f"{k}*{root}"))
            bounds.append(f"`{k}` from -{exponent.largest} to {exponent.largest}")
        return f"`{self.letter} = {' + '.join(terms)}` for integers {', '.join(bounds)}"

    def _letters_beside(self, names: Sequence[str], count: int) -> list[str]:
        """So many names of integers that are neither parameters nor d."""
        letters: list[str] = []
        for _ in range(count):
            letters.append(free_letter([self.letter, *names, *letters], "jkmnl"))
        return letters

    def _solved_for_a_parameter(self, numbers: Numbers, j: str, *, has_zero: bool) -> str | None:
        """(d - constant)^2 = j^2 square for the only root, solved for a parameter that is linear in the square.

        None where there is none.  `has_zero`: j can be 0.
        """
        (root,) = numbers.roots
        names = parameters_of(root.square.field)
        field = FunctionField((*names, j))
        square = over_parameters(root.square).value_at([field.generator(name) for name in names], field)
        d = field.poly([0, 1])
        equation = over_parameters((d - numbers.constant) ** 2 - field.generator(j) ** 2 * square)
        solved = families(equation, (*self.fixed, j))
        if not solved:
            return None
        name, f = solved[0]
        if _has_others(f.num, j) or _has_others(f.den, j):
            return None  # where numerator and denominator vanish for some parameters, more would have to be said
        least = 0 if has_zero else 1
        return f"{Notation(self.letter).equals(name, f)} for an integer `{j}` from {least} to {root.largest}"


class _Given(NamedTuple):
    """The exponents give a number where a polynomial vanishes: that, its zeros, and S there."""

    exponents: FunctionPoly
    surface: Hypersurface
    S: RatFunc


def _has_others(part: Poly, j: str) -> bool:
    """Are there parameters beside j in it?"""
    function = over_parameters(part)
    return any(degree for name, degree in zip(function.field.names, degrees(function), strict=True) if name != j)


def _in_parentheses(text: str) -> str:
    """A sum in parentheses, where it isn't within some."""
    outside = re.sub(r"[({][^()]*[)}]", "", text)
    if re.search(r" [+-] ", outside):
        return f"({text})"
    return text


def _has_no_natural_root(factor: FunctionPoly, assumptions: Assumptions) -> bool:
    """Is the root of a linear polynomial never natural, or the polynomial positive for all d >= 0?"""
    if factor.degree == 1:
        natural = [Coset(Fraction(0), Fraction(1))]
        if assumptions.meets_classes(-factor[0] / factor[1], natural) is False:
            return True
    if not assumptions.is_positive(over_parameters(factor[0])):
        return False
    return all(assumptions.is_positive(over_parameters(c), or_zero=True) for c in factor if c)


def _determinant(exponents: FunctionPoly, conditions: RankConditions, *, deficient: bool) -> Determinant:
    if deficient:
        return Determinant(exponents, (exponents - exponents,))
    if conditions.system is None:
        return Determinant(exponents)
    return Determinant(exponents, conditions.polynomials, conditions.system)


def _back(surface: Hypersurface, field: Field) -> Callable[[FunctionPoly], FunctionPoly]:
    """From functions on a hypersurface to functions of all parameters."""

    def change(function: FunctionPoly) -> FunctionPoly:
        if surface.curve:
            return surface.back(function)
        values = [field.generator(name) for name in function.field.names]  # type: ignore[attr-defined]
        return over_parameters(function.value_at(values, field))

    return change


@lru_cache(maxsize=256)
def _has_solution(S: RatFunc, number: int) -> bool:
    """Is there a solution with a P of this degree?  Several statements ask for the same."""
    found = has_solution(analyse(S, Budget()), number)
    if found is None:
        raise LimitExceeded(f"the exponents of y'' = ({S}) y need too large an extension", limit="degree")
    return found


@lru_cache(maxsize=256)
def _has_form(S: RatFunc, m: int) -> bool:
    """Is there a rational form of degree m in the solutions?"""
    return has_form(analyse(S, Budget()), m)

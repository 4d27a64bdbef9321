"""Solutions in the integer of a condition: for L = n (5 n + 3)/2, other formulas for n = 0, 2, 4, ... than for n = 1, 3, 5, ...

A formula with a choice of signs asks for a natural number d.  Where the parameter is f(n), the square roots are functions of n,
so that d is a n + b with numbers a and b for some choices of the signs, and each of these is the solution for a progression.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, NamedTuple

import sympy

from kovacic.parametric.claims import AllOf, AnyOf, Claim, IntegerFamily, IsNonzero
from kovacic.parametric.powers_of_factors import shorter_sum
from kovacic.parametric.solutions import PolynomialSolution
from kovacic.writing.formula import Math

#: Integers up to which it is checked that each belongs to a progression.
_CHECKED = 12


@dataclass(frozen=True)
class Progression:
    """start, start + step, start + 2 step, ...; the step may be negative."""

    start: int
    step: int

    def contains(self, number: int) -> bool:
        index = Fraction(number - self.start, self.step)
        return index.denominator == 1 and index >= 0

    def said(self, letter: str) -> list[str | Math]:
        """`even n >= 0`, `n <= -1`, or `n = 1, 4, 7, ...`."""
        if abs(self.step) > 2:
            listed = ", ".join(str(self.start + k * self.step) for k in range(3))
            return [Math(f"{letter} = {listed}, ...", rf"{letter} = {listed}, \ldots")]
        sign, latex = (">=", r"\ge") if self.step > 0 else ("<=", r"\le")
        bound = Math(f"{letter} {sign} {self.start}", f"{letter} {latex} {self.start}")
        if abs(self.step) == 1:
            return [bound]
        return ["odd " if self.start % 2 else "even ", bound]


class SolutionRow(NamedTuple):
    """The solution for the integers of a progression."""

    numbers: Progression
    solution: PolynomialSolution


def families_of(claim: Claim) -> list[IntegerFamily]:
    """The alternatives, where each is the parameter as a function of an integer, maybe beside what isn't 0; none for others."""
    parts = claim.parts if isinstance(claim, AllOf) else (claim,)
    parts = tuple(part for part in parts if not isinstance(part, IsNonzero))
    if len(parts) == 1 and isinstance(parts[0], AnyOf):
        parts = parts[0].parts
    elif len(parts) != 1:
        return []
    families = [part for part in parts if isinstance(part, IntegerFamily)]
    return families if len(families) == len(parts) else []


def rows_of(solutions: Iterable[PolynomialSolution], family: IntegerFamily) -> list[SolutionRow]:
    """A row for each progression; none unless they make up all integers of the family."""
    n = sympy.Symbol(family.letter)
    value = family.value.num.to_sympy(n) / family.value.den.to_sympy(n)
    values = {sympy.Symbol(family.parameter): value}
    rows: list[SolutionRow] = []
    for solution in solutions:
        if solution.conditions:
            return []
        there = solution.with_values(values)
        written = _without_roots(there.degree)
        degree = sympy.expand(written)
        y = _without_roots(there.y).xreplace({written: degree})
        there = PolynomialSolution(y, degree, jacobi=tuple(map(_without_roots, there.jacobi)))
        found = [*_progressions(degree, n, family)]
        if found and there.exclusion(family.letter):
            return []
        rows += [SolutionRow(progression, there) for progression in found]
    numbers = [number for number in range(-_CHECKED, _CHECKED + 1) if family.numbers.contains(Fraction(number))]
    if not all(any(row.numbers.contains(number) for row in rows) for number in numbers):
        return []
    return sorted(rows, key=lambda row: (row.numbers.step < 0, abs(row.numbers.start)))


def _progressions(degree: Any, n: Any, family: IntegerFamily) -> Iterator[Progression]:
    """The integers of the family for which the degree a n + b is natural; none for another degree."""
    slope, constant = degree.coeff(n, 1), degree.coeff(n, 0)
    is_linear = sympy.expand(degree - slope * n - constant) == 0
    if not (is_linear and slope.is_Rational and constant.is_Rational) or slope == 0:
        return
    a, b = (Fraction(int(number.p), int(number.q)) for number in (slope, constant))
    # n = (d - b)/a for d = 0, 1, ...: in the classes again after so many steps.
    period = (family.numbers.modulus * abs(a)).numerator
    for d in range(period):
        first = (d - b) / a
        if first.denominator == 1 and family.numbers.contains(first):
            yield Progression(int(first), int(period / a))


def _without_roots(expression: Any) -> Any:
    """The expression with polynomials in the place of square roots of squares; the sign of each is chosen anyway."""

    def rooted(power: Any) -> Any:
        outside: list[Any] = []
        inside: list[Any] = []
        for factor in sympy.Mul.make_args(sympy.factor(power.base)):
            base, k = factor.as_base_exp()
            is_square = k.is_Integer and k % 2 == 0 and not base.is_number
            (outside if is_square else inside).append(base ** (k * power.exp) if is_square else factor)
        return sympy.Mul(*outside) * sympy.Mul(*inside) ** power.exp

    found = expression.replace(lambda e: e.is_Pow and e.exp.is_Rational and e.exp.q == 2, rooted)
    return found.replace(lambda e: e.is_Pow and e.exp.has(sympy.Symbol), lambda e: e.base ** shorter_sum(e.exp))

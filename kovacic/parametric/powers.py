"""A parameter t that occurs in S in powers of t^k only: conditions for T = t^k, and what they say of t.

On a hypersurface such as 4 w^2 + 1 = 0 no parameter is eliminated; on 4 W + 1 = 0 one is.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from math import gcd

import sympy

from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.numbers.numerals import as_text
from kovacic.parametric.functions import element, irreducible_factors, over_parameters, powers_of, union
from kovacic.parametric.integers import Congruence, integer_roots
from kovacic.parametric.natural import Natural
from kovacic.parametric.regions import ParameterRegion
from kovacic.parametric.solutions import Carried, PolynomialSolution
from kovacic.parametric.statements import Both, Either, Statement, Vanishes, both, either
from kovacic.writing.formula import caret


@dataclass(frozen=True)
class InPowers:
    """S with T for t^k, T by the name of t, and the k of each parameter."""

    S: RatFunc
    powers: tuple[int, ...]

    def back(self, region: ParameterRegion) -> ParameterRegion:
        """What a region of T says of t."""
        field = self.S.field
        assert isinstance(field, FunctionField)
        names = dict(zip(field.names, self.powers, strict=True))
        origin = region.origin and Carried(region.origin, partial(_with_powers, names))

        def raised(function: FunctionPoly) -> FunctionPoly:  # of some of the parameters
            own = function.field
            values = [own.generator(name) ** names.get(name, 1) for name in own.names]
            return over_parameters(function.value_at(values, own))

        statement = _in_factors(region.statement.rewritten(raised))
        return replace(region, statement=statement, origin=origin)


def _with_powers(powers: Mapping[str, int], solution: PolynomialSolution) -> PolynomialSolution:
    """A solution with t^k for T."""
    raised = solution.with_values({sympy.Symbol(name): sympy.Symbol(name) ** k for name, k in powers.items()})
    if not raised.conditions and raised.where:
        return raised
    where = ", ".join(f"{caret(as_text(sympy.factor(condition)))} = 0" for condition in raised.conditions)
    return replace(raised, where=where)


def in_powers(S: RatFunc) -> InPowers | None:
    """None where each parameter occurs in powers without a common divisor."""
    field = S.field
    assert isinstance(field, FunctionField)
    parts = [over_parameters(part) for part in S.cleared()]
    occurring = [[n for part in parts for n in powers_of(part, i)] for i in range(len(field.names))]
    powers = tuple(gcd(*found) or 1 for found in occurring)  # the largest k for which t occurs in powers of t^k only
    if max(powers) == 1:
        return None
    num, den = (_lowered(part, powers) for part in parts)
    return InPowers(RatFunc(num, den), powers)


def _lowered(function: FunctionPoly, powers: Sequence[int]) -> FunctionPoly:
    terms = {}
    for (first, *exponents), coefficient in function.num.to_dict().items():
        lower = [n // k for n, k in zip(exponents, powers, strict=True)]
        terms[(first, *lower)] = coefficient
    return element(function.field, function.field.context.from_dict(terms))


def _in_factors(statement: Statement) -> Statement:
    """The same statement, said of irreducible polynomials: T and T - t are, t^2 and t^2 - s^2 aren't."""
    if isinstance(statement, Both):
        return both(*map(_in_factors, statement.parts))
    if isinstance(statement, Either):
        return either(*map(_in_factors, statement.parts))
    if isinstance(statement, Vanishes):
        return either(*map(Vanishes, irreducible_factors(statement.function)))
    if isinstance(statement, Congruence) and statement.form is None:
        return integer_roots(statement.equation, [*map(int, statement.residues)], int(statement.modulus))
    if isinstance(statement, Natural) and statement.factors is not None:
        factored = [equation.field.factor(equation) for equation in statement.factors]  # over Q(t)
        factors = union([over_parameters(factor) for factor, _ in one] for one in factored)
        return replace(statement, factors=tuple(factors))
    return statement

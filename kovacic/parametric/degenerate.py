"""Polynomials in the parameters at whose zeros S itself changes: undefined, poles that merge, vanish or change their order."""

from __future__ import annotations

from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.engine.places import Problem
from kovacic.parametric.bounded import irreducible_factors, union


def undefined(problem: Problem) -> list[Poly]:
    """The irreducible polynomials at whose zeros the leading coefficient of S's denominator vanishes."""
    _, below = problem.S.cleared()
    return irreducible_factors(below.lc)


def confluence(problem: Problem) -> list[Poly]:
    """Where poles merge or go to infinity."""
    radical = problem.field.poly([1])
    for place in problem.finite_places:
        radical = radical * place.factor
    return union([undefined(problem), _discriminant(radical)])


def structure_changes(problem: Problem) -> list[Poly]:
    """Where poles merge, go to infinity, or change their order."""
    above, below = problem.S.cleared()
    lists = [confluence(problem), irreducible_factors(above.lc), _resultant(above, below)]
    return union(lists)


def _discriminant(polynomial: Poly) -> list[Poly]:
    return _resultant(polynomial, polynomial.derivative()) if polynomial.degree > 1 else []


def _resultant(first: Poly, second: Poly) -> list[Poly]:
    assert isinstance(first, FunctionPoly)
    assert isinstance(second, FunctionPoly)
    if first.degree < 1 or second.degree < 1:
        return []
    value = first.num.resultant(second.num, 0)
    field = first.field
    return irreducible_factors(FunctionPoly(field, value, field.context.constant(1)))


__all__ = ["confluence", "structure_changes", "undefined"]

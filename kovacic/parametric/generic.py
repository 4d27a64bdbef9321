"""Where S itself changes, and under which conditions an answer for generic parameters was derived.

Polynomials in the parameters tell where S isn't defined, and where poles merge, vanish or change their order.  The engine
computes over Q(t).  Where these polynomials don't vanish, S has the same poles with the same orders, and a positive answer
specialises: omega's polynomial is defined there and solves the Riccati equation.  Exponent differences that depend on the
parameters count as irrational numbers; where one of them becomes rational, and the other listed conditions hold, more can be
solvable than generically, and `kovacic.conditions` says where exactly.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from kovacic.algebra.extension import ExtensionPoly, norm
from kovacic.algebra.factors import product
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import QQ
from kovacic.engine.places import Kind, Problem, analyse
from kovacic.limits import Budget
from kovacic.parametric.formulas import shown
from kovacic.parametric.functions import denominators, element, irreducible_factors, over_parameters, union

if TYPE_CHECKING:
    from kovacic.solution import Solution


def undefined(problem: Problem) -> list[FunctionPoly]:
    """The irreducible polynomials at whose zeros the leading coefficient of S's denominator vanishes."""
    return irreducible_factors(_down(problem.S.cleared()[1].lc))


def confluence(problem: Problem) -> list[FunctionPoly]:
    """Where poles merge or go to infinity."""
    radical = product([problem.field.poly([1]), *(place.factor for place in problem.finite_places)])
    return union([undefined(problem), _common_zeros(radical, radical.derivative())])


def structure_changes(problem: Problem) -> list[FunctionPoly]:
    """Where poles merge, go to infinity, or change their order."""
    above, below = problem.S.cleared()
    return union([confluence(problem), irreducible_factors(_down(above.lc)), _common_zeros(above, below)])


@dataclass(frozen=True)
class GenericConditions:
    """What must not vanish, and the squares of the exponent differences that were taken for irrational ones."""

    nonzero: tuple[FunctionPoly, ...]
    irrational_squares: tuple[FunctionPoly, ...]

    def __bool__(self) -> bool:
        return bool(self.nonzero or self.irrational_squares)

    def __str__(self) -> str:
        parts = [f"{shown(f)} != 0" for f in self.nonzero]
        parts += [f"sqrt({shown(f)}) isn't rational" for f in self.irrational_squares]
        return ", ".join(parts) or "none"


def generic_conditions(solution: Solution) -> GenericConditions:
    """The conditions of an answer over Q(t); empty where there are no parameters, or where assumptions make it proven.

    >>> import kovacic
    >>> print(generic_conditions(kovacic.solve("(m^2*x^4 + (2*n + 1)*m*x^2 + n^2 - n)/x^2")))
    m != 0, n != 0, n - 1 != 0, sqrt(4*n^2 - 4*n + 1) isn't rational
    """
    field = solution.S.field
    if field.ground == QQ or solution.assumed:
        return GenericConditions((), ())
    problem = analyse(solution.S, Budget())
    above, below = solution.S.cleared()
    changes = [irreducible_factors(_down(above.lc)), confluence(problem), _common_zeros(above, below)]
    riccati, constants = solution.decision.riccati, solution.constants
    if riccati is not None:
        for polynomial in (riccati.P, riccati.D, *riccati.numerators):
            changes += [irreducible_factors(_down(d)) for d in denominators(polynomial)]
    if constants is not None:
        changes.append(_common_zeros(constants, constants.derivative()))
    squares = [p.delta_squared for p in problem.places if p.kind is Kind.REGULAR and p.delta_squared is not None]
    irrational = [_down(square) for square in squares if field.rational_value(square) is None]
    return GenericConditions(tuple(union(changes)), tuple(union([irrational])))


def _common_zeros(first: Poly, second: Poly) -> list[FunctionPoly]:
    """The irreducible factors of the resultant, or of its norm over an extension of Q(t)."""
    if first.degree < 1 or second.degree < 1:
        return []
    if isinstance(first, FunctionPoly) and isinstance(second, FunctionPoly):
        return irreducible_factors(element(first.field, first.num.resultant(second.num, 0)))
    total: Poly = first.field.poly([1])
    while second.degree > 0:  # Euclid's algorithm, up to a factor in Q
        rest = first % second
        total = total * second.lc ** max(first.degree - rest.degree, 0)
        first, second = second, rest
    return irreducible_factors(_down(total * second ** max(first.degree, 0)))


def _down(constant: Poly) -> FunctionPoly:
    """An element of Q(t), or the norm of one of an extension."""
    while isinstance(constant, ExtensionPoly):
        constant = norm(constant)
    return over_parameters(constant)

"""Under which conditions was an answer for generic parameters derived?

The engine computes over Q(t).  Where the listed polynomials don't vanish, S has the same poles with the same orders, and
a positive answer specialises: omega's polynomial is defined there and solves the Riccati equation.  Exponent differences that
depend on the parameters count as irrational numbers; where one of them becomes rational, and the other listed conditions
hold, more can be solvable than generically, and `kovacic.conditions` says where exactly.
"""

from __future__ import annotations

from dataclasses import dataclass

from kovacic.algebra.extension import AlgebraicField, ExtensionPoly, norm
from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.rationals import QQ
from kovacic.engine.places import Kind, analyse
from kovacic.limits import Budget
from kovacic.parametric.bounded import denominators, irreducible_factors, union
from kovacic.parametric.formulas import shown
from kovacic.solution import Solution


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
    """The conditions of an answer over Q(t); empty where there are no parameters.

    >>> import kovacic
    >>> print(generic_conditions(kovacic.solve("(m^2*x^4 + (2*n + 1)*m*x^2 + n^2 - n)/x^2")))
    m != 0, n != 0, n - 1 != 0, sqrt(4*n^2 - 4*n + 1) isn't rational
    """
    field = solution.S.field
    if field.ground == QQ:
        return GenericConditions((), ())
    problem = analyse(solution.S, Budget())
    above, below = solution.S.cleared()
    radical: Poly = field.poly([1])
    for place in problem.finite_places:
        radical = radical * place.factor
    elements = [above.lc, below.lc, _resultant(radical, radical.derivative()), _resultant(above, below)]
    decision = solution.decision
    if decision.riccati is not None:
        for polynomial in (decision.riccati.P, decision.riccati.D, *decision.riccati.numerators):
            elements += denominators(polynomial)
    if solution.constants is not None:
        elements.append(_resultant(solution.constants, solution.constants.derivative()))
    nonzero = union([irreducible_factors(_down(element)) for element in elements if element])
    squares: list[FunctionPoly] = []
    for place in problem.places:
        square = place.delta_squared
        if place.kind is Kind.REGULAR and square is not None and field.rational_value(square) is None:
            value = _down(square)
            if value not in squares:
                squares.append(value)
    return GenericConditions(tuple(f for f in nonzero if isinstance(f, FunctionPoly)), tuple(squares))


def _resultant(first: Poly, second: Poly) -> Poly:
    """By Euclid's algorithm, up to a factor in Q; 1 where one of them is constant."""
    field: Field = first.field
    if first.degree < 1 or second.degree < 1:
        return field.poly([1])
    if isinstance(first, FunctionPoly) and isinstance(second, FunctionPoly):
        value = first.num.resultant(second.num, 0)
        return FunctionPoly(first.field, value, first.field.context.constant(1))
    total = field.poly([1])
    while second.degree > 0:
        rest = first % second
        total = total * second.lc ** max(first.degree - rest.degree, 0)
        first, second = second, rest
    return total * second ** max(first.degree, 0)


def _down(element: Poly) -> FunctionPoly:
    """An element of Q(t), or the norm of one of an extension."""
    while isinstance(element, ExtensionPoly) and isinstance(element.field, AlgebraicField):
        element = norm(element)
    if not isinstance(element, FunctionPoly) or not isinstance(element.field, FunctionField):
        raise TypeError("a field with parameters is expected")
    return element

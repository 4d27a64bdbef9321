"""Solutions of case 1 that exist in a region, as SymPy expressions, for one natural number d: y = exp(int theta) P.

With the choice of exponents of `search`, P of degree d follows from its first coefficient, and y solves the equation where
Delta_d = 0.  `confluent` and `quotient` have those for all d, with Laguerre's and Jacobi's polynomials of symbolic degree.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from kovacic.algebra.extension import ExtensionPoly
from kovacic.algebra.poly import Poly
from kovacic.engine.places import Problem
from kovacic.parametric.exponents import Exponents


@dataclass(frozen=True)
class PolynomialSolution:
    """y solves y'' = S y where `degree` is a natural number; SymPy expressions in the variable and the parameters.

    `where` says what else has to hold.
    """

    y: Any
    degree: Any
    where: str = ""

    def __str__(self) -> str:
        return f"y = {self.y} where {self.where or f'{self.degree} is a natural number'}"


def solution_of_degree(
    problem: Problem, exponents: Exponents, d: int, variable: str, where: str
) -> PolynomialSolution | None:
    """exp(int theta) P for one choice of exponents, valid where Delta_d = 0; None where P isn't determined by its degree."""
    import sympy

    P = exponents.polynomial(problem, d)
    if P is None:
        return None
    x = sympy.Symbol(variable)
    c = sympy.Integer(1) if exponents.square is None else sympy.sqrt(sympy.factor(exponents.square.to_sympy(x)))

    def expression(polynomial: Poly) -> Any:
        parts = polynomial.parts if isinstance(polynomial, ExtensionPoly) else [polynomial]
        return sum(part.to_sympy(x) * c**k for k, part in enumerate(parts))

    y = expression(P)
    for part in exponents.parts:
        exponential = sympy.integrate(sympy.expand(expression(part.main)), x)
        if part.factor is None:
            y *= sympy.exp(exponential)
        else:
            u = expression(part.factor)
            y *= u ** sympy.factor(expression(part.exponent)) * sympy.exp(exponential.subs(x, 1 / u))
    return PolynomialSolution(y, sympy.Integer(d), where)


def possible(found: list[PolynomialSolution]) -> tuple[PolynomialSolution, ...]:
    """Without those whose degree is a number but no natural one, and without repetitions."""
    possible = (s for s in found if s.degree.free_symbols or (s.degree.is_Integer and s.degree >= 0))
    return tuple(dict.fromkeys(possible))


def root(square: Poly) -> Any:
    """The square root of a constant, up to its sign."""
    import sympy

    root, x = square.field.sqrt(square), sympy.Symbol("x")
    return sympy.sqrt(sympy.factor(square.to_sympy(x))) if root is None else sympy.expand(root.to_sympy(x))

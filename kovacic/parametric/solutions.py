"""The solutions of case 1 that exist in a region, for all of its parameters at once: Laguerre and Jacobi polynomials.

With the letters of `confluent`, q != 0, and signs e, f (both +-1):

    y = s^((1 + f Delta)/2) exp(e sqrt(q) s^n/n) L_d^(f Delta/n)(-2 e sqrt(q) s^n/n),  d = (e beta - f Delta - n)/(2 n),   (1)

and with those of `riemann`, x = c + (c1 - c) w, singular points at w = 0, 1, infinity,

    y = w^((1 + f l)/2) (1 - w)^((1 + g m)/2) P_d^(f l, g m)(1 - 2 w),  d = (-1 - f l - g m - h n)/2,                       (2)

where d is a natural number (DLMF 18.8; the polynomials of Jacobi vanish for some negative integers as parameters).
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING, Any

from kovacic.algebra.poly import Poly
from kovacic.engine.places import Kind, Problem

if TYPE_CHECKING:
    from kovacic.parametric.confluent import Confluent


@dataclass(frozen=True)
class PolynomialSolution:
    """y solves y'' = S y where `degree` is a natural number; SymPy expressions in the variable and the parameters."""

    y: Any
    degree: Any

    def __str__(self) -> str:
        return f"y = {self.y} where {self.degree} is a natural number"


def laguerre_solutions(form: Confluent, variable: str) -> tuple[PolynomialSolution, ...]:
    """Equation (1), for all signs for which d can be a natural number."""
    import sympy

    from kovacic.reading.symbolic import read_expression

    if not form.q:
        return ()
    x = sympy.Symbol(variable)
    s = read_expression(form.coordinate)
    root, delta = _root(form.q), _root(1 + 4 * form.b)
    beta, n = form.r.to_sympy(x) / root, form.n
    found = []
    for e, f in product((1, -1), repeat=2):
        degree = sympy.expand((e * beta - f * delta - n) / (2 * n))
        u = sympy.expand(-2 * e * root / n) * s**n
        y = s ** sympy.expand((1 + f * delta) / 2) * sympy.exp(-u / 2) * sympy.assoc_laguerre(degree, f * delta / n, u)
        found.append(PolynomialSolution(y / s if form.inverted else y, degree))
    return _possible(found)


def jacobi_solutions(problem: Problem, variable: str) -> tuple[PolynomialSolution, ...]:
    """Equation (2), for all signs for which d can be a natural number; () where two singular points are conjugate."""
    import sympy

    x, zero = sympy.Symbol(variable), problem.field.poly([])
    places = [place for place in problem.places if place.kind is not Kind.ORDINARY]
    finite = [place for place in places if not place.at_infinity]
    if any(place.degree > 1 for place in finite) or len(finite) != 2:
        return ()
    squares = [place.delta_squared for place in (*finite, problem.places[-1])]
    first, second, third = (sympy.Integer(1) if square is None else _root(square) for square in squares)
    c, c1 = ((zero - place.factor[0]).to_sympy(x) for place in finite)
    w = (x - c) / (c1 - c)
    found = []
    for f, g, h in product((1, -1), repeat=3):
        degree = sympy.expand((-1 - f * first - g * second - h * third) / 2)
        powers = w ** sympy.expand((1 + f * first) / 2) * (1 - w) ** sympy.expand((1 + g * second) / 2)
        found.append(PolynomialSolution(powers * sympy.jacobi(degree, f * first, g * second, 1 - 2 * w), degree))
    return _possible(found)


def _possible(found: list[PolynomialSolution]) -> tuple[PolynomialSolution, ...]:
    """Without those whose degree is a number but no natural one, and without repetitions."""
    possible = (s for s in found if s.degree.free_symbols or (s.degree.is_Integer and s.degree >= 0))
    return tuple(dict.fromkeys(possible))


def _root(square: Poly) -> Any:
    import sympy

    root, x = square.field.sqrt(square), sympy.Symbol("x")
    return sympy.sqrt(sympy.factor(square.to_sympy(x))) if root is None else sympy.expand(root.to_sympy(x))

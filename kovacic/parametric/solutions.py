"""The solutions of case 1 that exist in a region, for all of its parameters at once, or for one natural number d.

With the letters of `confluent`, q != 0, and signs e, f (both +-1):

    y = s^((1 + f Delta)/2) exp(e sqrt(q) s^n/n) L_d^(f Delta/n)(-2 e sqrt(q) s^n/n),  d = (e beta - f Delta - n)/(2 n),   (1)

with those of `riemann`, w a Moebius map of z, singular points at w = 0, 1, infinity, z = x or z = (x - c)^n,

    y = w^((1 + f l)/2) (1 - w)^((1 + g m)/2) P_d^(f l, g m)(1 - 2 w) / sqrt(dw/dx),  d = (-1 - f l - g m - h n)/2,        (2)

where d is a natural number (DLMF 18.8; the polynomials of Jacobi vanish for some negative integers as parameters).  With those
of `search`, for one d, y = exp(int theta) P, whose P of degree d follows from its first coefficient, and solves the equation
where Delta_d = 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING, Any

from kovacic.algebra.extension import ExtensionPoly
from kovacic.algebra.poly import Poly
from kovacic.engine.places import Kind, Problem

if TYPE_CHECKING:
    from kovacic.parametric.confluent import Confluent
    from kovacic.parametric.exponents import Exponents
    from kovacic.parametric.quotient import Coordinate


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


def laguerre_solutions(form: Confluent, variable: str, _: int | None = None) -> tuple[PolynomialSolution, ...]:
    """Equation (1), for all signs for which d can be a natural number."""
    import sympy

    from kovacic.reading.symbolic import read_expression

    if not form.q:
        return ()
    x, s, weight = sympy.Symbol(variable), *map(read_expression, (form.coordinate.base, form.coordinate.weight))
    root, delta = _root(form.q), _root(1 + 4 * form.b)
    beta, n = form.r.to_sympy(x) / root, form.coordinate.n
    found = []
    for e, f in product((1, -1), repeat=2):
        degree = sympy.expand((e * beta - f * delta - n) / (2 * n))
        u = sympy.expand(-2 * e * root / n) * s**n
        y = s ** sympy.expand((1 + f * delta) / 2) * sympy.exp(-u / 2) * sympy.assoc_laguerre(degree, f * delta / n, u)
        found.append(PolynomialSolution(weight * y, degree))
    return _possible(found)


def jacobi_solutions(
    problem: Problem, coordinate: Coordinate, variable: str, _: int | None = None
) -> tuple[PolynomialSolution, ...]:
    """Equation (2), for all signs for which d can be a natural number; () where three singular points are conjugate."""
    import sympy

    from kovacic.parametric.riemann import difference_squared
    from kovacic.reading.symbolic import read_expression

    x, n = sympy.Symbol(variable), coordinate.n
    base, weight = map(read_expression, (coordinate.base, coordinate.weight))
    points: list[tuple[Any, Any]] = []
    for place in problem.places:
        if place.kind is Kind.ORDINARY or place.degree > 2:
            continue
        square = difference_squared(place)
        if place.at_infinity:
            points.append((None, _root(square)))
        elif place.degree == 1:
            points.append(((0 * square - place.factor[0]).to_sympy(x), _root(square)))
        else:
            half, rest = (place.factor[k].to_sympy(x) for k in (1, 0))
            for sign in (1, -1):
                c = (-half + sign * sympy.sqrt(sympy.factor(half**2 - 4 * rest))) / 2
                points.append((c, sympy.sqrt(sympy.simplify(square.to_sympy(x).subs(x, c)))))
    if len(points) == 2 and problem.infinity.kind is Kind.ORDINARY:
        points.append((None, sympy.Integer(1)))
    if len(points) != 3:
        return ()
    (c, first), (c1, second), (c2, third) = points
    z = base**n
    w = (z - c) / (c1 - c) if c2 is None else (z - c) * (c1 - c2) / ((z - c2) * (c1 - c))
    jacobian = weight * (1 if c2 is None else z - c2) / (base ** sympy.Rational(n - 1, 2))
    found = []
    for f, g, h in product((1, -1), repeat=3):
        degree = sympy.expand((-1 - f * first - g * second - h * third) / 2)
        powers = w ** sympy.expand((1 + f * first) / 2) * (1 - w) ** sympy.expand((1 + g * second) / 2)
        polynomial = sympy.jacobi(degree, f * first, g * second, 1 - 2 * w)
        found.append(PolynomialSolution(jacobian * powers * polynomial, degree))
    return _possible(found)


def solution_of_degree(
    problem: Problem, exponents: Exponents, d: int, variable: str, where: str
) -> PolynomialSolution | None:
    """exp(int theta) P for one choice of exponents, valid where Delta_d = 0; None where P isn't determined by its degree."""
    import sympy

    P = exponents.polynomial(problem, d)
    if P is None:
        return None
    x = sympy.Symbol(variable)
    root = sympy.Integer(1) if exponents.square is None else sympy.sqrt(sympy.factor(exponents.square.to_sympy(x)))

    def expression(polynomial: Poly) -> Any:
        parts = polynomial.parts if isinstance(polynomial, ExtensionPoly) else [polynomial]
        return sum(part.to_sympy(x) * root**k for k, part in enumerate(parts))

    y = expression(P)
    for part in exponents.parts:
        exponential = sympy.integrate(sympy.expand(expression(part.main)), x)
        if part.factor is None:
            y *= sympy.exp(exponential)
        else:
            u = expression(part.factor)
            y *= u ** sympy.factor(expression(part.exponent)) * sympy.exp(exponential.subs(x, 1 / u))
    return PolynomialSolution(y, sympy.Integer(d), where)


def _possible(found: list[PolynomialSolution]) -> tuple[PolynomialSolution, ...]:
    """Without those whose degree is a number but no natural one, and without repetitions."""
    possible = (s for s in found if s.degree.free_symbols or (s.degree.is_Integer and s.degree >= 0))
    return tuple(dict.fromkeys(possible))


def _root(square: Poly) -> Any:
    import sympy

    root, x = square.field.sqrt(square), sympy.Symbol("x")
    return sympy.sqrt(sympy.factor(square.to_sympy(x))) if root is None else sympy.expand(root.to_sympy(x))

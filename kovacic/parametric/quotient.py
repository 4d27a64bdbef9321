"""Symmetric equations: S(m(x)) m'(x)^2 = S(x) for a Moebius map m of order n, and their quotients.

m is x -> c + zeta (x - c), zeta^n = 1, or that in the coordinate 1/(x - p).  With z = s^n, s = x - c or 1/(x - p) - c, the
equation becomes v'' = S_z v, s^2 S = n^2 z^2 S_z + (n^2 - 1)/4 with S in the coordinate s, and the exponent differences at 0
and infinity are divided by n.  The theorem of `confluent` is about s^2 S of degree at most 2 in z; here is the one for at most
three singular points in z, all of them regular (`riemann`).

C(x) is a cyclic extension of C(z), branched at 0 and infinity: the group G over C(x) is normal in the one over C(z), H, with a
cyclic quotient of an order that divides n.  So an equation is solvable over both or neither, and

- H reducible: G is reducible;
- H imprimitive: the quadratic extension over which H becomes diagonal is branched where two of the differences are
  half-integers.  It is C(sqrt z), and G reducible, exactly where those at 0 and infinity are (n even); else G is imprimitive;
- H tetrahedral: its only cyclic quotient has order 3, with branch points where the differences have the denominator 3.
  Where these are 0 and infinity, so that the third difference is a half-integer, and 3 divides n, G is the quaternion
  group; else G = H;
- H octahedral: G is octahedral or tetrahedral (n even); H icosahedral, which is perfect: G = H.

In case 1, w a Moebius map of z with the singular points at w = 0, 1, infinity, and with signs f, g, h for which d is natural,

    y = w^((1 + f l)/2) (1 - w)^((1 + g m)/2) P_d^(f l, g m)(1 - 2 w) / sqrt(dw/dx),  d = (-1 - f l - g m - h n)/2         (1)

(DLMF 18.8; the polynomials of Jacobi vanish for some negative integers as parameters).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from itertools import product
from math import gcd
from typing import Any, Literal

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import Structure
from kovacic.engine.places import Kind, Problem, analyse
from kovacic.parametric import generic, riemann
from kovacic.parametric.formulas import shifted
from kovacic.parametric.functions import over_parameters
from kovacic.parametric.integers import integer_roots
from kovacic.parametric.regions import OMEGAS, Theorem, Verdict
from kovacic.parametric.solutions import PolynomialSolution, possible, root
from kovacic.parametric.statements import Statement, both, either

Statements = Literal[True] | list[Statement]


@dataclass(frozen=True)
class Coordinate:
    """z = s^n; `base` is s in words, and y = weight * v with the solution v in s: `weight` is 1 or x - p."""

    base: str
    n: int = 1
    weight: str = "1"

    def __str__(self) -> str:
        if self.n == 1:
            return self.base
        return f"{self.base}^{self.n}" if self.base.isidentifier() else f"({self.base})^{self.n}"


@dataclass(frozen=True)
class Symmetric:
    """s^2 S, with S in the coordinate s, is num/den in z = s^n, and n is the largest such number."""

    coordinate: Coordinate
    num: Poly
    den: Poly

    @property
    def equation(self) -> RatFunc:
        """S_z."""
        n, z = self.coordinate.n, self.num.field.poly([0, 1])
        return (RatFunc(self.num, self.den) - self.num.field.poly([n * n - 1]) / 4) / RatFunc(n * z) ** 2


def symmetries(problem: Problem, variable: str) -> Iterator[Symmetric]:
    """By the fixed points that can belong to a group of Moebius maps: the first is infinity, or a pole.

    The other one is the mean of the poles where the first is infinity, or of the zeros if there are none.
    """
    S, field = problem.S, problem.field
    x = RatFunc(field.poly([0, 1]))
    for pole in (None, *(-place.factor[0] for place in problem.finite_places if place.degree == 1)):
        moved = S if pole is None else S(1 / x + pole) / x**4
        points = moved.den if moved.den.degree else moved.num
        if points.degree < 1:
            continue
        center = -points[points.degree - 1] / (points.lc * points.degree)
        square = (moved(x + center) if center else moved) * x * x
        n = gcd(*(i for part in (square.num, square.den) for i, c in enumerate(part) if c))
        weight = "1" if pole is None else shifted(variable, pole)
        base = shifted(variable if pole is None else f"1/({weight})" if pole else f"1/{variable}", center)
        num, den = (field.poly([f[i] for i in range(0, f.degree + 1, n or 1)]) for f in (square.num, square.den))
        yield Symmetric(Coordinate(base, n, weight), num, den)


def kimura(problem: Problem, variable: str) -> Theorem | None:
    """Kimura's theorem, where the equation or its quotient has at most three singular points, and regular ones."""
    found = _recognised(problem, variable)
    if found is None:
        return None
    coordinate, equation = found
    points = "singular points" if coordinate.n == 1 else f"singular points in {coordinate}"
    omegas, origin = dict(OMEGAS), partial(jacobi_solutions, equation, coordinate, variable)
    if coordinate.n == 1:
        omegas[Structure.REDUCIBLE] = riemann.omega(problem, variable)
    regions = (
        (statements, Verdict(structure, family=family), omegas[structure], origin if structure.case == 1 else None)
        for structure, statements, family in structures(equation, coordinate.n)
    )
    return Theorem(f"at most three regular {points}: Kimura's theorem", generic.confluence(problem), regions)


def _recognised(problem: Problem, variable: str) -> tuple[Coordinate, Problem] | None:
    """A coordinate in which there are at most three singular points, all regular, with the equation in it."""
    if riemann.applies(problem):
        return Coordinate(variable), problem
    for symmetric in symmetries(problem, variable) if riemann.is_fuchsian(problem) else ():
        if symmetric.coordinate.n > 1:
            quotient = analyse(symmetric.equation, problem.budget)
            if riemann.applies(quotient):
                return symmetric.coordinate, quotient
    return None


def structures(problem: Problem, n: int) -> Iterator[tuple[Structure, Statements, str | None]]:
    """As `riemann.structures`, for the equation in x, with the family of the groups where the structure doesn't say it."""
    for structure, statements in riemann.structures(problem):
        family = riemann.group(problem, structure)
        if structure is Structure.IMPRIMITIVE and n % 2 == 0:
            diagonal = _with_denominators(problem, (2, 2))
            if diagonal:
                yield Structure.REDUCIBLE, diagonal, None
            if diagonal is True:
                return
        if structure is Structure.TETRAHEDRAL and n % 3 == 0:
            threefold = _with_denominators(problem, (3, 3, 2))
            if threefold:
                yield Structure.IMPRIMITIVE, threefold, "the quaternion group"
            if threefold is True:
                return
        if structure is Structure.OCTAHEDRAL and n % 2 == 0:
            family = "binary tetrahedral, or octahedral"
        yield structure, statements, family


def jacobi_solutions(
    problem: Problem, coordinate: Coordinate, variable: str, _: int | None = None
) -> tuple[PolynomialSolution, ...]:
    """Equation (1), for all signs for which d can be a natural number; () where three singular points are conjugate."""
    import sympy

    from kovacic.reading.symbolic import read_expression

    x, n = sympy.Symbol(variable), coordinate.n
    base, weight = map(read_expression, (coordinate.base, coordinate.weight))
    points: list[tuple[Any, Any]] = []
    for place in problem.places:
        if place.kind is Kind.ORDINARY or place.degree > 2:
            continue
        square = riemann.difference_squared(place)
        if place.at_infinity:
            points.append((None, root(square)))
        elif place.degree == 1:
            points.append(((0 * square - place.factor[0]).to_sympy(x), root(square)))
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
    return possible(found)


def _with_denominators(problem: Problem, denominators: tuple[int, ...]) -> Statements:
    """When the exponent differences at 0, at infinity and at the third point have these denominators; [] for never."""
    squares = [problem.field.poly([1])] * 3
    for place in problem.places:
        if place.kind is not Kind.ORDINARY and place.delta_squared is not None:
            squares[1 if place.at_infinity else 2 if place.factor[0] else 0] = place.delta_squared
    found: list[Statement] = []
    for square, denominator in zip(squares, denominators, strict=False):
        equation = over_parameters(problem.field.poly([-square * denominator**2, 0, 1]))
        residues = [r for r in range(denominator) if gcd(r, denominator) == 1]
        statements = integer_roots(equation, residues, denominator)
        if statements is not True:
            if not statements:
                return []
            statement = either(statements)
            found += [] if statement in found else [statement]
    return [both(*found)] if found else True

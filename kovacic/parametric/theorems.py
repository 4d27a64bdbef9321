"""Theorems about all values of the parameters, for equations that z = s^n brings to a standard one.

An equation is symmetric, S(m(x)) m'(x)^2 = S(x) for a Moebius map m of order n, where m is x -> c + zeta (x - c),
zeta^n = 1, or that in the coordinate 1/(x - p).  With z = s^n, s = x - c or 1/(x - p) - c, it becomes v'' = S_z v,
s^2 S = n^2 z^2 S_z + (n^2 - 1)/4 with S in the coordinate s, and the exponent differences at 0 and infinity are divided by n.

1. At most three singular points in z, all of them regular: Kimura's theorem (`riemann`).  C(x) is a cyclic extension of C(z),
branched at 0 and infinity: the group G over C(x) is normal in the one over C(z), H, with a cyclic quotient of an order that
divides n.  So an equation is solvable over both or neither, and

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

2. One irregular singular point and at most one other.  In a coordinate in which the irregular point is infinity and
the other one (or any chosen point) is 0,

    S = b/x^2 + r x^(n-2) + q x^(2n-2),   n >= 1,                                                                  (2)

are the equations treated here.  With z = x^n the exponent differences become Delta/n at 0, Delta^2 = 1 + 4b, and, for q != 0,
beta/n at infinity, beta^2 = r^2/q: Whittaker's equation with 2 kappa = beta/n and 2 mu = Delta/n.

Theorem [Martinet & Ramis 1989; Duval & Loday-Richaud 1992].  For q != 0 the equation has a Liouvillian solution exactly when
(beta + Delta)/n or (beta - Delta)/n is an odd integer, and then it is reducible (case 1): over C(z) the group is reducible or
SL2, for an imprimitive group needs two branch points, and a finite one no irregular point; SL2 has no subgroup of finite
index, so the group over C(x) is the same.  For q = 0, r != 0: case 1 never (n odd) and case 2 exactly when 2 Delta/n is an odd
integer, since an imprimitive group becomes reducible over C(sqrt x); n even is the first kind with n/2 and beta = 0.
The irregular point makes the group infinite.  For q != 0 a solution with a rational omega has one of two exponential factors;
the group is diagonal where both occur.  Then (beta + f Delta)/(2 n) and (-beta + g Delta)/(2 n) are positive half-integers, and
f = g: exactly where Delta/n is an integer and beta^2 < Delta^2, given the condition.

In case 1 there, with signs e, f (both +-1) for which d is a natural number (DLMF 18.8),

    y = weight x^((1 + f Delta)/2) exp(e sqrt(q) x^n/n) L_d^(f Delta/n)(-2 e sqrt(q) x^n/n),             (3)

d = (e beta - f Delta - n)/(2 n).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from itertools import chain
from math import gcd
from typing import Any, NamedTuple

import sympy

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import Structure
from kovacic.engine.places import Place, Problem, analyse, rational_square_root
from kovacic.parametric import restriction, riemann
from kovacic.parametric.claims import Classes, irreducible_factors, rational_number, signed_sums
from kovacic.parametric.exponents import singular_places
from kovacic.parametric.formulas import has_roots, in_sum, root_written, shifted, shorter_sum, shortest_form
from kovacic.parametric.integers import integer_roots
from kovacic.parametric.regions import ParameterRegion, RegionVerdict, Theorem, Theory, borel, reducible
from kovacic.parametric.solutions import BySigns, PolynomialSolution, Signed, SolutionsByDegree, jacobi, root_in_sympy
from kovacic.parametric.statements import Statement, all_of
from kovacic.reading.symbolic import written_expression


@dataclass(frozen=True)
class Coordinate:
    """z = s^n; `base` is the text of s, and y = weight * v with the solution v in s: `weight` is 1 or x - p."""

    base: str
    n: int = 1
    weight: str = "1"

    def __str__(self) -> str:
        if self.n == 1:
            return self.base
        base = self.base if self.base.isidentifier() else f"({self.base})"
        return f"{base}^{self.n}"


class Symmetric(NamedTuple):
    """s^2 S = num/den, polynomials in z = s^n, with S in the coordinate s."""

    coordinate: Coordinate
    num: Poly
    den: Poly

    def quotient(self, problem: Problem) -> Problem:
        """v'' = S_z v: s^2 S = n^2 z^2 S_z + (n^2 - 1)/4."""
        n = self.coordinate.n
        z = RatFunc(problem.field.x)
        return analyse((RatFunc(self.num, self.den) - Fraction(n * n - 1, 4)) / (n * z) ** 2, problem.budget)


def symmetries(problem: Problem, variable: str) -> Iterator[Symmetric]:
    """Coordinates s, with the largest n for which s^2 S, with S in this coordinate, is a function of z = s^n.

    They are found by the fixed points that a group of Moebius maps can have: the first one is infinity, or a pole.  With it at
    infinity, the other one is the mean of the poles, or of the zeros if there are no poles.
    """
    x = RatFunc(problem.field.x)
    rational_poles = [-place.factor[0] for place in problem.finite_places if place.degree == 1]
    for pole in (None, *rational_poles):
        S, base, weight = problem.S, variable, "1"
        if pole is not None:
            S = S(1 / x + pole) / x**4
            weight = shifted(variable, pole)
            base = f"1/{in_sum(weight)}"
        center = mean_of_singular_points(S)
        if center is None:
            continue
        square = S(x + center) * x * x
        parts = (square.num, square.den)
        n = gcd(*(i for part in parts for i, coefficient in enumerate(part) if coefficient))  # powers that occur
        coordinate = Coordinate(shifted(base, center), n, weight)
        # As polynomials in s^n, or numbers for n = 0.
        num, den = (problem.field.poly([part[i] for i in range(0, part.degree + 1, n or 1)]) for part in parts)
        yield Symmetric(coordinate, num, den)


def mean_of_singular_points(S: RatFunc) -> Poly | None:
    """The mean of the poles, or of the zeros of a polynomial; None for a constant."""
    points = S.den if S.den.degree else S.num
    return None if points.degree < 1 else points.mean_of_zeros


def kimura_theorem(problem: Problem, variable: str) -> Theorem | None:
    """Kimura's theorem, if the equation or its quotient has at most three singular points, all of them regular."""
    if not riemann.has_regular_points_only(problem):
        return None
    powers = (one for one in symmetries(problem, variable) if one.coordinate.n > 1)
    quotients = ((one.coordinate, one.quotient(problem)) for one in powers)
    for coordinate, equation in chain([(Coordinate(variable), problem)], quotients):
        if riemann.singular_points(equation) > 3:
            continue
        points = "singular points" if coordinate.n == 1 else f"singular points in `{coordinate}`"
        origin = Signed(partial(jacobi_formula, equation, coordinate, variable), 3)
        name = Theory(f"at most three regular {points}: Kimura's theorem", "Kim69")
        return Theorem(name, restriction.confluence(problem), kimura_regions(equation, coordinate.n, origin))
    return None


def kimura_regions(problem: Problem, n: int, origin: SolutionsByDegree) -> Iterator[ParameterRegion]:
    """The regions by `riemann.kimura_statements` for the equation in z = x^n, with the groups over C(x).

    `origin` has the solutions if the equation in z is reducible.
    """
    for structure, statement in riemann.kimura_statements(problem):
        # Equations in z with this structure that have a smaller group over C(x), and other solutions.
        if structure is Structure.IMPRIMITIVE and n % 2 == 0:
            yield ParameterRegion(_with_denominators(problem, (2, 2)), RegionVerdict(Structure.REDUCIBLE))
        if structure is Structure.TETRAHEDRAL and n % 3 == 0:
            quaternion = RegionVerdict(Structure.IMPRIMITIVE, family="the quaternion group")
            yield ParameterRegion(_with_denominators(problem, (3, 3, 2)), quaternion)
        verdict = riemann.verdict_by_exponents(problem, structure)
        if structure is Structure.OCTAHEDRAL and n % 2 == 0:
            verdict = replace(verdict, family="binary tetrahedral, or octahedral")
        yield ParameterRegion(statement, verdict, origin=origin if structure is Structure.REDUCIBLE else None)


def jacobi_formula(problem: Problem, coordinate: Coordinate, variable: str) -> BySigns | None:
    """Equation (1) for signs f, g, h; None if three singular points are conjugate."""
    base, weight = map(written_expression, (coordinate.base, coordinate.weight))
    points = _three_points(problem, sympy.Symbol(variable))
    if points is None:
        return None
    (c, first), (c1, second), (c2, third) = points
    z = base**coordinate.n
    last = sympy.Integer(1)
    if c2 is not None:
        argument = 1 - 2 * sympy.factor((z - c) * (c1 - c2) / ((z - c2) * (c1 - c)))
        last = z - c2
    elif has_roots(c) and not has_roots(sympy.expand(c + c1)):  # conjugate points
        argument = sympy.factor(c + c1 - 2 * z) / sympy.expand(c1 - c)
    else:
        argument = 1 - 2 * sympy.factor((z - c) / (c1 - c))

    def by_signs(signs: Sequence[Any]) -> PolynomialSolution:
        f, g, h = signs
        degree = shorter_sum((-1 - f * first - g * second - h * third) / 2)
        e, e1 = (sympy.expand((1 + difference) / 2) for difference in (f * first, g * second))
        own = -sympy.Rational(coordinate.n - 1, 2)
        powers = base**own * last ** sympy.expand(1 - e - e1)
        powers *= _positive_difference(z, c) ** e * _positive_difference(z, c1) ** e1
        y = weight * powers * jacobi(degree, f * first, g * second, argument)
        return PolynomialSolution(y, degree, jacobi=(f * first, g * second))

    return by_signs


#: A singular point (None at infinity) and its exponent difference.
_PointWithDifference = tuple[Any, Any]


def _three_points(problem: Problem, x: Any) -> list[_PointWithDifference] | None:
    """The three singular points, since an equation with two is always reducible; None if all are conjugate."""
    places = [place for place in singular_places(problem) if place.degree <= 2]
    return [*chain.from_iterable(_points_with_differences(place, x) for place in places)] or None


def _points_with_differences(place: Place, x: Any) -> list[_PointWithDifference]:
    """One point, or the roots of a quadratic factor; the square of the difference is q x + r at these."""
    square = place.difference_squared
    points = roots_of(place, x)
    if len(points) == 1:
        return [(points[0], root_in_sympy(square))]
    slope, constant = square[1].to_sympy(x), square[0].to_sympy(x)
    return [(c, _simplified_square_root(sympy.together(sympy.expand(slope * c) + constant))) for c in points]


def roots_of(place: Place, x: Any) -> list[Any]:
    """The points of a place of degree 1 or 2; infinity is None."""
    if place.at_infinity:
        return [None]
    if place.degree == 1:
        return [(-place.factor[0]).to_sympy(x)]
    linear = place.factor[1].to_sympy(x)
    constant = place.factor[0].to_sympy(x)
    radical = sympy.sqrt(sympy.factor(linear**2 - 4 * constant))
    return [(-linear + sign * radical) / 2 for sign in (1, -1)]


def _simplified_square_root(square: Any) -> Any:
    """The square root, without a radical for a square over Q(i)."""
    if not square.is_polynomial():
        return sympy.sqrt(square)
    constant, factors = sympy.factor_list(square, extension=sympy.I)
    if any(k % 2 for _, k in factors):
        return sympy.sqrt(square)
    return sympy.sqrt(constant) * sympy.prod(factor ** (k // 2) for factor, k in factors)


def _positive_difference(z: Any, c: Any) -> Any:
    """z - c, or c - z for a positive number c, so that it is positive at small z > 0."""
    return c - z if c.is_positive else z - c


def _with_denominators(problem: Problem, denominators: tuple[int, ...]) -> Statement:
    """The statement that the exponent differences at 0, at infinity and at the third point have these denominators."""
    squares = [problem.field.one] * 3
    for place in singular_places(problem):
        third = 2 if place.factor[0] else 0
        squares[1 if place.at_infinity else third] = place.difference_squared
    return all_of([riemann.has_denominator(*pair) for pair in zip(squares, denominators, strict=False)])


def laguerre_formula(coordinate: Coordinate, b: Poly, r: Poly, q: Poly, variable: str) -> BySigns:
    """Equation (3) for signs e, f, in the coordinate in which S has the form (2) with q != 0."""
    x = sympy.Symbol(variable)
    n = coordinate.n
    s, weight = map(written_expression, (coordinate.base, coordinate.weight))
    rate = root_in_sympy(q)
    delta = root_in_sympy(1 + 4 * b)
    beta = r.to_sympy(x) / rate

    def by_signs(signs: Sequence[Any]) -> PolynomialSolution:
        e, f = signs
        degree = shorter_sum((e * beta - f * delta - n) / (2 * n))
        u = sympy.expand(-2 * e * rate / n) * s**n
        y = s ** sympy.expand((1 + f * delta) / 2) * sympy.exp(-u / 2) * sympy.assoc_laguerre(degree, f * delta / n, u)
        return PolynomialSolution(weight * y, degree)

    return by_signs


def martinet_ramis(problem: Problem, variable: str) -> Theorem | None:
    """The theorem of Martinet & Ramis, if s^2 S is b + r z + q z^2 in z = s^n."""
    if riemann.singular_points(problem) > 2 or riemann.has_regular_points_only(problem):
        return None
    # The first coordinate in which s^2 S is a polynomial of degree 1 or 2 in z = s^n.
    fitting = (one for one in symmetries(problem, variable) if one.den.degree == 0 and one.num.degree in (1, 2))
    symmetric = next(fitting, None)
    if symmetric is None:
        return None
    coordinate, num, den = symmetric
    b, r, q = (num[k] / den[0] for k in range(3))
    if not q and coordinate.n % 2 == 0:  # b + r s^n is b + q z^2 in z = s^(n/2)
        coordinate, r, q = replace(coordinate, n=coordinate.n // 2), q, r
    n = coordinate.n
    author, squares = "Bessel", [4 * (1 + 4 * b)]  # N = 2 Delta is n modulo 2n
    verdict = RegionVerdict(Structure.IMPRIMITIVE, family="the infinite dihedral group")
    origin = None
    if q:  # N = +-beta +- Delta is n modulo 2n
        author, squares = "Whittaker", [r * r / q, 1 + 4 * b]
        verdict = _whittaker_group(squares[0], squares[1], n)
        origin = Signed(partial(laguerre_formula, coordinate, b, r, q, variable), 2)
    name = Theory(f"{author}'s equation in `{coordinate}`: Martinet & Ramis", "MR89", "DLR92")
    statement = integer_roots(signed_sums(squares, Fraction(0), b.field), Classes.of([n], 2 * n))
    region = ParameterRegion(statement, verdict, origin=origin)
    return Theorem(name, [*restriction.undefined(problem), *irreducible_factors(q or r)], [region])


def _whittaker_group(beta_squared: Poly, delta_squared: Poly, n: int) -> RegionVerdict:
    """The group of a reducible equation (2) for q != 0."""
    delta = rational_square_root(delta_squared / n**2)
    if not beta_squared:
        return reducible("`G_m`")
    is_constant = delta is not None or rational_number(delta_squared) is not None
    if is_constant and (delta is None or delta.denominator > 1 or not delta):
        return borel()
    where = f"`{shortest_form(beta_squared)} < {shortest_form(delta_squared)}`"
    return borel(where if delta is not None else f"`{root_written(delta_squared / n**2)}` is an integer and {where}")

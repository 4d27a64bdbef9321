"""Solutions exp(int theta) P with a P of given degree: theta from a choice of exponents at each place, conditions for P.

At a regular place theta has the residue (1 +- Delta)/2; at an irregular one its polar part is that of +- sqrt S, with a residue
that follows [Kovacic 1986, sec. 3.1].  With theta = R/D, D P'' + 2 R P' + ((R' D - R D' + R^2 - T)/D) P = 0 is a system for the
coefficients of P; at values with a solution P follows from its first coefficient.  In the same way the valuations at all places
leave a system for the P of a rational form of degree m in the solutions.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from typing import Any

from kovacic.algebra.extension import AlgebraicField, ExtensionPoly
from kovacic.algebra.function_field import FunctionField
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.engine.invariants import bounds
from kovacic.engine.places import Kind, Place, Problem
from kovacic.engine.riccati import Form, singular_part
from kovacic.parametric.ranks import RankConditions, rank_conditions

#: Q(t), or Q(t) with one square root.
Roots = FunctionField | AlgebraicField


@dataclass(frozen=True)
class LocalPart:
    """exponent/u - main(1/u)/u^2, u the `factor` x - c; at infinity (None) it is main(x), and the exponent that of 1/x."""

    factor: Poly | None
    exponent: Poly
    main: Poly

    @property
    def theta(self) -> RatFunc:
        if self.factor is None:
            return RatFunc(self.main)
        inverse = RatFunc(self.exponent * 0 + 1, self.factor)
        return inverse * self.exponent - RatFunc(self.main)(inverse) * inverse * inverse


@dataclass(frozen=True)
class Exponents:
    """A choice at each place, over Q(t), or with one square root."""

    field: Roots
    parts: tuple[LocalPart, ...]

    @property
    def degree(self) -> Poly:
        """That of P."""
        return 1 - sum((part.exponent for part in self.parts), self.field.poly([]))

    def images(self, problem: Problem, d: int) -> Iterator[Poly]:
        """The images of 1, x, ..., x^d under D P'' + 2 R P' + ((R' D - R D' + R^2 - T)/D) P, theta = R/D."""
        D = problem.D.over(self.field)
        R = (sum((part.theta for part in self.parts), RatFunc(0 * D)) * D).num
        for k in range(d + 1):
            yield 2 * Form(1, R, self.field.poly([0, 1]) ** k).numerators(problem)[-1] // D

    def polynomial(self, problem: Problem, d: int) -> Poly | None:
        """The only monic P of degree d that can solve the equation: its coefficients from the highest one down.

        None where they don't follow from one another.
        """
        images = [*self.images(problem, d)]
        shift = max(image.degree - k for k, image in enumerate(images))
        P, rest = self.field.poly([0] * d + [1]), images[d]
        for k in range(d - 1, -1, -1):
            if not images[k][k + shift]:
                return None
            factor = rest[k + shift] / images[k][k + shift]
            P, rest = P - self.field.poly([0] * k + [factor]), rest - images[k] * factor
        return P


def with_degree(problem: Problem, d: int) -> list[tuple[Exponents, RankConditions]] | None:
    """The choices that give this degree, each with the conditions for a P; None where one square root isn't enough."""
    chosen = _choices(problem)
    if chosen is None:
        return None
    found = []
    for exponents in (e for e in chosen if e.field.rational_value(e.degree) == d):
        field = exponents.field
        basis = [field.poly([1]), *([] if isinstance(field, FunctionField) else [field.generator])]
        images = [image * root for image in exponents.images(problem, d) for root in basis]
        found.append((exponents, rank_conditions(images, problem)))
    return found


def _choices(problem: Problem) -> list[Exponents] | None:
    """All choices of exponents; None where a place isn't rational or one square root isn't enough.

    The exponents at a place differ by a root: the exponent difference, or the root of the leading coefficient.
    """
    base, roots = problem.field, list[tuple[Place, Poly]]()
    assert isinstance(base, FunctionField)
    field: Roots = base
    for place in (place for place in problem.places if place.kind is not Kind.ORDINARY):
        if place.degree > 1:
            return None
        square = place.delta_squared if place.kind is Kind.REGULAR else _at_infinity(place, problem.S).lc
        assert square is not None  # at a single point
        root = field.sqrt(square.over(field))
        if root is None and field == base:
            field = AlgebraicField(base, base.poly([-square, 0, 1]), "root")
            root = field.generator
        if root is None:
            return None
        roots.append((place, root))
    S = RatFunc(problem.S.num.over(field), problem.S.den.over(field))
    parts = [_local_parts(place, S, root.over(field)) for place, root in roots]
    return [Exponents(field, choice) for choice in product(*parts)]


def _at_infinity(place: Place, S: RatFunc) -> Poly:
    """The polynomial part of z S(z), where v'' = S(z) v is the equation in a coordinate in which the place is infinity."""
    x = S.field.poly([0, 1])
    if not place.at_infinity:  # v(z) = z y(c + 1/z)
        S = S(RatFunc(1 - place.factor[0] * x, x)) / RatFunc(x**4)
    return S.num * x // S.den


def _local_parts(place: Place, S: RatFunc, root: Poly) -> list[LocalPart]:
    """The two local parts of theta."""
    x, factor = root.field.poly([0, 1]), None if place.at_infinity else place.factor.over(root.field)
    if place.kind is Kind.REGULAR:
        return [LocalPart(factor, (1 + sign * root) / 2, 0 * x) for sign in (1, -1)]
    n, quotient = place.order // 2 - 2, _at_infinity(place, S)
    main = root * x**n  # S - main^2 = b x^(n-1) + ..., and omega = +-main + e/x + ... with e = (+-b/a - n)/2
    for k in range(1, n + 1):
        main = main + (quotient - x * main * main)[2 * n - k + 1] / (2 * root) * x ** (n - k)
    ratio = (quotient - x * main * main)[n] / root
    return [LocalPart(factor, 1 - (sign * ratio - n) / 2, sign * main) for sign in (1, -1)]


def form_conditions(problem: Problem, m: int) -> RankConditions:
    """Where there are more rational forms of degree m than generically."""
    bound = bounds(problem, m, logarithms=False)  # whether or not there is a logarithm at special values
    if bound is None:
        return RankConditions()
    (valuations, N), x = bound, problem.field.poly([0, 1])
    R0 = singular_part(problem, valuations[:-1])
    return rank_conditions([Form(m, R0, x**j).numerators(problem)[-1] for j in range(N + 1)], problem)


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
    x, field = sympy.Symbol(variable), exponents.field
    square = -field.modulus[0] if isinstance(field, AlgebraicField) else field.poly([1])
    c = sympy.sqrt(sympy.factor(square.to_sympy(x)))

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


def may_be_natural(degree: Any) -> bool:
    """Is it a natural number, or can it be one for some values of the parameters?"""
    return bool(degree.free_symbols or (degree.is_Integer and degree >= 0))


def root(square: Poly) -> Any:
    """The square root of a constant, up to its sign."""
    import sympy

    root, x = square.field.sqrt(square), sympy.Symbol("x")
    return sympy.sqrt(sympy.factor(square.to_sympy(x))) if root is None else sympy.expand(root.to_sympy(x))

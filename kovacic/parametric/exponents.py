"""Solutions exp(int theta) P with a P of given degree: theta from a choice of exponents at each place, conditions for P.

At a regular place theta has the residue (1 +- Delta)/2; at an irregular one its polar part is that of +- sqrt S, with a residue
that follows [Kovacic 1986, sec. 3.1].  With theta = R/D, D P'' + 2 R P' + ((R' D - R D' + R^2 - T)/D) P = 0 is a system for the
coefficients of P.  The roots Delta and sqrt S need lie in no field that is given: conjugate poles are split, and square roots
adjoined, one after the other.  A system over such an extension is one over the field below for the coordinates of P, and it has
a solution where one of the conjugate systems has one; which of them is told by P itself, whose coefficients follow from the
highest one.  In the same way the valuations at all places leave a system for the P of a rational form of degree m.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import NamedTuple

from kovacic.algebra.extension import AlgebraicField, adjoined_square_root
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.engine.invariants import bounds, least_valuation
from kovacic.engine.local import irregular_difference_squared
from kovacic.engine.places import Kind, Place, Problem, analyse
from kovacic.engine.riccati import Form, singular_part
from kovacic.parametric.ranks import RankConditions, has_kernel, rank_conditions

#: The degree of the extension that the exponents may need, and singular points up to which all choices are tried.
_DEGREE = 16
_POINTS = 8
#: The degree of a hypersurface in its parameter up to which roots are looked for in its field: factoring there is slow.
_SURFACE = 2


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
    """A choice at each point of the `problem`, whose singular points are rational over the field of the choice."""

    problem: Problem
    field: Field
    parts: tuple[LocalPart, ...]

    @property
    def degree(self) -> Poly:
        """That of P."""
        return 1 - sum((part.exponent for part in self.parts), self.field.poly([]))

    def images(self, d: int) -> list[Poly]:
        """The images of 1, x, ..., x^d under D P'' + 2 R P' + ((R' D - R D' + R^2 - T)/D) P, theta = R/D."""
        D = self.problem.D.over(self.field)
        x = self.field.poly([0, 1])
        R = (sum((part.theta for part in self.parts), RatFunc(0 * D)) * D).num
        return [2 * Form(1, R, x**k).numerators(self.problem)[-1] // D for k in range(d + 1)]

    def polynomial(self, d: int) -> PossiblePolynomial | None:
        """The only monic P of degree d that can solve the equation.

        The coefficients follow from the highest one down; None where they don't.
        """
        images = self.images(d)
        shift = max(image.degree - k for k, image in enumerate(images))
        P = self.field.poly([0] * d + [1])
        rest = images[d]
        for k in range(d - 1, -1, -1):
            if not images[k][k + shift]:
                return None
            factor = rest[k + shift] / images[k][k + shift]
            P = P - self.field.poly([0] * k + [factor])
            rest = rest - images[k] * factor
        return PossiblePolynomial(P, rest)


class PossiblePolynomial(NamedTuple):
    """A polynomial that solves an equation where `rest`, what is left of its image, is 0."""

    P: Poly
    rest: Poly


class ExponentRoot(NamedTuple):
    """sqrt(square), of which multiples k occur with an integer k, |k| <= largest."""

    square: Poly
    largest: int


@dataclass(frozen=True)
class Numbers:
    """What the exponents allow as a degree of P, or as the number of zeros of a form: constant + sum of k times a root.

    With `only_signs` each k is 1 or -1.
    """

    constant: Fraction
    roots: tuple[ExponentRoot, ...]
    only_signs: bool = False


def degrees_of_solutions(problem: Problem) -> Numbers | None:
    """The degrees of P in exp(int theta) P; None where the exponents differ at conjugate points."""
    roots: list[ExponentRoot] = []
    singular = _singular(problem)
    for place in singular:
        square = place.delta_squared if place.kind is Kind.REGULAR else irregular_difference_squared(place)
        if square is None or square.degree > 0:
            return None
        roots += [ExponentRoot(square / 4, 1)] * place.degree
    weights = sum(place.weight * place.degree for place in singular)
    return Numbers(1 - Fraction(weights) / 2, tuple(roots), only_signs=True)


def zeros_of_forms(problem: Problem, m: int) -> Numbers | None:
    """The numbers of zeros of rational forms of an even degree m; None where some place leaves none.

    Exponents that differ at conjugate poles are left out.
    """
    roots: list[ExponentRoot] = []
    room = m
    for place in problem.places:
        if place.kind is Kind.REGULAR and place.delta_squared is None:
            continue
        square = place.delta_squared if place.kind is Kind.REGULAR else None
        if square is not None and square.field.rational_value(square) is None:
            largest = m // 2 * place.degree
            roots.append(ExponentRoot(square, largest))
            room -= largest
            continue
        valuation = least_valuation(place, m, logarithms=False)
        if valuation is None:
            return None
        room -= valuation * place.degree
    return Numbers(Fraction(room), tuple(roots))


def choices_of_degree(problem: Problem, d: int) -> list[Exponents] | None:
    """The choices that give P this degree; None where there are too many, or their roots need too large an extension."""
    places = places_of(problem)
    if places is None:
        return None
    chosen = (Exponents(places.problem, places.field, parts) for parts in product(*places.parts))
    return [exponents for exponents in chosen if exponents.field.rational_value(exponents.degree) == d]


def conditions_of_degree(problem: Problem, d: int) -> list[RankConditions] | None:
    """For each of these choices, where there is a P of the degree: over the field of the problem."""
    chosen = choices_of_degree(problem, d)
    if chosen is None:
        return None
    found = []
    for exponents in chosen:
        images = _coordinates(exponents.images(d), exponents.field, problem.field)
        found.append(rank_conditions(images, problem.field))
    return found


def has_solution(problem: Problem, d: int) -> bool | None:
    """Over a field of numbers: is there a solution with a P of this degree?  None as in `choices_of_degree`."""
    chosen = choices_of_degree(problem, d)
    if chosen is None:
        return None
    numbers = problem.field.ground
    return any(has_kernel(_coordinates(e.images(d), e.field, numbers)) for e in chosen)


def _coordinates(images: Sequence[Poly], field: Field, below: Field) -> list[Poly]:
    """The images under the same map over the field below: those of the basis of the extension times 1, x, ...

    The coordinates of an image are put into one polynomial, one behind the other for each power.
    """
    basis = [field.poly([1])]  # products of powers of the generators
    level = field
    while level != below:
        assert isinstance(level, AlgebraicField)
        basis = [element * level.generator**k for k in range(level.dimension) for element in basis]
        level = level.base
    if len(basis) == 1:
        return list(images)
    found = []
    for image in images:
        for element in basis:
            parts = _parts(image * element, below)
            size = max(part.degree for part in parts) + 1
            found.append(below.poly([part[k] for k in range(size) for part in parts]))
    return found


def _parts(polynomial: Poly, below: Field) -> list[Poly]:
    """The coordinates of a polynomial over a field below its own."""
    if polynomial.field == below:
        return [polynomial]
    found = []
    for part in polynomial.parts:
        found += _parts(part, below)
    return found


@dataclass(frozen=True)
class Places:
    """One or two choices at each singular point, rational over the field."""

    problem: Problem
    field: Field
    parts: list[list[LocalPart]]


def is_too_large(field: Field) -> bool:
    """Is it that of a hypersurface of too high a degree, for which no exponents are looked for?"""
    return field.ground != QQ and field.absolute_degree > _SURFACE


def places_of(problem: Problem) -> Places | None:
    """The choices differ by a root: the exponent difference, or the root of a leading coefficient."""
    if is_too_large(problem.field):
        return None
    if sum(place.degree for place in _singular(problem)) > _POINTS:
        return None
    split = _with_rational_points(problem)
    if split is None:
        return None
    singular = _singular(split)
    field = split.field
    roots: list[Poly] = []
    for place in singular:
        square = place.delta_squared if place.kind is Kind.REGULAR else _at_infinity(place, split.S).lc
        assert square is not None  # at a single point
        root = _square_root(square.over(field), field)
        field = root.field
        if _degree_over(field, problem.field) > _DEGREE:
            return None
        roots.append(root)
    S = RatFunc(split.S.num.over(field), split.S.den.over(field), reduced=True)
    parts = [_local_parts(place, S, root.over(field)) for place, root in zip(singular, roots, strict=True)]
    return Places(split, field, parts)


def _singular(problem: Problem) -> list[Place]:
    return [place for place in problem.places if place.kind is not Kind.ORDINARY]


def _with_rational_points(problem: Problem) -> Problem | None:
    """The same problem over an extension over which its singular points are rational; None where that is too large."""
    base = problem.field
    while factor := next((place.factor for place in problem.finite_places if place.degree > 1), None):
        if factor.degree == 2:
            extension = _square_root(factor[1] * factor[1] - 4 * factor[0], problem.field).field
        else:
            extension = AlgebraicField(problem.field, factor, "point")
        if _degree_over(extension, base) > _DEGREE:
            return None
        S = RatFunc(problem.S.num.over(extension), problem.S.den.over(extension), reduced=True)
        problem = analyse(S, problem.budget)
    return problem


def _degree_over(field: Field, base: Field) -> int:
    return field.absolute_degree // base.absolute_degree


def _square_root(square: Poly, field: Field) -> Poly:
    """A square root of a constant; one that has to be adjoined is called so that it is written as a radical."""
    root = field.sqrt(square)
    if root is not None:
        return root
    if field.ground == field and not isinstance(square, FunctionPoly):
        return adjoined_square_root(field, square)
    outer = field.poly([1])
    inner = square
    if isinstance(square, FunctionPoly):
        outer, inner = square.square_part()
    return AlgebraicField(field, field.poly([-inner, 0, 1]), f"sqrt({inner.to_str()})").generator * outer


def _at_infinity(place: Place, S: RatFunc) -> Poly:
    """The polynomial part of z S(z), where v'' = S(z) v is the equation in a coordinate in which the place is infinity."""
    x = S.field.poly([0, 1])
    if not place.at_infinity:  # v(z) = z y(c + 1/z)
        S = S(RatFunc(1 - place.factor[0] * x, x)) / RatFunc(x**4)
    return S.num * x // S.den


def _local_parts(place: Place, S: RatFunc, root: Poly) -> list[LocalPart]:
    """The two local parts of theta; one where the exponents are equal."""
    x = root.field.poly([0, 1])
    factor = None if place.at_infinity else place.factor.over(root.field)
    if place.kind is Kind.REGULAR:
        signs = (1, -1) if root else (1,)
        return [LocalPart(factor, (1 + sign * root) / 2, 0 * x) for sign in signs]
    n = place.order // 2 - 2
    quotient = _at_infinity(place, S)
    main = root * x**n  # S - main^2 = b x^(n-1) + ..., and omega = +-main + e/x + ... with e = (+-b/a - n)/2
    for k in range(1, n + 1):
        rest = quotient - x * main * main
        main = main + rest[2 * n - k + 1] / (2 * root) * x ** (n - k)
    ratio = (quotient - x * main * main)[n] / root
    return [LocalPart(factor, 1 - (sign * ratio - n) / 2, sign * main) for sign in (1, -1)]


def form_images(problem: Problem, m: int) -> list[Poly] | None:
    """The images of 1, x, ..., x^N under the map whose kernel has the P of the rational forms of degree m.

    Whether or not there are logarithms at special values.  None where there can be no such form.
    """
    bound = bounds(problem, m, logarithms=False)
    if bound is None:
        return None
    valuations, N = bound
    x = problem.field.poly([0, 1])
    R0 = singular_part(problem, valuations[:-1])
    return [Form(m, R0, x**j).numerators(problem)[-1] for j in range(N + 1)]


def form_conditions(problem: Problem, m: int) -> RankConditions:
    """Where there are more rational forms of degree m than generically."""
    images = form_images(problem, m)
    if images is None:
        return RankConditions()
    return rank_conditions(images, problem.field)


def has_form(problem: Problem, m: int) -> bool:
    """Over a field of numbers: is there a rational form of degree m in the solutions?"""
    images = form_images(problem, m)
    return images is not None and has_kernel(_coordinates(images, problem.field, problem.field.ground))

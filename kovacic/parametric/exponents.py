"""Solutions exp(int theta) P with a P of given degree: theta from a choice of exponents at each place, conditions for P.

At a regular place theta has the residue (1 +- Delta)/2; at an irregular one its polar part is that of +- sqrt S, with a residue
that follows [Kovacic 1986, sec. 3.1].  P'' + 2 theta P' + (theta' + theta^2 - S) P = 0 is a system for its coefficients.
In the same way the valuations at all places leave a system for the P of a rational form of degree m in the solutions.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionField
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.engine import invariants
from kovacic.engine.places import Kind, Place, Problem
from kovacic.engine.riccati import Form, singular_part
from kovacic.limits import check_time
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
    """A choice at each place, over Q(t), or over Q(t)(c) where c^2 is `square`."""

    field: Roots
    parts: tuple[LocalPart, ...]

    @property
    def degree(self) -> Poly:
        """That of P."""
        return 1 - sum((part.exponent for part in self.parts), self.field.poly([]))

    @property
    def square(self) -> Poly | None:
        return -self.field.modulus[0] if isinstance(self.field, AlgebraicField) else None

    def operator(self, S: RatFunc) -> tuple[Poly, Poly, Poly]:
        """Polynomials with A P'' + B P' + C P = 0."""
        theta = sum((part.theta for part in self.parts), RatFunc(self.field.poly([])))
        zeroth = theta.derivative() + theta * theta - RatFunc(S.num.over(self.field), S.den.over(self.field))
        common = theta.den * zeroth.den
        return common, (2 * theta * common).num, (zeroth * common).num

    def polynomial(self, S: RatFunc, d: int) -> Poly | None:
        """The only monic P of degree d that can solve the equation: its coefficients from the highest one down.

        None where they don't follow from one another.
        """
        A, B, C = self.operator(S)
        x, top = self.field.poly([0, 1]), max(A.degree - 2, B.degree - 1, C.degree)
        P = x**d
        for k in range(d - 1, -1, -1):
            image, own = (A * p.derivative().derivative() + B * p.derivative() + C * p for p in (P, x**k))
            if not own[k + top]:
                return None
            P = P - x**k * (image[k + top] / own[k + top])
        return P


def with_degree(problem: Problem, d: int) -> list[tuple[Exponents, RankConditions]] | None:
    """The choices that give this degree, each with the conditions for a P; None where one square root isn't enough."""
    chosen = _choices(problem)
    if chosen is None:
        return None
    found = []
    for exponents in chosen:
        field = exponents.field
        if field.rational_value(exponents.degree) != d:
            continue
        A, B, C = exponents.operator(problem.S)
        images: list[Poly] = []
        for power in range(d + 1):
            P = field.poly([0, 1]) ** power
            image = A * P.derivative().derivative() + B * P.derivative() + C * P
            images += [image] if isinstance(field, FunctionField) else [image, image * field.generator]
            check_time()
        found.append((exponents, rank_conditions(images, problem)))
    return found


def _choices(problem: Problem) -> list[Exponents] | None:
    """All choices of exponents; None where a place isn't rational or one square root isn't enough.

    The exponents at a place differ by a root: the exponent difference, or the root of the leading coefficient.
    """
    base = problem.field
    assert isinstance(base, FunctionField)
    field: Roots = base
    roots: list[tuple[Place, Poly]] = []
    for place in problem.places:
        if place.kind is Kind.ORDINARY:
            continue
        if place.degree > 1:
            return None
        square = place.delta_squared if place.kind is Kind.REGULAR else _at_infinity(place, problem.S).lc
        root = None if square is None else field.sqrt(square.over(field))
        if root is None and square is not None and field == base:
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


def least_valuation(place: Place, m: int) -> int | None:
    """The least valuation of a rational form of degree m, whether or not there is a logarithm at special values."""
    return invariants.least_valuation(place, m, logarithms=False)


def number_of_zeros(problem: Problem, m: int) -> int | None:
    """The largest degree of P for a form of degree m; None where there is no such form at any values of the parameters."""
    valuations = [least_valuation(place, m) for place in problem.places]
    known = [v for v in valuations if v is not None]
    if len(known) < len(valuations):
        return None
    N = m - known[-1] - sum(v * place.degree for v, place in zip(known, problem.finite_places, strict=False))
    return N if N >= 0 else None


def form_conditions(problem: Problem, m: int) -> RankConditions:
    """Where there are more rational forms of degree m than generically."""
    N = number_of_zeros(problem, m)
    if N is None:
        return RankConditions()
    valuations = [least_valuation(place, m) for place in problem.finite_places]
    R0 = singular_part(problem, [v for v in valuations if v is not None])
    x = problem.field.poly([0, 1])
    images = []
    for j in range(N + 1):
        images.append(Form(m, R0, x**j).numerators(problem)[-1])
        check_time()
    return rank_conditions(images, problem)

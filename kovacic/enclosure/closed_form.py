"""Route (a): transition matrices from the certificate of a decision, without integrating the equation.

The guarantee is that of route (b), with which nothing is shared: the matrices of balls contain the exact transition
matrices along the leg.

A leg from a to b is carried by the closed form (E = exp int_a^x theta, followed continuously, see `exponential`):
- case 1, two rational or conjugate omega = theta + P'/P: y = E P for either.
- case 1, a unique omega: y1 = E P, y2 = y1 int dx/y1^2.  P has simple zeros at ordinary points, where the integrand has
  double poles; they are split off exactly [Hermite's reduction]: with A P' = -1 mod P,

      1/y1^2 = (A/(P E^2))' + B/E^2,    B = (1 + A P' - A' P + 2 theta A P)/P^2,    y2 = A/E + y1 int_a^x B/E^2 dx,   (1)

  and B has no poles but the singular points of S.  Where E^2 is rational the integral is one of partial fractions, else
  a rigorous quadrature.
- case 2, f = y+ y- = E P, w^2 = 4 S f^2 - 2 f f'' + f'^2 (a constant), y+-'/y+- = (f' +- w)/(2 f), in which a zero of f is
  removed by the conjugate:

      y-'/y- = (f'' - 2 S f)/(f' + w)  where f' + w has no zero,   y+'/y+ = (f'' - 2 S f)/(f' - w)  where f' - w has none; (2)

  the leg is cut into pieces of these two kinds, and the other solution is the quotient of f and this one.
- case 3: Klein's form, see `klein`.
So the zeros of P need not be known, and no leg goes around them.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.partial_fractions import decompose
from kovacic.enclosure.carry import Itinerary, Start, carry
from kovacic.enclosure.exponential import LogDerivative, conjugates, embed, integral
from kovacic.enclosure.gauge import with_gauge
from kovacic.enclosure.klein import Chart, charts, klein_leg
from kovacic.enclosure.pieces import Piece, Quotient, cut, fundamental, quotient, unknown, values
from kovacic.enclosure.points import Point, to_acb
from kovacic.enclosure.problem import NumericProblem
from kovacic.enclosure.singular import check_segment
from kovacic.enclosure.transport import adjugate, multiply
from kovacic.errors import InputError
from kovacic.limits import Budget
from kovacic.solution import Solution

if TYPE_CHECKING:
    from flint import acb, acb_poly

    from kovacic.algebra.poly import Poly
    from kovacic.decision import Decision
    from kovacic.enclosure.taylor import Matrix

_CHEAP_DEGREE = 60
"""Degree of P up to which its evaluation costs less than the Taylor steps."""

_LARGEST_SQUARE = 1_000
"""Degree up to which y1^2 is written out; it may be x^1000000."""


@dataclass(frozen=True)
class ClosedForm:
    """The certificate that the legs are computed from, and what follows from it exactly, computed once."""

    problem: NumericProblem
    S: RatFunc
    decision: Decision

    @property
    def case(self) -> int | None:
        """Kovacic's case."""
        return self.decision.case

    @property
    def theta(self) -> RatFunc:
        """f'/f = theta + P'/P for the product f of the solutions with conjugate omegas (case 1: for y1 itself)."""
        assert self.decision.semi_invariant is not None
        return self.decision.semi_invariant.theta

    @property
    def P(self) -> Poly:
        """The polynomial factor of f."""
        assert self.decision.semi_invariant is not None
        return self.decision.semi_invariant.P

    @cached_property
    def second(self) -> tuple[RatFunc, Poly] | None:
        """(theta, P) of the other omega, where two of them are rational."""
        semi, product = self.decision.semi_invariant, self.decision.invariant
        if semi is None or product is None or semi.theta.field != product.theta.field:
            return None
        zeros = product.P.exact_quotient(semi.P)
        if zeros is None or product.logarithmic_derivative == 2 * semi.logarithmic_derivative:
            return None
        return product.theta - semi.theta, zeros

    @cached_property
    def reduction(self) -> tuple[Poly, RatFunc]:
        """A and B of equation (1)."""
        theta, P = self.theta, self.P
        slope = P.derivative()
        A = -(slope.inverse_modulo(P)) if P.degree > 0 else P.field.poly([])
        # theta.den (1 + A P' - A' P) + 2 theta.num A P, divided by P^2
        top = theta.den * (A * slope - A.derivative() * P + 1) + 2 * theta.num * A * P
        quotient = top.exact_quotient(P * P)
        if quotient is None:
            raise AssertionError("the zeros of the solution are ordinary points")
        return A, RatFunc(quotient, theta.den)

    @cached_property
    def square_size(self) -> int | None:
        """The degrees together of numerator and denominator of a rational function with the logarithmic derivative 2 theta;
        None where there is none."""
        parts = decompose(self.theta * 2)
        values = [r.value.field.rational_value(r.value) if r.is_constant else None for r in parts.residues]
        if parts.exact or any(value is None or value.denominator != 1 for value in values):
            return None
        return sum(abs(int(v)) * r.factor.degree for r, v in zip(parts.residues, values, strict=True) if v is not None)

    @cached_property
    def rational_square(self) -> RatFunc | None:
        """A rational function with the logarithmic derivative 2 theta; None if there is none, or one too large to write out."""
        if self.square_size is None or self.square_size > _LARGEST_SQUARE:
            return None
        total = RatFunc(self.P.field.poly([1]))
        for residue in decompose(self.theta * 2).residues:
            value = residue.value.field.rational_value(residue.value)
            assert value is not None
            total = total * RatFunc(residue.factor) ** int(value)
        return total

    @property
    def is_cheap(self) -> bool:
        """Case 1: does a leg cost less than Taylor steps (measured): no quadrature, and no polynomial of a high degree?"""
        two = len(conjugates(self.P.field)) == 2 or self.second is not None
        return self.P.degree <= _CHEAP_DEGREE and (
            two or (self.square_size is not None and self.square_size <= 2 * _CHEAP_DEGREE)
        )

    @cached_property
    def charts(self) -> tuple[Chart, ...]:
        """Klein's form, case 3."""
        assert self.decision.structure is not None
        return charts(self.S, self.decision.structure, self.decision.invariant)


def closed_form_of(problem: NumericProblem) -> ClosedForm:
    """The certificate of a solution; raises InputError where there is none."""
    source = problem.source
    if not isinstance(source, Solution) or source.semi_invariant is None:
        raise InputError(
            "the method 'closed form' needs a Liouvillian solution with its certificate",
            hint="pass kovacic.solve(S) with status LIOUVILLIAN, or use method='taylor'",
        )
    return ClosedForm(problem, source.S, source.decision)


def leg_matrix(closed: ClosedForm, a: Point, b: Point, budget: Budget) -> list[Matrix]:
    """Transition matrices whose product carries (y, y') from a to b along the straight segment."""
    if a == b:
        return []
    check_segment(closed.problem.system, a, b)
    budget.check()
    if closed.case == 3:
        return klein_leg(closed.charts, a, b, budget)
    if closed.case == 2:
        return _pair_leg(closed, a, b, budget)
    embeddings = conjugates(closed.P.field)
    if len(embeddings) == 2:
        return [_two_exponentials([(closed.theta, closed.P, c) for c in embeddings], a, b)]
    if closed.second is not None:
        return [_two_exponentials([(closed.theta, closed.P, None), (*closed.second, None)], a, b)]
    return [_integral_leg(closed, a, b, budget)]


def _two_exponentials(solutions: list[tuple[RatFunc, Poly, acb | None]], a: Point, b: Point) -> Matrix:
    """Case 1 with two omegas: y = E P for either."""
    za, zb = to_acb(a), to_acb(b)
    at_a, at_b = [], []
    for function, polynomial, c in solutions:
        theta, P = LogDerivative.make(function, c), embed(polynomial, c)
        slope, growth = P.derivative(), theta.growth(za, zb)
        at_a.append((P(za), theta.value(za) * P(za) + slope(za)))
        at_b.append((growth * P(zb), growth * (theta.value(zb) * P(zb) + slope(zb))))
    return quotient(fundamental(*at_b), fundamental(*at_a))


def _integral_leg(closed: ClosedForm, a: Point, b: Point, budget: Budget) -> Matrix:
    """Case 1 with a unique omega, equation (1)."""
    from flint import acb

    za, zb = to_acb(a), to_acb(b)
    theta = LogDerivative.make(closed.theta, None)
    exact_A, exact_B = closed.reduction
    P, A, B = embed(closed.P, None), embed(exact_A, None), Quotient.make(exact_B, None)
    dP, dA = P.derivative(), A.derivative()

    def integrand(z: acb, analytic: bool) -> acb:
        return B(z) * (-2 * theta.exponent(za, z, analytic=analytic)).exp()

    square = closed.rational_square
    if square is not None:
        scale = Quotient.make(square, None)(za)
        area = LogDerivative.make(exact_B / square, None).exponent(za, zb) * scale
    else:
        area = integral(integrand, za, zb, budget)

    def states(x: acb, E: acb, I: acb) -> tuple[tuple[acb, acb], tuple[acb, acb]]:  # noqa: E741 - the integral in (1)
        t, p, alpha = theta.value(x), P(x), A(x)
        y, dy = E * p, E * (t * p + dP(x))
        return (y, dy), (alpha / E + y * I, (dA(x) - t * alpha + B(x) * p) / E + dy * I)

    at_a, at_b = fundamental(*states(za, acb(1), acb(0))), fundamental(*states(zb, theta.growth(za, zb), area))
    return multiply(at_b, adjugate(at_a))  # the Wronskian of y1 and y2 is 1


def _pair_leg(closed: ClosedForm, a: Point, b: Point, budget: Budget) -> list[Matrix]:
    """Case 2, equation (2): the leg is cut into pieces with a fixed sign."""
    pair = Pair.make(closed, to_acb(a))
    pieces = cut(Piece(a, b), pair.sign_on, budget)
    if pieces is None:
        return [unknown()]
    return [pair.matrix(sign, to_acb(piece.a), to_acb(piece.b), budget) for piece, sign in pieces]


@dataclass(frozen=True)
class Pair:
    """f = y+ y- = E P and w in balls, E = 1 at `origin`: f' = E first, f'' - 2 S f = E (second - 2 S P)."""

    origin: acb
    theta: LogDerivative
    P: acb_poly
    first: Quotient
    second: Quotient
    S: Quotient
    w: acb

    @classmethod
    def make(cls, closed: ClosedForm, origin: acb) -> Pair:
        """The pair of a decision of case 2; w is one of the two square roots."""
        t, P = closed.theta, closed.P
        c = conjugates(P.field)[0]
        dP = P.derivative()
        first = Quotient.make(t * P + dP, c)
        second = Quotient.make((t.derivative() + t * t) * P + 2 * t * dP + dP.derivative(), c)
        S, p = Quotient.make(closed.S, None), embed(P, c)
        f, df, rest = p(origin), first(origin), second(origin) - 2 * S(origin) * p(origin)
        return cls(origin, LogDerivative.make(t, c), p, first, second, S, (df * df - 2 * f * rest).sqrt())

    def sign_on(self, piece: Piece) -> int | None:
        """+1 or -1 where f' + w or f' - w is proven to have no zero on the piece; None where neither is."""
        start = to_acb(piece.a)
        slope, w = self.first(piece.box()), self.wronskian(start) / self.theta.growth(start, piece.box())
        for sign in (1, -1):
            value = slope + sign * w
            if value.is_finite() and not value.contains(0):
                return sign
        return None

    def wronskian(self, x: acb) -> acb:
        """w for E = 1 at x."""
        return self.w / self.theta.growth(self.origin, x)

    def matrix(self, sign: int, a: acb, b: acb, budget: Budget) -> Matrix:
        """The transition matrix from a to b, a piece with this sign of the leg that begins at `origin`."""
        from flint import acb

        w = sign * self.wronskian(a)

        def omega(z: acb, analytic: bool = False) -> acb:
            """y'/y of y- (sign 1) or y+ (sign -1)."""
            rest = self.second(z) - 2 * self.S(z) * values(self.P, z)
            return rest / (self.first(z) + w * (-self.theta.exponent(a, z, analytic=analytic)).exp())

        def states(x: acb, E: acb, y: acb) -> tuple[tuple[acb, acb], tuple[acb, acb]]:
            slope, f = omega(x), E * self.P(x)
            return (y, y * slope), (f / y, (E * self.first(x) - f * slope) / y)

        growth = integral(omega, a, b, budget).exp()
        at_a, at_b = states(a, acb(1), acb(1)), states(b, self.theta.growth(a, b), growth)
        return quotient(fundamental(*at_b), fundamental(*at_a))


@dataclass(frozen=True)
class ClosedFormRoute:
    """Route (a) as a `kovacic.enclosure.precision.Route`."""

    closed: ClosedForm
    itinerary: Itinerary
    start: Start

    def __call__(self, prec: int, budget: Budget) -> list[tuple[acb, acb]]:
        legs = with_gauge(self.closed.problem.gauge, lambda a, b: leg_matrix(self.closed, a, b, budget))
        return carry(legs, self.itinerary, self.start)


def closed_form_route(problem: NumericProblem, itinerary: Itinerary, start: Start) -> ClosedFormRoute:
    """The route of a solution with a certificate; raises InputError where there is none."""
    return ClosedFormRoute(closed_form_of(problem), itinerary, start)

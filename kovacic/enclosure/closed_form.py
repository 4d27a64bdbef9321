"""Case 1 in balls: logarithmic derivatives of solutions, and transition matrices without integrating the equation.

The guarantee of the matrices is that of the Taylor route, with which nothing is shared: they contain the exact transition
matrices along the leg.  They follow from the certificate of the decision: two rational or conjugate omega = theta + P'/P,
and y = E P for either, E = exp int_a^x theta, followed continuously (see `kovacic.enclosure.log_derivative`).  Where y1^2 is a
rational function of small degree, and int y1^-2 is rational, y2 = y1 int y1^-2 is such a solution, too.  The zeros of P need
not be known.  Other closed forms (quadratures, hypergeometric functions) cost more than Taylor steps, and aren't used.

`omega` numbers the solutions whose logarithmic derivative is algebraic: in case 1 the conjugates of omega, or the two rational
ones; in cases 2 and 3 the roots of the polynomial of omega at the point, by real part and then imaginary part.
"""

from __future__ import annotations

import math
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property, cmp_to_key, lru_cache

from flint import acb, acb_poly, arb

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.partial_fractions import decompose
from kovacic.algebra.poly import Poly
from kovacic.algebra.precision import working_precision
from kovacic.algebra.ratfunc import RatFunc, logarithmic_derivative
from kovacic.decision import SemiInvariant
from kovacic.enclosure.frame import check_segment
from kovacic.enclosure.log_derivative import LogDerivative, conjugates, embed, log_derivative, sharp_roots
from kovacic.enclosure.matrices import Matrix, State, fundamental, inverse_matrix, multiply
from kovacic.enclosure.points import ExactPoint, kept_at_precision, to_acb
from kovacic.enclosure.problem import NumericProblem
from kovacic.engine.decide import decide_reducible
from kovacic.errors import InputError, VerificationFailed
from kovacic.limits import Budget, Limits, bounded_work, check_time
from kovacic.numbers.numerals import in_a_message
from kovacic.special import prices
from kovacic.verify import verify

# Degree of y1^2 P up to which a second rational omega is sought by integration: 13 ms for 60, 0.8 s for 400
_MOST_INTEGRATED = 60


@dataclass(frozen=True)
class Exponential:
    """y = exp(int theta) P; constants are embedded by the conjugate number `embedding`."""

    theta: RatFunc
    P: Poly
    embedding: int = 0

    def constants(self) -> list[acb | None]:
        """The conjugate values of the generator of the field, at the working precision in force."""
        # P or theta alone may have algebraic constants.
        return conjugates(self.P.field if isinstance(self.P.field, AlgebraicField) else self.theta.field)

    def constant(self) -> acb | None:
        """The value of the generator in this embedding."""
        return self.constants()[self.embedding]

    def omega(self, z: acb) -> acb:
        """omega = y'/y = theta + P'/P at z, which is no zero of P."""
        c = self.constant()
        P = embed(self.P, c)
        return ball_value(self.theta, c, z) + P.derivative()(z) / P(z)

    def states(self, a: acb, b: acb) -> list[State]:
        """y and y' at a and at b, the ends of a straight line without a singular point; the exponential is 1 at a."""
        theta, P, slope = _in_balls(self)
        E = theta.growth(a, b)
        # y' = E (theta P + P').
        return [(g * P(x), g * (theta.value(x) * P(x) + slope(x))) for x, g in ((a, acb(1)), (b, E))]


@kept_at_precision(maxsize=32)
def _in_balls(y: Exponential) -> tuple[LogDerivative, acb_poly, acb_poly]:
    """theta, P and P', kept for the next points."""
    P = embed(y.P, y.constant())
    return log_derivative(y.theta, y.embedding), P, P.derivative()


def ball_value(function: RatFunc, c: acb | None, z: acb) -> acb:
    """A rational function at z, for this value of the generator of its field."""
    return embed(function.num, c)(z) / embed(function.den, c)(z)


@dataclass(frozen=True, eq=False)
class CaseOneForm:
    """The certificate of case 1 from which the legs are computed, with its exact consequences."""

    problem: NumericProblem
    square: SemiInvariant | None  # the product of both, or y1^2
    first: Exponential

    @cached_property
    def branches(self) -> tuple[Exponential, ...]:
        """The solutions with conjugate omegas, or with two rational ones: those of the certificate, or the companion."""
        theta, P = self.first.theta, self.first.P
        # Conjugates over Q: each embedding of the constants gives a solution.
        count = len(self.first.constants())
        if count > 1:
            return tuple(Exponential(theta, P, k) for k in range(count))
        square = self.square
        if square is not None and theta.field == square.theta.field:
            # y1 y2 is the invariant: y2 has the rest of theta and of the zeros, unless the invariant is y1^2.
            zeros = square.P.exact_quotient(P)
            if zeros is not None and square.logarithmic_derivative != 2 * (theta + logarithmic_derivative(P)):
                return self.first, Exponential(square.theta - theta, zeros)
        return (self.first, *self._companion())

    def _companion(self) -> tuple[Exponential, ...]:
        """y2 = y1 int y1^-2 if y1^2 is rational, of small degree, and the integral is rational too."""
        theta, P = self.first.theta, self.first.P
        parts = decompose(theta * 2)  # of the logarithmic derivative of (y1/P)^2
        residues = [(part.factor, part.rational) for part in parts.residues]
        exponents = [(factor, int(e)) for factor, e in residues if e is not None and e.denominator == 1]
        if parts.exact or len(exponents) < len(residues):
            return ()
        if sum(abs(e) * factor.degree for factor, e in exponents) // 2 + P.degree > _MOST_INTEGRATED:
            return ()
        # y1^2 = exp(int 2 theta) P^2, and exp(int e/(x - a)) = (x - a)^e.
        square = math.prod((RatFunc(factor) ** e for factor, e in exponents), start=RatFunc(P) ** 2)
        inverse = decompose(1 / square)
        if inverse.residues:
            return ()
        # y2 = y1 R with R = int y1^-2, so P R in place of P; its denominator goes into theta.
        factor = inverse.exact * P
        return (Exponential(theta - logarithmic_derivative(factor.den), factor.num),)

    def __str__(self) -> str:
        return f"the closed form of case 1, with a polynomial of degree {self.first.P.degree}"

    def price(self, digits: int) -> float:
        """The estimated cost of a target."""
        return prices.EXPONENTIALS(digits) + self.first.P.degree * prices.COEFFICIENT(digits)

    @property
    def is_elementary(self) -> bool:
        """True if both solutions are given without a quadrature."""
        return len(self.branches) == 2

    def leg(self, a: ExactPoint, b: ExactPoint) -> Matrix:
        """The transition matrix that carries (y, y') from a to b along the straight segment, for elementary solutions."""
        check_segment(self.problem.system, a, b)
        first, second = (y.states(to_acb(a), to_acb(b)) for y in self.branches)
        # Y(b) Y(a)^-1, with the two solutions as columns.
        start, end = (fundamental(y, z) for y, z in zip(first, second, strict=True))
        return multiply(end, inverse_matrix(start))


@lru_cache(maxsize=64)
def with_decision(problem: NumericProblem, degree: int) -> NumericProblem | None:
    """The problem with a decision that has a Liouvillian solution, or None.

    An equation that wasn't solved is decided for case 1, with polynomials of at most this degree and the work for that.
    """
    decision = problem.decision
    if decision is not None:
        return problem if decision.semi_invariant is not None else None
    if not problem.is_rational:
        return None
    budget = Budget(Limits(unknown_degree=degree))
    with bounded_work(int(degree / prices.DEGREES / prices.UNIT)):
        decision = decide_reducible(problem.S, budget)
    check_time()  # a result that the clock cut short isn't kept
    if decision is None:
        return None
    if not verify(problem.S, decision, budget=budget):
        raise VerificationFailed(f"the closed form for S = {problem.S} failed its own check; please report it")
    return replace(problem, decision=decision)


@lru_cache(maxsize=32)
def closed_form_of(problem: NumericProblem) -> CaseOneForm | None:
    """The closed form of a solution of case 1, or None in the other cases."""
    decision = problem.decision
    if decision is None or decision.semi_invariant is None or decision.case != 1:
        return None
    y1 = decision.semi_invariant
    return CaseOneForm(problem, decision.invariant, Exponential(y1.theta, y1.P))


def exponential_solutions(problem: NumericProblem) -> list[Exponential]:
    """The solutions of case 1 with a rational logarithmic derivative, with the gauge in it; empty in the other cases."""
    closed = closed_form_of(problem)
    if closed is None:
        return []
    return [Exponential(y.theta + problem.gauge, y.P, y.embedding) for y in closed.branches]


def omegas(problem: NumericProblem, x0: ExactPoint) -> list[acb]:
    """The logarithmic derivatives at x0 in their order, at the working precision in force; not finite at a zero.

    The list is empty if the precision is too low to tell the roots of the polynomial of omega apart.
    """
    z = to_acb(x0)
    if found := exponential_solutions(problem):
        return [branch.omega(z) for branch in found]
    assert problem.decision is not None
    riccati = problem.decision.riccati
    assert riccati is not None
    # The roots of its polynomial are all conjugates already, for any embedding of the constants.
    c = conjugates(riccati.coefficients[0].field)[0]
    roots = sorted(
        sharp_roots(acb_poly([ball_value(r, c, z) for r in riccati.coefficients])), key=cmp_to_key(_by_real_part)
    )
    shift = ball_value(problem.gauge, None, z)
    return [root + shift for root in roots]


def _by_real_part(a: acb, b: acb) -> int:
    """The order by real part, and by imaginary part if the real parts can't be told apart (conjugates)."""
    is_first = a.imag < b.imag if a.real.overlaps(b.real) else a.real < b.real
    return -1 if is_first else 1


def omega(problem: NumericProblem, which: int, x0: ExactPoint, bits: int) -> acb:
    """The logarithmic derivative with this number at x0, accurate to `bits` bits.

    Raises InputError if there is no solution of this number, and ZeroDivisionError if the solution is zero at x0, as far as the
    highest precision can tell.
    """
    for doublings in range(9):  # a polynomial of degree 400 may cancel thousands of bits
        with working_precision((bits + 64) << doublings):
            found = omegas(problem, x0)
        if found and not 0 <= which < len(found):
            names = "only which = 0" if len(found) == 1 else f"which = 0, ..., {len(found) - 1}"
            raise InputError(
                f"which = {in_a_message(which)}: the equation has {names} here",
                hint="tabulate gives every solution, by initial values",
            )
        if found and found[which].is_finite():
            ball = found[which]
            # A logarithmic derivative that is 0 has no relative accuracy.
            if ball.rel_accuracy_bits() >= bits or ball.real.rad() + ball.imag.rad() < arb((1, -bits - 400)):
                return ball
    raise ZeroDivisionError(f"the logarithmic derivative isn't finite at {x0}")


def finite_base(problem: NumericProblem, which: int, candidates: list[ExactPoint]) -> ExactPoint:
    """The first of the points where y'/y is finite for the solution of this number."""
    for x0 in candidates:
        with suppress(ZeroDivisionError):
            omega(problem, which, x0, 64)
            return x0
    raise InputError("no point was found where the logarithmic derivative of the solution is finite")

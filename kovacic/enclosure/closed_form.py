"""Case 1 in balls: logarithmic derivatives of solutions, and transition matrices without integrating the equation.

The guarantee of the matrices is that of the Taylor route, with which nothing is shared: they contain the exact transition
matrices along the leg, which is carried by the certificate of the decision (E = exp int_a^x theta, followed continuously, see
`kovacic.enclosure.log_derivative`):
- two rational or conjugate omega = theta + P'/P: y = E P for either.
- a unique omega: y1 = E P, y2 = y1 int dx/y1^2.  P has simple zeros at ordinary points, where the integrand has double
  poles; they are split off exactly [Hermite's reduction]: with A P' = -1 mod P,

      1/y1^2 = (A/(P E^2))' + B/E^2,    B = (1 + A P' - A' P + 2 theta A P)/P^2,    y2 = A/E + y1 int_a^x B/E^2 dx,   (1)

  and B has no poles but the singular points of S.  Where E^2 is rational the integral is one of partial fractions.
So the zeros of P need not be known, and no leg goes around them.  Other closed forms cost more than Taylor steps (quadratures,
hypergeometric functions): there is no such route.

`omega` numbers the solutions whose logarithmic derivative is algebraic: in case 1 the conjugates of omega, or the two rational
ones; in cases 2 and 3 the roots of the polynomial of omega at the point, by real part and then imaginary part.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property, cmp_to_key, lru_cache

from flint import acb, acb_poly, arb

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.partial_fractions import decompose
from kovacic.algebra.poly import Poly
from kovacic.algebra.precision import working_precision
from kovacic.algebra.ratfunc import RatFunc
from kovacic.enclosure.frame import check_segment
from kovacic.enclosure.log_derivative import LogDerivative, conjugates, embed, log_derivative, sharp_roots
from kovacic.enclosure.matrices import Matrix, State, fundamental, inverse, multiply
from kovacic.enclosure.points import ExactPoint, kept_at_precision, to_acb
from kovacic.enclosure.problem import NumericProblem
from kovacic.engine.decide import decide_reducible
from kovacic.errors import InputError, VerificationFailed
from kovacic.limits import Budget, Limits, bounded_work, check_time
from kovacic.numbers.numerals import in_a_message
from kovacic.special import prices
from kovacic.verify import verify

_CHEAP = 400  # degree of P up to which the values of two exponentials cost less than the Taylor steps
_LARGEST_SQUARE = 1_000  # degree up to which y1^2 is written out; it may be x^1000000
_HIGHEST = 40_000  # bits up to which a logarithmic derivative is computed: the polynomial may cancel as many
_SMALL = 60  # degree up to which a second rational omega is sought by integration


@dataclass(frozen=True)
class Exponential:
    """y = exp(int theta) P; constants are embedded by the conjugate number `embedding`."""

    theta: RatFunc
    P: Poly
    embedding: int = 0

    def constants(self) -> list[acb | None]:
        """The conjugate values of the generator of the field, at the working precision in force."""
        field = self.P.field
        if not isinstance(field, AlgebraicField):
            field = self.theta.field
        return conjugates(field)

    def constant(self) -> acb | None:
        """The one that is meant."""
        return self.constants()[self.embedding]

    def omega(self, z: acb) -> acb:
        """y'/y at z."""
        c = self.constant()
        P = embed(self.P, c)
        return value(self.theta, c, z) + P.derivative()(z) / P(z)

    def embedded(self, a: acb, b: acb) -> tuple[LogDerivative, acb_poly, acb]:
        """theta, P, and E at b over E at a."""
        theta = log_derivative(self.theta, self.embedding)
        return theta, embed(self.P, self.constant()), theta.growth(a, b)

    def states(self, a: acb, b: acb) -> list[State]:
        """y and y' at a and b, where E is 1 at a."""
        theta, P, E = self.embedded(a, b)
        return [(g * P(x), g * (theta.value(x) * P(x) + P.derivative()(x))) for x, g in ((a, acb(1)), (b, E))]


def value(function: RatFunc, c: acb | None, z: acb) -> acb:
    """A rational function at z."""
    return embed(function.num, c)(z) / embed(function.den, c)(z)


@dataclass(frozen=True, eq=False)
class CaseOneForm:
    """The certificate of case 1 that the legs are computed from, and what follows from it exactly, computed once."""

    problem: NumericProblem
    first: Exponential

    @cached_property
    def branches(self) -> tuple[Exponential, ...]:
        """The solutions with conjugate omegas, or with the two rational ones that the certificate has."""
        theta = self.first.theta
        P = self.first.P
        count = len(self.first.constants())
        if count > 1:
            return tuple(Exponential(theta, P, k) for k in range(count))
        assert self.problem.decision is not None
        square = self.problem.decision.invariant  # the product of both, or y1^2
        if square is not None and theta.field == square.theta.field:
            zeros = square.P.exact_quotient(P)
            if zeros is not None and square.logarithmic_derivative != 2 * (theta + RatFunc(P.derivative(), P)):
                return self.first, Exponential(square.theta - theta, zeros)
        return (self.first,)

    @cached_property
    def reduction(self) -> tuple[Poly, RatFunc]:
        """A and B of equation (1)."""
        theta = self.first.theta
        P = self.first.P
        slope = P.derivative()
        A = -(slope.inverse_modulo(P)) if P.degree > 0 else P.field.poly([])
        # theta.den (1 + A P' - A' P) + 2 theta.num A P, divided by P^2
        top = theta.den * (A * slope - A.derivative() * P + 1) + 2 * theta.num * A * P
        quotient = top.exact_quotient(P * P)
        if quotient is None:
            raise AssertionError("the zeros of the solution are ordinary points")
        return A, RatFunc(quotient, theta.den)

    @cached_property
    def _square(self) -> list[tuple[Poly, int]] | None:
        """The factors, with exponents, of a rational function with logarithmic derivative 2 theta; None if there is none."""
        parts = decompose(self.first.theta * 2)
        if parts.exact:
            return None
        found = []
        for residue in parts.residues:
            if not residue.is_constant:
                return None
            exponent = residue.value.field.rational_value(residue.value)
            if exponent is None or exponent.denominator != 1:
                return None
            found.append((residue.factor, int(exponent)))
        return found

    @property
    def square_size(self) -> int | None:
        """The degrees together of numerator and denominator of that function, or None."""
        return None if self._square is None else sum(abs(e) * factor.degree for factor, e in self._square)

    @cached_property
    def rational_square(self) -> RatFunc | None:
        """The function itself; None if there is none, or one too large to write out."""
        if self._square is None or (self.square_size or 0) > _LARGEST_SQUARE:
            return None
        total = RatFunc(self.first.P.field.poly([1]))
        for factor, e in self._square:
            total = total * RatFunc(factor) ** e
        return total

    def __str__(self) -> str:
        return f"the closed form of case 1, with a polynomial of degree {self.first.P.degree}"

    def is_cheap(self, digits: int) -> bool:
        """True if the first leg costs less than Taylor steps (measured): two exponentials, or a small integral of 1/y1^2."""
        if len(self.branches) == 2:
            return self.first.P.degree <= _CHEAP
        poles = sum(factor.degree * e * e for factor, e in self._square or () if e > 0)
        return self.is_elementary and self.first.P.degree**2 + poles / 4 <= 4_000 + 70 * digits

    def price(self, digits: int) -> float:
        """That of a target."""
        one = prices.EXPONENTIALS if len(self.branches) == 2 else prices.INTEGRAL
        return one(digits) + self.first.P.degree * prices.COEFFICIENT(digits)

    @cached_property
    def companion(self) -> Exponential | None:
        """y2 = y1 int y1^-2 where y1^2 is rational, of small degree, and the integral is rational too."""
        theta = self.first.theta
        P = self.first.P
        if self.square_size is None or self.square_size // 2 + P.degree > _SMALL:
            return None
        assert self.rational_square is not None
        inverse = decompose(1 / (self.rational_square * RatFunc(P) ** 2))
        if inverse.residues:
            return None
        factor = inverse.exact * P
        return Exponential(theta - RatFunc(factor.den.derivative(), factor.den), factor.num)

    @property
    def is_elementary(self) -> bool:
        """True if both solutions are given without a quadrature."""
        return len(self.branches) == 2 or self.rational_square is not None

    def leg(self, a: ExactPoint, b: ExactPoint) -> Matrix:
        """The transition matrix that carries (y, y') from a to b along the straight segment, for elementary solutions."""
        check_segment(self.problem.system, a, b)
        ends = to_acb(a), to_acb(b)
        if len(self.branches) == 2:
            first, second = (y.states(*ends) for y in self.branches)
        else:
            first, second = self._pair(*ends)
        start, end = (fundamental(y, z) for y, z in zip(first, second, strict=True))
        return multiply(end, inverse(start))

    def _pair(self, a: acb, b: acb) -> tuple[list[State], list[State]]:
        """y1 and y2 of equation (1) at a and b, where E^2 is rational."""
        theta, P, E = self.first.embedded(a, b)
        exact_A, exact_B = self.reduction
        assert self.rational_square is not None
        A = embed(exact_A, None)
        first = self.first.states(a, b)
        second = []
        area = _integrand(self).exponent(a, b) * value(self.rational_square, None, a)
        for x, growth, I, (y, dy) in zip((a, b), (acb(1), E), (acb(0), area), first, strict=True):  # noqa: E741
            slope = A.derivative()(x) - theta.value(x) * A(x) + value(exact_B, None, x) * P(x)
            second.append((A(x) / growth + y * I, slope / growth + dy * I))
        return first, second


@kept_at_precision(maxsize=32)
def _integrand(closed: CaseOneForm) -> LogDerivative:
    """The rational function B/E^2 of equation (1), at the precision in force."""
    assert closed.rational_square is not None
    return LogDerivative.make(closed.reduction[1] / closed.rational_square, None)


@lru_cache(maxsize=64)
def decided(problem: NumericProblem, degree: int) -> NumericProblem | None:
    """The problem with the decision of its answer; for an equation that wasn't solved with that of case 1, if this is the case
    and is seen with a polynomial of at most this degree, in as much work as it stands for.  None without a Liouvillian
    solution."""
    decision = problem.decision
    if decision is not None:
        return problem if decision.semi_invariant is not None else None
    if problem.S is None:
        return None
    budget = Budget(Limits(unknown_degree=degree))
    with bounded_work(int(degree / prices.DEGREES / prices.UNIT)):
        decision = decide_reducible(problem.S, budget)
    check_time()  # what the clock stopped isn't kept
    if decision is None:
        return None
    if not verify(problem.S, decision, budget=budget):
        raise VerificationFailed(f"the closed form for S = {problem.S} failed its own check; please report it")
    return replace(problem, decision=decision)


@lru_cache(maxsize=32)
def closed_form_of(problem: NumericProblem) -> CaseOneForm | None:
    """The closed form of a solution of case 1, None in the other cases of an equation that has a Liouvillian solution."""
    decision = problem.decision
    assert decision is not None
    assert decision.semi_invariant is not None
    if decision.case != 1:
        return None
    return CaseOneForm(problem, Exponential(decision.semi_invariant.theta, decision.semi_invariant.P))


def exponentials(problem: NumericProblem) -> list[Exponential]:
    """The solutions of case 1 with a rational logarithmic derivative, with the gauge in it; empty in the other cases."""
    closed = closed_form_of(problem)
    if closed is None:
        return []
    found = list(closed.branches)
    if len(found) == 1 and closed.companion is not None:
        found.append(closed.companion)
    gauge = problem.gauge
    return found if gauge is None else [Exponential(y.theta + gauge, y.P, y.embedding) for y in found]


def omegas(problem: NumericProblem, x0: ExactPoint) -> list[acb]:
    """The logarithmic derivatives at x0 in their order, at the working precision in force; not finite at a zero.

    The list is empty where the precision is too low to tell the roots of the polynomial of omega apart.
    """
    z = to_acb(x0)
    found = exponentials(problem)
    if found:
        return [branch.omega(z) for branch in found]
    assert problem.decision is not None
    riccati = problem.decision.riccati
    assert riccati is not None
    c = conjugates(riccati.coefficients[0].field)[0]
    roots = sorted(sharp_roots(acb_poly([value(r, c, z) for r in riccati.coefficients])), key=cmp_to_key(_order))
    shift = 0 if problem.gauge is None else value(problem.gauge, None, z)
    return [root + shift for root in roots]


def _order(a: acb, b: acb) -> int:
    """By real part, and by imaginary part where the real parts can't be told apart (conjugates)."""
    if a.real.overlaps(b.real):
        return -1 if a.imag < b.imag else 1
    return -1 if a.real < b.real else 1


def omega(problem: NumericProblem, which: int, x0: ExactPoint, bits: int) -> acb:
    """One of them, accurate to that many bits.

    Raises InputError if there is no solution of this number, and ZeroDivisionError where it is zero at x0, as far as the
    highest precision can tell.
    """
    prec = bits + 64
    while prec <= max(4 * bits, _HIGHEST):
        with working_precision(prec):
            found = omegas(problem, x0)
            if found and not 0 <= which < len(found):
                names = "only which = 0" if len(found) == 1 else f"which = 0, ..., {len(found) - 1}"
                raise InputError(
                    f"which = {in_a_message(which)}: the equation has {names} here",
                    hint="tabulate gives every solution, by initial values",
                )
            if found and found[which].is_finite():
                ball = found[which]
                if ball.rel_accuracy_bits() >= bits or ball.real.rad() + ball.imag.rad() < arb((1, -bits - 400)):
                    return ball
        prec *= 2
    raise ZeroDivisionError(f"the logarithmic derivative isn't finite at {x0}")


def finite_base(problem: NumericProblem, which: int, candidates: list[ExactPoint]) -> ExactPoint:
    """The first of the points where y'/y is finite for the solution of this number."""
    for x0 in candidates:
        try:
            omega(problem, which, x0, 64)
        except ZeroDivisionError:
            continue
        return x0
    raise InputError("no point was found where the logarithmic derivative of the solution is finite")

"""A second opinion on transition matrices, by closed forms: what only tests use.

A leg from a to b is carried by
- case 1, y1 = E P with E = exp(int theta), and y2 = y1 int dx/y1^2 by a quadrature.  P has simple zeros at ordinary points,
  where the integrand has double poles, which are split off exactly [Hermite's reduction]: with A P' = -1 mod P,

      1/y1^2 = (A/(P E^2))' + B/E^2,   B = (1 + A P' - A' P + 2 theta A P)/P^2,   y2 = A/E + y1 int_a^x B/E^2 dx;         (1)

- case 2, f = y+ y- = E P, w^2 = 4 S f^2 - 2 f f'' + f'^2 (a constant), y+-'/y+- = (f' +- w)/(2 f), in which a zero of f is
  removed by the conjugate:

      y-'/y- = (f'' - 2 S f)/(f' + w)  where f' + w has no zero,   y+'/y+ = (f'' - 2 S f)/(f' - w)  where f' - w has none; (2)

  the leg is cut into pieces of these two kinds, and the other solution is the quotient of f and this one;
- case 3 by Klein's form: transition matrices from hypergeometric functions of the absolute invariant J.

The guarantee: the matrices of balls contain the exact transition matrices along the pieces of the leg.

With v, f, t the forms of the vertices, faces and edges (degrees 6, 8, 12 for the tetrahedral and octahedral, 12, 20, 30
for the icosahedral group), nu = 1/4 or 1/5, n = 12 or 30, a = (1/6 - nu)/2, b = a + 1/2, J = c1 v^(1/nu)/t^2 and
1 - J = c2 f^3/t^2, the equation is solved by t^(1/n) u(J) with u'' hypergeometric with the exponents 0, nu at J = 0;
0, 1/3 at 1; a, b at infinity.  The three pairs of local solutions are

    at 0         t^(1/n) F(a, b; 1 - nu; J),                     v t^(1/n - 2 nu) F(a + nu, b + nu; 1 + nu; J)
    at 1         t^(1/n) F(a, b; 2/3; 1 - J),                    f t^(1/n - 2/3) F(a + 1/3, b + 1/3; 4/3; 1 - J)       (1)
    at infinity  v^(-a/nu) F(a, a + nu; 1/2; 1/J),               t v^(-a/nu - 1/(2 nu)) F(b, b + nu; 3/2; 1/J)

(t^(1/n) J^(-a) is v^(-a/nu), as 1/n + 2 a = 0), with F the principal branch of 2F1, analytic outside [1, infinity).  The
forms have zeros at ordinary points, but those in a pair that are raised to fractions vanish only where its argument is
infinite: each pair is analytic where its argument z = J, 1 - J, 1/J keeps away from [1, infinity).  Every J is good for
one of the three, so a leg is cut into pieces on which z of one pair is proven to do so; there the matrix is
Y(b) Y(a)^-1.  No branch of F is chosen, and the powers are followed by `kovacic.enclosure.log_derivative`.

References: F. Klein, Vorlesungen ueber das Ikosaeder (1884); see also `kovacic.closed_form.structure`.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, TypeVar

import flint
from build import Poly, RatFunc
from flint import acb, acb_poly, fmpq

from kovacic import Solution, Structure
from kovacic.closed_form.structure import covariants
from kovacic.decision import SemiInvariant
from kovacic.enclosure.closed_form import CaseOneForm, closed_form_of
from kovacic.enclosure.log_derivative import LogDerivative, conjugates, embed
from kovacic.enclosure.matrices import Matrix, adjugate, fundamental, matrix_product, multiply
from kovacic.enclosure.points import ExactPoint, as_point, to_acb
from kovacic.enclosure.problem import as_problem
from kovacic.engine.riccati import Form, normalised
from kovacic.engine.riccati import root_of_form as root_of
from kovacic.limits import check_time

Found = TypeVar("Found")

_DEPTH = 200


def serves(solution: Solution) -> bool:
    """Is there a transition matrix here?  Not in case 1 with two conjugate omegas."""
    closed = closed_form_of(as_problem(solution))
    return closed is None or len(closed.branches) == 1


def transition(solution: Solution, vertices: Sequence[object], prec: int) -> Matrix:
    """The transition matrix along the polygon, from the certificate of a decision; in case 1 one with a rational omega."""
    points = [as_point(v, "a vertex") for v in vertices]
    decision = solution.decision
    assert decision.semi_invariant is not None
    assert decision.structure is not None
    matrices: list[Matrix] = []
    with flint.ctx.workprec(prec):
        for a, b in itertools.pairwise(points):
            if decision.case == 1:
                closed = closed_form_of(as_problem(solution))
                assert closed is not None
                matrices.append(quadrature_leg(closed, to_acb(a), to_acb(b)))
            elif decision.case == 2:
                matrices += pair_leg(solution.S, decision.semi_invariant, a, b)
            else:
                matrices += klein_leg(charts(solution.S, decision.structure, decision.invariant), a, b)
        return matrix_product(matrices)


@dataclass(frozen=True)
class Piece:
    """The straight piece from a to b."""

    a: ExactPoint
    b: ExactPoint

    @property
    def middle(self) -> ExactPoint:
        """(a + b)/2."""
        return (self.a + self.b).scaled(Fraction(1, 2))

    def box(self) -> acb:
        """A ball that contains the piece."""
        return to_acb(self.a).union(to_acb(self.b))


def cut(piece: Piece, found_on: Callable[[Piece], Found | None]) -> list[tuple[Piece, Found]] | None:
    """The piece in halves, quarters, ... so that `found_on` gives an answer on each of them, with the answers.

    None if 2^-200 of the length is too long at the working precision in force.
    """
    result: list[tuple[Piece, Found]] = []
    open_pieces = [(piece, 0)]
    while open_pieces:
        check_time()
        current, depth = open_pieces.pop()
        found = found_on(current)
        if found is not None:
            result.append((current, found))
            continue
        if depth == _DEPTH:
            return None
        middle = current.middle
        open_pieces += [(Piece(middle, current.b), depth + 1), (Piece(current.a, middle), depth + 1)]
    return result


def values(poly: acb_poly, x: acb) -> acb:
    """The values of a polynomial on a ball, by its expansion at the middle: narrow where Horner's rule isn't."""
    centre = x.mid()
    value: acb = poly(acb_poly([centre, 1]))(x - centre)
    return value


def reduction(theta: RatFunc, P: Poly) -> tuple[Poly, RatFunc]:
    """A and B of equation (1)."""
    slope = P.derivative()
    A = -(slope.inverse_modulo(P)) if P.degree > 0 else P.field.poly([])
    # theta.den (1 + A P' - A' P) + 2 theta.num A P, divided by P^2
    top = theta.den * (A * slope - A.derivative() * P + 1) + 2 * theta.num * A * P
    quotient = top.exact_quotient(P * P)
    assert quotient is not None, "the zeros of the solution are ordinary points"
    return A, RatFunc(quotient, theta.den)


def quadrature_leg(closed: CaseOneForm, a: acb, b: acb) -> Matrix:
    """Case 1, whatever E is."""
    exact_A, exact_B = reduction(closed.first.theta, closed.first.P)
    theta, B = LogDerivative.make(closed.first.theta, None), Quotient.make(exact_B, None)
    P, A = embed(closed.first.P, None), embed(exact_A, None)

    def integrand(z: acb, analytic: bool) -> acb:
        return B(z) * (-2 * theta.exponent(a, z, analytic=analytic)).exp()

    def states(x: acb, E: acb, area: acb) -> Matrix:
        t, p, alpha = theta.value(x), P(x), A(x)
        y, dy = E * p, E * (t * p + P.derivative()(x))
        return fundamental((y, dy), (alpha / E + y * area, (A.derivative()(x) - t * alpha + B(x) * p) / E + dy * area))

    at_b = states(b, theta.growth(a, b), acb.integral(integrand, a, b))
    return multiply(at_b, adjugate(states(a, acb(1), acb(0))))  # the Wronskian is 1


@dataclass(frozen=True)
class Quotient:
    """A rational function in balls."""

    num: acb_poly
    den: acb_poly

    @classmethod
    def make(cls, function: RatFunc, c: acb | None) -> Quotient:
        """The function at the working precision in force, with the value c of its algebraic constant."""
        return cls(embed(function.num, c), embed(function.den, c))

    def __call__(self, x: acb) -> acb:
        """The values on a ball; not finite where a pole can't be excluded."""
        return values(self.num, x) / values(self.den, x)


def quotient(at_b: Matrix, at_a: Matrix) -> Matrix:
    """Y(b) Y(a)^-1."""
    determinant = at_a[0] * at_a[3] - at_a[1] * at_a[2]
    m = multiply(at_b, adjugate(at_a))
    return m[0] / determinant, m[1] / determinant, m[2] / determinant, m[3] / determinant


def unknown() -> Matrix:
    """The matrix of which nothing is known: the caller raises the precision."""
    nothing = acb("nan", "nan")
    return nothing, nothing, nothing, nothing


def pair_leg(S: RatFunc, f: SemiInvariant, a: ExactPoint, b: ExactPoint) -> list[Matrix]:
    """Case 2, equation (2): the leg is cut into pieces with a fixed sign."""
    pair = Pair.make(S, f, to_acb(a))
    pieces = cut(Piece(a, b), pair.sign_on)
    if pieces is None:
        return [unknown()]
    return [pair.matrix(sign, to_acb(piece.a), to_acb(piece.b)) for piece, sign in pieces]


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
    def make(cls, coefficient: RatFunc, form: SemiInvariant, origin: acb) -> Pair:
        """The pair of a decision of case 2; w is one of the two square roots."""
        t, P = form.theta, form.P
        c = conjugates(P.field)[0]
        dP = P.derivative()
        first = Quotient.make(t * P + dP, c)
        second = Quotient.make((t.derivative() + t * t) * P + 2 * t * dP + dP.derivative(), c)
        S, p = Quotient.make(coefficient, None), embed(P, c)
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

    def matrix(self, sign: int, a: acb, b: acb) -> Matrix:
        """The transition matrix from a to b, a piece with this sign of the leg that begins at `origin`."""
        w = sign * self.wronskian(a)

        def omega(z: acb, analytic: bool = False) -> acb:
            """y'/y of y- (sign 1) or y+ (sign -1)."""
            rest = self.second(z) - 2 * self.S(z) * values(self.P, z)
            return rest / (self.first(z) + w * (-self.theta.exponent(a, z, analytic=analytic)).exp())

        def states(x: acb, E: acb, y: acb) -> tuple[tuple[acb, acb], tuple[acb, acb]]:
            slope, f = omega(x), E * self.P(x)
            return (y, y * slope), (f / y, (E * self.first(x) - f * slope) / y)

        growth = acb.integral(omega, a, b).exp()
        at_a, at_b = states(a, acb(1), acb(1)), states(b, self.theta.growth(a, b), growth)
        return quotient(fundamental(*at_b), fundamental(*at_a))


@dataclass(frozen=True)
class HypergeometricSolution:
    """exp(int theta) P F(a, b; c; z), z the argument of its `Chart`."""

    theta: RatFunc
    P: Poly
    a: Fraction
    b: Fraction
    c: Fraction


@dataclass(frozen=True)
class Chart:
    """One line of (1): two solutions with the argument z, a rational function of x."""

    z: RatFunc
    slope: RatFunc
    pair: tuple[HypergeometricSolution, HypergeometricSolution]


def charts(S: RatFunc, structure: Structure, invariant: Any) -> tuple[Chart, Chart, Chart]:
    """The three pairs (1)."""
    forms = covariants(S, structure, invariant)
    octahedral = structure is Structure.OCTAHEDRAL
    v, f, t = forms.F, forms.H, normalised(forms.T, forms.problem)
    if octahedral:
        v, f = root_of(forms.H, 2, forms.problem), forms.F
        edges = t.P.exact_quotient(v.P)
        assert edges is not None
        t = Form(t.degree - v.degree, t.R - v.R, edges)
    nu, n = (Fraction(1, 5), 30) if structure is Structure.ICOSAHEDRAL else (Fraction(1, 4), 12)
    a, third = (Fraction(1, 6) - nu) / 2, Fraction(1, 3)
    b = a + Fraction(1, 2)
    one = S.field.poly([1])

    def solution(base: Any, exponent: Fraction, factor: Any, *parameters: Fraction) -> HypergeometricSolution:
        theta = (RatFunc(base.R, forms.problem.D) + RatFunc(base.P.derivative(), base.P)) * exponent
        if factor is None:
            return HypergeometricSolution(theta, one, *parameters)
        return HypergeometricSolution(theta + RatFunc(factor.R, forms.problem.D), factor.P, *parameters)

    def chart(z: RatFunc, *pair: HypergeometricSolution) -> Chart:
        return Chart(z, z.derivative(), (pair[0], pair[1]))

    root = Fraction(1, n)
    return (
        chart(
            forms.J,
            solution(t, root, None, a, b, 1 - nu),
            solution(t, root - 2 * nu, v, a + nu, b + nu, 1 + nu),
        ),
        chart(
            1 - forms.J,
            solution(t, root, None, a, b, 2 * third),
            solution(t, root - 2 * third, f, a + third, b + third, 4 * third),
        ),
        chart(
            1 / forms.J,
            solution(v, -a / nu, None, a, a + nu, Fraction(1, 2)),
            solution(v, -b / nu, t, b, b + nu, Fraction(3, 2)),
        ),
    )


def klein_leg(pairs: tuple[Chart, ...], a: ExactPoint, b: ExactPoint) -> list[Matrix]:
    """The matrices of the pieces of the leg from a to b, in order."""
    arguments = {chart: Quotient.make(chart.z, None) for chart in pairs}

    def chart_on(piece: Piece) -> Chart | None:
        return next((chart for chart in pairs if _off_the_cut(arguments[chart](piece.box()))), None)

    pieces = cut(Piece(a, b), chart_on)
    if pieces is None:
        return [unknown()]
    prepared = {chart: tuple(_prepared(solution) for solution in chart.pair) for _, chart in pieces}
    return [_matrix(chart, prepared[chart], piece) for piece, chart in pieces]


def _off_the_cut(z: acb) -> bool:
    """True if z certainly doesn't meet [1, infinity)."""
    return bool(z.is_finite() and (z.real < 1 or not z.imag.contains(0)))


@dataclass(frozen=True)
class _Prepared:
    """A solution in balls: theta, P and P', the parameters of F and those of F', and the factor before the latter."""

    theta: LogDerivative
    P: acb_poly
    slope: acb_poly
    parameters: tuple[acb, ...]
    raised: tuple[acb, ...]
    factor: acb


def _prepared(solution: HypergeometricSolution) -> _Prepared:
    parameters = (solution.a, solution.b, solution.c)
    return _Prepared(
        LogDerivative.make(solution.theta, None),
        embed(solution.P, None),
        embed(solution.P.derivative(), None),
        tuple(_exact(value) for value in parameters),
        tuple(_exact(value + 1) for value in parameters),
        _exact(solution.a * solution.b / solution.c),
    )


def _matrix(chart: Chart, pair: tuple[_Prepared, ...], piece: Piece) -> Matrix:
    a, b = to_acb(piece.a), to_acb(piece.b)
    at_a = [_state(solution, chart, a, acb(1)) for solution in pair]
    at_b = [_state(solution, chart, b, solution.theta.growth(a, b)) for solution in pair]
    return quotient(fundamental(*at_b), fundamental(*at_a))


def _state(solution: _Prepared, chart: Chart, x: acb, growth: acb) -> tuple[acb, acb]:
    """(y, y') at x, where exp(int theta) has the value `growth`."""
    z, dz = Quotient.make(chart.z, None)(x), Quotient.make(chart.slope, None)(x)
    if not _off_the_cut(z):
        return acb("nan", "nan"), acb("nan", "nan")
    F, dF = z.hypgeom_2f1(*solution.parameters), solution.factor * z.hypgeom_2f1(*solution.raised)
    p = solution.P(x)
    return growth * p * F, growth * ((solution.theta.value(x) * p + solution.slope(x)) * F + p * dF * dz)


def _exact(value: Fraction) -> acb:
    return acb(fmpq(value.numerator, value.denominator))

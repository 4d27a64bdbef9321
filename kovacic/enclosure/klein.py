"""Case 3 by Klein's form: transition matrices from hypergeometric functions of the absolute invariant J.

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
Y(b) Y(a)^-1.  No branch of F is chosen, and the powers are followed by `kovacic.enclosure.exponential`.

References: F. Klein, Vorlesungen ueber das Ikosaeder (1884); see also `kovacic.closed_form.klein`.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.klein import covariants
from kovacic.decision import Structure
from kovacic.enclosure.exponential import LogDerivative, embed
from kovacic.enclosure.pieces import Piece, Quotient, cut, fundamental, quotient, unknown
from kovacic.enclosure.points import Point, to_acb
from kovacic.limits import Budget

if TYPE_CHECKING:
    from flint import acb, acb_poly

    from kovacic.algebra.poly import Poly
    from kovacic.enclosure.taylor import Matrix


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
    v, f, t = forms.vertices, (forms.F if octahedral else forms.H), forms.edges
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


def klein_leg(pairs: tuple[Chart, ...], a: Point, b: Point, budget: Budget) -> list[Matrix]:
    """The matrices of the pieces of the leg from a to b, in order."""
    arguments = {chart: Quotient.make(chart.z, None) for chart in pairs}

    def chart_on(piece: Piece) -> Chart | None:
        return next((chart for chart in pairs if _off_the_cut(arguments[chart](piece.box()))), None)

    pieces = cut(Piece(a, b), chart_on, budget)
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
    from flint import acb

    a, b = to_acb(piece.a), to_acb(piece.b)
    at_a = [_state(solution, chart, a, acb(1)) for solution in pair]
    at_b = [_state(solution, chart, b, solution.theta.growth(a, b)) for solution in pair]
    return quotient(fundamental(*at_b), fundamental(*at_a))


def _state(solution: _Prepared, chart: Chart, x: acb, growth: acb) -> tuple[acb, acb]:
    """(y, y') at x, where exp(int theta) has the value `growth`."""
    from flint import acb

    z, dz = Quotient.make(chart.z, None)(x), Quotient.make(chart.slope, None)(x)
    if not _off_the_cut(z):
        return acb("nan", "nan"), acb("nan", "nan")
    F, dF = z.hypgeom_2f1(*solution.parameters), solution.factor * z.hypgeom_2f1(*solution.raised)
    p = solution.P(x)
    return growth * p * F, growth * ((solution.theta.value(x) * p + solution.slope(x)) * F + p * dF * dz)


def _exact(value: Fraction) -> acb:
    from flint import acb, fmpq

    return acb(fmpq(value.numerator, value.denominator))

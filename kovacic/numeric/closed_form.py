"""Route (a): transition matrices from the certificate of a decision, without integrating the equation.

The guarantee is that of route (b): the matrix of balls contains the exact transition matrix along the leg.

A leg from a to b is carried by the closed form (E = exp int_a^x theta, followed continuously, see `exponential`):
- case 1, omega = theta + P'/P: y = E P.  A second solution comes from the conjugate omega, or, where omega is unique,
from
  y int dx / y^2 (rigorous quadrature).
- case 2, f = y1 y2 = E P, w^2 = 4 S f^2 - 2 f f'' + f'^2 (a constant):  y = sqrt(f) exp(+- w/2 int dx/f).
- case 3: three roots of the polynomial of omega.  Two solutions with omega_i, omega_j have the Wronskian
  y_i y_j (omega_j - omega_i), a constant; so, normalised to 1 at a,

      y_i(b)^2 = g_ij g_ik / g_jk,    g_ij = (omega_i - omega_j)(a) / (omega_i - omega_j)(b):

  no integral at all.  Which root of the polynomial at b continues which one at a, and the sign of the square root,
  are discrete
  data; they are read off route (b) at 15 to 40 digits.  Every digit of the value comes from the polynomial.

The zeros of P are ordinary points of the equation, where this arrangement is singular in case 2 and for the second
solution
of case 1: the leg goes around them; where an end of the leg is (nearly) such a zero, a short Taylor step leads away
from it.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import Budget
from kovacic.numeric.exponential import (
    LogDerivative,
    conjugates,
    continued_root,
    embed,
    integral,
    sharp_roots,
    zeros,
)
from kovacic.numeric.gauge import with_gauge
from kovacic.numeric.points import Point, to_acb
from kovacic.numeric.problem import NumericProblem
from kovacic.numeric.singular import check_segment
from kovacic.numeric.taylor import Matrix
from kovacic.numeric.transport import adjugate, multiply, piece_matrices, product

if TYPE_CHECKING:
    from flint import acb


@dataclass(frozen=True)
class ClosedForm:
    """The certificate that the legs are computed from."""

    problem: NumericProblem
    degree: int
    theta: Any
    P: Any
    riccati: Any
    case: int


def closed_form_of(problem: NumericProblem) -> ClosedForm:
    """The certificate of a solution; raises InputError where there is none."""
    source = problem.source
    form = getattr(source, "semi_invariant", None)
    case = getattr(source, "case", None)
    if form is None or case is None:
        raise InputError(
            "the method 'closed form' needs a Liouvillian solution with its certificate",
            hint="pass kovacic.solve(S) with status LIOUVILLIAN, or use method='taylor'",
        )
    return ClosedForm(problem, form.degree, form.theta, form.P, source.riccati, case)


def leg_matrix(closed: ClosedForm, a: Point, b: Point, prec: int, budget: Budget) -> list[Matrix]:
    """Transition matrices whose product carries (y, y') from a to b along the straight segment."""
    if (b - a).norm_squared() == 0:
        return []
    check_segment(closed.problem.system, a, b)
    budget.check()
    if closed.case == 3:
        return [_algebraic_leg(closed, a, b, prec, budget)]
    if closed.case == 1:
        embeddings = conjugates(closed.theta.field if closed.P.field == closed.theta.field else closed.P.field)
        if len(embeddings) >= 2:
            return [_two_exponentials(closed, embeddings[:2], a, b)]
    result = []
    for start, stop, plain in _around_zeros(closed, a, b):
        if plain:
            leg = _pair_leg if closed.case == 2 else _integral_leg
            result.append(leg(closed, start, stop, budget))
        else:
            result += piece_matrices(closed.problem.system, start, stop, prec, budget)
    return result


def _fundamental(rows: list[tuple[acb, acb]]) -> Matrix:
    """The matrix with the states (y, y') of two solutions as its columns."""
    (y1, d1), (y2, d2) = rows
    return y1, y2, d1, d2


def _quotient(at_b: Matrix, at_a: Matrix) -> Matrix:
    """Y(b) Y(a)^-1."""
    determinant = at_a[0] * at_a[3] - at_a[1] * at_a[2]
    m = multiply(at_b, adjugate(at_a))
    return m[0] / determinant, m[1] / determinant, m[2] / determinant, m[3] / determinant


def _two_exponentials(closed: ClosedForm, embeddings: list[acb | None], a: Point, b: Point) -> Matrix:
    """Case 1 with two conjugate omegas: y = E P for either."""
    za, zb = to_acb(a), to_acb(b)
    at_a, at_b = [], []
    for c in embeddings:
        theta, P = LogDerivative.make(closed.theta, c), embed(closed.P, c)
        slope, growth = P.derivative(), theta.growth(za, zb)
        at_a.append((P(za), theta.value(za) * P(za) + slope(za)))
        at_b.append((growth * P(zb), growth * (theta.value(zb) * P(zb) + slope(zb))))
    return _quotient(_fundamental(at_b), _fundamental(at_a))


def _integral_leg(closed: ClosedForm, a: Point, b: Point, budget: Budget) -> Matrix:
    """Case 1 with a unique omega, P without zeros on the segment: y1 = E P and y2 = y1 int_a dx/y1^2."""
    from flint import acb

    za, zb = to_acb(a), to_acb(b)
    theta, P = LogDerivative.make(closed.theta, None), embed(closed.P, None)
    slope = P.derivative()

    def inverse_square(z: acb, analytic: bool) -> acb:
        value = theta.growth(za, z, analytic=analytic) * P(z)
        return 1 / (value * value)

    area = integral(inverse_square, za, zb, budget)
    growth = theta.growth(za, zb)
    y1a, d1a = P(za), theta.value(za) * P(za) + slope(za)
    y1b, d1b = growth * P(zb), growth * (theta.value(zb) * P(zb) + slope(zb))
    at_a = (y1a, acb(0), d1a, 1 / y1a)
    at_b = (y1b, y1b * area, d1b, d1b * area + 1 / y1b)
    return _quotient(at_b, at_a)


def _pair_leg(closed: ClosedForm, a: Point, b: Point, budget: Budget) -> Matrix:
    """Case 2, P without zeros on the segment: y = sqrt(f/f(a)) exp(+- w/2 int dx/f)."""
    from flint import acb

    field = closed.theta.field if closed.theta.field != closed.problem.source.S.field else closed.P.field
    c = conjugates(field)[0]
    za, zb = to_acb(a), to_acb(b)
    theta, P = LogDerivative.make(closed.theta, c), embed(closed.P, c)
    P1 = P.derivative()
    P2 = P1.derivative()
    S = closed.problem.source.S
    t, t1 = theta.value(za), embed(closed.theta.derivative().num, c)(za) / embed(closed.theta.derivative().den, c)(za)
    f, f1 = P(za), t * P(za) + P1(za)
    f2 = (t1 + t * t) * P(za) + 2 * t * P1(za) + P2(za)
    w = (4 * (embed(S.num, None)(za) / embed(S.den, None)(za)) * f * f - 2 * f * f2 + f1 * f1).sqrt()
    roots = zeros(closed.P, c)

    def inverse(z: acb, analytic: bool) -> acb:
        return 1 / (theta.growth(za, z, analytic=analytic) * P(z))

    phase = integral(inverse, za, zb, budget) * w / 2
    exponent = theta.exponent(za, zb)
    root = (exponent / 2).exp() * continued_root(roots, za, zb)
    g = exponent.exp() * P(zb)
    g1 = theta.value(zb) * g + exponent.exp() * P1(zb)
    rise, fall = phase.exp(), (-phase).exp()
    at_a = (acb(1), acb(1), (f1 + w) / (2 * f), (f1 - w) / (2 * f))
    y_plus, y_minus = root * rise, root * fall
    at_b = (y_plus, y_minus, y_plus * (g1 + w) / (2 * g), y_minus * (g1 - w) / (2 * g))
    return _quotient(at_b, at_a)


def _around_zeros(closed: ClosedForm, a: Point, b: Point) -> list[tuple[Point, Point, bool]]:
    """Legs (start, stop, plain) that replace the segment: plain ones keep away from the zeros of P, the others are
    for route (b).

    The detour stays in a strip beside the segment that contains no singular point, so it is homotopic to the segment.
    """
    field = closed.P.field
    c = conjugates(field)[0]
    roots = [root for root, _ in zeros(closed.P, c)]
    if not roots:
        return [(a, b, True)]
    step = b - a
    if _clearance(roots, a, b) > 1 / 64:
        return [(a, b, True)]
    # perpendicular offsets; the width is bounded by the distance of the singular points to the segment
    for denominator in (8, 11, 17, 29, 64, 131, 400, 1601, 10007):
        for sign in (1, -1):
            side = Point(-step.im, step.re).scaled(Fraction(sign, denominator))
            if not _strip_is_free(closed, a, b, side):
                continue
            top = (a + side, b + side)
            if _clearance(roots, *top) < 1 / 256:
                continue
            return [(a, top[0], False), (*top, True), (top[1], b, False)]
    raise LimitExceeded("no way around the zeros of the closed form was found on this leg", limit="unknown_degree")


def _clearance(roots: list[acb], a: Point, b: Point) -> float:
    """A lower bound of the distance from the segment to the nearest root, as a share of the segment's length (0:
    unknown)."""
    za, step = to_acb(a), to_acb(b - a)
    best = 1e300
    for root in roots:
        u = (root - za) / step
        x, y = float(u.real.mid()), float(u.imag.mid())
        error = float(u.real.rad()) + float(u.imag.rad()) + 1e-12 * (1 + abs(x) + abs(y))
        outside = max(0.0, -x, x - 1.0)
        best = min(best, max(0.0, (outside * outside + y * y) ** 0.5 - error))
    return best


def _strip_is_free(closed: ClosedForm, a: Point, b: Point, side: Point) -> bool:
    """True if the parallelogram a, b, b + side, a + side contains no singular point (proven with the enclosures)."""
    za, step, across = to_acb(a), to_acb(b - a), to_acb(side)
    turn = across / step  # purely imaginary
    for root, _ in closed.problem.system.roots("den", 128):
        u = (root - za) / step
        along, beside = u.real, u.imag / turn.imag
        if not (along < 0 or along > 1 or beside < 0 or beside > 1):
            return False
    return True


def _algebraic_leg(closed: ClosedForm, a: Point, b: Point, prec: int, budget: Budget) -> Matrix:
    """Case 3: three roots of the polynomial of omega at both ends, matched through route (b) at low precision."""
    from flint import ctx

    coefficients = closed.riccati.coefficients
    c = conjugates(coefficients[0].field)[0]
    at_a, at_b = (_riccati_roots(coefficients, c, to_acb(p)) for p in (a, b))
    low = 40
    while True:
        budget.check()
        with ctx.workprec(low + 40):
            rough = product(piece_matrices(closed.problem.system, a, b, low, budget))
        matched = _match(at_a, at_b, rough)
        if len(matched) >= 3:
            break
        low *= 2
        if low > prec:
            return _unknown()
    (wa, wb, ya), (xa, xb, yb), (va, vb, _) = matched[:3]
    g12, g13, g23 = (wa - xa) / (wb - xb), (wa - va) / (wb - vb), (xa - va) / (xb - vb)
    y1, y2 = _signed((g12 * g13 / g23).sqrt(), ya), _signed((g12 * g23 / g13).sqrt(), yb)
    if y1 is None or y2 is None:
        return _unknown()
    at_start = (_one(), _one(), wa, xa)
    at_end = (y1, y2, y1 * wb, y2 * xb)
    return _quotient(at_end, at_start)


def _one() -> acb:
    from flint import acb

    return acb(1)


def _riccati_roots(coefficients: tuple[Any, ...], c: acb | None, x: acb) -> list[acb]:
    from flint import acb_poly

    return sharp_roots(acb_poly([embed(r.num, c)(x) / embed(r.den, c)(x) for r in coefficients]))


def _unknown() -> Matrix:
    """The matrix of which nothing is known: the caller raises the precision."""
    from flint import acb

    nothing = acb(float("nan"), float("nan"))
    return nothing, nothing, nothing, nothing


def _match(at_a: list[acb], at_b: list[acb], rough: Matrix) -> list[tuple[acb, acb, acb]]:
    """Triples (omega at a, its continuation at b, rough value of y(b) for y(a) = 1) that are unambiguous."""
    found = []
    for omega in at_a:
        y, dy = rough[0] + rough[1] * omega, rough[2] + rough[3] * omega
        if y.contains(0):
            continue
        slope = dy / y
        candidates = [other for other in at_b if other.overlaps(slope)]
        if len(candidates) == 1:
            found.append((omega, candidates[0], y))
    return found


def _signed(root: acb, rough: acb) -> acb | None:
    """The square root that is near the rough value; None where that can't be told."""
    if root.overlaps(rough) and not (-root).overlaps(rough):
        return root
    if (-root).overlaps(rough) and not root.overlaps(rough):
        return -root
    return None


@dataclass(frozen=True)
class ClosedFormRoute:
    """Route (a) as a `kovacic.numeric.evaluate.Route`."""

    closed: ClosedForm
    itinerary: Any
    start: tuple[Any, Any]

    def __call__(self, prec: int, budget: Budget) -> list[tuple[acb, acb]]:
        from kovacic.numeric.evaluate import carry

        legs = with_gauge(self.closed.problem.gauge, lambda a, b: leg_matrix(self.closed, a, b, prec, budget))
        return carry(legs, self.itinerary, self.start)


def closed_form_route(problem: NumericProblem, itinerary: Any, start: tuple[Any, Any]) -> ClosedFormRoute:
    """The route of a solution with a certificate; raises InputError where there is none."""
    return ClosedFormRoute(closed_form_of(problem), itinerary, start)

"""Case 1: a solution with omega = y'/y in C(x).

1. If two different omegas are rational, y1 y2 is a rational invariant of degree 2 up to a constant [Hendriks & van der Put,
   J. Symb. Comp. 19 (1995)], and omega comes from it: F = y1 y2 with D = F'^2 - 2 F F'' + 4 S F^2 a constant, and
   omega = (F' +- sqrt D) / (2 F); or F = y1^2 if D = 0.  If every solution is the root of a rational function the invariants
   of degree 2 have dimension 3, and the least of them in degree is the square of a solution.
2. Otherwise omega is unique if it exists, so it is rational over K.  One place at which the local solutions differ leaves at
   most two expansions; see `kovacic.local`.  Its P is then found exactly from its recurrence.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from kovacic.algebra.fields import BadPrimeError, Homomorphism
from kovacic.algebra.poly import Poly, to_fraction
from kovacic.algebra.recurrence import polynomial_solution
from kovacic.algebra.traces import trace_of_square_root
from kovacic.cases.constants import square_root
from kovacic.cases.outcome import Found, Outcome
from kovacic.cases.singular import singular_factor
from kovacic.invariants import invariants
from kovacic.local import chart, exponential_parts, omega_parts, rational_omega
from kovacic.places import Kind, Place, Problem
from kovacic.riccati import Form, normalised, root
from kovacic.solution import Evidence, Exclusion, NecessaryCondition, NoInvariant, NoRationalOmega, Rule, Structure


def decide(problem: Problem) -> Outcome:
    """Find omega in C(x), or prove that there is none."""
    quadratic = invariants(problem, 2)
    if not isinstance(quadratic, NoInvariant):
        F = quadratic[0]
        return Found(Structure.REDUCIBLE, lambda: _from_quadratic_invariant(problem, F), F)
    unique = _unique_omega(problem)
    if isinstance(unique, Form):
        return Found(Structure.REDUCIBLE, lambda: unique)
    return (Exclusion(Structure.REDUCIBLE, (quadratic, unique)),)


def _from_quadratic_invariant(problem: Problem, F: Form) -> Form:
    """omega from F = y1 y2 or y1^2."""
    F = normalised(F, problem)
    D, P, R = problem.D, F.P, F.R
    # Everything divided by Q0 = F/P: F' = Q0 X / D, and sqrt(disc) = Q0 Y / D.
    A0, X, A2 = F.numerators(problem)[:3]
    discriminant = X * X - 4 * A0 * A2
    if not discriminant:
        return root(F, 2, problem)
    weight = singular_factor(problem, R, 1)
    square, remainder = divmod(discriminant, weight * weight)
    if remainder or square.degree > 0:
        raise AssertionError("the discriminant of an invariant of degree 2 is a constant")
    w = square_root(problem.field, square)
    Y = w * weight
    P = P.over(w.field)
    zeros = P.gcd(X - Y)  # the zeros of y1 are those zeros of F at which F' = sqrt(disc)
    omega = (X + Y) // (P // zeros) / 2  # D * zeros * omega
    return Form(1, (omega - D * zeros.derivative()) // zeros, zeros)


def largest_degree(problem: Problem) -> int | NecessaryCondition:
    """The largest degree that P can have for a unique omega = R/D + P'/P: d = 1 - sum of the exponents over all places.

    The exponents at the roots of a factor are conjugate, (A +- sqrt g)/2 with g in K[x]/p, so their sum is bounded by the
    trace of sqrt g [sec. 3.2 of Kovacic 1986 for the exponents].  Not rational over K[x]/p: omega doesn't exist.
    """
    total = Fraction(1)
    for place in problem.places:
        if place.kind is Kind.ORDINARY:
            continue
        if place.logarithm and place.delta is not None:
            total -= place.degree * (1 + place.delta) / 2
            continue
        trace = _trace(place)
        if trace is None:
            return NecessaryCondition(Rule.NOT_A_SQUARE, (str(place),))
        total += (abs(_rational_part(trace)) - place.degree * place.weight) / 2
    return total.numerator // total.denominator


def _rational_part(constant: Poly) -> Fraction:
    """The first rational coordinate: a Q-linear map of the field onto Q that is the identity on Q."""
    return to_fraction(constant.rational_coefficients()[0]) if constant else Fraction(0)


def _trace(place: Place) -> Poly | None:
    """The trace of the exponents' difference over the roots of the factor, up to sign; None if it isn't in K[x]/p."""
    if place.delta is not None:
        return place.factor.field.poly([place.delta * place.degree])
    if place.kind is Kind.REGULAR:
        if place.delta_squared is not None:
            return trace_of_square_root(place.delta_squared, place.factor)
        p = place.factor
        cofactor = p.derivative() ** 2 * (place.den // p**2) % p
        return trace_of_square_root((1 + 4 * place.num * cofactor.inverse_modulo(p)) % p, p)
    return trace_of_square_root(_irregular_difference_squared(place), place.factor)


def _irregular_difference_squared(place: Place) -> Poly:
    """(b/a)^2 at an unramified irregular place, in K[x]/p: 4 s_0 rho^2, rho the coefficient of t^(nu-1) in sqrt(s/s_0).

    Here S = s(t)/t^(2 nu) with t = x - c, c the class of x modulo p.
    """
    p, nu, field = place.factor, place.order // 2, place.factor.field
    N = _taylor(place.num, p, nu)
    E = _taylor(place.den, p, nu + place.order)[place.order :]
    inverse = E[0].inverse_modulo(p)
    s: list[Poly] = []
    for i in range(nu):
        value = N[i] - sum((E[j] * s[i - j] for j in range(1, i + 1)), field.poly([]))
        s.append(value * inverse % p)
    lead = s[0].inverse_modulo(p)
    rho: list[Poly] = [field.poly([1])]
    for i in range(1, nu):
        value = s[i] * lead - sum((rho[j] * rho[i - j] for j in range(1, i)), field.poly([]))
        rho.append(value * Fraction(1, 2) % p)
    return 4 * s[0] * rho[nu - 1] ** 2 % p


def _taylor(polynomial: Poly, p: Poly, count: int) -> list[Poly]:
    """The first Taylor coefficients at the class of x in K[x]/p."""
    coefficients, current = [], polynomial
    for i in range(count):
        coefficients.append(current % p)
        current = current.derivative() * Fraction(1, i + 1)
    return coefficients


def distinguishing_places(problem: Problem) -> list[Place]:
    """The places at which only finitely many local solutions can belong to omega, the cheapest first."""
    suitable = [place for place in problem.places if not place.is_apparent]
    return sorted(suitable, key=lambda place: (place.degree, not place.logarithm, not place.at_infinity))


def _unique_omega(problem: Problem) -> Form | Evidence:
    bound = largest_degree(problem)
    if isinstance(bound, NecessaryCondition):
        return bound
    if bound < 0:
        return NoRationalOmega(bound)
    place = distinguishing_places(problem)[0]
    lifter, ladder = problem.field.lifter(), _ladder(bound)
    for bundle in problem.field.bundles():
        try:
            parts = [_omega_modulo(h, problem, place, ladder) for h in bundle]
        except BadPrimeError:
            continue
        for h, part in zip(bundle, parts, strict=True):
            if part is None:
                return NoRationalOmega(bound, h.p, str(place))
        images = [part for part in parts if part is not None]
        degrees = {d for _, d in images}
        if len(degrees) > 1:
            continue
        degree = degrees.pop()
        ladder = [degree] if degree == bound else [degree, *_ladder(bound)]
        proposal = lifter.add(bundle, [[R] for R, _ in images])
        if proposal:
            P = _polynomial_part(problem, proposal[0], degree)
            if P is not None:
                return Form(1, proposal[0], P)
    raise AssertionError("the sequence of primes is infinite")


def _ladder(bound: int) -> list[int]:
    """Degrees to be tried for P: small ones first, for the bound is often far above the degree; the bound last."""
    return [*(4**k for k in range(2, 32) if 4**k < bound), bound]


def _omega_modulo(h: Homomorphism, problem: Problem, place: Place, degrees: list[int]) -> tuple[Any, int] | None:
    """R and deg P of the only rational omega modulo p; None if there is none.

    Raises `BadPrimeError` if the place has no root in F_p, or if there are two such omegas modulo p.
    """
    c = chart(h, problem, place)
    if c is None:
        raise BadPrimeError("the place has no root modulo this prime")
    parts = exponential_parts(c.equation, place)
    for degree in degrees:
        problem.budget.check()
        problem.budget.check_degree(degree, "the polynomial part of a solution")
        found = [pair for Q in parts if (pair := rational_omega(c, Q, degree))]
        if len(found) > 1:
            raise BadPrimeError("two solutions modulo this prime")
        if found:
            return omega_parts(h, problem, c, *found[0])
    return None


def _polynomial_part(problem: Problem, R: Poly, degree: int) -> Poly | None:
    """The monic P of this degree with omega = R/D + P'/P: D P'' + 2 R P' + ((R' D - R D' + R^2 - T)/D) P = 0."""
    D = problem.D
    zeroth = (R.derivative() * D - R * D.derivative() + R * R - problem.T).exact_quotient(D)
    return None if zeroth is None else polynomial_solution(D, 2 * R, zeroth, degree, problem.budget.check)

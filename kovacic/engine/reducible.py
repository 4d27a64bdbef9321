"""Case 1: a solution with omega = y'/y in C(x).

1. If two different omegas are rational, y1 y2 is a rational invariant of degree 2 up to a constant [Hendriks & van der Put,
   J. Symb. Comp. 19 (1995)], and omega comes from it: F = y1 y2 with D = F'^2 - 2 F F'' + 4 S F^2 a constant, and
   omega = (F' +- sqrt D) / (2 F); or F = y1^2 if D = 0.  If every solution is the root of a rational function the invariants
   of degree 2 have dimension 3, and the least of them in degree is the square of a solution.
2. Otherwise omega is unique if it exists, so it is rational over K.  One place at which the local solutions differ leaves at
   most two expansions; see `kovacic.engine.local`.  Its P is then found exactly from its recurrence.
3. Where the degree of P may exceed the limit, a recurrence of two terms may decide: see `kovacic.engine.terminating`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from itertools import count, islice
from typing import Any

from kovacic.algebra.extension import adjoined_square_root
from kovacic.algebra.homomorphism import BadPrimeError, Homomorphism
from kovacic.algebra.lifting import Lifter
from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import LARGE_DEGREE, QQ
from kovacic.algebra.recurrence import polynomial_solution
from kovacic.decision import Evidence, Exclusion, NoInvariant, NoRationalOmega, NoTerminatingSeries, Structure
from kovacic.engine.families import Roots, first_case_choices
from kovacic.engine.invariants import invariants
from kovacic.engine.local import (
    DegreeBound,
    degree_bound,
    exponential_parts,
    irrational_exponents,
    is_cheap,
    modular_chart,
    omega_parts,
    rational_omega,
)
from kovacic.engine.places import Kind, Place, Problem
from kovacic.engine.riccati import Form, Found, Outcome, normalised, singular_factor
from kovacic.engine.terminating import terminating_series
from kovacic.errors import LimitExceeded
from kovacic.limits import MOST_TRIALS


def decide_rational_omega(problem: Problem) -> Outcome:
    """Find omega in C(x), or prove that there is none."""
    try:
        return _decide_within_limits(problem)
    except LimitExceeded as limit:
        if limit.limit != "unknown_degree":
            raise
        series = terminating_series(problem)
        if series is None:
            raise
    if isinstance(series, NoTerminatingSeries):
        return (Exclusion(Structure.REDUCIBLE, (series,)),)
    R = (series.theta * problem.D).num
    if series.degree > problem.budget.limits.unknown_degree:
        return Found(Structure.REDUCIBLE, series=series)
    P = _polynomial_part(problem, R, series.degree)
    if P is None:
        raise AssertionError("the recurrence ends")
    return Found(Structure.REDUCIBLE, lambda: Form(1, R, P))


def _decide_within_limits(problem: Problem) -> Outcome:
    """By the invariants of degree 2 and the expansions of omega, with polynomials of degrees within the limit."""
    try:
        quadratic = invariants(problem, 2)
    except LimitExceeded:
        # The exponents are too far apart for a decision within the limits; there may be a simple solution all the same.
        simple = _omegas_of_low_degree(problem)
        if not simple:
            raise
        y1 = simple[0]
        y2 = simple[-1]  # the same one if there is only one
        product = Form(2, y1.R + y2.R, y1.P * y2.P) if y1 != y2 else None
        return Found(Structure.REDUCIBLE, lambda: y1, product)
    if not isinstance(quadratic, NoInvariant):
        F = quadratic[0]
        return Found(Structure.REDUCIBLE, lambda: _from_quadratic_invariant(problem, F), F)
    unique = _unique_omega(problem)
    if isinstance(unique, Form):
        return Found(Structure.REDUCIBLE, lambda: unique)
    return (Exclusion(Structure.REDUCIBLE, (quadratic, unique)),)


def _from_quadratic_invariant(problem: Problem, F: Form) -> Form:
    """The form y1 of degree 1, from F = y1 y2 or F = y1^2.

    F' = Q0 X / D and sqrt(disc) = Q0 Y / D with F = Q0 P; so D omega = (X + Y) / (2 P), and the zeros of y1 are the common
    zeros of P and X - Y.  Over Q and for moderate degrees this is done exactly, else modulo primes; then R of
    omega = R/D + P1'/P1 is lifted, and P1 follows from its recurrence.
    """
    F = normalised(F, problem)
    # The discriminant F'^2 - 2 F F'' + 4 S F^2 is Q0^2 (X^2 - 4 P A2)/D^2, a constant: one value of it is enough.
    P, X, A2 = F.numerators(problem, 2)
    point = next(n for n in count() if problem.D(n))
    value = X(point) ** 2 - 4 * P(point) * A2(point)
    if not value:  # F = y1^2
        R = F.R / 2
        y1 = _polynomial_part(problem, R, P.degree // 2)
        if y1 is None:
            raise AssertionError("an invariant of degree 2 without discriminant is the square of a solution")
        return Form(1, R, y1)
    weight = singular_factor(problem, F.R, 1)
    w = adjoined_square_root(problem.field, value / weight(point) ** 2)
    field = w.field
    Y = w * weight
    if field == QQ and P.degree <= LARGE_DEGREE:
        return Form(1, *_first_factor(problem.D, P, X, Y, Fraction(1, 2)))
    lifter = Lifter(field)
    for bundle in field.bundles():
        problem.budget.check()
        try:
            parts = [_first_factor(h(problem.D), h.keeping_degree(P), h(X), h(Y), pow(2, -1, h.p)) for h in bundle]
        except BadPrimeError:
            continue
        form = _lifted_omega(problem, lifter, bundle, [(R, zeros.degree()) for R, zeros in parts])
        if form is not None:
            return form
    raise AssertionError("the sequence of primes is infinite")


def _first_factor(D: Any, P: Any, X: Any, Y: Any, half: Any) -> tuple[Any, Any]:
    """R and the monic P1 of omega = R/D + P1'/P1, over Q or modulo p, where a half is given."""
    zeros = P.gcd(X - Y)
    omega, rest = divmod((X + Y) * half, P // zeros)  # D P1 omega
    R, remainder = divmod(omega - D * zeros.derivative(), zeros)
    if rest or remainder:
        raise BadPrimeError("zeros of the solutions meet modulo this prime")
    return R, zeros


def _unique_omega(problem: Problem) -> Form | Evidence:
    """The only rational omega, lifted from its images modulo primes, or a proof that there is none.

    One set of primes without an omega of a degree up to the bound proves it.  The bound is computed at first where it is
    cheap, else where the first degrees bring none.
    """
    impossible = irrational_exponents(problem)
    if impossible is not None:
        return impossible
    bound = degree_bound(problem) if is_cheap(problem) else None
    if bound is not None and not isinstance(bound, DegreeBound):
        return bound
    # Only finitely many local solutions can belong to omega there; the cheapest such place.
    suitable = (place for place in problem.places if not place.is_apparent)
    place = min(suitable, key=lambda place: (place.degree, not place.logarithm, not place.at_infinity))
    degrees = _first_degrees(problem) if bound is None else _ladder(bound.largest)
    # For small degrees the expansion that can be left out costs less than to find it.
    exponents = bound.exponents(place) if bound is not None and bound.largest > degrees[0] else None
    lifter = Lifter(problem.field)
    for bundle in problem.field.bundles():
        problem.budget.check()
        try:
            found = [_omega_modulo(h, problem, place, degrees, exponents) for h in bundle]
            if None in found:
                bound = bound or degree_bound(problem)
                if not isinstance(bound, DegreeBound):
                    return bound
                if further := [n for n in _ladder(bound.largest) if n > degrees[-1]]:
                    found = [_omega_modulo(h, problem, place, further, exponents) for h in bundle]
                if None in found:
                    return NoRationalOmega(bound.largest, bundle[found.index(None)].p, place.name)
        except BadPrimeError:
            continue
        images = [part for part in found if part is not None]
        degrees = [images[0][1]]
        form = _lifted_omega(problem, lifter, bundle, images)
        if form is not None:
            return form
    raise AssertionError("the sequence of primes is infinite")


def _omegas_of_low_degree(problem: Problem) -> list[Form]:
    """Every omega = R/D + P'/P over K with a P of low degree, told apart by their exponents at a place."""

    def agreement(place: Place) -> tuple[Any, int]:
        # At an apparent point all solutions of the smaller exponent agree up to the term of the difference of the exponents.
        return (-(place.delta or 0) if place.is_apparent else -math.inf, place.degree)

    singular = [place for place in problem.places if place.kind is not Kind.ORDINARY]
    for place in sorted(singular, key=agreement):
        roots = Roots(problem.field)
        choices = first_case_choices(place, roots) or ()
        exponents = [problem.field.one * c.value for c in choices] if roots.field == problem.field else []
        if exponents and len(set(exponents)) == len(exponents):
            # At infinity a power of x, whose exponent e is that of (1/x)^(1 - e) in the chart.
            found = [_of_exponent(problem, place, 1 - e if place.at_infinity else e) for e in exponents]
            return [form for form in found if form is not None]
    return []


def _of_exponent(problem: Problem, place: Place, exponent: Poly) -> Form | None:
    """The omega over K with a P of low degree and this exponent, if a few primes are enough to find it."""
    degrees = _first_degrees(problem)
    lifter = Lifter(problem.field)
    for bundle in islice(problem.field.bundles(), MOST_TRIALS):
        problem.budget.check()
        try:
            found = [_omega_modulo(h, problem, place, degrees, [exponent]) for h in bundle]
        except BadPrimeError:
            continue
        if None in found:
            return None
        form = _lifted_omega(problem, lifter, bundle, [part for part in found if part is not None])
        if form is not None:
            return form
    return None


def _lifted_omega(
    problem: Problem, lifter: Lifter, bundle: Sequence[Homomorphism], images: list[tuple[Any, int]]
) -> Form | None:
    """The form with these R and degrees of P modulo p, once there are enough primes; None as long as there aren't."""
    degrees = {degree for _, degree in images}
    if len(degrees) != 1:
        return None
    proposal = lifter.add(bundle, [[R] for R, _ in images])
    if not proposal:
        return None
    P = _polynomial_part(problem, proposal[0], degrees.pop())
    return None if P is None else Form(1, proposal[0], P)


def _first_degrees(problem: Problem) -> list[int]:
    """Degrees of P that are tried before their bound is computed where that is the more expensive part."""
    return [min(degree, problem.budget.limits.unknown_degree) for degree in (8, 32)]


def _ladder(bound: int) -> list[int]:
    """Degrees to be tried for P: small ones first, for the bound is often far above the degree; the bound last."""
    return [*(n for n in (8, 32, 128, 1024) if n < bound), bound]


def _omega_modulo(
    h: Homomorphism,
    problem: Problem,
    place: Place,
    degrees: list[int],
    exponents: list[Poly] | None,
) -> tuple[Any, int] | None:
    """R and deg P of the only rational omega modulo p; None if there is none.

    `exponents` restricts the search to expansions with these.  Raises `BadPrimeError` if the place has no root in F_p, or if
    there are two such omegas modulo p.
    """
    c = modular_chart(h, problem, place)
    if c is None:
        raise BadPrimeError("the place has no root modulo this prime")
    allowed = None if exponents is None else [int(h(exponent)[0]) for exponent in exponents]
    parts = exponential_parts(c.equation, place, allowed)
    for degree in degrees:
        problem.budget.check()
        if degree > problem.budget.limits.unknown_degree:
            # The bound, not the step on the way to it: a limit between the two would not be enough.
            problem.budget.check_degree(degrees[-1], "the polynomial part of a solution")
        found = [pair for pair in (rational_omega(c, Q, degree) for Q in parts) if pair]
        if len(found) > 1:
            raise BadPrimeError("two solutions modulo this prime")
        if found:
            return omega_parts(h, problem, c, *found[0])
    return None


def _polynomial_part(problem: Problem, R: Poly, degree: int) -> Poly | None:
    """The monic P of this degree with omega = R/D + P'/P: D P'' + 2 R P' + ((R' D - R D' + R^2 - T)/D) P = 0."""
    D = problem.D
    zeroth = (R.derivative() * D - R * D.derivative() + R * R - problem.T).exact_quotient(D)
    return None if zeroth is None else polynomial_solution(D.over(R.field), 2 * R, zeroth, degree)

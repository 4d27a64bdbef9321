"""Rational invariants of degree m: forms in the solutions of y'' = S y that are rational functions of x.

No combination of exponents is searched.  Each place bounds the valuation of such a form F from below, so F = Q0 P with a
known Q0 = prod p^(v_p) and a polynomial P of degree at most N.  With the fundamental system y1, y2 at an ordinary point,
F = sum c_i y1^i y2^(m-i), and the m + 1 constants c_i satisfy the linear equations which say that the coefficients of F/Q0
above x^N vanish.  Modulo a prime a rank can only drop, so the nullity there bounds the dimension from above; what is found
is lifted to the field and verified with equation (2) of `kovacic.engine.riccati`.

References: Ulmer & Weil, J. Symb. Comp. 22 (1996); van Hoeij & Weil, J. Pure Appl. Algebra 117-118 (1997).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from kovacic.algebra.homomorphism import BadPrimeError, Homomorphism
from kovacic.algebra.lifting import Lifter
from kovacic.algebra.modular import (
    echelon_by_degree,
    fundamental_system,
    null_space,
    ordinary_point,
    power_series,
    translate,
)
from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import QQ
from kovacic.decision import NoInvariant
from kovacic.engine.expansion import polynomial_invariant
from kovacic.engine.places import Kind, Place, Problem
from kovacic.engine.riccati import Form, numerators, singular_part

#: Equations beyond the number of unknowns, so that accidental solutions are improbable.
_MARGIN = 6


def least_valuation(place: Place, m: int, *, logarithms: bool = True) -> int | None:
    """The least valuation that a rational invariant of degree m can have at a place; None if there can be none.

    A form of degree m is a combination of y+^i y-^(m-i); with local exponents (1 +- Delta)/2 its rational members have
    valuations among m/2 + j Delta, j = -m/2, ..., m/2.  A logarithm leaves only the m-th power of the solution without
    one, an irregular place only powers of y+ y-, whose valuation is order/2.  With `logarithms=False` none is counted on.
    """
    if place.kind is Kind.ORDINARY:
        return 0
    if place.kind is not Kind.REGULAR:
        exact = Fraction(m * place.order, 4)
        return int(exact) if exact.denominator == 1 else None
    if place.delta is None:
        return m // 2 if m % 2 == 0 else None
    # With Delta = a/b the valuations are (m b + 2 j a) / (2 b).
    a = place.delta.numerator
    b = place.delta.denominator
    multiples = [m * a] if logarithms and place.logarithm else range(-m * a, m * a + 1, 2 * a or 1)
    for k in multiples:
        v, rest = divmod(m * b + k, 2 * b)
        if not rest:
            return v
    return None


def bounds(problem: Problem, m: int, *, logarithms: bool = True) -> tuple[list[int], int] | None:
    """The least valuations of an invariant of degree m, infinity's last, and the largest degree N of P; None if it can't be."""
    valuations = list[int]()
    N = m
    for place in problem.places:
        v = least_valuation(place, m, logarithms=logarithms)
        if v is None:
            return None
        valuations.append(v)
        N -= v * place.degree
    return (valuations, N) if N >= 0 else None


def invariants(problem: Problem, m: int) -> list[Form] | NoInvariant:
    """The rational invariants of degree m: a verified basis, of increasing degrees of P, or the proof that there is none."""
    bound = bounds(problem, m)
    if bound is None:
        return NoInvariant(m)
    valuations, N = bound
    problem.budget.check_degree(N, f"an invariant of degree {m}")
    R0 = singular_part(problem, valuations[:-1])
    lifter = Lifter(problem.field)
    margin = _MARGIN
    recurrence_tried = False
    for bundle in problem.field.bundles():
        problem.budget.check()
        try:
            spaces = [invariants_modulo(h, problem, m, valuations, N, margin=margin) for h in bundle]
        except BadPrimeError:
            continue
        excluded = _excluded(bundle, spaces, m, N)
        if excluded is not None:
            return excluded
        bases = [space for space, _ in spaces]
        dimensions = {len(space) for space in bases}
        if len(dimensions) > 1:
            continue
        forms = _verified_forms(problem, m, R0, lifter.add(bundle, bases) or [])
        if forms:
            return forms
        if not _are_forms(bundle, problem, m, R0, bases):
            margin *= 2
            lifter = Lifter(problem.field)
            continue
        is_single = dimensions == {1}
        if is_single and not recurrence_tried and _recurrence_is_cheaper(problem, m, N, lifter.primes_used):
            recurrence_tried = True
            form = _by_recurrence(problem, m, N, valuations, R0)
            if form is not None:
                return [form]
    raise AssertionError("the sequence of primes is infinite")


def _excluded(
    bundle: Sequence[Homomorphism], spaces: Sequence[tuple[list[Any], int]], m: int, N: int
) -> NoInvariant | None:
    """The proof by the first prime modulo which there is none; None if there is one modulo each."""
    for h, (space, point) in zip(bundle, spaces, strict=True):
        if not space:
            return NoInvariant(m, prime=h.p, point=point, degree=N)
    return None


def _verified_forms(problem: Problem, m: int, R0: Poly, proposal: Sequence[Poly]) -> list[Form]:
    """Those with the proposed P, if all of them are right; else none."""
    forms = [Form(m, R0, P) for P in proposal]
    return forms if all(form.is_form(problem) for form in forms) else []


def _are_forms(bundle: Sequence[Homomorphism], problem: Problem, m: int, R0: Poly, bases: Sequence[list[Any]]) -> bool:
    """Are all that were found modulo the primes forms there?  Too few equations let others pass."""
    return all(_all_close(h, problem, m, R0, space) for h, space in zip(bundle, bases, strict=True))


def _by_recurrence(problem: Problem, m: int, N: int, valuations: list[int], R0: Poly) -> Form | None:
    """The invariant that is found over the field itself, verified; None if there is none."""
    lifted = polynomial_invariant(problem, m, N, valuations)
    if lifted is None:
        return None
    form = Form(m, R0, lifted)
    return form if form.is_form(problem) else None


def _recurrence_is_cheaper(problem: Problem, m: int, N: int, primes_used: int) -> bool:
    """Has lifting by primes already cost as much as the recurrence would?

    Building the recurrence takes about (m + 1)^2 n^2 products of short polynomials, and a prime about as long as N + 20 of
    them; measured by `benchmarks/lifting.py`.
    """
    products = ((m + 1) * (problem.D.degree + 1)) ** 2
    return problem.field == QQ and primes_used * (N + 20) >= products


def invariants_modulo(
    h: Homomorphism, problem: Problem, m: int, valuations: Sequence[int], N: int, *, margin: int
) -> tuple[list[Any], int]:
    """The echelon basis modulo p of all P whose expansion agrees with a form to N + m + 2 + margin terms; and the point."""
    num = h(problem.S.num)
    den = h.keeping_degree(problem.S.den)
    point = ordinary_point(den)
    p = h.p
    order = N + m + 2 + margin
    y1, y2 = fundamental_system(translate(num, point), translate(den, point), order)
    factors = [
        (translate(h.keeping_degree(place.factor), point), -v)
        for place, v in zip(problem.finite_places, valuations, strict=False)
        if v
    ]
    # F/Q0 = (y1^m / Q0) * sum_i c_i (y2/y1)^i
    product = y1.pow_trunc(m, order)
    if factors:
        product = product.mul_low(power_series(factors, order), order)
    ratio = y2.mul_low(y1.inverse_series_trunc(order), order)
    columns = [product]
    for _ in range(m):
        columns.append(columns[-1].mul_low(ratio, order))
    rows = [[column[k] for column in columns] for k in range(N + 1, order)]
    space = []
    for c in null_space(rows, m + 1, p):
        P = sum((column.truncate(N + 1) * value for column, value in zip(columns, c, strict=True)), columns[0] * 0)
        space.append(translate(P, -point % p))
    return echelon_by_degree(space), point


def _all_close(h: Homomorphism, problem: Problem, m: int, R0: Poly, space: Sequence[Any]) -> bool:
    return all(_closes(h, problem, m, R0, P) for P in space)


def _closes(h: Homomorphism, problem: Problem, m: int, R0: Poly, P: Any) -> bool:
    """Equation (2) of `riccati`, modulo p: is P really an invariant there, beyond the terms that were looked at?"""
    return not numerators(h(problem.D), h(problem.T), h(R0), P, m, m + 1)[-1]

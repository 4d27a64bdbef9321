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
    EXTRA_EQUATIONS,
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
from kovacic.engine.places import Place, Problem
from kovacic.engine.riccati import Form, numerators, singular_part


def least_invariant_valuation(place: Place, m: int, *, logarithms: bool = True) -> int | None:
    """The least valuation that a rational invariant of degree m can have at a place; None if there can be none.

    A form of degree m is a combination of y+^i y-^(m-i); with local exponents (1 +- Delta)/2 its rational members have
    valuations among m/2 + j Delta, j = -m/2, ..., m/2.  A logarithm leaves only the m-th power of the solution without
    one, an irregular place only powers of y+ y-, whose valuation is order/2.  With `logarithms=False` none is counted on.
    """
    if place.order > 2:
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
    """For an invariant of degree m the least valuations at all places, infinity's last, and the largest degree N of its P.

    None if there can be none.
    """
    valuations = list[int]()
    N = m
    for place in problem.places:
        v = least_invariant_valuation(place, m, logarithms=logarithms)
        if v is None:
            return None
        valuations.append(v)
        N -= v * place.degree
    return (valuations, N) if N >= 0 else None


def invariants(problem: Problem, m: int) -> list[Form] | NoInvariant:
    """The rational invariants of degree m: a verified basis, of increasing degrees of P, or the proof that there is none."""
    found = bounds(problem, m)
    if found is None:
        return NoInvariant(m)
    valuations, N = found
    problem.budget.check_degree(N, f"an invariant of degree {m}")
    R0 = singular_part(problem, valuations[:-1])

    def verified(proposal: Sequence[Poly]) -> list[Form]:
        """The forms with the proposed P, if all of them are right; else none."""
        forms = [Form(m, R0, P) for P in proposal]
        return forms if all(form.is_form(problem) for form in forms) else []

    # Equations beyond the number of unknowns, and the images modulo all primes that were of use with them.
    margin = EXTRA_EQUATIONS
    lifter = Lifter(problem.field)
    may_use_recurrence = problem.field == QQ
    for bundle in problem.field.bundles():
        problem.budget.check()
        try:
            spaces = [invariants_modulo(h, problem, m, valuations, N, margin=margin) for h in bundle]
        except BadPrimeError:
            continue
        for h, (basis, point) in zip(bundle, spaces, strict=True):
            if not basis:
                return NoInvariant(m, prime=h.p, point=point, degree=N)
        bases = [basis for basis, _ in spaces]
        dimensions = {len(basis) for basis in bases}
        if len(dimensions) > 1:
            continue
        if forms := verified(lifter.add(bundle, bases) or []):
            return forms
        # Equation (2) of `riccati` modulo p says whether every P is an invariant there, beyond the terms that were compared.
        images = [(h(problem.D), h(problem.T), h(R0), P) for h, basis in zip(bundle, bases, strict=True) for P in basis]
        if any(numerators(*image, m, m + 1)[-1] for image in images):
            margin *= 2  # more equations, from the beginning
            lifter = Lifter(problem.field)
            continue
        # Building the recurrence takes about (m + 1)^2 n^2 products of short polynomials, and a prime about as long as
        # N + 20 of them; measured by `benchmarks/lifting.py`.
        products = ((m + 1) * (problem.D.degree + 1)) ** 2
        if dimensions == {1} and may_use_recurrence and lifter.primes_used * (N + 20) >= products:
            may_use_recurrence = False
            P = polynomial_invariant(problem, m, N, valuations)  # over the field itself
            if P is not None and (forms := verified([P])):
                return forms
    raise AssertionError("the sequence of primes is infinite")


def invariants_modulo(
    h: Homomorphism, problem: Problem, m: int, valuations: Sequence[int], N: int, *, margin: int
) -> tuple[list[Any], int]:
    """The echelon basis modulo a prime of all P whose expansion at a point agrees with a form to enough terms; the point."""
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

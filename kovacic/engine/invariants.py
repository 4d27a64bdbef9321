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
from typing import Any, NamedTuple

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


class Bounds(NamedTuple):
    """The least `valuations` of an invariant at all places, infinity's last, and the largest `degree` N of its P."""

    valuations: list[int]
    degree: int


def bounds(problem: Problem, m: int, *, logarithms: bool = True) -> Bounds | None:
    """The bounds that the places set for an invariant of degree m; None if there can be none."""
    valuations = list[int]()
    N = m
    for place in problem.places:
        v = least_invariant_valuation(place, m, logarithms=logarithms)
        if v is None:
            return None
        valuations.append(v)
        N -= v * place.degree
    return Bounds(valuations, N) if N >= 0 else None


def invariants(problem: Problem, m: int) -> list[Form] | NoInvariant:
    """The rational invariants of degree m: a verified basis, of increasing degrees of P, or the proof that there is none."""
    found = bounds(problem, m)
    if found is None:
        return NoInvariant(m)
    problem.budget.check_degree(found.degree, f"an invariant of degree {m}")
    search = _Search(problem, m, *found)
    for bundle in problem.field.bundles():
        problem.budget.check()
        try:
            spaces = [invariants_modulo(h, problem, m, *found, margin=search.margin) for h in bundle]
        except BadPrimeError:
            continue
        for h, space in zip(bundle, spaces, strict=True):
            if not space.basis:
                return NoInvariant(m, prime=h.p, point=space.point, degree=found.degree)
        forms = search.lifted(bundle, [space.basis for space in spaces])
        if forms:
            return forms
    raise AssertionError("the sequence of primes is infinite")


class _Search:
    """The invariants of degree m, from their images modulo one prime after the other.

    `margin` equations are taken beyond the number of unknowns; the `lifter` has the images of all primes that were of use.
    """

    def __init__(self, problem: Problem, m: int, valuations: list[int], N: int) -> None:
        self.problem = problem
        self.m = m
        self.valuations = valuations
        self.N = N
        self.R0 = singular_part(problem, valuations[:-1])
        self.margin = EXTRA_EQUATIONS
        self.lifter = Lifter(problem.field)
        self.recurrence_tried = False

    def lifted(self, bundle: Sequence[Homomorphism], bases: Sequence[list[Any]]) -> list[Form]:
        """A verified basis over the field, if one can be told with the bases modulo these primes; else none, for now."""
        dimensions = {len(basis) for basis in bases}
        if len(dimensions) > 1:
            return []
        forms = self._verified(self.lifter.add(bundle, bases) or [])
        if forms:
            return forms
        # Equation (2) of `riccati` modulo p says whether every P is an invariant there, beyond the terms that were compared.
        problem = self.problem
        for h, basis in zip(bundle, bases, strict=True):
            D, T, R0 = h(problem.D), h(problem.T), h(self.R0)
            if any(numerators(D, T, R0, P, self.m, self.m + 1)[-1] for P in basis):
                self.margin *= 2  # more equations, from the beginning
                self.lifter = Lifter(problem.field)
                return []
        if dimensions == {1} and not self.recurrence_tried and problem.field == QQ:
            # Building the recurrence takes about (m + 1)^2 n^2 products of short polynomials, and a prime about as long as
            # N + 20 of them; measured by `benchmarks/lifting.py`.
            products = ((self.m + 1) * (problem.D.degree + 1)) ** 2
            if self.lifter.primes_used * (self.N + 20) < products:
                return []
            self.recurrence_tried = True
            P = polynomial_invariant(problem, self.m, self.N, self.valuations)  # over the field itself
            return [] if P is None else self._verified([P])
        return []

    def _verified(self, proposal: Sequence[Poly]) -> list[Form]:
        """The forms with the proposed P, if all of them are right; else none."""
        forms = [Form(self.m, self.R0, P) for P in proposal]
        return forms if all(form.is_form(self.problem) for form in forms) else []


class ModularSpace(NamedTuple):
    """The echelon `basis` modulo a prime of all P whose expansion at this `point` agrees with a form to enough terms."""

    basis: list[Any]
    point: int


def invariants_modulo(
    h: Homomorphism, problem: Problem, m: int, valuations: Sequence[int], N: int, *, margin: int
) -> ModularSpace:
    """The polynomials P that agree with a form to N + m + 2 + margin terms."""
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
    return ModularSpace(echelon_by_degree(space), point)

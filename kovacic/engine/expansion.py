"""One invariant of high degree over Q, from its recurrence in integers instead of prime by prime.

By equation (2) of `kovacic.engine.riccati` the polynomials B_k = k! A_k satisfy B_(k+1) = L_(k+1) P with the operators

    L_0 = 1,   L_(k+1) = (D d/dt + R - k D') L_k - k (m - k + 1) T L_(k-1),                                       (1)

and P belongs to an invariant of degree m exactly when L_(m+1) P = 0.  Write L_k t^i = sum_j l_(k,j)(i) t^(i+j), l_(k,j) a
polynomial in i.  With j0 the least j (0 at a regular singular point t = 0, -(m+1) at an ordinary one) the coefficients of a
power series solution P = sum u_i t^i follow from one another,

    l_(m+1,j0)(i) u_i = - sum_(h>0) l_(m+1,j0+h)(i-h) u_(i-h),                                                    (2)

except at the roots i of l_(m+1,j0), the exponents of the symmetric power: each begins a solution of its own.  Which
combination of these few solutions is a polynomial of degree N is linear algebra with as many unknowns.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import lcm
from typing import Any, NamedTuple

from flint import Ordering, fmpq, fmpq_mat, fmpq_poly, fmpz_mpoly_ctx, fmpz_poly

from kovacic.algebra.factors import product
from kovacic.algebra.modular import EXTRA_EQUATIONS, ordinary_point
from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import QQ, RationalPoly
from kovacic.algebra.recurrence import RationalSeries
from kovacic.algebra.sparse import constant_term
from kovacic.engine.places import Kind, Place, Problem


def polynomial_invariant(problem: Problem, m: int, N: int, valuations: Sequence[int]) -> Poly | None:
    """P of the only invariant prod p^v P of degree m with deg P <= N over Q; None if the linear algebra isn't conclusive.

    `valuations` are the least ones at all places, infinity included.  The caller verifies the proposal.
    """
    place = _cheapest_place(problem, m, valuations)
    D, R, T, point = _local_coefficients(problem, place, valuations)
    solutions, conditions = _local_solutions(problem, _recurrence_factors(m, D, R, T), N)
    combination = _unique_null_vector(conditions, len(solutions))
    if combination is None:
        return None
    P = fmpq_poly([])
    for factor, solution in zip(combination, solutions, strict=True):
        terms = solution.series.polynomial(max(N + 1 - solution.start, 0))  # up to t^N
        P += terms.rep.left_shift(solution.start) * factor
    if place is not None and place.at_infinity:
        return RationalPoly(fmpq_poly(P.coeffs()[::-1]).left_shift(N - P.degree())).monic()
    return RationalPoly(P)(QQ.poly([-point, 1])).monic()


class _Solution(NamedTuple):
    """A solution of the recurrence that begins with t^start."""

    start: int
    series: RationalSeries

    def term(self, k: int) -> Any:
        """The coefficient of t^k."""
        return self.series.term(k - self.start) if k >= self.start else fmpq(0)


def _local_solutions(problem: Problem, factors: Sequence[Any], N: int) -> tuple[list[_Solution], list[list[Any]]]:
    """The solutions to some terms beyond t^N, and the conditions, a row each, on a combination of them that is a polynomial of
    degree N at most: those of the recurrence where its first factor vanishes, and that the terms beyond are zero."""
    lowest, *others = factors
    solutions: list[_Solution] = []
    conditions = []
    end = N + 1
    i = 0
    while i < end:
        if i % 16 == 0:
            problem.budget.check()
        pivot = lowest(i)
        values = [factor(i - h) for h, factor in enumerate(others[:i], 1)]
        obstructions = [solution.series.extend(pivot, values) for solution in solutions]
        if not pivot:
            if any(obstructions):
                conditions.append(obstructions)
            solutions.append(_Solution(i, RationalSeries(len(others))))
            end = N + 1 + len(solutions) + EXTRA_EQUATIONS
        i += 1
    conditions += [[solution.term(k) for solution in solutions] for k in range(N + 1, end)]
    return solutions, conditions


def _cheapest_place(problem: Problem, m: int, valuations: Sequence[int]) -> Place | None:
    """The rational regular place with the fewest solutions to carry, if it has fewer than an ordinary point; else None."""
    fewest = m + 1
    best = None
    for place, least in zip(problem.places, valuations, strict=True):
        if place.kind is Kind.REGULAR and place.degree == 1:
            # The exponents of the products of m solutions; an irrational Delta, with y+ and y- equally often, leaves m/2.
            delta = place.delta or Fraction(0)
            exponents = {(m + (2 * k - m) * delta) / 2 for k in range(m + 1)}
            count = sum(1 for value in exponents if value.denominator == 1 and value >= least)
            if count < fewest:
                fewest = count
                best = place
    return best


def _local_coefficients(
    problem: Problem, place: Place | None, valuations: Sequence[int]
) -> tuple[Any, Any, Any, Fraction | int]:
    """D, R, T as integer polynomials in the coordinate of the place, t = x - point or t = 1/x; and the point."""
    t = QQ.x
    point: Fraction | int = 0
    pairs: list[tuple[Poly, int, int]]
    if place is not None and place.at_infinity:
        pairs = [(QQ.poly(list(p.factor)[::-1]), v, p.weight) for p, v in zip(problem.places, valuations, strict=False)]
        pairs[-1] = (t, valuations[-1], place.weight)
        num = place.num
        den = place.den
    else:
        point = ordinary_point(problem.S.den) if place is None else -place.factor[0].constant()  # type: ignore[attr-defined]
        finite = zip(problem.finite_places, valuations, strict=False)
        pairs = [(p.factor(t + point), v, p.weight) for p, v in finite]
        num = problem.S.num(t + point)
        den = problem.S.den(t + point)
    D = product([QQ.one, *(factor**weight for factor, _, weight in pairs)])
    R = sum((v * (D // factor) * factor.derivative() for factor, v, _ in pairs), QQ.zero)
    T = num * (D * D // den)
    scale = lcm(*(f.content()[1] for f in (D, R, T)))
    return (D * scale).rep.numer(), (R * scale).rep.numer(), (T * scale**2).rep.numer(), point  # type: ignore[attr-defined]


def _recurrence_factors(m: int, D: Any, R: Any, T: Any) -> list[Any]:
    """The factors l_(m+1,j0+h) of equation (2), h = 0, 1, ..., polynomials in i: L_(m+1) of equation (1) by its action on t^i.

    M_k = t^k L_k t^i/t^i is a polynomial in t and i, since t d/dt (M t^i) = (i M + t M') t^i.
    """
    ring = fmpz_mpoly_ctx.get(("t", "i"), Ordering.lex)
    t, i = ring.gens()
    D, R, T = (ring.from_dict({(k, 0): c for k, c in enumerate(f.coeffs())}) for f in (D, R, T))
    slope = D.derivative(0)
    previous = ring.constant(0)
    current = ring.constant(1)
    for k in range(m + 1):
        following = D * ((i - k) * current + t * current.derivative(0)) + t * (R - k * slope) * current
        previous, current = current, following - k * (m - k + 1) * t * t * T * previous
    columns: dict[int, dict[int, int]] = {}
    for (j, power), coefficient in current.to_dict().items():
        columns.setdefault(int(j), {})[int(power)] = int(coefficient)
    lowest = 0 if constant_term(D) else m + 1
    polynomials = [columns.get(j, {0: 0}) for j in range(lowest, max(columns) + 1)]
    return [fmpz_poly([terms.get(k, 0) for k in range(max(terms) + 1)]) for terms in polynomials]


def _unique_null_vector(rows: list[list[Any]], columns: int) -> list[Any] | None:
    """The vector v with rows v = 0 if it is unique up to a factor, else None.

    Short rows are filled with zeros: a condition that is met early doesn't concern the solutions that begin later.
    """
    entries = [value for row in rows for value in (*row, *[fmpq(0)] * (columns - len(row)))]
    basis, nullity = fmpq_mat(len(rows), columns, entries).numer_denom()[0].nullspace()
    return [basis[i, 0] for i in range(columns)] if nullity == 1 else None

"""Case 1 beyond the limit of the degree: a P that is known by a recurrence of two terms.

Kovacic's families give every theta that omega = theta + P'/P can have, with the degree of P.  About a suitable point the
equation D P'' + 2 R P' + Z P = 0, R = D theta, is often a relation between two coefficients of P alone, as that of Hermite's,
Laguerre's and Jacobi's polynomials, and of these with x replaced by a power of x.  The roots of its two factors decide
whether it ends in a polynomial, whatever the degree; see `kovacic.algebra.recurrence`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain
from math import prod

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc, over_one_denominator
from kovacic.algebra.recurrence import TwoTerms
from kovacic.decision import NoTerminatingSeries, TerminatingSeries
from kovacic.engine.families import (
    Roots,
    families,
    first_case_choices,
    natural,
    points_of_place,
    theta_numerator,
)
from kovacic.engine.places import Problem
from kovacic.limits import MOST_TRIALS


@dataclass(frozen=True)
class SeriesSearch:
    """The theta that leave a natural degree for P: those for which there is a P, by degree, and whether all were decided.

    `known` is false from the first theta on whose recurrence has more terms than two; `complete` says that all poles and
    exponents lie in the field of S, so that the kernel can go through the same theta.
    """

    found: tuple[TerminatingSeries, ...]
    known: bool
    complete: bool
    count: int


def terminating_series(problem: Problem) -> TerminatingSeries | NoTerminatingSeries | None:
    """A solution exp(int theta) P with P of least degree, or the proof that there is none; None if recurrences don't decide."""
    search = search_series(problem)
    if search is None:
        return None
    if search.found:
        return search.found[0]
    return NoTerminatingSeries(search.count) if search.known and search.complete else None


def search_series(problem: Problem) -> SeriesSearch | None:
    """All theta, by the degree of P up to the first that isn't decided; None if they are too many, or over other fields."""
    roots = Roots(problem.field, "c")
    *poles, infinity = problem.places
    points = [*points_of_place(infinity, roots), *chain.from_iterable(points_of_place(place, roots) for place in poles)]
    choices = []
    for point in points:
        chosen = first_case_choices(point.place, roots)
        if chosen is None:
            return None
        choices.append(chosen)
    field = roots.field
    is_single = isinstance(field, AlgebraicField) and field.base == problem.field
    if prod(map(len, choices)) > MOST_TRIALS or not (field == problem.field or is_single):
        return None
    D = problem.D.over(field)
    tried = []
    for family, d in families(choices, points, 1, field):
        if (degree := natural(d)) is not None:
            theta = RatFunc(theta_numerator(D, points, family), D)
            if not any([*theta.num.parts[1:], *theta.den.parts[1:]]):  # over K, if it doesn't contain c
                theta = RatFunc(theta.num.parts[0], theta.den.parts[0])
            tried.append((degree, theta))
    found = []
    is_known = True
    for degree, theta in sorted(tried, key=lambda pair: pair[0]):
        problem.budget.check()
        recurrences = (
            (centre, recurrence_about(centre, problem.S, theta)) for centre in _possible_centres(problem, theta)
        )
        centre, recurrence = next((pair for pair in recurrences if pair[1] is not None), (theta.num, None))
        if recurrence is None:
            is_known = False
            break
        lowest = recurrence.lowest(degree)
        if lowest is not None:
            found.append(TerminatingSeries(theta, centre, recurrence.step, degree, lowest))
    is_complete = field == problem.field and all(point.count == 1 for point in points)
    return SeriesSearch(tuple(found), is_known, is_complete, len(tried))


def recurrence_about(centre: Poly, S: RatFunc, theta: RatFunc) -> TwoTerms | None:
    """That of P'' + 2 theta P' + (theta' + theta^2 - S) P = 0 in powers of x - centre; None for more terms than two."""
    x = theta.field.x
    one = RatFunc(x**0)
    parts = over_one_denominator([one, 2 * theta, theta.derivative() + theta * theta - one * S])
    return TwoTerms.of(*(part(x + centre) for part in parts))


def _possible_centres(problem: Problem, theta: RatFunc) -> Iterator[Poly]:
    """Points about which a recurrence can have two terms: poles in K, the centre of all, or of theta's zeros, other poles."""
    D = problem.D
    poles = [place.factor for place in problem.finite_places]
    yield from (-p[0] for p in poles if p.degree == 1)
    whole = D if poles else theta.num
    if whole.degree > 0:
        yield whole.mean_of_zeros
    for p in poles:
        if p.degree > 1 and theta.field != D.field:
            yield from (-q[0] for q, _ in theta.field.factor(p.over(theta.field)) if q.degree == 1)

"""Numerical values of solutions as enclosures: one point, many points, complex paths, any number of digits.

The guarantee: the exact value of the solution (in its homotopy class of paths) lies in the returned ball.  The radius is at
most 10^-digits relative to the value, unless the problem forbids it (a value that is zero or can't be told from zero, initial
values that are balls themselves, a limit that was reached); then the ball is wide and an `AccuracyWarning` says why.

Two independent routes: "taylor" (the equation itself, `kovacic.enclosure.transport`; every S) and "closed form"
(the certificate of a decision, `kovacic.enclosure.closed_form`; Liouvillian solutions only).
"""

from __future__ import annotations

import itertools
import warnings
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from kovacic.enclosure.ball import Ball, ball_from_flint
from kovacic.enclosure.carry import Itinerary, Prefix, Start, carry, initial_value, make_itinerary
from kovacic.enclosure.gauge import with_gauge
from kovacic.enclosure.points import as_point
from kovacic.enclosure.precision import METHODS, Evaluation, Method, Route, check_digits, raise_precision, start_bits
from kovacic.enclosure.problem import NumericProblem, as_problem
from kovacic.enclosure.transport import piece_matrices
from kovacic.errors import InputError
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits

if TYPE_CHECKING:
    from flint import acb


class AccuracyWarning(UserWarning):
    """An enclosure is wider than asked for; the message says why."""


def evaluate(
    equation: object,
    x: object,
    *,
    x0: object,
    y0: object,
    dy0: object,
    digits: int = 15,
    method: Method | None = None,
    path: Sequence[object] | Literal["chain"] | None = None,
    limits: Limits | None = None,
) -> Ball | tuple[Ball, ...]:
    """The solution with y(x0) = y0, y'(x0) = dy0 at x: a ball that contains the exact value.

    `equation` is S of y'' = S y (text, SymPy expression, rational function, or a pair of coefficient lists from low to high),
    an equation a z'' + b z' + c z = 0, or a solution of this package.  `x` is a number or a sequence of numbers (a tuple of
    balls is returned, in the same order).  Numbers are exact: int, Fraction, float and complex (their binary values), Decimal
    and decimal text, mpmath and SymPy numbers; y0 and dy0 may be balls as well.

    The path is the straight line from x0 to each x; `path=[v1, v2, ...]` goes through these vertices first; `path="chain"`
    visits the points of x one after the other.  A path through a singular point is refused.

    Raises InputError (a singular point at an end or on the path, with its distance; digits out of range; a number that
    isn't finite; an unknown method) and LimitExceeded (nothing could be said within the limits).

    >>> airy = ([0, 1], [1])                                     # y'' = x y
    >>> value = evaluate(airy, 2, x0=0, y0=1, dy0=0, digits=20)
    >>> print(value.contains(2.73), value.digits >= 20, f"{float(value):.12f}")
    False True 2.730883017890
    """
    many = isinstance(x, Iterable) and not isinstance(x, str)
    points = list(x) if isinstance(x, Iterable) and not isinstance(x, str) else [x]
    results = evaluate_states(
        equation, points, x0=x0, y0=y0, dy0=dy0, digits=digits, method=method, path=path, limits=limits
    )
    for result in results:
        if result.note is not None:
            warnings.warn(f"at x = {result.x}: {result.note}", AccuracyWarning, stacklevel=2)
    return tuple(result.y for result in results) if many else results[0].y


def evaluate_states(
    equation: object,
    points: Sequence[object],
    *,
    x0: object,
    y0: object,
    dy0: object,
    digits: int = 15,
    method: Method | None = None,
    path: Sequence[object] | Literal["chain"] | None = None,
    limits: Limits | None = None,
) -> tuple[Evaluation, ...]:
    """As `evaluate`, with y and y' and the circumstances, for each of `points` (no warnings: see `Evaluation.note`)."""
    limits = limits or DEFAULT_LIMITS
    check_digits(digits, limits)
    if method is not None and method not in METHODS:
        raise InputError(f"unknown method {method!r}", hint=f"one of {', '.join(map(repr, METHODS))}, or None")
    problem = as_problem(equation)
    itinerary = make_itinerary(points, x0, path)
    budget = Budget(limits)
    start = (initial_value(y0, "y0"), initial_value(dy0, "dy0"))
    route, used = _route(problem, itinerary, start, method)
    exact = not any(isinstance(value, Ball) for value in start)
    return raise_precision(route, used, itinerary.targets, digits, budget, exact)


def transition_matrix(
    equation: object, vertices: Sequence[object], *, digits: int = 15, limits: Limits | None = None
) -> tuple[tuple[Ball, Ball], tuple[Ball, Ball]]:
    """Balls around the matrix that carries (y, y') along the polygon through `vertices` (determinant 1), for the
    normal form y'' = S y.

    The radii are at most 10^-digits relative to the largest entry, unless a limit is reached first (then
    LimitExceeded).

    >>> ((a, b), (c, d)) = transition_matrix(([1], [1]), [0, 1])   # cosh, sinh
    >>> float(a), float(b)
    (1.5430806348152437, 1.1752011936438014)
    """
    limits = limits or DEFAULT_LIMITS
    check_digits(digits, limits)
    problem = as_problem(equation)
    polygon = [as_point(v, "a vertex") for v in vertices]
    if not polygon:
        raise InputError("a path needs at least one vertex")
    from flint import arb, ctx

    budget = Budget(limits)
    prec = start_bits(digits)
    while True:
        with ctx.workprec(prec + 40):
            stack = Prefix()
            for a, b in itertools.pairwise(polygon):
                for matrix in piece_matrices(problem.system, a, b, prec, budget):
                    stack.push(matrix)
            total = stack.product()
            size = max((entry.abs_upper() for entry in total), key=float)
            goal = size * arb(10) ** -digits
            missing = 0
            for entry in total:
                if not entry.real.rad() + entry.imag.rad() <= goal:
                    missing = max(missing, 16 + max(0, int(prec / 2) if not entry.is_finite() else 0))
            if missing == 0:
                balls = [ball_from_flint(entry) for entry in total]
                if all(ball is not None for ball in balls):
                    a11, a12, a21, a22 = (ball for ball in balls if ball is not None)
                    return (a11, a12), (a21, a22)
        prec += max(missing, prec // 4)
        budget.check()


@dataclass(frozen=True)
class TaylorRoute:
    """Route (b): the equation itself, for every S."""

    problem: NumericProblem
    itinerary: Itinerary
    start: Start

    def __call__(self, prec: int, budget: Budget) -> list[tuple[acb, acb]]:
        system = self.problem.system
        legs = with_gauge(self.problem.gauge, lambda a, b: piece_matrices(system, a, b, prec, budget))
        return carry(legs, self.itinerary, self.start)


def _route(problem: NumericProblem, itinerary: Itinerary, start: Start, method: Method | None) -> tuple[Route, Method]:
    """The route asked for; by itself the cheaper one, by a rule that was measured (`benchmarks/numeric_work_precision.py`).

    A closed form of case 1 without quadrature costs about a millisecond whatever the distance, the digits and the solution's
    zeros, if its polynomial has a moderate degree: less than the Taylor steps.  Quadratures and hypergeometric functions
    cost as much as Taylor steps at 15 digits and several times as much at 500.
    """
    if method is None and getattr(problem.source, "case", None) == 1:
        from kovacic.enclosure.closed_form import closed_form_of

        method = "closed form" if closed_form_of(problem).is_cheap else None
    if method == "closed form":
        from kovacic.enclosure.closed_form import closed_form_route

        return closed_form_route(problem, itinerary, start), "closed form"
    return TaylorRoute(problem, itinerary, start), "taylor"

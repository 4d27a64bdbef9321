"""Numerical values of solutions as enclosures: one point, many points, complex paths, any number of digits.

The guarantee: the exact value of the solution (in its homotopy class of paths) lies in the returned ball.  The radius is at
most 10^-digits relative to the value, unless the problem forbids it (a value that is zero or can't be told from zero, initial
values that are balls themselves, a limit that was reached); then the ball is wide and an `AccuracyWarning` says why.

Two independent routes: "taylor" (the equation itself, `kovacic.enclosure.transport`; every S) and "closed form"
(the certificate of a decision, `kovacic.enclosure.closed_form`; solutions of case 1).  Either gives transition matrices of
straight legs, and a state (y, y') is carried along a path with many targets by their products.
"""

from __future__ import annotations

import itertools
import warnings
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

from flint import acb, arb

from kovacic.enclosure.ball import Ball, ball_from_flint, ball_to_flint
from kovacic.enclosure.exponential import Legs, with_gauge
from kovacic.enclosure.matrices import Matrix, Product, State, real_part
from kovacic.enclosure.points import Point, as_point, to_acb
from kovacic.enclosure.precision import METHODS, Evaluation, Method, Route, check_digits, raise_precision, start_bits
from kovacic.enclosure.problem import NumericProblem, as_problem
from kovacic.enclosure.transport import piece_matrices
from kovacic.enclosure.working import working_precision
from kovacic.errors import InputError
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits

Start = tuple[Point | Ball, Point | Ball]
"""y(x0) and y'(x0)."""

Path = Sequence[object] | Literal["chain"] | None


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
    path: Path = None,
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
    points: list[object] = list(x) if many else [x]  # type: ignore[call-overload]
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
    path: Path = None,
    limits: Limits | None = None,
) -> tuple[Evaluation, ...]:
    """As `evaluate`, with y and y' and the circumstances, for each of `points` (no warnings: see `Evaluation.note`)."""
    limits = limits or DEFAULT_LIMITS
    check_digits(digits, limits)
    if method is not None and method not in METHODS:
        raise InputError(f"unknown method {method!r}", hint=f"one of {', '.join(map(repr, METHODS))}, or None")
    budget = Budget(limits)
    problem = as_problem(equation)
    itinerary = make_itinerary(points, x0, path)
    start = (initial_value(y0, "y0"), initial_value(dy0, "dy0"))
    with budget.watched():
        route, used = _route(problem, itinerary, start, method)
        exact = not any(isinstance(value, Ball) for value in start)
        return raise_precision(route, used, itinerary.targets, digits, budget, exact)


def _route(problem: NumericProblem, itinerary: Itinerary, start: Start, method: Method | None) -> tuple[Route, Method]:
    """The route asked for; by itself the cheaper one, by a rule that was measured (`benchmarks/enclosure_work_precision.py`).

    A closed form without quadrature costs about a millisecond whatever the distance, the digits and the solution's zeros, if
    its polynomial has a moderate degree: less than the Taylor steps.  Quadratures cost as much as Taylor steps at 15 digits
    and several times as much at 500.
    """
    closed = None
    if method == "closed form" or (method is None and problem.decision is not None and problem.decision.case == 1):
        from kovacic.enclosure.closed_form import closed_form_of

        closed = closed_form_of(problem)
        if method is None and closed is not None and not closed.is_cheap:
            closed = None
        elif closed is None:
            raise InputError(
                "the method 'closed form' is for solutions with a rational logarithmic derivative (case 1)",
                hint="method='taylor' treats every equation, and the other cases as fast",
            )

    def route(prec: int, budget: Budget) -> list[State]:
        def legs(a: Point, b: Point) -> list[Matrix]:
            return piece_matrices(problem.system, a, b, prec, budget) if closed is None else closed.legs(a, b, budget)

        gauged = with_gauge(problem.gauge, legs)

        def known(a: Point, b: Point) -> list[Matrix]:  # along the real axis the matrices of a real equation are real
            return [real_part(m) for m in gauged(a, b)] if a.is_real() and b.is_real() else gauged(a, b)

        return carry(known, itinerary, start)

    return route, "taylor" if closed is None else "closed form"


@dataclass(frozen=True)
class Itinerary:
    """Where to go: the polygon `trunk` from x0, then from its end a straight line to each target, or (`chain`) from
    target to target."""

    trunk: tuple[Point, ...]
    targets: tuple[Point, ...]
    chain: bool


def make_itinerary(points: Sequence[object], x0: object, path: Path) -> Itinerary:
    """The exact polygon and targets that the arguments x, x0 and path of `evaluate` stand for."""
    targets = tuple(as_point(p, "x") for p in points)
    origin = as_point(x0, "x0")
    if path is None:
        return Itinerary((origin,), targets, False)
    if isinstance(path, str):
        if path != "chain":
            raise InputError(f"unknown path {path!r}", hint='a sequence of vertices, "chain", or None')
        return Itinerary((origin,), targets, True)
    return Itinerary((origin, *(as_point(p, "a vertex of the path") for p in path)), targets, False)


def initial_value(value: object, name: str) -> Point | Ball:
    """The exact number, or the ball, that the argument `name` of `evaluate` stands for."""
    if isinstance(value, Ball) and not value.is_exact():
        return value
    return as_point(value, name)


def initial_ball(value: Point | Ball) -> acb:
    """The flint ball of an initial value at the working precision in force."""
    return ball_to_flint(value) if isinstance(value, Ball) else to_acb(value)


def carry(legs: Legs, plan: Itinerary, start: Start) -> list[State]:
    """The states at the targets, from the transition matrices that `legs` gives for straight pieces."""
    state = (initial_ball(start[0]), initial_ball(start[1]))
    trunk = Product()
    for a, b in zip(plan.trunk, plan.trunk[1:], strict=False):
        for matrix in legs(a, b):
            trunk.push(matrix)
    result: dict[int, State] = {}
    for order in _branches(plan):
        stack, here = trunk.copy(), plan.trunk[-1]
        for index in order:
            target = plan.targets[index]
            for matrix in legs(here, target):
                stack.push(matrix)
            here = target
            result[index] = stack.apply(state)
    return [result[index] for index in range(len(plan.targets))]


def _branches(plan: Itinerary) -> list[list[int]]:
    """The targets in the order of visit: chains that start at the end of the trunk.

    Straight lines to points on one ray from there share their way: on the real axis two chains (right and left).
    """
    origin, indices = plan.trunk[-1], range(len(plan.targets))
    if plan.chain:
        return [list(indices)]
    ahead = {i: t.re - origin.re for i, t in enumerate(plan.targets) if origin.is_real() and t.is_real()}
    right = sorted((i for i in ahead if ahead[i] >= 0), key=ahead.__getitem__)
    left = sorted((i for i in ahead if ahead[i] < 0), key=ahead.__getitem__, reverse=True)
    return [chain for chain in (right, left, *([i] for i in indices if i not in ahead)) if chain]


def transition_matrix(
    equation: object, vertices: Sequence[object], *, digits: int = 15, limits: Limits | None = None
) -> tuple[tuple[Ball, Ball], tuple[Ball, Ball]]:
    """Balls around the matrix that carries (y, y') along the polygon through `vertices` (determinant 1), for the
    normal form y'' = S y.

    The radii are at most 10^-digits relative to the largest entry, unless a limit is reached first (then LimitExceeded).

    >>> ((a, b), (c, d)) = transition_matrix(([1], [1]), [0, 1])   # cosh, sinh
    >>> float(a), float(b)
    (1.5430806348152437, 1.1752011936438014)
    """
    limits = limits or DEFAULT_LIMITS
    check_digits(digits, limits)
    system = as_problem(equation).system
    polygon = [as_point(v, "a vertex") for v in vertices]
    if not polygon:
        raise InputError("a path needs at least one vertex")
    budget = Budget(limits)
    prec = start_bits(digits)
    while True:
        with working_precision(prec + 40):
            total = Product()
            for a, b in itertools.pairwise(polygon):
                for matrix in piece_matrices(system, a, b, prec, budget):
                    total.push(matrix)
            entries = total.matrix()
            goal = max((entry.abs_upper() for entry in entries), key=float) * arb(10) ** -digits
            sharp = all(entry.real.rad() + entry.imag.rad() <= goal for entry in entries)
            balls = [ball for ball in map(ball_from_flint, entries) if ball is not None]
        if len(balls) < 4:
            prec += prec // 2
        elif sharp:
            return (balls[0], balls[1]), (balls[2], balls[3])
        prec += max(16, prec // 4)
        budget.check()

"""Numerical values of solutions as enclosures: one point, many points, complex paths, any number of digits.

The guarantee: the exact value of the solution (in its homotopy class of paths) lies in the returned ball.  The radius
is at most
10^-digits relative to the value, unless the problem forbids it (a value that is zero or can't be told from zero,
initial values
that are balls themselves, a limit that was reached); then the ball is wide and an `AccuracyWarning` says why.

Two independent routes: "taylor" (the equation itself, `kovacic.numeric.transport`; every S) and "closed form"
(the certificate of a decision, `kovacic.numeric.closed_form`; Liouvillian solutions only).

Precision is raised until the goal is met: first digits + guard bits, then by as many bits as were missing.  The global
precision of flint is set inside `flint.ctx.workprec` only, so an interruption leaves it as it was.
"""

from __future__ import annotations

import itertools
import warnings
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, Protocol

from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits
from kovacic.numeric.ball import Ball, ball_from_flint, ball_to_flint
from kovacic.numeric.gauge import with_gauge
from kovacic.numeric.points import Point, as_point, to_acb
from kovacic.numeric.problem import NumericProblem, as_problem
from kovacic.numeric.taylor import Matrix
from kovacic.numeric.transport import apply, identity, multiply, piece_matrices

if TYPE_CHECKING:
    from flint import acb

Method = Literal["taylor", "closed form"]
METHODS: tuple[Method, ...] = ("taylor", "closed form")


class AccuracyWarning(UserWarning):
    """An enclosure is wider than asked for; the message says why."""


@dataclass(frozen=True)
class Evaluation:
    """The solution at one point: enclosures of y and y', and how they were obtained.

    `reached` says whether the relative radius of y is at most 10^-digits; if not, `note` says why.  `bits` is the
    working precision of
    the run that gave the enclosures, `runs` the number of runs (the precision was raised runs - 1 times).
    """

    x: Point
    y: Ball
    dy: Ball
    digits: int
    reached: bool
    note: str | None
    method: Method
    bits: int
    runs: int


class Route(Protocol):
    """One way of carrying states along a path: the states (y, y') at each target in turn, at about `prec` bits."""

    def __call__(self, prec: int, budget: Budget) -> list[tuple[acb, acb]]: ...


@dataclass(frozen=True)
class Itinerary:
    """Where to go: the polygon `trunk` from x0, then from its end a straight line to each target, or (`chain`) from
    target to target."""

    trunk: tuple[Point, ...]
    targets: tuple[Point, ...]
    chain: bool


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

    `equation` is S (text, SymPy expression, rational function, or a pair of coefficient lists from low to high, of
    y'' = S y), an
    equation a z'' + b z' + c z = 0, or a solution of this package.  `x` is a number or a sequence of numbers (a tuple
    of balls is returned, in
    the same order).  Numbers are exact: int, Fraction, float and complex (their binary values), Decimal and decimal
    text,
    mpmath and SymPy numbers; y0 and dy0 may be balls as well.

    The path is the straight line from x0 to each x; `path=[v1, v2, ...]` goes through these vertices first;
    `path="chain"` visits the
    points of x one after the other.  A path through a singular point is refused.

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
    _check_digits(digits, limits)
    if method is not None and method not in METHODS:
        raise InputError(f"unknown method {method!r}", hint=f"one of {', '.join(map(repr, METHODS))}, or None")
    problem = as_problem(equation)
    itinerary = make_itinerary(points, x0, path)
    budget = Budget(limits)
    start = (_initial(y0, "y0"), _initial(dy0, "dy0"))
    route, used = _route(problem, itinerary, start, method)
    exact = not any(isinstance(value, Ball) for value in start)
    return _raise_precision(route, used, itinerary, digits, budget, exact)


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
    _check_digits(digits, limits)
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


def start_bits(digits: int) -> int:
    """The working precision of the first run."""
    return int(digits * 3.3219280948873626) + 24


def _check_digits(digits: object, limits: Limits) -> None:
    if isinstance(digits, bool) or not isinstance(digits, int):
        raise InputError(f"digits must be an integer, not {digits!r}")
    if digits < 1:
        raise InputError(f"digits = {digits}: at least 1 is needed")
    if digits > limits.digits:
        raise InputError(f"digits = {digits} is beyond the limit of {limits.digits}", hint="raise limits.digits")


def make_itinerary(points: Sequence[object], x0: object, path: Sequence[object] | str | None) -> Itinerary:
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


def _initial(value: object, name: str) -> Point | Ball:
    if isinstance(value, Ball) and not value.is_exact():
        return value
    return as_point(value, name)


def initial_ball(value: Point | Ball) -> acb:
    """The flint ball of an initial value at the working precision in force."""
    return ball_to_flint(value) if isinstance(value, Ball) else to_acb(value)


class Prefix:
    """Products M_k ... M_1 while k grows: a binary counter of partial products, so that every prefix is O(log k)
    factors."""

    def __init__(self) -> None:
        self._parts: list[tuple[int, Matrix]] = []  # sizes are falling powers of two, the earliest factors first

    def push(self, matrix: Matrix) -> None:
        """Put one more factor on the left."""
        size = 1
        while self._parts and self._parts[-1][0] == size:
            _, earlier = self._parts.pop()
            matrix, size = multiply(matrix, earlier), 2 * size
        self._parts.append((size, matrix))

    def copy(self) -> Prefix:
        """An independent copy."""
        other = Prefix()
        other._parts = list(self._parts)
        return other

    def apply(self, state: tuple[acb, acb]) -> tuple[acb, acb]:
        """M_k ... M_1 v."""
        for _, matrix in self._parts:
            state = apply(matrix, state)
        return state

    def product(self) -> Matrix:
        """M_k ... M_1."""
        total: Matrix | None = None
        for _, matrix in self._parts:
            total = matrix if total is None else multiply(matrix, total)
        return total if total is not None else identity()


@dataclass(frozen=True)
class TaylorRoute:
    """Route (b): the equation itself, for every S."""

    problem: NumericProblem
    itinerary: Itinerary
    start: tuple[Point | Ball, Point | Ball]

    def __call__(self, prec: int, budget: Budget) -> list[tuple[acb, acb]]:
        system = self.problem.system
        legs = with_gauge(self.problem.gauge, lambda a, b: piece_matrices(system, a, b, prec, budget))
        return carry(legs, self.itinerary, self.start)


def carry(
    legs: Callable[[Point, Point], list[Matrix]], plan: Itinerary, start: tuple[Point | Ball, Point | Ball]
) -> list[tuple[acb, acb]]:
    """The states at the targets, from the transition matrices that `legs` gives for straight pieces."""
    state = (initial_ball(start[0]), initial_ball(start[1]))
    trunk = Prefix()
    for a, b in zip(plan.trunk, plan.trunk[1:], strict=False):
        for matrix in legs(a, b):
            trunk.push(matrix)
    result: dict[int, tuple[acb, acb]] = {}
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
    indices = list(range(len(plan.targets)))
    if plan.chain:
        return [indices]
    origin = plan.trunk[-1]
    if not origin.is_real():
        return [[i] for i in indices]
    real = [i for i in indices if plan.targets[i].is_real()]
    right = sorted((i for i in real if plan.targets[i].re >= origin.re), key=lambda i: plan.targets[i].re)
    left = sorted((i for i in real if plan.targets[i].re < origin.re), key=lambda i: -plan.targets[i].re)
    chains = [right, left, *([i] for i in indices if not plan.targets[i].is_real())]
    return [chain for chain in chains if chain]


def _route(
    problem: NumericProblem,
    itinerary: Itinerary,
    start: tuple[Point | Ball, Point | Ball],
    method: Method | None,
) -> tuple[Route, Method]:
    """The route asked for; by itself the cheaper one: the closed form only where it needs neither detours nor
    quadrature.

    That's two conjugate exponentials without a polynomial factor, whose cost doesn't depend on the distance.
    Measured at 15 to 50
    digits, everything else costs more than the Taylor steps.
    """
    if method is None:
        form = getattr(problem.source, "semi_invariant", None)
        cheap = form is not None and form.degree == 1 and form.P.degree == 0 and hasattr(form.P.field, "modulus")
        method = "closed form" if cheap else "taylor"
    if method == "closed form":
        from kovacic.numeric.closed_form import closed_form_route

        return closed_form_route(problem, itinerary, start), "closed form"
    return TaylorRoute(problem, itinerary, start), "taylor"


def _raise_precision(
    route: Route, method: Method, itinerary: Itinerary, digits: int, budget: Budget, exact: bool
) -> tuple[Evaluation, ...]:
    """Run the route at rising precision until every relative radius is small enough."""
    from flint import ctx

    prec = start_bits(digits)
    highest = 6 * prec + 4000  # a value below 2^-highest isn't told from zero
    runs = 0
    previous: tuple[Evaluation, ...] | None = None
    while True:
        runs += 1
        try:
            with ctx.workprec(prec + 40):
                states = route(prec, budget)
                missing = max((_missing_bits(y, digits, prec) for y, _ in states), default=0)
                found = _as_evaluations(states, itinerary, digits, method, prec, runs)
        except LimitExceeded as limit:
            if previous is None:
                raise
            return tuple(_with_note(result, str(limit)) for result in previous)
        if missing == 0 and found is not None:
            return found
        stalled = not exact and previous is not None and found is not None and _stalled(previous, found)
        if prec >= highest or stalled:
            if found is None:
                raise LimitExceeded("no finite enclosure was found up to the highest precision", limit="digits")
            return tuple(_with_note(result, _reason(result)) for result in found)
        previous = found or previous
        prec = min(prec + missing + 16, highest)


def _missing_bits(y: acb, digits: int, prec: int) -> int:
    """How many bits of precision the enclosure lacks (0: the goal is met)."""
    if not y.is_finite():
        return prec
    if y.is_exact():
        return 0
    if y.contains(0):
        return prec
    goal = int(digits * 3.3219280948873626) + 2
    return max(0, goal - int(y.rel_accuracy_bits()))


def _stalled(previous: tuple[Evaluation, ...], found: tuple[Evaluation, ...]) -> bool:
    """True if a higher precision hasn't made the balls smaller: their size comes from the initial values."""
    return all(f.reached or 4 * f.y.radius > 3 * p.y.radius for p, f in zip(previous, found, strict=True))


def _reason(result: Evaluation) -> str:
    if result.y.contains_zero():
        size = f"|y| is at most about {result.y.radius:.1e}"
        return f"the value can't be told from zero ({size}): no relative accuracy was reached"
    known = max(0.0, result.y.digits)
    return f"only {known:.1f} of {result.digits} digits: the initial values or the limits allow no more"


def _with_note(result: Evaluation, note: str) -> Evaluation:
    from dataclasses import replace

    return result if result.reached else replace(result, note=note)


def _as_evaluations(
    states: list[tuple[acb, acb]], itinerary: Itinerary, digits: int, method: Method, prec: int, runs: int
) -> tuple[Evaluation, ...] | None:
    results = []
    for target, (y, dy) in zip(itinerary.targets, states, strict=True):
        value, slope = ball_from_flint(y), ball_from_flint(dy)
        if value is None or slope is None:
            return None
        reached = _missing_bits(y, digits, prec) == 0
        results.append(Evaluation(target, value, slope, digits, reached, None, method, prec, runs))
    return tuple(results)

"""Numerical values of solutions as enclosures: one point, many points, complex paths, any number of digits.

The guarantee: the exact value of the solution (in its homotopy class of paths) lies in the returned ball.  The radius is at
most 10^-digits relative to the value, unless the problem forbids it (a value that is zero or can't be told from zero, numbers
that are balls themselves, a limit that was reached); then the ball is wide and an `AccuracyWarning` says why.

Two independent routes: "taylor" (the equation itself, `kovacic.enclosure.transport`; every S) and "closed form"
(the certificate of a decision, `kovacic.enclosure.closed_form`; solutions of case 1).  A start at a regular singular point
begins with its Frobenius series (`kovacic.enclosure.frobenius`), whichever the route.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from typing import Any, Literal, Required, TypedDict, Unpack, overload

from flint import acb, acb_poly, arb

from kovacic.enclosure.ball import Ball, ball_from_flint
from kovacic.enclosure.closed_form import value
from kovacic.enclosure.constants import Constant, Number, as_number, to_ball
from kovacic.enclosure.frobenius import Basis, junction
from kovacic.enclosure.journey import Itinerary, Traveller, carry
from kovacic.enclosure.matrices import Matrix, State, adjugate, multiply
from kovacic.enclosure.points import Point, as_point, to_acb
from kovacic.enclosure.precision import METHODS, Evaluation, Method, Route, check_digits, raise_precision, start_bits
from kovacic.enclosure.problem import NumericProblem, as_problem, equation_of
from kovacic.enclosure.recessive import logarithmic_derivative
from kovacic.enclosure.singular import Singular
from kovacic.enclosure.working import working_precision
from kovacic.errors import InputError
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits

Path = Sequence[object] | Literal["chain", "above", "below"] | None

Start = tuple[Number, Number]
"""y(x0) and y'(x0), or the coordinates in the Frobenius basis at x0."""


_APART = arb(2) ** -200
"""What is nearer to a singular point can't be told from it."""
_FEW = 8
"""Targets up to which a closed form costs less than the Taylor steps, which serve many at once."""


class AccuracyWarning(UserWarning):
    """An enclosure is wider than asked for; the message says why."""


class Options(TypedDict, total=False):
    """The keywords of `evaluate` but `derivative`, for its types."""

    x0: Required[object]
    y0: object
    dy0: object
    frobenius: Sequence[object] | None
    which: Literal["regular", "decaying"] | None
    params: Mapping[str, object] | None
    digits: int
    method: Method | None
    path: Path
    limits: Limits | None


_One = str | complex | Fraction | Decimal | Ball
_Many = list[Any] | tuple[Any, ...] | range


@overload
def evaluate(equation: object, x: _One, *, derivative: Literal[False] = ..., **options: Unpack[Options]) -> Ball: ...
@overload
def evaluate(
    equation: object, x: _One, *, derivative: Literal[True], **options: Unpack[Options]
) -> tuple[Ball, Ball]: ...
@overload
def evaluate(
    equation: object, x: _Many, *, derivative: Literal[False] = ..., **options: Unpack[Options]
) -> tuple[Ball, ...]: ...
@overload
def evaluate(
    equation: object, x: _Many, *, derivative: Literal[True], **options: Unpack[Options]
) -> tuple[tuple[Ball, Ball], ...]: ...
@overload
def evaluate(equation: object, x: object, *, derivative: bool = ..., **options: Unpack[Options]) -> Any: ...
def evaluate(
    equation: object,
    x: object,
    *,
    x0: object,
    y0: object = None,
    dy0: object = None,
    frobenius: Sequence[object] | None = None,
    which: Literal["regular", "decaying"] | None = None,
    params: Mapping[str, object] | None = None,
    digits: int = 15,
    derivative: bool = False,
    method: Method | None = None,
    path: Path = None,
    limits: Limits | None = None,
) -> Any:
    """A ball that contains y(x) for one solution y of the equation, given by its start at x0.

    `equation` is S of y'' = S y (text, SymPy expression, rational function, or a pair of coefficient lists from low to high),
    an equation a y'' + b y' + c y = f, or a solution of this package; f is rational, or has exp, log, sin, cos, ... in it.

    The start is one of
    - `y0`, `dy0`: y(x0) and y'(x0);
    - `frobenius=(c1, c2)`: y = c1 y1 + c2 y2 with the Frobenius basis at x0, a regular singular point or an ordinary one (or
      infinity, "oo").  y1 is the dominant one: the leading terms are t^lambda log(t)^k, t = x - x0 (1/x at infinity), by
      the real part of lambda upwards, and the logarithm first.  Either has the coefficient 1 at its own leading term and 0
      at the other's;
    - `which="regular"`: frobenius=(0, 1), the solution that is smaller than all others at x0;
    - `which="decaying"` and `y0`: y(x0), and y is the solution that becomes smaller than all others as x goes to +infinity.
    S or the equation may have real algebraic constants, and parameters, which get real values: `params={"n": "sqrt(2)"}`.
    Then no bound is lost, but the start is at a regular point.

    Numbers are exact: int, Fraction, float and complex (their binary values), Decimal and decimal text, mpmath and SymPy
    numbers; or constants such as "sqrt(2)" and "1 + 2*I"; or balls (ours, python-flint's, mpmath's), and then the result
    holds for every number in them.  A ball, or a constant that isn't rational, stands as `x0` of a Frobenius basis for the only
    singular point that it contains.

    `x` is a number, or a sequence of numbers (a tuple comes back, in the same order), or a NumPy array (an array of balls of
    the same shape; NaN stays NaN).  With `derivative` there are pairs (y, y') of balls.

    The path is the straight line from x0 to each x (from infinity: along the line through 0).  A path through a singular
    point is refused, unless `path` says on which side of the real axis to go around: "above" or "below".  `path=[v1, v2,
    ...]` goes through these vertices first; `path="chain"` visits the points of x one after the other.  At x0 the logarithm
    is the principal one.

    Raises InputError (a singular point at an end or on the path, with its distance; an irregular one as the start; digits out
    of range; a number that isn't finite; an unknown method) and LimitExceeded (nothing could be said within the limits).

    >>> airy = ([0, 1], [1])                                     # y'' = x y
    >>> value = evaluate(airy, 2, x0=0, y0=1, dy0=0, digits=20)
    >>> print(value.contains(2.73), value.digits >= 20, f"{float(value):.12f}")
    False True 2.730883017890
    >>> bessel = "x^2*y'' + x*y' + x^2*y = 0"
    >>> print(f"{evaluate(bessel, 1, x0=0, which='regular'):.15f}")      # J0
    0.765197686557967
    """
    shape = getattr(x, "shape", None)
    many = shape != () and isinstance(x, Iterable) and not isinstance(x, str)
    points: list[Any] = list(x) if many and not shape else [x]  # type: ignore[call-overload]
    if shape:
        import numpy as np

        points = list(np.asarray(x, dtype=object).flat)
    holes = {i for i, p in enumerate(points) if shape is not None and p != p}
    results = evaluate_states(
        equation,
        [p for i, p in enumerate(points) if i not in holes],
        x0=x0,
        y0=y0,
        dy0=dy0,
        frobenius=frobenius,
        which=which,
        params=params,
        digits=digits,
        method=method,
        path=path,
        limits=limits,
    )
    for result in results:
        if result.note is not None:
            warnings.warn(f"at x = {result.x}: {result.note}", AccuracyWarning, stacklevel=2)
    found: list[Any] = [(result.y, result.dy) if derivative else result.y for result in results]
    if shape is None:
        return tuple(found) if many else found[0]
    values = iter(found)
    if shape == ():
        return next(values, math.nan)
    array = np.empty(len(points), dtype=object)
    for i in range(len(points)):
        array[i] = math.nan if i in holes else next(values)
    return array.reshape(shape)


def evaluate_states(
    equation: object,
    points: Sequence[object],
    *,
    x0: object,
    y0: object = None,
    dy0: object = None,
    frobenius: Sequence[object] | None = None,
    which: str | None = None,
    params: Mapping[str, object] | None = None,
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
    problem = as_problem(equation, params, forced=True, constants=True)
    targets = tuple(as_number(p, "x") for p in points)
    side: str | None = None
    chain, vertices = path == "chain", tuple[Number, ...]()
    if isinstance(path, str):
        if path not in ("chain", "above", "below"):
            raise InputError(
                f"unknown path {path!r}", hint='a sequence of vertices, "chain", "above", "below", or None'
            )
        side = None if chain else path
    elif path is not None:
        vertices = tuple(as_number(p, "a vertex of the path") for p in path)
    origin, start = _start(problem, x0, y0, dy0, frobenius, which)
    _check_regular(problem, (origin, *targets, *vertices))
    trip = Trip(problem, origin, vertices, targets, start, which == "decaying", chain, side)
    with budget.watched():
        route, used = _route(trip, method)
        return raise_precision(route, used, targets, digits, budget, trip.exact)


def _check_regular(problem: NumericProblem, numbers: Sequence[Number | Singular]) -> None:
    """Raise InputError for a number such as sqrt(2) that is a singular point; rational points are compared exactly."""
    constants = problem.embedded
    places = [number for number in numbers if not isinstance(number, Singular)]
    unclear = [number for number in places if constants is not None or not isinstance(number, Point)]
    if not unclear:
        return
    with working_precision(256):
        singular = [to_acb(z) for z in problem.singular_points(256)] if constants is None else []
        for number in unclear:
            ball = to_ball(number)
            near = any(abs(ball - z).lower() < _APART for z in singular)
            if near or (constants is not None and not constants.bound(ball).is_finite()):
                raise InputError(f"{number} is a singular point of the equation, or can't be told from one")


@dataclass(frozen=True)
class Trip:
    """What is asked for, before numbers such as sqrt(2) are taken at a working precision."""

    problem: NumericProblem
    origin: Number | Singular
    vertices: tuple[Number, ...]
    targets: tuple[Number, ...]
    start: Start
    decaying: bool
    chain: bool
    side: str | None

    def state(self, place: Point | Singular, prec: int, budget: Budget) -> State:
        """The start at the working precision in force."""
        y, dy = map(to_ball, self.start)
        if self.decaying:
            assert isinstance(place, Point)
            slope, x = logarithmic_derivative(self.problem.system, place, prec, budget), to_acb(place)
            gauge = self.problem.gauge
            dy = y * (slope if gauge is None else slope + value(gauge, None, x))
        return _spread(self.problem, self.origin, place, (y, dy))

    @property
    def exact(self) -> bool:
        """True if a higher precision makes every ball smaller."""
        numbers = (self.origin, *self.targets, *self.start)
        return self.problem.is_exact and not any(isinstance(number, Constant) and number.fixed for number in numbers)

    def itinerary(self) -> Itinerary:
        """With exact points: the midpoints of balls."""
        targets, origin = tuple(map(_middle, self.targets)), self.origin
        first = origin if isinstance(origin, Singular) else _middle(origin)
        return Itinerary((first, *map(_middle, self.vertices)), targets, self.chain, self.side)


def _middle(number: Number) -> Point:
    return number if isinstance(number, Point) else number.point()


def _start(
    problem: NumericProblem,
    x0: object,
    y0: object,
    dy0: object,
    frobenius: Sequence[object] | None,
    which: str | None,
) -> tuple[Number | Singular, Start]:
    """The place and the data of the start, from the arguments of `evaluate`."""
    if which not in (None, "regular", "decaying"):
        raise InputError(f"which = {which!r} isn't known", hint="which='regular' or which='decaying'")
    if problem.right is not None and (which is not None or frobenius is not None):
        raise InputError("an equation with a right-hand side needs y0 and dy0 at a regular point")
    if problem.embedded is not None and (which is not None or frobenius is not None):
        raise InputError("an equation whose constants aren't rational needs y0 and dy0 at a regular point")
    if which == "decaying":
        if dy0 is not None or frobenius is not None:
            raise InputError("the decaying solution is given by y0 alone")
        return as_number(x0, "x0"), (as_number(1 if y0 is None else y0, "y0"), Point(Fraction(0)))
    if sum((y0 is not None or dy0 is not None, frobenius is not None, which is not None)) != 1:
        raise InputError("one start is expected", hint="y0= and dy0=, or frobenius=(c1, c2), or which='regular'")
    if frobenius is None and which is None:
        if y0 is None or dy0 is None:
            raise InputError("both y0 and dy0 are needed", hint="or frobenius=(c1, c2), or which='regular'")
        return as_number(x0, "x0"), (as_number(y0, "y0"), as_number(dy0, "dy0"))
    place = place_of(problem, x0, "x0")
    if frobenius is None:
        if not place.has_regular:
            raise InputError(f"no solution is smaller than all others at {place}", hint="give frobenius=(c1, c2)")
        frobenius = (0, 1)
    if isinstance(frobenius, str) or len(frobenius) != 2:
        raise InputError("frobenius needs two coordinates", hint="frobenius=(c1, c2), the dominant solution first")
    first, second = (as_number(value, "a coordinate") for value in frobenius)
    return place, (first, second)


def place_of(problem: NumericProblem, x0: object, name: str) -> Singular:
    """The regular singular point, ordinary point or infinity ("oo") that the argument stands for."""
    if str(x0) in ("oo", "inf", "+inf"):
        return Singular.at(problem, None)
    number = as_number(x0, name)
    if isinstance(number, Point):
        return Singular.at(problem, number)
    with working_precision(256):
        return Singular.at(problem, number.value())


def _route(trip: Trip, method: Method | None) -> tuple[Route, Method]:
    """The route asked for; by itself the cheaper one, by a rule that was measured (`benchmarks/enclosure_work_precision.py`).

    A closed form without quadrature costs about a millisecond whatever the distance, the digits and the solution's zeros, if
    its polynomial has a moderate degree: less than the Taylor steps to a few points.
    """
    closed, problem = None, trip.problem
    decided = problem.decision is not None and problem.decision.case == 1 and problem.right is None
    if method == "closed form" and problem.right is not None:
        raise InputError("the method 'closed form' is for equations without a right-hand side", hint="method='taylor'")
    if method == "closed form" or (method is None and decided and len(trip.targets) <= _FEW):
        from kovacic.enclosure.closed_form import closed_form_of

        closed = closed_form_of(problem)
        if closed is not None and not (closed.is_elementary if method else closed.is_cheap):
            closed = None
        if method and closed is None:
            raise InputError(
                "the method 'closed form' is for solutions of case 1 without a quadrature",
                hint="method='taylor' treats every equation, and the others as fast",
            )

    def route(prec: int, budget: Budget) -> list[State]:
        plan = trip.itinerary()
        states = carry(problem.at(prec), plan, trip.state(plan.start, prec, budget), closed, prec, budget)
        places = zip(trip.targets, plan.targets, states, strict=True)
        return [_spread(problem, number, middle, state) for number, middle, state in places]

    return route, "taylor" if closed is None else "closed form"


def _spread(problem: NumericProblem, number: Number | Singular, middle: Point | Singular, state: State) -> State:
    """The state at a number in a ball from that at its midpoint: with r the radius and K >= max(1, |b/a| + |c/a|) on the
    ball, (y, y') changes by at most (exp(K r) - 1) max(|y|, |y'|)."""
    if not isinstance(number, Constant) or not isinstance(middle, Point):
        return state
    ball = number.value()
    if problem.embedded is not None:
        size = max(arb(1), problem.embedded.bound(ball))
    else:
        a, b, c = (acb_poly(poly)(ball) for poly in equation_of(problem))
        size = max(arb(1), (abs(b / a) + abs(c / a)).upper())
    change = (size * abs(ball - to_acb(middle)).upper()).expm1() * max(abs(v).upper() for v in state)
    real = all(v.imag.is_zero() for v in (ball, *state))
    error = acb(arb(0, change.upper()), arb(0, 0 if real else change.upper()))
    return state[0] + error, state[1] + error


def connection_matrix(
    equation: object,
    path: Sequence[object],
    *,
    params: Mapping[str, object] | None = None,
    digits: int = 15,
    limits: Limits | None = None,
) -> tuple[tuple[Ball, Ball], tuple[Ball, Ball]]:
    """Balls around the matrix that turns coordinates at the first point of `path` into those at the last one, of the same
    solution continued along this polygon.

    At an ordinary point the coordinates are (y, y'), at a regular singular one (or "oo") those in its Frobenius basis, as
    for `evaluate`.  Constants and values of parameters are as there, too; where these are balls, the radii are what they
    allow.  A path to or from infinity goes along the line through 0 and its neighbour.  The radii are at most
    10^-digits relative to the largest entry, unless a limit is reached first (then LimitExceeded).

    >>> ((a, b), (c, d)) = connection_matrix(([1], [1]), [0, 1])   # cosh, sinh
    >>> float(a), float(b)
    (1.5430806348152437, 1.1752011936438014)
    >>> legendre = "(1-x^2)*y'' - 2*x*y' + 2*y = 0"                # P1 = x is regular at both ends
    >>> (_, log_part), (_, regular_part) = connection_matrix(legendre, [-1, 1])
    >>> log_part.contains(0), regular_part.contains(-1)
    (True, True)

    Reference: the path and the bases are as in ore_algebra's numerical_transition_matrix.
    """
    limits = limits or DEFAULT_LIMITS
    check_digits(digits, limits)
    problem = as_problem(equation, params, constants=True)
    if len(path) < 2:
        raise InputError("a path needs at least two vertices")
    ends = [_end(problem, value) for value in (path[0], path[-1])]
    middle = [as_point(v, "a vertex") for v in path[1:-1]]
    if len(path) == 2 and isinstance(ends[0], Singular) and isinstance(ends[1], Singular):
        middle = [_between(ends[0], ends[1])]
    budget = Budget(limits)
    prec = start_bits(digits)
    while True:
        with working_precision(prec + 40), budget.watched():
            entries = _connection(problem.at(prec), ends[0], middle, ends[1], prec, budget)
            goal = max((entry.abs_upper() for entry in entries), key=float) * arb(10) ** -digits
            sharp = all(entry.real.rad() + entry.imag.rad() <= goal for entry in entries)
            balls = [ball for ball in map(ball_from_flint, entries) if ball is not None]
        if len(balls) < 4:
            prec += prec // 2
        elif sharp or not problem.is_exact:
            return (balls[0], balls[1]), (balls[2], balls[3])
        prec += max(16, prec // 4)
        budget.check()


def _end(problem: NumericProblem, value: object) -> Point | Singular:
    """An end of a path: a point where the equation is regular stays one."""
    if problem.embedded is not None:
        return as_point(value, "an end of the path of an equation whose constants aren't rational")
    place = place_of(problem, value, "a vertex")
    return place.near if place.is_ordinary else place


def _between(a: Singular, b: Singular) -> Point:
    """A point of the straight line between two finite singular points."""
    if a.inverted or b.inverted:
        raise InputError("a path between a singular point and infinity needs a vertex", hint="e.g. [0, 1j, 'oo']")
    return (a.near + b.near).scaled(Fraction(1, 2)).rounded(-64)


def _connection(
    problem: NumericProblem, a: Point | Singular, middle: list[Point], b: Point | Singular, prec: int, budget: Budget
) -> Matrix:
    """The matrix at about so many bits."""
    traveller, unit = Traveller.at(problem, a, None, prec, budget), ((acb(1), acb(0)), (acb(0), acb(1)))
    both = acb(1), acb(1)
    for vertex in middle:
        traveller.go([vertex], both)
    if isinstance(b, Singular):
        here = traveller.here
        assert isinstance(here, Point)
        end, bound = junction(b, here, prec)
        basis: Matrix | None = Basis(b, end, here, bound, prec, budget).at(end)
    else:
        end, basis = b, None
    traveller.go([end], both)
    (p, r), (q, s) = (traveller.state(start) for start in unit)
    if basis is None:
        return p, q, r, s
    m, determinant = multiply(adjugate(basis), (p, q, r, s)), basis[0] * basis[3] - basis[1] * basis[2]
    return m[0] / determinant, m[1] / determinant, m[2] / determinant, m[3] / determinant

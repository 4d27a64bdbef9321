"""Numerical values of solutions as enclosures: one point, many points, complex paths, any number of digits.

The guarantee: the exact value of the solution (in its homotopy class of paths) lies in the returned ball.  The radius is at
most 10^-digits relative to the value, unless the problem forbids it (a value that is zero or can't be told from zero, numbers
that are balls themselves, a limit that was reached); then the ball is wide and an `AccuracyWarning` says why.

Two independent routes: "taylor" (the equation itself, `kovacic.enclosure.transport`; every S) and "closed form" (the
certificate of a decision, `kovacic.enclosure.closed_form`, solutions of case 1; or FLINT's special functions,
`kovacic.enclosure.classical`, where S is a pull-back of their equations).  A start at a regular singular point begins with its
Frobenius series (`kovacic.enclosure.frobenius`), unless FLINT's functions have it.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from decimal import Decimal
from fractions import Fraction
from typing import Any, Literal, Required, TypedDict, Unpack, overload

from flint import arb

from kovacic.enclosure.ball import Ball
from kovacic.enclosure.classical import Classical, NotServed, classical_of
from kovacic.enclosure.closed_form import ClosedForm, closed_form_of
from kovacic.enclosure.constants import Number, as_number, to_ball
from kovacic.enclosure.journey import Journey
from kovacic.enclosure.points import Point, to_acb, working_precision
from kovacic.enclosure.precision import METHODS, Evaluation, Method, check_digits, raise_precision
from kovacic.enclosure.problem import NumericProblem, as_problem
from kovacic.enclosure.singular import Singular
from kovacic.enclosure.start import Start, read_start
from kovacic.errors import InputError, NotRational
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits

Path = Sequence[object] | Literal["chain", "above", "below"] | None
_APART = arb(2) ** -200  # what is nearer to a singular point can't be told from it
_NO_CLOSED_FORM = (
    "the method 'closed form' is for solutions of case 1 without a quadrature, and pull-backs of Airy's, Bessel's, Whittaker's "
    "and Gauss' equations over Q"
)
_TAYLOR = "method='taylor' treats every equation"
_FEW = 8  # targets up to which a closed form costs less than the Taylor steps, which serve many at once


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
def evaluate(equation: object, x: object, *, derivative: bool = False, **options: Unpack[Options]) -> Any:
    """A ball that contains y(x) for one solution y of the equation, given by its start at x0.

    `equation` is S of y'' = S y (text, SymPy expression, rational function, or a pair of coefficient lists from low to high),
    an equation a y'' + b y' + c y = f, or a solution of this package; f is rational, or has exp, log, sin, cos, ... in it.  a,
    b and c may be rational in exp(k x), sin(k x), ..., too (then with y0 and dy0, where that function is real and monotone).

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
    if getattr(equation, "change", None) is not None:
        return _in_given_variable(equation, x, derivative, options)
    shape = getattr(x, "shape", None)
    many = shape != () and isinstance(x, Iterable) and not isinstance(x, str)
    points: list[Any] = list(x) if many and not shape else [x]  # type: ignore[call-overload]
    if shape:
        import numpy as np

        points = list(np.asarray(x, dtype=object).flat)
    holes = {i for i, p in enumerate(points) if shape is not None and p != p}
    try:
        results = evaluate_states(equation, [p for i, p in enumerate(points) if i not in holes], **options)
    except NotRational as reason:  # rational in exp(k x), perhaps
        from kovacic.reading.read import read_input

        parsed = read_input(equation, limits=options.get("limits") or DEFAULT_LIMITS, exponentials=True)
        if parsed.equation is None or parsed.equation.change is None:
            raise reason from None
        return _in_given_variable(parsed, x, derivative, options)
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


def _in_given_variable(equation: Any, x: object, derivative: bool, options: Mapping[str, Any]) -> Any:
    """As `evaluate`, where the coefficients are rational in a function of x."""
    from kovacic.enclosure.change import evaluate_in_x

    return evaluate_in_x(equation, equation.equation.change, x, derivative=derivative, **options)


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
    if isinstance(path, str) and path not in ("chain", "above", "below"):
        raise InputError(f"unknown path {path!r}", hint='a sequence of vertices, "chain", "above", "below", or None')
    budget = Budget(limits)
    problem = as_problem(equation, params, forced=True, constants=True)
    targets = tuple(as_number(p, "x") for p in points)
    polygon = () if path is None or isinstance(path, str) else path
    vertices = tuple(as_number(p, "a vertex of the path") for p in polygon)
    start = read_start(problem, x0, y0, dy0, frobenius, which)
    _check_regular(problem, [n for n in (start.place, *targets, *vertices) if not isinstance(n, Singular)])
    side = path if path in ("above", "below") else None
    journey = Journey(problem, start, vertices, targets, path == "chain", side)
    with budget.watched():
        closed = _closed_form(problem, method, start, targets, digits)
        if closed is not None:
            try:
                return raise_precision(replace(journey, closed=closed), "closed form", digits, budget)
            except NotServed:
                if method is not None:
                    raise InputError("the closed form doesn't prove its values on this path", hint=_TAYLOR) from None
        return raise_precision(journey, "taylor", digits, budget)


def _check_regular(problem: NumericProblem, numbers: Sequence[Number]) -> None:
    """Raise InputError for a number such as sqrt(2) that is a singular point; rational points are compared exactly."""
    constants = problem.embedded
    unclear = [number for number in numbers if constants is not None or not isinstance(number, Point)]
    if not unclear:
        return
    with working_precision(256):
        singular = [to_acb(z) for z in problem.singular_points(256)] if constants is None else []
        for number in unclear:
            ball = to_ball(number)
            near = any(abs(ball - z).lower() < _APART for z in singular)
            if near or (constants is not None and not constants.bound(ball).is_finite()):
                raise InputError(f"{number} is a singular point of the equation, or can't be told from one")


def _closed_form(
    problem: NumericProblem, method: Method | None, start: Start, targets: Sequence[Number], digits: int
) -> ClosedForm | Classical | None:
    """The closed form, where it is asked for or the cheaper way by a rule that was measured
    (`benchmarks/enclosure_work_precision.py`).

    A closed form without quadrature costs about a millisecond whatever the distance, the digits and the solution's zeros, if
    its polynomial has a moderate degree, and FLINT's functions cost less: less than the Taylor steps to a few points, or to
    points beside the real axis.
    """
    if method == "taylor":
        return None
    if problem.right is not None:
        if method is not None:
            raise InputError(
                "the method 'closed form' is for equations without a right-hand side", hint="method='taylor'"
            )
        return None
    few = len(targets) <= _FEW
    if problem.decision is not None and problem.decision.case == 1 and (few or method):
        closed = closed_form_of(problem)
        if closed is not None and (closed.is_elementary if method else closed.is_cheap):
            return closed
    if method or few or not all(isinstance(target, Point) and target.is_real() for target in targets):
        classical = None if problem.S is None else classical_of(problem.S)
        if classical is not None and (method or digits <= classical.most_digits(start.place)):
            return classical
    if method is not None:
        raise InputError(_NO_CLOSED_FORM, hint=_TAYLOR)
    return None

"""One evaluation: what is asked for is read, a route is chosen by a rule, and the precision is raised until the goal is met."""

from __future__ import annotations

import logging
from collections.abc import Iterable, Mapping, Sequence, Set
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Literal

from flint import arb

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.classical import NotServed
from kovacic.enclosure.constants import Number, as_number, to_ball
from kovacic.enclosure.journey import Journey
from kovacic.enclosure.points import ExactPoint, as_point
from kovacic.enclosure.precision import METHODS, Method, PointValue, number_of_digits, raise_precision
from kovacic.enclosure.problem import Coefficients, NumericProblem, as_problem, change_of
from kovacic.enclosure.rational import way_for
from kovacic.enclosure.routes import TAYLOR, route_of
from kovacic.enclosure.singular import Singular
from kovacic.enclosure.start import read_start
from kovacic.errors import InputError, LimitExceeded, NotRational
from kovacic.limits import Budget, Limits, limits_of

if TYPE_CHECKING:
    from kovacic.enclosure.through import Substitution

_LOG = logging.getLogger(__name__)

Path = Sequence[object] | Literal["chain", "above", "below"] | None
_NAMED_PATHS = ("chain", "above", "below")
_APART = arb(2) ** -200  # what is nearer to a singular point can't be told from it


@dataclass(frozen=True)
class AskedSolution:
    """One solution, of which values are asked for: the journey keeps what was computed for them.

    `through` is a change of the variable, and the same journey in one in which the coefficients are rational.
    """

    journey: Journey
    digits: int
    method: Method | None
    limits: Limits
    through: tuple[Substitution, Journey] | None = None

    def states(self, points: Sequence[object]) -> tuple[PointValue, ...]:
        """y and y' with the circumstances, for each of `points` (no warnings: see `PointValue.note`)."""
        targets = tuple(as_number(p, "x") for p in points)
        if self.journey.problem is not None:
            _check_regular(self.journey.problem, targets)
        with Budget(self.limits).watched():
            if self.through is not None and self.through[0].is_real(targets):
                change, journey = self.through
                with suppress(InputError, LimitExceeded):  # whose reasons would speak of t
                    found = self._states(journey, [change.image(target) for target in targets])
                    return tuple(map(change.seen, targets, found))
            return self._states(self.journey, targets)

    def _states(self, journey: Journey, targets: Sequence[Number]) -> tuple[PointValue, ...]:
        route = route_of(journey, targets, self.method, self.digits)
        if route is not None:
            _LOG.info("route: %s", route.closed)
            try:
                return raise_precision(journey, targets, route.closed, self.digits, self.limits, begin=route.bits)
            except NotServed:
                if self.method is not None:
                    raise InputError("the closed form doesn't prove its values on this path", hint=TAYLOR) from None
                _LOG.info("it doesn't prove its values on this path")
        _LOG.info("route: Taylor's method")
        return raise_precision(journey, targets, None, self.digits, self.limits)


def question_of(
    equation: object,
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
) -> AskedSolution:
    """The solution that the keywords of `evaluate` describe."""
    limits = limits_of(limits)
    digits = number_of_digits(digits, limits)
    _check_method(method)
    start = [_comparable(value) for value in (x0, y0, dy0)]
    given = *start, _comparables(frobenius, "frobenius"), which, _comparables(path, "path")
    if change_of(equation) is None and not isinstance(equation, Coefficients):
        try:
            problem = as_problem(equation, params, forced=True, constants=True)
            return AskedSolution(_looked_up(journey_of, problem, *given), digits, method, limits)
        except NotRational:
            pass
    from kovacic.enclosure.functions import coefficients_of_any  # imports SymPy

    coefficients = coefficients_of_any(equation, params, limits)
    if method == "closed form":
        raise InputError("the method 'closed form' is for rational coefficients", hint="leave the method out")
    journey, through = _looked_up(analytic_journeys, coefficients, *given)
    return AskedSolution(journey, digits, method, limits, through)


def evaluate_states(equation: object, points: Sequence[object], **given: Any) -> tuple[PointValue, ...]:
    """As `evaluate`, with y and y' and the circumstances, for each of `points`."""
    return question_of(equation, **given).states(points)


@lru_cache(maxsize=32, typed=True)
def journey_of(
    problem: NumericProblem,
    x0: object,
    y0: object,
    dy0: object,
    frobenius: Sequence[object] | None,
    which: str | None,
    path: Path,
) -> Journey:
    """What doesn't depend on the targets; kept, so that a call for one more point finds the discs that are there."""
    vertices = _vertices_of(path)
    start = read_start(problem, x0, y0=y0, dy0=dy0, frobenius=frobenius, which=which)
    _check_regular(problem, [n for n in (start.place, *vertices) if not isinstance(n, Singular)])
    side = path if path in ("above", "below") else None
    return Journey(way_for(problem), start, vertices, chain=path == "chain", side=side, problem=problem)


@lru_cache(maxsize=32, typed=True)
def analytic_journeys(
    coefficients: Coefficients,
    x0: object,
    y0: object,
    dy0: object,
    frobenius: Sequence[object] | None,
    which: str | None,
    path: Path,
) -> tuple[Journey, tuple[Substitution, Journey] | None]:
    """The same where coefficients are functions of x: in x and, if the path is straight, in t."""
    if path in ("above", "below"):
        hint = "path=[v1, v2, ...] goes through these vertices"
        raise InputError(f"path={path!r} isn't for equations whose coefficients are functions of x", hint=hint)
    vertices = _vertices_of(path)
    start = read_start(None, x0, y0=y0, dy0=dy0, frobenius=frobenius, which=which)
    from kovacic.enclosure.constant import ConstantWay, constant_way
    from kovacic.enclosure.through import Substitution

    way = constant_way(coefficients)
    journey = Journey(way, start, vertices, chain=path == "chain")
    change = None if vertices or isinstance(way, ConstantWay) else Substitution.of(coefficients)
    assert not isinstance(start.place, Singular)
    if change is None or not change.is_real([start.place]):
        return journey, None
    begun = change.start(start.place, start.data)
    return journey, (change, journey_of(change.problem, begun.place, *begun.data, None, None, path))


def _vertices_of(path: Path) -> tuple[Number, ...]:
    """Those of a polygon; a path that has a name has none."""
    if path is None:
        return ()
    if not isinstance(path, str):
        return tuple(as_number(vertex, "a vertex of the path") for vertex in path)
    if path not in _NAMED_PATHS:
        raise InputError(f"unknown path {path!r}", hint='a sequence of vertices, "chain", "above", "below", or None')
    return ()


def _check_regular(problem: NumericProblem, numbers: Sequence[Number]) -> None:
    """Raise InputError for a number such as sqrt(2) that is a singular point; rational points are compared exactly."""
    with working_precision(256):
        for number in numbers:
            if problem.embedded is None and isinstance(number, ExactPoint):
                continue
            ball = to_ball(number)
            if any(abs(ball - z).lower() < _APART for z in problem.enclosures(256)):
                raise InputError(f"{number} is a singular point of the equation, or can't be told from one")


def _check_method(method: object) -> None:
    """Raise InputError for an unknown one."""
    if method is not None and method not in METHODS:
        raise InputError(f"unknown method {method!r}", hint=f"one of {', '.join(map(repr, METHODS))}, or None")


def _comparable(value: object) -> object:
    """A number of NumPy's as a point: SymPy can't compare all of them with its own, when journeys are looked up."""
    return as_point(value, "a number of the start") if type(value).__module__ == "numpy" else value


def _comparables(values: object, name: str) -> Any:
    """A sequence of numbers as a tuple of such; a word, or None, as it is."""
    if values is None or isinstance(values, str):
        return values
    if isinstance(values, bytes | Mapping | Set) or not isinstance(values, Iterable):
        raise InputError(f"{name} is a sequence of numbers, not {type(values).__name__!r}")
    return tuple(map(_comparable, values))


def _looked_up(cached: Any, *given: Any) -> Any:
    """A function that keeps its values; of lists and FLINT's balls, which can't be looked up, computed anew."""
    try:
        hash(given)
    except (TypeError, ValueError):
        return cached.__wrapped__(*given)
    return cached(*given)

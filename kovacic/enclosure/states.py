"""One evaluation: what is asked for is read, a route is chosen by a rule, and the precision is raised until the goal is met."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Literal

from flint import arb

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.arguments import check_method, comparable, comparables, looked_up
from kovacic.enclosure.classical import NotServed
from kovacic.enclosure.constants import Number, as_number, to_ball
from kovacic.enclosure.journey import Journey
from kovacic.enclosure.points import ExactPoint, to_acb
from kovacic.enclosure.precision import Method, PointValue, number_of_digits, raise_precision, start_bits
from kovacic.enclosure.problem import NumericProblem, as_problem
from kovacic.enclosure.routes import TAYLOR, route_of
from kovacic.enclosure.singular import Singular
from kovacic.enclosure.start import read_start
from kovacic.errors import InputError
from kovacic.limits import Budget, Limits, limits_of

_LOG = logging.getLogger(__name__)

Path = Sequence[object] | Literal["chain", "above", "below"] | None
_NAMED_PATHS = ("chain", "above", "below")
_APART = arb(2) ** -200  # what is nearer to a singular point can't be told from it


@dataclass(frozen=True)
class AskedSolution:
    """One solution, of which values are asked for: the journey keeps what was computed for them."""

    journey: Journey
    digits: int
    method: Method | None
    limits: Limits

    def states(self, points: Sequence[object]) -> tuple[PointValue, ...]:
        """y and y' with the circumstances, for each of `points` (no warnings: see `PointValue.note`)."""
        return self.states_at(tuple(as_number(p, "x") for p in points))

    def states_at(self, targets: Sequence[Number]) -> tuple[PointValue, ...]:
        """The same for numbers that were read."""
        _check_regular(self.journey.problem, targets)
        with Budget(self.limits).watched():
            if self.method is None and self.journey.knows(targets, start_bits(self.digits)):
                _LOG.info("route: Taylor's method, on discs that are known")
                return raise_precision(self.journey, targets, None, self.digits, self.limits)
            found = self._on_kept_ways(targets)
            if found is not None:
                return found
            choice = route_of(self.journey, targets, self.method, self.digits)
            if choice is None:
                _LOG.info("route: Taylor's method")
            else:
                _LOG.info("route: %s", choice.closed)
                try:
                    return raise_precision(
                        self.journey, targets, choice.closed, self.digits, self.limits, begin=choice.bits
                    )
                except NotServed:
                    if self.method is not None:
                        said = "the closed form doesn't prove its values on this path"
                        raise InputError(said, hint=TAYLOR) from None
                    _LOG.info("it doesn't prove its values on this path: Taylor's method")
            return raise_precision(self.journey, targets, None, self.digits, self.limits)

    def _on_kept_ways(self, targets: Sequence[Number]) -> tuple[PointValue, ...] | None:
        """The values of an equation with a right-hand side by power series; None on all others."""
        if self.journey.problem.right is None or self.method is not None:
            return None
        from kovacic.enclosure.forced_ways import forced_journey, is_straight  # imports SymPy

        forced = forced_journey(self.journey)
        if forced is None or not is_straight(self.journey, targets):
            return None
        try:
            found = raise_precision(forced, targets, None, self.digits, self.limits)
        except InputError:
            # A right-hand side such as sqrt(x) from 0 on is integrated there, and has no power series.
            return None
        _LOG.info("route: power series of the coefficients and the right-hand side, on ways that are kept")
        return found


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
    check_method(method)
    problem = as_problem(equation, params, forced=True, constants=True)
    start = [comparable(value) for value in (x0, y0, dy0)]
    given = problem, *start, comparables(frobenius, "frobenius"), which, comparables(path, "path")
    return AskedSolution(looked_up(journey_of, *given), digits, method, limits)


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
    """What doesn't depend on the targets; kept, so that a call for one more point begins where the last one did."""
    vertices = _vertices_of(path)
    start = read_start(problem, x0, y0=y0, dy0=dy0, frobenius=frobenius, which=which)
    _check_regular(problem, [n for n in (start.place, *vertices) if not isinstance(n, Singular)])
    side = path if path in ("above", "below") else None
    return Journey(problem, start, vertices, chain=path == "chain", side=side)


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
            if _may_be_singular(problem, number):
                raise InputError(f"{number} is a singular point of the equation, or can't be told from one")


def _may_be_singular(problem: NumericProblem, number: Number) -> bool:
    """Can't it be told from a singular point?  False for a rational point, unless the constants are known by balls."""
    if problem.embedded is not None:
        return not all(value.is_finite() for value in problem.embedded.coefficients(to_ball(number)))
    if isinstance(number, ExactPoint):
        return False
    ball = to_ball(number)
    return any(abs(ball - to_acb(z)).lower() < _APART for z in problem.singular_points(256))

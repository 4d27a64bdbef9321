"""One evaluation: the keywords are read, a rule chooses a route, and the precision rises until the goal is met.

The rule compares the estimated costs of Taylor's method, the closed form of case 1 and FLINT's functions
(`kovacic.special.prices`): no choice depends on earlier calls or on a clock.  The number of Taylor discs is estimated from the
distances of singular points and |S|^(1/2) on the way.  A search for a closed form may take a fifth of what Taylor's method
would; an equation given as text has to be decided for case 1.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from flint import acb, arb

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.classical import Closed, NotServed, classical_of
from kovacic.enclosure.closed_form import closed_form_of, with_decision
from kovacic.enclosure.frame import foreseen_growth, frequency
from kovacic.enclosure.journey import Journey
from kovacic.enclosure.points import ExactPoint, Number, as_number, as_point, middle, to_ball
from kovacic.enclosure.precision import PointValue, raise_precision, start_bits
from kovacic.enclosure.problem import Coefficients, NumericProblem, as_problem
from kovacic.enclosure.rational import growth_of_disc, side_of, way_for
from kovacic.enclosure.request import METHODS, Method, Path, Request, Start, number_of_digits
from kovacic.enclosure.singular import Singular
from kovacic.enclosure.start import read_start
from kovacic.enclosure.way import position
from kovacic.errors import InputError, LimitExceeded, NotRational
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits, limits_of
from kovacic.special import prices

if TYPE_CHECKING:
    from kovacic.enclosure.functions import Substitution

NO_CLOSED_FORM = (
    "the method 'closed form' is for solutions of case 1 without a quadrature, and pull-backs of Airy's, Bessel's, Whittaker's "
    "and Gauss' equations over Q"
)
TAYLOR = "method='taylor' treats every equation"
_LOG = logging.getLogger(__name__)
#: Of the milliseconds that Taylor's method takes, for a decision or a search.
_SHARE_OF_A_SEARCH = 0.2
Ways = tuple[tuple[ExactPoint, ExactPoint], ...]
#: A closed form and its first precision in bits: enough where both solutions grow towards the start.
ClosedRoute = tuple[Closed, int]


def route_of(journey: Journey, targets: Sequence[Number], method: Method | None, digits: int) -> ClosedRoute | None:
    """The closed form, if it is required or cheaper; None for Taylor's method.

    The choice depends on the horizons of the farthest targets and on their number alone.  Raises InputError if
    a closed form is required and there is none.
    """
    if method == "taylor" or not targets:
        return None
    if method is not None:
        return _required(journey, digits)
    problem = journey.problem
    if problem is None or problem.right is not None or not problem.is_rational:
        return None
    return _chosen(journey, problem, tuple(_ways(journey, targets)), len(targets), digits)


def _required(journey: Journey, digits: int) -> ClosedRoute:
    """The closed form, whatever it costs."""
    problem = journey.problem
    if problem is None or problem.right is not None:
        raise InputError("the method 'closed form' is for equations without a right-hand side", hint="method='taylor'")
    known = with_decision(problem, DEFAULT_LIMITS.unknown_degree)
    closed = None if known is None else closed_form_of(known)
    if closed is not None and closed.is_elementary and isinstance(journey.place, ExactPoint):
        return closed, 0
    classical = classical_of(problem.S)
    if classical is None:
        raise InputError(NO_CLOSED_FORM, hint=TAYLOR)
    return classical, start_bits(digits + classical.lost_digits(journey.place))


@lru_cache(maxsize=64)
def _chosen(journey: Journey, problem: NumericProblem, ways: Ways, count: int, digits: int) -> ClosedRoute | None:
    """That of case 1, or FLINT's functions, sought for a share of the time that Taylor's method would take; from a singular
    point on the functions always pay."""
    price = _foreseen(journey, problem, ways, count, digits)
    sought = _SHARE_OF_A_SEARCH * price
    most = (price - prices.FIRST) / count  # for a target
    if not all(a.is_real() and b.is_real() for a, b in ways):
        most /= prices.CLOSED_BESIDE
    from_zero = isinstance(journey.place, Singular)
    S = problem.S
    if not from_zero and (problem.decision is not None or price >= prices.decided_from(S)):
        is_sure = prices.has_sure_solutions(S)
        known = with_decision(problem, DEFAULT_LIMITS.unknown_degree if is_sure else _rounded(sought * prices.DEGREES))
        closed = None if known is None else closed_form_of(known)
        if closed is not None and closed.is_elementary and closed.price(digits) <= most:
            return closed, 0
    if not from_zero and price < prices.sought_from(S.num.degree + S.den.degree):
        return None
    classical = classical_of(S, _rounded(sought / prices.UNIT))
    if classical is None or not classical.is_cheap(digits, from_zero=from_zero):
        return None
    more = digits + classical.lost_digits(journey.place)
    return (classical, start_bits(more)) if from_zero or classical.price(more) <= most else None


def _rounded(work: float) -> int:
    """The next power of two, so that targets of about the same price share the results of a search."""
    return 1 << int(min(work, 2.0**62)).bit_length()


def _foreseen(journey: Journey, problem: NumericProblem, ways: Ways, count: int, digits: int) -> float:
    """Estimated milliseconds of Taylor's method on these ways to this number of targets."""
    place = journey.place
    corners = [place.near if isinstance(place, Singular) else place, *map(middle, journey.vertices)]
    with working_precision(128):
        poles = [complex(root) for root, _ in problem.poles(128)]
        frequent = frequency(problem.system)
    # Of the bits of growth that a disc may have: log(2), for discs half as long as they may be (measured).
    growth = growth_of_disc(start_bits(digits), alone=False) * 0.35

    def rate(x: acb) -> float:
        """The inverse of a disc's diameter: its mean radius is 0.3 of the distance to a singular point."""
        here = complex(x)
        # Without the pole where a solution starts.
        near = min([abs(here - pole) for pole in poles if here != pole], default=math.inf)
        return max(float(frequent(x).mid()) / growth, 1 / near / 0.3) / 2

    size = problem.S.num.degree + problem.S.den.degree
    discs = 0.0
    target = prices.TARGET(digits)
    for a, b in [*pairwise(corners), *ways]:
        discs_here = 1 + foreseen_growth(rate, a, b)
        if not (a.is_real() and b.is_real()):
            discs_here *= prices.beside(size)
            target = prices.TARGET_BESIDE * prices.TARGET(digits)
        discs += discs_here
    return prices.BEGIN + count * target + discs * prices.DISC(digits, prices.terms(size))


def _ways(journey: Journey, targets: Sequence[Number]) -> Iterator[tuple[ExactPoint, ExactPoint]]:
    """The straight ways to the horizons of the targets: of the farthest real ones and the farthest other one."""
    place = middle(journey.vertices[-1]) if journey.vertices else journey.place
    here = place.near if isinstance(place, Singular) else place
    stops = [middle(target) for target in targets]
    by_distance = sorted(stops, key=lambda stop: position(here, stop))
    farthest = {side_of(here, stop): stop for stop in by_distance if stop != here}
    for stop in farthest.values():
        yield here, journey.way.horizon(here, stop)


@dataclass(frozen=True)
class AskedSolution:
    """One solution whose values are wanted: the journey keeps what was computed for them.

    `through` is a change of the variable to one in which the coefficients are rational, and the same journey in that.
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
            closed, bits = route
            _LOG.info("route: %s", closed)
            try:
                return raise_precision(journey, targets, closed, self.digits, self.limits, begin=bits)
            except NotServed:
                if self.method is not None:
                    raise InputError("the closed form doesn't prove its values on this path", hint=TAYLOR) from None
                _LOG.info("it doesn't prove its values on this path")
        _LOG.info("route: Taylor's method")
        return raise_precision(journey, targets, None, self.digits, self.limits)


def question_of(equation: object, request: Request) -> AskedSolution:
    """The solution that is described."""
    initial, accuracy, path, params, _ = request
    limits = limits_of(accuracy.limits)
    digits = 15 if accuracy.digits is None else number_of_digits(accuracy.digits, limits)
    method = accuracy.method
    if method is not None and method not in METHODS:
        raise InputError(f"unknown method {method!r}", hint=f"one of {', '.join(map(repr, METHODS))}, or None")
    numbers = [_comparable(value) for value in (initial.x0, initial.y0, initial.dy0)]
    given = _comparables(path, "path"), *numbers, initial.which, _comparables(initial.frobenius, "frobenius")
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
    return question_of(equation, Request.of("evaluate", given)).states(points)


@lru_cache(maxsize=32, typed=True)
def journey_of(problem: NumericProblem, path: Path, *start: Any) -> Journey:
    """The part that doesn't depend on the targets, for the fields of a `Start`; cached for the discs that it keeps."""
    vertices = _vertices_of(path)
    origin = read_start(problem, Start(*start))
    _check_regular(problem, [n for n in (origin.place, *vertices) if not isinstance(n, Singular)])
    side = path if path in ("above", "below") else None
    return Journey(way_for(problem), origin, vertices, chain=path == "chain", side=side, problem=problem)


@lru_cache(maxsize=32, typed=True)
def analytic_journeys(
    coefficients: Coefficients, path: Path, *start: Any
) -> tuple[Journey, tuple[Substitution, Journey] | None]:
    """As `journey_of` for coefficients that are functions of x: in x and, if the path is straight, in t."""
    if path in ("above", "below"):
        raise InputError(
            f"path={path!r} isn't for equations whose coefficients are functions of x",
            hint="path=[v1, v2, ...] goes through these vertices",
            shell="leave --path out",
        )
    vertices = _vertices_of(path)
    origin = read_start(None, Start(*start))
    from kovacic.enclosure.analytic import ConstantWay, constant_way
    from kovacic.enclosure.functions import Substitution

    way = constant_way(coefficients)
    journey = Journey(way, origin, vertices, chain=path == "chain")
    change = None if vertices or isinstance(way, ConstantWay) else Substitution.of(coefficients)
    assert not isinstance(origin.place, Singular)
    if change is None or not change.is_real([origin.place]):
        return journey, None
    begun = change.start(origin.place, origin.data)
    return journey, (change, journey_of(change.problem, path, begun.place, *begun.data))


def _vertices_of(path: Path) -> tuple[Number, ...]:
    """Those of a polygon; a path that has a name has none."""
    if path in (None, "chain", "above", "below"):
        return ()
    if isinstance(path, str):
        raise InputError(f"unknown path {path!r}", hint='a sequence of vertices, "chain", "above", "below", or None')
    return tuple(as_number(vertex, "a vertex of the path") for vertex in path or ())


def _check_regular(problem: NumericProblem, numbers: Sequence[Number]) -> None:
    """Raise InputError for a number such as sqrt(2) that is a singular point; rational points are compared exactly."""
    with working_precision(256):
        for number in numbers:
            if problem.is_rational and isinstance(number, ExactPoint):
                continue
            ball = to_ball(number)
            # At 256 bits 2^-200 can't be told from 0.
            if any(abs(ball - z).lower() < arb((1, -200)) for z in problem.enclosures(256)):
                raise InputError(f"{number} is a singular point of the equation, or can't be told from one")


def _comparable(value: object) -> object:
    """The value; a number of NumPy's as a point, since SymPy can't compare all of them with its own in the cache."""
    return as_point(value, "a number of the start") if type(value).__module__ == "numpy" else value


def _comparables(values: object, name: str) -> Any:
    """A sequence of numbers as a tuple of such; a word or None unchanged."""
    if values is None or isinstance(values, str):
        return values
    if isinstance(values, bytes | Mapping | Set) or not isinstance(values, Iterable):
        raise InputError(f"{name} is a sequence of numbers, not {type(values).__name__!r}")
    return tuple(map(_comparable, values))


def _looked_up(cached: Any, *given: Any) -> Any:
    """The value of a cached function; computed anew for lists and FLINT's balls, which can't be hashed."""
    try:
        hash(given)
    except (TypeError, ValueError):
        return cached.__wrapped__(*given)
    return cached(*given)

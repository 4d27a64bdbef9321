"""Which way a value is computed: what Taylor's method, the closed form of case 1 and FLINT's functions cost, by foreseen work.

No choice depends on earlier calls.

The prices stand in `kovacic.special.prices`.  How many discs Taylor's method needs is foreseen by the distances of singular
points and |S|^(1/2) on the way.  A search for a closed form is given up where Taylor's method would be through; an equation
given as text has to be decided for case 1.  No clock decides.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from flint import acb, arb

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.classical import Classical, Closed, classical_of
from kovacic.enclosure.closed_form import CaseOneForm, closed_form_of, decided
from kovacic.enclosure.constants import Number
from kovacic.enclosure.frame import foreseen_growth, frequency
from kovacic.enclosure.journey import Journey
from kovacic.enclosure.points import ExactPoint
from kovacic.enclosure.precision import Method, start_bits
from kovacic.enclosure.problem import NumericProblem
from kovacic.enclosure.singular import Singular
from kovacic.enclosure.start import middle
from kovacic.enclosure.transport import growth_of_disc
from kovacic.enclosure.way import position
from kovacic.errors import InputError
from kovacic.limits import DEFAULT_LIMITS
from kovacic.special import prices

NO_CLOSED_FORM = (
    "the method 'closed form' is for solutions of case 1 without a quadrature, and pull-backs of Airy's, Bessel's, Whittaker's "
    "and Gauss' equations over Q"
)
TAYLOR = "method='taylor' treats every equation"
_WORTH = 3.0  # milliseconds that Taylor's method takes where a closed form is sought
_SOUGHT = 0.5  # of them, for the search
_DEGREE = 40  # of S, up to which an equation given as text is decided
_UNKNOWN = 400  # degree of a polynomial that is sought for that, at most
_SHARE = 0.3  # of the distance to a singular point: the mean radius of a disc
_LOG_2 = 0.69
_MOST_SEARCH = 60.0  # milliseconds of Taylor's method that count for the search for a pull-back
_BITS = 64
Ways = tuple[tuple[ExactPoint, ExactPoint], ...]


@dataclass(frozen=True)
class ClosedRoute:
    """A closed form, for which so many `bits` are the first precision: enough where both solutions grow to the start."""

    closed: Closed
    bits: int = 0


def route_of(journey: Journey, targets: Sequence[Number], method: Method | None, digits: int) -> ClosedRoute | None:
    """The closed form, where it is asked for or the cheaper way; None for Taylor's method.

    The choice depends on the horizons of the farthest targets and on the size of their number alone.  Raises InputError where
    a closed form is asked for and there is none.
    """
    if method == "taylor" or not targets:
        return None
    if method is not None:
        return _asked_for(journey, digits)
    problem = journey.problem
    if problem is None or problem.right is not None or problem.S is None:
        return None
    count = 1 << (len(targets) - 1).bit_length()
    ways = tuple(_ways(journey, targets))
    key = ways, count, digits
    if key not in journey.routes:
        journey.routes[key] = _chosen(journey, problem, Foreseen(journey, problem, ways, count, digits))
    found: ClosedRoute | None = journey.routes[key]
    return found


def _asked_for(journey: Journey, digits: int) -> ClosedRoute:
    """The closed form, whatever it costs."""
    problem = journey.problem
    if problem is None or problem.right is not None:
        raise InputError("the method 'closed form' is for equations without a right-hand side", hint="method='taylor'")
    known = None if problem.S is None else decided(problem, DEFAULT_LIMITS.unknown_degree)
    closed = None if known is None else closed_form_of(known)
    if closed is not None and closed.is_elementary and isinstance(journey.place, ExactPoint):
        return ClosedRoute(closed)
    classical = None if problem.S is None else classical_of(problem.S, None)
    if classical is None:
        raise InputError(NO_CLOSED_FORM, hint=TAYLOR)
    lost = _lost_digits(classical, journey)
    return ClosedRoute(classical, start_bits(digits + lost))


def _lost_digits(classical: Classical, journey: Journey) -> float:
    """About so many; none from a singular point on."""
    return 0.0 if isinstance(journey.place, Singular) else classical.lost_digits(journey.place)


def _chosen(journey: Journey, problem: NumericProblem, foreseen: Foreseen) -> ClosedRoute | None:
    """That of case 1, or FLINT's functions, sought for no longer than Taylor's method would take; from a singular point on
    the functions always pay."""
    from_zero = isinstance(journey.place, Singular)
    if not from_zero:
        closed = _case_1(problem, foreseen)
        if closed is not None and closed.is_cheap(foreseen.digits) and foreseen.pays(closed.price(foreseen.digits)):
            return ClosedRoute(closed)
        if foreseen.price < _WORTH:
            return None
    assert problem.S is not None
    classical = classical_of(problem.S, int(_SOUGHT * min(foreseen.price, _MOST_SEARCH) / prices.UNIT))
    if classical is None or not classical.is_cheap(foreseen.digits, from_zero=from_zero):
        return None
    digits = foreseen.digits + _lost_digits(classical, journey)
    return ClosedRoute(classical, start_bits(digits)) if from_zero or foreseen.pays(classical.price(digits)) else None


def _case_1(problem: NumericProblem, foreseen: Foreseen) -> CaseOneForm | None:
    """The closed form of case 1; an equation that wasn't solved is decided only as far as Taylor's method takes that long."""
    degree = _UNKNOWN
    if problem.decision is None:
        assert problem.S is not None
        size = problem.S.num.degree + problem.S.den.degree
        if size > _DEGREE or (size > 0 and foreseen.price < _WORTH):  # a constant S is decided in no time
            return None
        degree = int(min(_SOUGHT * prices.DEGREES * foreseen.price, _UNKNOWN))
    known = decided(problem, degree)
    return None if known is None else closed_form_of(known)


class Foreseen:
    """What Taylor's method takes on these ways to so many targets, about, in milliseconds."""

    def __init__(self, journey: Journey, problem: NumericProblem, ways: Ways, count: int, digits: int) -> None:
        self.digits = digits
        self._count = count
        place = journey.place
        corners = [place.near if isinstance(place, Singular) else place, *map(middle, journey.vertices)]
        with working_precision(_BITS):
            poles = [complex(root) for root, _ in problem.poles(_BITS)]
            frequent = frequency(problem.system)
        growth = growth_of_disc(start_bits(digits), alone=False) * _LOG_2

        def rate(x: acb) -> arb:
            """The inverse of a disc's diameter."""
            here = complex(x)
            distances = (abs(here - pole) for pole in poles)
            near = min((d for d in distances if d > 0), default=math.inf)  # not where a solution starts
            return (frequent(x) / growth).max(arb(1 / near) / _SHARE) / 2

        discs = sum(1 + foreseen_growth(rate, a, b) for a, b in [*pairwise(corners), *ways])
        self.price = prices.BEGIN + count * prices.TARGET(digits) + discs * prices.DISC(digits)

    def pays(self, price: float) -> bool:
        """True if a closed form takes less, with this price for each target."""
        return self.price >= prices.FIRST + self._count * price


def _ways(journey: Journey, targets: Sequence[Number]) -> Iterator[tuple[ExactPoint, ExactPoint]]:
    """The straight ways to the horizons of the targets: of the farthest real ones and the farthest other one."""
    place = middle(journey.vertices[-1]) if journey.vertices else journey.place
    here = place.near if isinstance(place, Singular) else place
    stops = [middle(target) for target in targets]
    if journey.chain:
        yield from pairwise([here, *stops])
        return
    real = [stop for stop in stops if stop.is_real() and here.is_real()]
    others = [stop for stop in stops if not (stop.is_real() and here.is_real())]
    farthest = {max(real, key=lambda stop: stop.x), min(real, key=lambda stop: stop.x)} if real else set()
    if others:
        farthest.add(max(others, key=lambda stop: position(here, stop)))
    for stop in sorted(farthest - {here}, key=lambda stop: (stop.x, stop.y)):
        yield here, journey.way.horizon(here, stop)

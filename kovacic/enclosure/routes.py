"""Which way a value is computed: what Taylor's method, the closed form of case 1 and FLINT's functions cost, by foreseen work.

No choice depends on earlier calls.

The prices stand in `kovacic.special.prices`.  How many discs Taylor's method needs is foreseen by a walk in small balls that
looks at the distances of singular points and at |S|^(1/2), and ends as soon as the answer is known.  A search for a closed form
is given up where Taylor's method would be through; an equation given as text has to be decided for case 1.  No clock decides.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise

from flint import acb, acb_poly, arb

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.classical import Classical, Closed, classical_of
from kovacic.enclosure.closed_form import CaseOneForm, closed_form_of, decided
from kovacic.enclosure.constants import Number
from kovacic.enclosure.journey import Journey
from kovacic.enclosure.points import ExactPoint, to_acb
from kovacic.enclosure.precision import Method, start_bits
from kovacic.enclosure.problem import NumericProblem
from kovacic.enclosure.singular import Singular
from kovacic.enclosure.start import middle
from kovacic.enclosure.transport import growth_of_disc
from kovacic.enclosure.way import position
from kovacic.errors import InputError
from kovacic.limits import DEFAULT_LIMITS, check_time
from kovacic.special import prices

NO_CLOSED_FORM = (
    "the method 'closed form' is for solutions of case 1 without a quadrature, and pull-backs of Airy's, Bessel's, Whittaker's "
    "and Gauss' equations over Q"
)
TAYLOR = "method='taylor' treats every equation"
_WORTH = 1.0  # milliseconds that Taylor's method takes where a closed form is sought
_DEGREE = 40  # of S, up to which an equation given as text is decided
_UNKNOWN = 400  # degree of a polynomial that is sought for that, at most
_SHARE = 0.3  # of the distance to a singular point: the mean radius of a disc
_HELPS = 0.9  # to half a step the growth falls by more
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
        if not foreseen.reaches(_WORTH):
            return None
    assert problem.S is not None
    classical = classical_of(problem.S, int(foreseen.price(_MOST_SEARCH) / prices.UNIT))
    if classical is None or not classical.is_cheap(foreseen.digits, from_zero=from_zero):
        return None
    digits = foreseen.digits + _lost_digits(classical, journey)
    return ClosedRoute(classical, start_bits(digits)) if from_zero or foreseen.pays(classical.price(digits)) else None


def _case_1(problem: NumericProblem, foreseen: Foreseen) -> CaseOneForm | None:
    """The closed form of case 1; an equation that wasn't solved is decided only as far as Taylor's method takes that long."""
    degree = _UNKNOWN
    if problem.decision is None:
        assert problem.S is not None
        large = problem.S.num.degree + problem.S.den.degree > _DEGREE
        if large or not foreseen.reaches(_WORTH):
            return None
        degree = int(prices.DEGREES * foreseen.price(_UNKNOWN / prices.DEGREES))
    known = decided(problem, degree)
    return None if known is None else closed_form_of(known)


class Foreseen:
    """What Taylor's method takes on these ways to so many targets, about, in milliseconds; its discs are counted no further
    than somebody asks."""

    def __init__(self, journey: Journey, problem: NumericProblem, ways: Ways, count: int, digits: int) -> None:
        self.digits = digits
        self._count = count
        place = journey.place
        corners = [place.near if isinstance(place, Singular) else place, *map(middle, journey.vertices)]
        self._discs = _discs(problem, [*pairwise(corners), *ways], start_bits(digits))
        self._price = prices.BEGIN + count * prices.TARGET(digits)

    def price(self, most: float) -> float:
        """What it takes, or `most`."""
        self.reaches(most)
        return min(most, self._price)

    def reaches(self, price: float) -> bool:
        """Does it take so long?"""
        each = prices.DISC(self.digits)
        while self._price < price:
            if next(self._discs, None) is None:
                return False
            self._price += each
        return True

    def pays(self, price: float) -> bool:
        """Does a closed form take less, with this price for each target?"""
        return self.reaches(prices.FIRST + self._count * price)


def _discs(problem: NumericProblem, ways: Sequence[tuple[ExactPoint, ExactPoint]], prec: int) -> Iterator[arb]:
    """The radii of the discs of a walk in small balls, about."""
    growth = growth_of_disc(prec, alone=False) * 0.69  # log 2: from bits
    for a, b in ways:
        with working_precision(_BITS):
            num, den = problem.polynomials()
            poles = [root for root, _ in problem.poles(_BITS)]
            start = to_acb(a)
            end = to_acb(b)
            length = abs(end - start)
            direction = (end - start) / length if a != b else acb(0)
        gone = arb(0)
        while gone < length:
            with working_precision(_BITS):
                x = start + direction * gone
                # The radius at a singular point, where a solution may start, is given by the others.
                distances = [abs(x - pole) for pole in poles]
                radii = [distance.mid() * _SHARE for distance in distances if not distance.contains(0)]
                rate = _rate(num, den, x)
                if rate > 0:
                    radii.append(growth / rate)
                step = min([*radii, (length - gone).mid()])
                step = _within(growth, step, partial(_rate_beyond, num, den, x, direction))
                gone = (gone + 2 * step).mid()
            if not step > 0:
                return
            yield step


def _within(growth: float, step: arb, rate: Callable[[arb], arb]) -> arb:
    """The step, halved until a solution grows no more at its far end; or as long as that helps: beside a pole it doesn't."""
    grown = rate(2 * step) * step
    while step > 0 and grown > growth:
        step /= 2
        before = grown
        grown = rate(2 * step) * step
        if not grown < before * _HELPS:
            break
    return step


def _rate_beyond(num: acb_poly, den: acb_poly, x: acb, direction: acb, distance: arb) -> arb:
    """So far from x."""
    return _rate(num, den, x + direction * distance)


def _rate(num: acb_poly, den: acb_poly, x: acb) -> arb:
    """|S|^(1/2), about; of polynomials of degree 4000 it takes some milliseconds, and is asked for at many points."""
    check_time()
    return arb(abs(num(x) / den(x)).sqrt().mid())


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

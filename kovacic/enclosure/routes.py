"""Which way a value is computed: what Taylor's method, the closed form of case 1 and FLINT's functions cost, by foreseen work.

The prices stand in `kovacic.special.prices`.  How many discs Taylor's method needs is foreseen by a walk in small balls that
looks at the distances of singular points and at |S|^(1/2), and ends as soon as the answer is known.  A search for a closed form
is given up where Taylor's method would be through; an equation given as text has to be decided for case 1.  No clock decides.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import pairwise

from flint import acb, acb_poly, arb

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.classical import Closed
from kovacic.enclosure.closed_form import CaseOneForm, closed_form_of, decided
from kovacic.enclosure.constants import Number
from kovacic.enclosure.journey import ChosenForm, Journey
from kovacic.enclosure.points import ExactPoint, to_acb
from kovacic.enclosure.precision import Method, start_bits
from kovacic.enclosure.problem import NumericProblem
from kovacic.enclosure.singular import Singular
from kovacic.enclosure.start import middle
from kovacic.enclosure.transport import growth_of_disc
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
_SEARCH = 0.6  # what it may take of them where the equation was decided before it
_BITS = 64


def route_of(journey: Journey, targets: Sequence[Number], method: Method | None, digits: int) -> ChosenForm | None:
    """The closed form, where it is asked for or the cheaper way; None for Taylor's method.

    What was chosen for the journey before is taken again, as long as it pays for all targets together.
    Raises InputError where it is asked for and there is none.
    """
    if method == "taylor":
        return None
    count = len(targets)
    known = journey.choices.get((method, digits))
    if known is None:
        known = _chosen(journey, targets, method, digits)
    elif not known.pays(count):
        known.most = Foreseen(journey, targets, digits, known.served).most(known.price)
    if known is None or not known.pays(count):
        journey.choices.pop((method, digits), None)
        return None
    known.served += count
    journey.choices[method, digits] = known
    return known


def _chosen(journey: Journey, targets: Sequence[Number], method: Method | None, digits: int) -> ChosenForm | None:
    """The choice for the first targets of a journey."""
    if method is not None:
        return _asked_for(journey, digits)
    problem = journey.problem
    if problem.right is not None or problem.S is None:
        return None
    foreseen = Foreseen(journey, targets, digits)
    if not isinstance(journey.start.place, Singular):
        closed = _case_1(problem, foreseen)
        if closed is not None and closed.is_cheap(digits):
            choice = foreseen.choice(closed, closed.price(digits))
            if choice.pays(len(targets)):
                return choice
    return _functions(journey, foreseen)


def _asked_for(journey: Journey, digits: int) -> ChosenForm:
    """The closed form, whatever it costs."""
    problem = journey.problem
    if problem.right is not None:
        raise InputError("the method 'closed form' is for equations without a right-hand side", hint="method='taylor'")
    known = None if problem.S is None else decided(problem, DEFAULT_LIMITS.unknown_degree)
    start = journey.start.place
    if known is not None and not isinstance(start, Singular):
        closed = closed_form_of(known)
        if closed is not None and closed.is_elementary:
            return ChosenForm(closed)
    classical = journey.classical(None)
    if classical is None:
        raise InputError(NO_CLOSED_FORM, hint=TAYLOR)
    if isinstance(start, Singular):
        return ChosenForm(classical)
    return ChosenForm(classical, bits=start_bits(digits + classical.lost_digits(middle(start))))


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


def _functions(journey: Journey, foreseen: Foreseen) -> ChosenForm | None:
    """FLINT's functions, sought for no longer than Taylor's method would take; from a singular point on they always pay."""
    start = journey.start.place
    from_zero = isinstance(start, Singular)
    if not (from_zero or foreseen.reaches(_WORTH)):
        return None
    share = 1.0 if from_zero else _SEARCH
    classical = journey.classical(int(share * foreseen.price(_MOST_SEARCH) / prices.UNIT))
    if classical is None or not classical.is_cheap(foreseen.digits, from_zero=from_zero):
        return None
    if isinstance(start, Singular):
        return ChosenForm(classical)
    digits = foreseen.digits + classical.lost_digits(middle(start))
    choice = foreseen.choice(classical, classical.price(digits))
    choice.bits = start_bits(digits)
    return choice


class Foreseen:
    """What Taylor's method takes to the targets, about, in milliseconds; its discs are counted no further than somebody asks.

    So many targets were `served` before by a closed form, for which the discs aren't there.
    """

    def __init__(self, journey: Journey, targets: Sequence[Number], digits: int, served: int = 0) -> None:
        self.digits = digits
        self._count = served + len(targets)
        self._discs = _discs(journey, targets, start_bits(digits))
        self._price = prices.BEGIN + self._count * prices.TARGET(digits)

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

    def choice(self, closed: Closed, price: float) -> ChosenForm:
        """A closed form; for how many targets of this price it pays is known as far as it is asked."""
        self.reaches(prices.FIRST + self._count * price)
        return ChosenForm(closed, price, self._limit(price))

    def most(self, price: float) -> float:
        """For how many targets it pays, known for twice as many as there are: so that this is seldom asked."""
        self.reaches(prices.FIRST + self._count * (2 * price - prices.TARGET(self.digits)))
        return self._limit(price)

    def _limit(self, price: float) -> float:
        """Where so many targets cost as much as the discs and their targets."""
        each = prices.TARGET(self.digits)
        discs = self._price - self._count * each
        return math.inf if price <= each else (discs - prices.FIRST) / (price - each)


def _discs(journey: Journey, targets: Sequence[Number], prec: int) -> Iterator[arb]:
    """The radii of the discs of a walk in small balls, about."""
    problem = journey.problem
    growth = growth_of_disc(prec, len(targets)) * 0.69  # log 2: from bits
    place = journey.start.place
    here = place.near if isinstance(place, Singular) else middle(place)
    stops = [middle(vertex) for vertex in journey.vertices]
    for a, b in (*pairwise([here, *stops]), *_ways([here, *stops][-1], targets, journey.chain)):
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


def _ways(here: ExactPoint, targets: Sequence[Number], chain: bool) -> Iterator[tuple[ExactPoint, ExactPoint]]:
    """The straight ways to the targets: to the farthest ones of the real axis, and to each of the others."""
    stops = [middle(target) for target in targets]
    if chain:
        yield from pairwise([here, *stops])
        return
    real = [stop for stop in stops if stop.is_real() and here.is_real()]
    if real:
        yield here, max(real, key=lambda stop: stop.x)
        yield here, min(real, key=lambda stop: stop.x)
    yield from ((here, stop) for stop in stops if not (stop.is_real() and here.is_real()))

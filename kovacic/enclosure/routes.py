"""Which way a value is computed: what the Taylor steps, the closed form of case 1 and FLINT's functions cost, by counted work.

The unit is what Taylor's method takes for one more target in a disc, some 0.04 ms at 15 digits.  A disc takes _DISC of them.
How many discs there will be is foreseen by a walk in small balls that looks at the distances of singular points and at
|S|^(1/2), and ends as soon as the answer is known.  A closed form takes its `ratio` for each target, and next to nothing before
the first; an equation given as text has to be decided for it.  The numbers were measured; no clock decides.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from flint import acb, arb

from kovacic.enclosure.classical import Classical, Closed
from kovacic.enclosure.closed_form import CaseOneForm, closed_form_of, decided
from kovacic.enclosure.constants import Number
from kovacic.enclosure.journey import Journey
from kovacic.enclosure.points import ExactPoint, to_acb, working_precision
from kovacic.enclosure.precision import Method, start_bits
from kovacic.enclosure.problem import NumericProblem
from kovacic.enclosure.singular import Singular
from kovacic.enclosure.start import middle
from kovacic.enclosure.transport import growth_of_disc
from kovacic.errors import InputError
from kovacic.limits import DEFAULT_LIMITS

NO_CLOSED_FORM = (
    "the method 'closed form' is for solutions of case 1 without a quadrature, and pull-backs of Airy's, Bessel's, Whittaker's "
    "and Gauss' equations over Q"
)
TAYLOR = "method='taylor' treats every equation"
_DISC = 15.0  # a Taylor disc, in targets
_DECISION = 4  # discs, as much as a decision costs
_DEGREE = 40  # of S, up to which an equation given as text is decided
_UNKNOWN = 400  # degree of a polynomial that is sought for that
_SHARE = 0.3  # of the distance to a singular point: the mean radius of a disc
_LOG_2 = 0.69
_LEAST = 1.2  # the ratio of the cheapest of FLINT's functions
_SEARCH, _MOST_SEARCH = (
    40,
    20,
)  # units of the search for a pull-back that a disc is worth, and up to how many discs count
_BITS = 64


def route_of(journey: Journey, targets: Sequence[Number], method: Method | None, digits: int) -> Closed | None:
    """The closed form, where it is asked for or the cheaper way; None for Taylor's method.

    Raises InputError where it is asked for and there is none.
    """
    if method == "taylor":
        return None
    if method is not None:
        return _asked_for(journey)
    problem = journey.problem
    if problem.right is not None or problem.S is None:
        return None
    foreseen = Foreseen(journey, targets, digits)
    if not isinstance(journey.start.place, Singular):
        closed = _case_1(problem, foreseen)
        if closed is not None and closed.is_cheap(digits) and foreseen.pays(closed.ratio(digits)):
            return closed
    return _functions(journey, foreseen)


def _asked_for(journey: Journey) -> Closed:
    """The closed form, whatever it costs."""
    problem = journey.problem
    if problem.right is not None:
        raise InputError("the method 'closed form' is for equations without a right-hand side", hint="method='taylor'")
    known = None if problem.S is None else decided(problem, DEFAULT_LIMITS.unknown_degree)
    if known is not None and not isinstance(journey.start.place, Singular):
        closed = closed_form_of(known)
        if closed is not None and closed.is_elementary:
            return closed
    classical = journey.classical(None)
    if classical is None:
        raise InputError(NO_CLOSED_FORM, hint=TAYLOR)
    return classical


def _case_1(problem: NumericProblem, foreseen: Foreseen) -> CaseOneForm | None:
    """The closed form of case 1; an equation that wasn't solved is decided only where the Taylor steps would take as long."""
    if problem.decision is None:
        assert problem.S is not None
        large = problem.S.num.degree + problem.S.den.degree > _DEGREE
        if large or not foreseen.discs_reach(_DECISION):
            return None
    known = decided(problem, _UNKNOWN)
    return None if known is None else closed_form_of(known)


def _functions(journey: Journey, foreseen: Foreseen) -> Classical | None:
    """FLINT's functions, sought for no longer than the Taylor steps would take; beside the real axis they always pay."""
    from_zero = isinstance(journey.start.place, Singular)
    beside = not all(isinstance(target, ExactPoint) and target.is_real() for target in foreseen.targets)
    if not (from_zero or beside or foreseen.pays(_LEAST)):
        return None
    classical = journey.classical(foreseen.work())
    if classical is None or not classical.is_cheap(foreseen.digits, from_zero=from_zero):
        return None
    return classical if from_zero or beside or foreseen.pays(classical.cost.ratio(foreseen.digits)) else None


class Foreseen:
    """How many Taylor discs lead to the targets, at least; counted no further than somebody asks."""

    def __init__(self, journey: Journey, targets: Sequence[Number], digits: int) -> None:
        self.targets = targets
        self.digits = digits
        self._discs = _discs(journey, targets, start_bits(digits))
        self._counted = 0

    def discs_reach(self, most: float) -> bool:
        """Are there so many discs?"""
        while self._counted < most:
            if next(self._discs, None) is None:
                return False
            self._counted += 1
        return True

    def pays(self, ratio: float) -> bool:
        """Does a closed form that costs `ratio` for each target cost less than Taylor's method, but for a disc?"""
        return self.discs_reach(len(self.targets) * (ratio - 1) / _DISC - 1)

    def work(self) -> int:
        """What a search may take: as much as the discs, up to what is enough for most."""
        self.discs_reach(_MOST_SEARCH)
        return _SEARCH * (1 + self._counted)


def _discs(journey: Journey, targets: Sequence[Number], prec: int) -> Iterator[arb]:
    """The radii of the discs of a walk in small balls, about."""
    problem, growth = journey.problem, growth_of_disc(prec, len(targets)) * _LOG_2
    place = journey.start.place
    here = place.near if isinstance(place, Singular) else middle(place)
    stops = [middle(vertex) for vertex in journey.vertices]
    for a, b in (*pairwise([here, *stops]), *_ways([here, *stops][-1], targets, journey.chain)):
        with working_precision(_BITS):
            (num, den), poles = problem.polynomials(), [root for root, _ in problem.poles(_BITS)]
            start, end = to_acb(a), to_acb(b)
            length = abs(end - start)
            direction = (end - start) / length if a != b else acb(0)
        gone = arb(0)
        while gone < length:
            with working_precision(_BITS):
                x = start + direction * gone
                rate = abs(num(x) / den(x)).sqrt()
                radii = [abs(x - pole).mid() * _SHARE for pole in poles]
                radii += [(growth / rate).mid()] if rate > 0 else []
                step = min(radii, default=length)
                gone = (gone + 2 * step).mid()
            if not step > 0:
                return
            yield step


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

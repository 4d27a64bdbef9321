"""Raising the working precision until the enclosures have the requested digits, or can't have them.

First digits + guard bits, then as many bits more as were missing.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import count, repeat
from typing import Literal

from flint import acb, arb

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.ball import Ball, Route, finite_ball
from kovacic.enclosure.classical import Closed, NotServed
from kovacic.enclosure.frame import upper_exponent
from kovacic.enclosure.journey import Journey
from kovacic.enclosure.matrices import State
from kovacic.enclosure.points import Number
from kovacic.errors import LimitExceeded
from kovacic.limits import Limits
from kovacic.numbers.numerals import in_a_message

_LOG = logging.getLogger(__name__)
_BITS_PER_DIGIT = math.log2(10)


class AccuracyWarning(UserWarning):
    """An enclosure is wider than requested; the message says why."""


@dataclass(frozen=True, eq=False)
class PointValue:
    """The solution at one point: enclosures of y and y' (`state`, finite), and how they were obtained.

    `missing` are the bits of y that are missing for the requested digits; if there are any, `note` says why.
    """

    x: Number
    state: State
    missing: int
    route: Route
    note: str | None = None

    @property
    def y(self) -> Ball:
        """y(x)."""
        return finite_ball(self.state[0], self.route)

    @property
    def dy(self) -> Ball:
        """y'(x)."""
        return finite_ball(self.state[1], self.route)


Values = tuple[PointValue, ...]
_METHODS: dict[bool, Literal["taylor", "closed form"]] = {True: "taylor", False: "closed form"}


def start_bits(digits: float) -> int:
    """The working precision of the first run."""
    return int(digits * _BITS_PER_DIGIT) + 24


def raise_precision(
    journey: Journey, targets: Sequence[Number], closed: Closed | None, digits: int, limits: Limits, *, begin: int = 0
) -> tuple[PointValue, ...]:
    """Make the journey at rising precision until every relative radius is small enough; not below `begin` bits."""
    exact = journey.is_exact(targets)
    # Below 2^-ceiling a value isn't told from zero, unless other solutions are seen to be as large.
    ceiling = 6 * start_bits(digits) + 4000
    # No later ceiling is above what the limit of digits stands for, or above the first one.
    most = int(max(ceiling, limits.digits * _BITS_PER_DIGIT))
    # At most half the ceiling, so that a second run can be at twice the precision.
    bits = max(start_bits(digits), min(begin, ceiling // 2))
    previous: Values | None = None  # those of the last run with finite balls
    for number in count(1):
        try:
            values = _run(journey, targets, closed, Route(digits, _METHODS[closed is None], bits, number))
        except LimitExceeded as limit:
            if previous is None:
                raise
            return _explained(previous, exact=exact, limit=str(limit))
        is_stalled = False
        if values is not None:
            if not _lacking(values):
                return values
            if closed is not None and previous is not None and _lacking(values) > _lacking(previous):
                raise NotServed("a higher precision gives fewer digits: FLINT sums another series")
            if exact and number > 1:  # the first run doesn't tell how large other solutions are
                ceiling = max(ceiling, 2 * max(map(_growth, values)) + 2 * start_bits(digits))
                if closed is not None:
                    ceiling = min(ceiling, most)
            is_stalled = not exact and previous is not None and _is_stalled(previous, values)
        if bits >= ceiling or ceiling > most or is_stalled:
            if values is None:
                raise LimitExceeded("no finite enclosure was found up to the highest precision", limit="digits")
            return _explained(values, exact=exact)
        previous = values or previous
        more = 16 + (bits if values is None else max(value.missing for value in values))
        if closed is None:  # by multiples of 64, so that points of other calls share the expansions
            more = -(-more // 64) * 64
        bits = min(bits + more, ceiling)
    raise AssertionError


def _run(journey: Journey, targets: Sequence[Number], closed: Closed | None, route: Route) -> Values | None:
    """The values at the precision of this route; None if the balls aren't all finite."""
    doubled = route.runs == 1 or closed is not None
    with working_precision(route.bits + 40):
        states = journey.states(targets, closed, route.bits)
        missing = [_missing_bits(y, route.digits, route.bits, doubled=doubled) for y, _ in states]
    _LOG.info(
        "run %d, %d bits: %d of %d points to %d digits",
        *(route.runs, route.bits, missing.count(0), len(missing), route.digits),
    )
    finite = all(part.is_finite() for state in states for part in state)
    return tuple(map(PointValue, targets, states, missing, repeat(route))) if finite else None


def _lacking(values: Values) -> int:
    return sum(value.missing > 0 for value in values)


def _is_stalled(previous: Values, values: Values) -> bool:
    """True if a higher precision hasn't halved the balls: their size comes from the initial values."""
    lacking = [pair for pair in zip(previous, values, strict=True) if pair[1].missing]
    # A ball around 0 may at first be wide just because the precision was too low.
    if values[0].route.runs <= 2 and any(value.y.contains_zero() for _, value in lacking):
        return False
    return all(2 * arb(value.y.rad) > arb(before.y.rad) for before, value in lacking)


def _explained(values: Values, *, exact: bool, limit: str | None = None) -> Values:
    """Those that lack digits get a note, which is the limit or a reason that their balls give."""
    return tuple(v if v.missing == 0 else replace(v, note=limit or _reason(v, exact=exact)) for v in values)


def _missing_bits(y: acb, digits: int, prec: int, *, doubled: bool) -> int:
    """How many bits of precision the enclosure lacks (0: the goal is met).

    A first ball that contains zero, and one of a closed form, may be wide because the precision was low, which says nothing of
    the solutions: then the precision is `doubled`.
    """
    if not y.is_finite():
        return prec
    # Exact, such as y = 0 or an end of the way: no digit is missing.
    if y.is_exact():
        return 0
    goal = int(digits * _BITS_PER_DIGIT) + 2
    if not y.contains(0):
        return max(0, goal - int(y.rel_accuracy_bits()))
    if doubled:
        return prec
    # If the solution is the recessive one, twice the growth of the others is lost.
    return max(prec, 2 * _lost(y, prec) + goal - prec)


def _lost(y: acb, prec: int) -> int:
    """The bits by which other solutions grow, as far as an enclosure that contains zero tells."""
    largest = y.abs_upper()
    # A solution of size 1 would be off by about 2^-prec: a wider ball comes from growth.
    return 0 if largest == 0 else max(0, upper_exponent(largest) + prec)


def _growth(result: PointValue) -> int:
    """The bits by which other solutions grow, as far as this value tells."""
    return _lost(result.state[0], result.route.bits) if result.y.contains_zero() else 0


def _reason(result: PointValue, *, exact: bool) -> str:
    """Why digits are missing, as far as the ball tells; only where all numbers are `exact` is it wide because others grow."""
    if result.y.contains_zero():
        known = arb(result.y.rad).mid().str(2, radius=False)
        growth = _growth(result) if exact else 0
        reason = (
            f"the value can't be told from zero (|y| is at most about {known}): no relative accuracy was reached"
            f" with {result.route.bits} bits"
        )
        if growth > 200:
            power = in_a_message(growth * 30103 // 100000)  # as a decimal
            reason += f": other solutions grow to about 10^{power} on the way, so that as many digits are lost"
        return reason
    known = f"{max(0.0, result.y.digits):.1f}"
    return f"only {known} of {result.route.digits} digits: the initial values or the limits allow no more"

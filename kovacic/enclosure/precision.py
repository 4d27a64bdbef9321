"""Raising the working precision until the enclosures are as small as was asked for, or until they can't be.

First digits + guard bits, then as many bits more as were missing.  The global precision of flint is set inside
`flint.ctx.workprec` only, so an interruption leaves it as it was.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import repeat
from typing import Literal

from flint import acb, arb

from kovacic.enclosure.ball import Ball, Route, finite_ball
from kovacic.enclosure.constants import Number
from kovacic.enclosure.frame import upper_exponent
from kovacic.enclosure.journey import Closed, Journey
from kovacic.enclosure.matrices import State
from kovacic.enclosure.points import working_precision
from kovacic.errors import InputError, LimitExceeded
from kovacic.exact import whole
from kovacic.limits import Limits
from kovacic.numerals import in_a_message

_LOG = logging.getLogger(__name__)

Method = Literal["taylor", "closed form"]
METHODS: tuple[Method, ...] = ("taylor", "closed form")


class AccuracyWarning(UserWarning):
    """An enclosure is wider than asked for; the message says why."""


@dataclass(frozen=True, eq=False)
class PointValue:
    """The solution at one point: enclosures of y and y' (`state`, finite), and how they were obtained.

    `missing` are the bits of y that are missing for the digits asked for; if there are any, `note` says why.
    """

    x: Number
    state: State
    missing: int
    route: Route
    note: str | None = None

    @property
    def reached(self) -> bool:
        """Is the relative radius of y at most 10^-digits?"""
        return self.missing == 0

    @property
    def y(self) -> Ball:
        """y(x)."""
        return finite_ball(self.state[0], self.route)

    @property
    def dy(self) -> Ball:
        """y'(x)."""
        return finite_ball(self.state[1], self.route)


def start_bits(digits: int) -> int:
    """The working precision of the first run."""
    return int(digits * 3.3219280948873626) + 24


def number_of_digits(given: object, limits: Limits) -> int:
    """As Python's integer; raises InputError unless this is a number of digits within the limits."""
    digits = whole(given, "digits", least=1)
    if digits > limits.digits:
        shown = in_a_message(digits)
        raise InputError(
            f"digits = {shown} is beyond the limit of {limits.digits}",
            hint=f"limits=kovacic.Limits(digits={shown})",
            shell=f"--limit digits={shown}",
        )
    return digits


def raise_precision(
    journey: Journey, targets: Sequence[Number], closed: Closed | None, digits: int, limits: Limits
) -> tuple[PointValue, ...]:
    """Make the journey at rising precision until every relative radius is small enough."""
    prec, exact = start_bits(digits), journey.is_exact(targets)
    highest = 6 * prec + 4000  # a value below 2^-highest isn't told from zero, unless others are as large
    most = int(max(highest, limits.digits * math.log2(10)))
    runs = 0
    previous: tuple[PointValue, ...] | None = None
    while True:
        runs += 1
        try:
            with working_precision(prec + 40):
                states = journey.states(targets, closed, prec)
                route = Route(digits, METHODS[closed is not None], prec, runs)
                lacking = [_missing_bits(y, digits, prec, doubled=runs == 1 or closed is not None) for y, _ in states]
                finite = all(y.is_finite() and dy.is_finite() for y, dy in states)
                found = tuple(map(PointValue, targets, states, lacking, repeat(route))) if finite else None
                missing = max(lacking, default=0)
            _LOG.info(
                "run %d, %d bits: %d of %d points to %d digits", runs, prec, lacking.count(0), len(lacking), digits
            )
        except LimitExceeded as limit:
            if previous is None:
                raise
            return tuple(result if result.reached else replace(result, note=str(limit)) for result in previous)
        if missing == 0 and found is not None:
            return found
        # where a higher precision hasn't halved the balls, their size comes from the initial values
        stalled = bool(not exact and previous and found) and all(
            f.reached or (_is_telling(f, runs) and 2 * arb(f.y.rad) > arb(p.y.rad))
            for p, f in zip(previous or (), found or (), strict=True)
        )
        if exact and found is not None and runs > 1:  # a recessive solution is as small as the others are large
            highest = max(highest, 2 * max(map(_growth, found)) + 2 * start_bits(digits))
            highest = highest if closed is None else min(highest, most)
        if prec >= highest or stalled or highest > most:
            if found is None:
                raise LimitExceeded("no finite enclosure was found up to the highest precision", limit="digits")
            return tuple(result if result.reached else replace(result, note=_reason(result)) for result in found)
        previous = found or previous
        prec = min(prec + missing + 16, highest)


def _missing_bits(y: acb, digits: int, prec: int, *, doubled: bool) -> int:
    """How many bits of precision the enclosure lacks (0: the goal is met).

    A first ball that contains zero, and one of a closed form, may be wide because the precision was low, which says nothing of
    the solutions: then the precision is `doubled`.
    """
    if not y.is_finite():
        return prec
    if y.is_exact():
        return 0
    goal = int(digits * 3.3219280948873626) + 2
    if y.contains(0) and doubled:
        return prec
    if y.contains(0):  # if the solution is the recessive one, twice the growth of the others is lost
        return max(prec, 2 * _lost(y, prec) + goal - prec)
    return max(0, goal - int(y.rel_accuracy_bits()))


def _is_telling(result: PointValue, runs: int) -> bool:
    """Does the size of the ball tell of more than a precision that was too low at first?"""
    return runs > 2 or not result.y.contains_zero()


def _lost(y: acb, prec: int) -> int:
    """By how many bits other solutions grow, seen by an enclosure that contains zero."""
    largest = y.abs_upper()
    return 0 if largest == 0 else max(0, upper_exponent(largest) + prec)


def _growth(result: PointValue) -> int:
    return _lost(result.state[0], result.route.bits) if result.y.contains_zero() else 0


def _reason(result: PointValue) -> str:
    if result.y.contains_zero():
        known = arb(result.y.rad).mid().str(2, radius=False)
        growth = _growth(result)
        power = in_a_message(growth * 30103 // 100000)  # as a decimal
        lost = f": other solutions grow to about 10^{power} on the way, so that as many digits are lost"
        return (
            f"the value can't be told from zero (|y| is at most about {known}): no relative accuracy was reached"
            f" with {result.route.bits} bits{lost if growth > 200 else ''}"
        )
    known = f"{max(0.0, result.y.digits):.1f}"
    return f"only {known} of {result.route.digits} digits: the initial values or the limits allow no more"

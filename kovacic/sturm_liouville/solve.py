"""From counts to the levels of a problem: its counter and its range, brackets, guesses, and the proof of each ball.

Where the ball is doesn't need a proof; that it is right is proven by two counts: at its lower end the upper count is at most k,
at its upper end the lower one at least k + 1.  So eigenvalue number k is inside, and no other if both are equalities.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import count
from typing import Any

from flint import arb

from kovacic.algebra.precision import working_precision
from kovacic.closed_form.order import ball
from kovacic.enclosure.ball import Ball, finite_ball
from kovacic.enclosure.frame import upper_exponent
from kovacic.errors import LimitExceeded
from kovacic.limits import check_time
from kovacic.sturm_liouville.ends import End, SingularEnd, at_threshold, end_of
from kovacic.sturm_liouville.levels import Count, Eigenvalues, Level, PeriodicCounter, SeparatedCounter
from kovacic.sturm_liouville.problem import Span, SturmProblem, kept

#: Attempts to count at a number, and to tell two levels apart or cut an end nearer to infinity.
_COUNT_ATTEMPTS = 5
#: Steps of the range's ends, each four times as far away.
_RANGE_STEPS = 24
#: Radii of a ball that are free of other levels on both sides of it: balls of neighbours are disjoint, also as printed.
_FREE_RADII = 16
#: Where an interval is divided; the next share is taken if a count fails, as it does at an eigenvalue.
_SHARES = tuple(arb(n) / 64 for n in (31, 37, 23, 41))


class _Near(LimitExceeded):
    """A number is so near to an eigenvalue that it isn't known on which side it lies."""

    def __init__(self) -> None:
        super().__init__("eigenvalues can't be told apart at this precision", limit="digits")


class Searcher:
    """Levels from a counter, which is for a range of E and a number of digits; balls have `digits` of them."""

    def __init__(self, counter: Any, digits: int) -> None:
        self.counter = counter
        self.digits = digits
        self.bits = 40 + int(counter.digits * 3.33)
        self.unit = arb(0)
        self._known: dict[tuple[Any, bool], Count] = {}

    def at(self, E: Any, *, high: bool = False, attempts: int = _COUNT_ATTEMPTS) -> Count:
        """The count at E, the precision raised by half at each attempt; raises `_Near` if E is too near to an eigenvalue."""
        key = (E.man_exp(), high)
        if key in self._known:
            return self._known[key]
        bits = self.bits
        for _ in range(attempts):
            check_time()
            found: Count = self.counter.at(E, bits, high=high)
            if found.count is not None:
                self._known[key] = found
                return found
            bits += max(bits // 2, 64)
            if found.mismatch is None:  # other numbers need that, too
                self.bits = bits
        raise _Near

    def range_with(self, low: Any, high: Any) -> tuple[Count, Count]:
        """N at the ends of a range, the lower end being below all levels.  Raises `LimitExceeded`."""
        below, above = self.at(low), self.at(high)
        if self.at(low, high=True).count != 0:
            raise LimitExceeded("the levels weren't counted", limit="digits")
        with working_precision(64):
            self.unit = ((above.E - below.E) / (1024 * max(above.count, 1))).mid()
        return below, above

    def between(self, a: Any, b: Any) -> Count:
        """N somewhere near the middle of an interval; raises `_Near` if it can't be counted at any of the shares."""
        for share in _SHARES:
            with suppress(_Near):
                return self.at(self._rounded(a + (b - a) * share, b - a))
        raise _Near

    def _rounded(self, E: Any, unit: Any) -> Any:
        """A dyadic number with few digits, within 2^-8 of the unit."""
        with working_precision(2 * self.bits + 200):
            power = arb(2) ** (upper_exponent(unit) - 9)
            return ((E / power).floor() * power).mid()

    def radius(self, a: Count, b: Count, digits: int) -> Any:
        """The radius of a ball with this many digits, for a level between two numbers: relative to it, or to a larger unit."""
        with working_precision(64):
            return (max(abs(a.E), abs(b.E), self.unit) / (4 * arb(10) ** digits)).mid()

    def _radius_inside(self, E: Any, free: tuple[Any, Any], a: Count, b: Count) -> Any:
        """The radius of a ball about E with all digits, far from the ends of an interval that is free of other levels."""
        least, most = free
        room = min(E - least, most - E) / _FREE_RADII
        return min(self.radius(a, b, self.digits), room).mid()

    def bracket(self, k: int, low: Count, high: Count) -> tuple[Count, Count]:
        """The nearest known counts around level k, halved until no other level is between, or they are too near."""
        known = [low, high, *(c for (_, upper), c in self._known.items() if not upper)]
        a = max((c for c in known if c.count <= k), key=lambda c: c.E)
        b = min((c for c in known if c.count > k), key=lambda c: c.E)
        while (a.count, b.count) != (k, k + 1):
            with working_precision(2 * self.bits):
                width = b.E - a.E
                if width < self.radius(a, b, self.counter.digits):
                    break
                middle = self.between(a.E, b.E)
            a, b = (middle, b) if middle.count <= k else (a, middle)
        return a, b

    def level(self, k: int, low: Count, high: Count) -> tuple[Any, Any] | None:
        """The lower and the upper end of a ball with level k alone in it; None if more digits are needed."""
        a, b = self.bracket(k, low, high)
        if (a.count, b.count) != (k, k + 1):
            return None
        free = a.E, b.E
        with suppress(_Near):
            for _ in range(8):
                guess, a, b = self._refined(k, a, b, free)
                with working_precision(2 * self.bits):
                    radius = self._radius_inside(guess, free, a, b)
                    lower, upper = (self._rounded(guess + sign * radius, radius) for sign in (-1, 1))
                below, above = self.at(lower), self.at(upper)
                if below.count == k and above.count == k + 1:
                    # The upper count has to say the same as the lower one.
                    upper_counts = [self.at(E, high=self.counter.is_bracket).count for E in (lower, upper)]
                    return (lower, upper) if upper_counts == [k, k + 1] else None
                a, b = (a, below) if below.count > k else (above, b)
        return None

    def _refined(self, k: int, a: Count, b: Count, free: tuple[Any, Any]) -> tuple[Any, Count, Count]:
        """A number near the zero of the mismatch in (a, b): regula falsi with bisections."""
        fa, fb = a.mismatch, b.mismatch
        E = last = a.E
        side = 0
        with working_precision(2 * self.bits):
            before = b.E - a.E
            for number in count():
                E = ((a.E * fb - b.E * fa) / (fb - fa)).mid()
                width = b.E - a.E
                is_slow = number % 4 == 3 and width * 4 > before
                if number % 4 == 3:
                    before = width
                # Far from a level the mismatch is exponential in E: the zero of a chord would be next to one end.
                is_steep = number < 4 and not abs(fa) / 1000 < abs(fb) < abs(fa) * 1000
                if is_slow or is_steep or not a.E < E < b.E:
                    E = ((a.E + b.E) / 2).mid()
                radius = self._radius_inside(E, free, a, b)
                if abs(E - last) < radius / 16 or width < radius:
                    break
                last = E
                try:
                    c = self.at(self._rounded(E, radius / 64), attempts=2)
                except _Near:
                    break
                if c.count <= k:
                    fb = _weighted(fb, c.mismatch, fa) if side < 0 else fb
                    a, fa, side = c, c.mismatch, -1
                else:
                    fa = _weighted(fa, c.mismatch, fb) if side > 0 else fa
                    b, fb, side = c, c.mismatch, 1
        return E, a, b


def _weighted(other: Any, new: Any, old: Any) -> Any:
    """The value at the end that stays, made smaller [Anderson and Bjorck]: else regula falsi would keep that end for long."""
    factor = 1 - new / old
    return other * (factor if factor > 0 else arb(1) / 2)


def _ball(low: Any, high: Any) -> Ball:
    with working_precision(64 + 2 * max(low.bits(), high.bits())):
        return finite_ball(low.union(high))


@dataclass
class Eigenproblem:
    """A problem as read; `levels` computes its lowest levels, one after the other.

    `complete`: these are all, as is proven; `exhausted`: others may be too near to the essential spectrum to be counted.
    """

    problem: SturmProblem
    parameter: str
    notes: tuple[str, ...] = ()
    complete: bool = False
    exhausted: bool = False
    _found: list[Level] = field(default_factory=list)

    @cached_property
    def ends(self) -> tuple[End, End]:
        """The ends of separated conditions.  Raises `InputError` for conditions that don't fit them."""
        return end_of(self.problem, 0), end_of(self.problem, 1)

    @cached_property
    def threshold(self) -> Any:
        """The bottom of the essential spectrum; None if there is none."""
        if self.problem.wrap:
            return None
        finite = [end.threshold for end in self.ends if end.threshold is not None]
        return min(finite, key=lambda e: float(ball(e).mid())) if finite else None

    @cached_property
    def scale(self) -> Any:
        """An exact number of the size of the lowest levels, pi^2/(length^2 W), for a finite interval; else 1."""
        low, high = self.problem.ends
        if low.is_infinite or high.is_infinite:
            return arb(1)
        with working_precision(64):
            length = ball(high) - ball(low)
            _, W = self.problem.around((ball(low) + length * 3 / 7).mid())
            return (10 / (length**2 * W)).mid()

    @property
    def total(self) -> int | None:
        """The number of levels below the essential spectrum; None if it isn't proven."""
        first, second = (at_threshold(end, self.threshold) for end in self.ends)
        if first is None or second is None:
            return None
        with working_precision(128):
            bottom = ball(self.threshold)
        counter = SeparatedCounter(self.problem, (first, second), Span(bottom.upper(), abs(bottom).upper()), digits=6)
        found: int | None = counter.at(bottom, 128, high=True).count
        return found

    def levels(self, count: int, digits: int) -> Iterator[Level]:
        """The lowest levels, `count` at most.  Raises `InputError` and `LimitExceeded`."""
        low, high, number = self._range(count)
        k = 0
        while k < number:
            for level in self._next(k, low, high, digits):
                found = level if self.problem.sign == 1 else replace(level, value=-level.value)
                self._found.append(found)
                yield found
                k += 1

    def _next(self, k: int, low: Any, high: Any, digits: int) -> list[Level]:
        """Level k, or all that share its ball."""
        # Pairs of periodic levels often coincide, whatever the number of digits.
        for attempt in range(2 if self.problem.wrap else _COUNT_ATTEMPTS):
            searcher = self._searcher(high, max(abs(low), abs(high)), digits, digits * 2**attempt)
            below, above = searcher.range_with(low, high)
            ends = searcher.level(k, below, above)
            if ends is not None:
                return [Level(_ball(*ends), searcher.counter.zeros(k))]
        a, b = searcher.bracket(k, below, above)
        if searcher.at(a.E, high=True).count != k or b.count < k + 2:
            raise LimitExceeded(f"level number {k} wasn't found to {digits} digits", limit="digits")
        return [Level(_ball(a.E, b.E), searcher.counter.zeros(n), alone=False) for n in range(k, b.count)]

    @kept
    def _searcher(self, high: Any, size: Any, digits: int, more: int) -> Searcher:
        """For |E| <= size and E <= high, balls with `digits` digits, and counts with `more`."""
        span = Span(high, size)
        if self.problem.wrap:
            return Searcher(PeriodicCounter(self.problem, span, more), digits)
        return Searcher(SeparatedCounter(self.problem, self.ends, span, more), digits)

    def _range(self, count: int) -> tuple[Any, Any, int]:
        """A number below all levels, one above the `count` lowest levels or above all, and how many are between."""
        bottom = None if self.threshold is None else ball(self.threshold)
        low = self._free_of_levels(bottom)
        total = None
        # Each step towards the essential spectrum leaves a quarter of the distance, and needs a longer interval.
        for number in range(_RANGE_STEPS if bottom is None else 7):
            with working_precision(64):
                power = arb(4) ** number
                E = self._short(self.scale * power * 15 / 16 if bottom is None else bottom - self.scale / (4 * power))
            found = self._rough(E, low, high=False)
            if found.count >= count:
                return low, found.E, count
            if bottom is not None and number == 0:
                total = self.total
            if found.count == total:
                self.complete = True
                return low, found.E, found.count
        if bottom is None:
            raise LimitExceeded(f"{count} levels weren't found", limit="unknown_degree")
        self.exhausted = True
        return low, found.E, found.count

    def _free_of_levels(self, bottom: Any) -> Any:
        """A number below all levels."""
        start = -self.scale / 7 if bottom is None else bottom - self.scale
        with working_precision(64):
            for number in range(_RANGE_STEPS):
                E = self._short(start - self.scale * (arb(4) ** number - 1))
                found = self._rough(E, E, high=True)
                if found.count == 0:
                    return found.E
        raise LimitExceeded("no lower bound of the levels was found", limit="unknown_degree")

    def _short(self, E: Any) -> Any:
        """A dyadic number near E, with few digits."""
        unit = arb(2) ** (upper_exponent(abs(E) + self.scale / 2**20) - 31)
        return ((E / unit).floor() * unit).mid()

    def _rough(self, E: Any, low: Any, *, high: bool) -> Count:
        """The count at E, or a little below where E may be a level itself."""
        searcher = self._searcher(E, max(abs(low), abs(E)), 4, 4)
        for shift in range(3):
            with suppress(_Near):
                return searcher.at(self._short(E - self.scale * shift / 2**20), high=high)
        raise _Near

    def answer(self, reason: str = "") -> Eigenvalues:
        """The levels found so far, with notes, and the reason why there aren't more."""
        notes = (*self.notes, *([reason] if reason else self._said()))
        return Eigenvalues(tuple(self._found), self.complete and not reason, self.parameter, notes, self.problem)

    def _said(self) -> Iterator[str]:
        """Notes on assumptions, and on claims that aren't proven."""
        if not self.problem.wrap:
            x = self.problem.x
            for end, wish in zip(self.ends, self.problem.conditions, strict=True):
                if isinstance(end, SingularEnd) and wish is None and not end.square >= 1:
                    said = f"at {x} = {end.at} all solutions are square integrable"
                    yield f"{said}: the smallest one is meant (Friedrichs)"
        if self.threshold is not None:
            yield f"the essential spectrum begins at {self.parameter} = {self.problem.sign * self.threshold}"
            if self.exhausted:
                yield "whether there are others that are nearer to it isn't proven"

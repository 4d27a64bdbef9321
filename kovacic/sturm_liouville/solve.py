"""The levels of a problem: its counter, its range, and the notes on it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import Any

from flint import arb

from kovacic.algebra.precision import working_precision
from kovacic.closed_form.balls import BallEvaluator
from kovacic.sturm_liouville.count import PeriodicCounter, SeparatedCounter
from kovacic.sturm_liouville.ends import End, SingularEnd, at_threshold, end_of
from kovacic.sturm_liouville.levels import Eigenvalues, Level
from kovacic.sturm_liouville.problem import Span, SturmProblem, ball
from kovacic.sturm_liouville.search import LevelSearch

#: Bits of the count at the bottom of the essential spectrum, which has to be one of few levels.
_TOTAL_BITS = 128
#: Pairs of periodic levels often coincide: twice the digits are tried, not more.
_PERIODIC_SEPARATIONS = 2


@dataclass(frozen=True)
class Eigenproblem:
    """A problem as read; `levels` computes its lowest levels, one after the other."""

    problem: SturmProblem
    parameter: str
    notes: tuple[str, ...] = ()
    _found: list[Level] = field(default_factory=list, compare=False, repr=False)

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
    def search(self) -> LevelSearch:
        """The search for the levels."""
        if self.problem.wrap:
            return LevelSearch(partial(PeriodicCounter, self.problem), self._scale(), separations=_PERIODIC_SEPARATIONS)
        threshold = None if self.threshold is None else ball(self.threshold)
        counter = partial(SeparatedCounter, self.problem, self.ends)
        return LevelSearch(counter, self._scale(), threshold=threshold, total=self._total)

    def _scale(self) -> Any:
        """An exact number of the size of the lowest levels, pi^2/(length^2 W), for a finite interval; else 1."""
        low, high = self.problem.ends
        if low.is_infinite or high.is_infinite:
            return arb(1)
        with working_precision(64):
            middle = (ball(low) + (ball(high) - ball(low)) * 3 / 7).mid()
            pieces = self.problem.pieces
            piece = next((p for p in pieces if p.high.is_infinite or middle < ball(p.high)), pieces[-1])
            weight = BallEvaluator({self.problem.x: middle})(piece.W).real
            return (10 / ((ball(high) - ball(low)) ** 2 * weight)).mid()

    def _total(self) -> int | None:
        """The number of levels below the essential spectrum; None if it isn't proven."""
        ends = [at_threshold(end, self.threshold) for end in self.ends]
        first, second = ends
        if first is None or second is None:
            return None
        with working_precision(_TOTAL_BITS):
            bottom = ball(self.threshold)
        counter = SeparatedCounter(self.problem, (first, second), Span(bottom.upper(), abs(bottom).upper()), digits=6)
        return counter.at(bottom, _TOTAL_BITS, high=True).count

    def levels(self, count: int, digits: int) -> Iterator[Level]:
        """The lowest levels, `count` at most.  Raises `InputError` and `LimitExceeded`."""
        for level in self.search.levels(count, digits):
            value = level.value if self.problem.sign == 1 else -level.value
            found = Level(value, level.zeros, level.alone)
            self._found.append(found)
            yield found

    def answer(self, reason: str = "") -> Eigenvalues:
        """The levels found so far, with notes, and the reason why there aren't more."""
        found = tuple(self._found)
        if reason:
            return Eigenvalues(found, False, self.parameter, (*self.notes, reason), self.problem)
        notes = (*self.notes, *self._said())
        return Eigenvalues(found, self.search.complete, self.parameter, notes, self.problem)

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
            if self.search.exhausted and not self.search.complete:
                yield "whether there are others that are nearer to it isn't proven"

"""A clock that a test controls: limits of time are tested without waiting, and whatever else the machine does."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from kovacic.limits import CLOCK


class Hands:
    """The time since midnight: it passes by `step` with each look at the clock, and as the test says."""

    def __init__(self, step: float = 0.0) -> None:
        self.step = step
        self.time = 0.0
        self.looks = 0

    def __call__(self) -> float:
        self.looks += 1
        self.time += self.step
        return self.time

    def move(self, seconds: float) -> None:
        self.time += seconds


@contextmanager
def controlled(step: float = 0.0) -> Iterator[Hands]:
    """Inside `with`, all limits read this clock.  With a step, a look costs time, and so a search without end ends."""
    hands = Hands(step)
    with CLOCK.read_from(hands):
        yield hands

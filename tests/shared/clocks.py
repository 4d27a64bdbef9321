"""A clock that a test controls: limits of time are tested without waiting, and whatever else the machine does."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import count
from math import inf
from types import FrameType
from unittest.mock import patch

from kovacic.limits import CLOCK


class Hands:
    """The time since midnight: it passes by `step` with each look at the clock, and as the test says."""

    def __init__(self, step: float = 0.0, looks_in_time: float = inf) -> None:
        self.step = step
        self.looks_in_time = looks_in_time
        self.time = 0.0
        self.looks = 0

    def __call__(self) -> float:
        self.looks += 1
        self.time += self.step if self.looks <= self.looks_in_time else 1000
        return self.time

    @property
    def late_looks(self) -> float:
        """How often somebody has looked since the time is over for all, the first one included."""
        return max(0, self.looks - self.looks_in_time)

    def move(self, seconds: float) -> None:
        self.time += seconds


@contextmanager
def controlled(step: float = 0.0, looks_in_time: float = inf) -> Iterator[Hands]:
    """Inside `with`, all limits read this clock.

    With a step, a look costs time, and so a search without end ends.  After `looks_in_time` looks, each takes 1000 s.
    """
    hands = Hands(step, looks_in_time)
    with patch.object(CLOCK, "now", hands):
        yield hands


@contextmanager
def interrupted(looks: int) -> Iterator[None]:
    """Inside `with`, the user presses Ctrl-C at this look at the clock, the first one being 1."""
    looked = count(1)

    def source() -> float:
        if next(looked) == looks:
            raise KeyboardInterrupt
        return 0.0

    with patch.object(CLOCK, "now", source):
        yield


class Stretches:
    """How many Python functions are called from one look at the clock to the next one: the longest work without a look."""

    def __init__(self) -> None:
        self.calls = 0
        self.longest = 0

    def __call__(self) -> float:
        self.longest = max(self.longest, self.calls)
        self.calls = 0
        return 0.0

    def count(self, _frame: FrameType, event: str, _argument: object) -> None:
        self.calls += event == "call"


@contextmanager
def stretches() -> Iterator[Stretches]:
    """Inside `with`, the time stands still, and the work between looks at the clock is counted."""
    counted = Stretches()
    with patch.object(CLOCK, "now", counted):
        sys.setprofile(counted.count)
        try:
            yield counted
        finally:
            sys.setprofile(None)
            counted()

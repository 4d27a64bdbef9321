"""What a batch has found, in numbers."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from math import floor, log

from kovacic.batch.items import ERROR, FAILED, LABELS, UNDECIDED, Record

# The times are kept in classes that are 5 % wide, so that the memory doesn't grow with the batch.
_CLASS_RATIO = 1.05
_SHORTEST = 1e-6


class Summary:
    """Counts by case, and the quantiles of the time of an equation to within 5 %."""

    def __init__(self) -> None:
        self.counts: Counter[str] = Counter()
        self.slowest: Record | None = None
        self._times: Counter[int] = Counter()

    def add(self, record: Record) -> None:
        self.counts[record.label] += 1
        if self.slowest is None or record.seconds > self.slowest.seconds:
            self.slowest = record
        self._times[_time_class(record.seconds)] += 1

    @property
    def total(self) -> int:
        return self.counts.total()

    def quantile(self, q: float) -> float:
        """The time, in seconds, within which a fraction q of the equations was answered; 0 for an empty batch.

        >>> summary = Summary()
        >>> for k in range(1, 101):
        ...     summary.add(Record(k, "none", k / 100, ""))
        >>> 0.48 <= summary.quantile(0.5) <= 0.53
        True
        """
        seen = 0
        for time_class in sorted(self._times):
            seen += self._times[time_class]
            if seen >= q * self.total:
                return float(_SHORTEST * _CLASS_RATIO ** (time_class + 0.5))
        return 0.0

    def rows(self) -> Iterator[tuple[str, int]]:
        """The labels that occur, in their order, with their counts."""
        return ((label, self.counts[label]) for label in LABELS if self.counts[label])

    @property
    def exit_status(self) -> int:
        """As for `kovacic solve`: 4 if a self-check failed, else 2 if an input was bad, else 3 if one is undecided, else 0."""
        if self.counts[FAILED]:
            return 4
        if self.counts[ERROR]:
            return 2
        return 3 if self.counts[UNDECIDED] else 0


def _time_class(seconds: float) -> int:
    return floor(log(max(seconds, _SHORTEST) / _SHORTEST) / log(_CLASS_RATIO))


__all__ = ["Summary"]

"""Initial value problems in mpmath's arithmetic, to any number of digits: extrapolation of the explicit midpoint rule.

The rule with n = 2j steps has an error that is a series in 1/n^2 [Gragg 1965]; row j of the table extrapolates the results
for 2, 4, ..., 2j steps to order 2j.  Rows are added until the last two entries agree; a step that needs more rows than the
number of digits suggests is halved, one that needs few is followed by a longer one.  E. Hairer, S. P. Norsett, G. Wanner,
Solving Ordinary Differential Equations I, II.9.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import mpmath

from kovacic.errors import LimitExceeded

Rates = Callable[[Any, Sequence[Any]], list[Any]]

#: Digits carried beyond those asked for: the extrapolation's weights add up to a few powers of ten for each row.
GUARD = 25
_SMALLEST_STEP = mpmath.mpf(2) ** -40


def extrapolate(rates: Rates, start: Sequence[Any], times: Sequence[Any], *, digits: int) -> list[list[Any]]:
    """The solution of y' = rates(t, y) with y(0) = `start`, at each of `times` (monotonic, forwards or backwards from 0).

    The error of each step is below 10^-(digits + 3), estimated by the difference of the last two columns; it isn't a proven
    bound.  Raises `LimitExceeded` where a step would have to be shorter than 2^-40: at a singularity.

    >>> [[value]] = extrapolate(lambda t, y: [y[0]], [1], [1], digits=40)
    >>> with mpmath.workdps(40):
    ...     print(value)
    2.718281828459045235360287471352662497757
    """
    rows = max(6, 3 * digits // 5)
    states = []
    with mpmath.workdps(digits + GUARD):
        tolerance = mpmath.mpf(10) ** -(digits + 3)
        t, y, size = mpmath.mpf(0), [mpmath.mpf(value) for value in start], mpmath.mpf(1) / 4
        for end in map(mpmath.mpf, times):
            while t != end:
                whole = abs(end - t) <= size
                step = end - t if whole else mpmath.sign(end - t) * size
                ahead, used = _step(rates, t, y, step, tolerance, rows)
                if ahead is None:
                    size = abs(step) / 2
                    if size < _SMALLEST_STEP:
                        raise LimitExceeded(f"the steps become too short at t = {mpmath.nstr(t, 8)}", limit="steps")
                    continue
                t, y = end if whole else t + step, ahead
                if used <= 2 * rows // 3 and not whole:
                    size *= mpmath.mpf(3) / 2
            states.append(list(y))
    return states


def _step(rates: Rates, t: Any, y: Sequence[Any], step: Any, tolerance: Any, rows: int) -> tuple[list[Any] | None, int]:
    """The state after one step and the number of rows that it took; no state if `rows` rows don't suffice."""
    first = rates(t, y)
    above: list[list[Any]] = []
    for j in range(1, rows + 1):
        n = 2 * j
        h = step / n
        before, here = list(y), [p + h * q for p, q in zip(y, first, strict=True)]
        for k in range(1, n):
            slope = rates(t + k * h, here)
            before, here = here, [p + 2 * h * q for p, q in zip(before, slope, strict=True)]
        row = [here]
        for k in range(1, j):
            weight = 1 / ((mpmath.mpf(j) / (j - k)) ** 2 - 1)
            row.append([p + (p - q) * weight for p, q in zip(row[-1], above[k - 1], strict=True)])
        if j > 1 and max(abs(p - q) for p, q in zip(row[-1], row[-2], strict=True)) < tolerance:
            return row[-1], j
        above = row
    return None, rows

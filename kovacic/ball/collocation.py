"""Smooth autonomous equations y' = f(y) in double precision: Gauss's collocation with sixteen stages, solved by Picard's iteration.

A step of length h is the polynomial that satisfies the equation at the sixteen nodes; its error at the end is of order
h^33, between the nodes of order h^17, and quadratic integrals (lengths, angles) are kept up to rounding [E. Hairer, C. Lubich,
G. Wanner, Geometric Numerical Integration, II.1, IV.2].  The last Legendre coefficients of f(y) say how long a step may be.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from kovacic.errors import LimitExceeded

Array = NDArray[np.float64]
STAGES = 16
#: Of the last Legendre coefficients of a step's change, in the unknowns' own scales; the step's error is far smaller.
_TOLERANCE = 1e-13
_ITERATIONS = 40


@cache
def _tables() -> tuple[Array, Array, Array, Array]:
    """The nodes and weights on [-1, 1], the map from values there to Legendre coefficients, and the integrals from -1."""
    nodes, weights = legendre.leggauss(STAGES)
    transform = legendre.legvander(nodes, STAGES - 1).T * weights * (np.arange(STAGES)[:, None] + 0.5)
    return nodes, weights, transform, _integrals(nodes) @ transform


def _integrals(z: Array) -> Array:
    """The integrals of P_0, ..., P_15 from -1 to z, one row for each z."""
    P = legendre.legvander(z, STAGES)
    k = np.arange(1, STAGES)
    return np.column_stack([z + 1, (P[:, 2:] - P[:, :-2]) / (2 * k + 1)])


@dataclass(frozen=True, slots=True)
class Step:
    """The solution on [start, start + length]; `values` and `slopes` are y and f(y) at the nodes, at `times`."""

    start: float
    length: float
    begin: Array
    values: Array
    slopes: Array

    @property
    def times(self) -> Array:
        times: Array = self.start + self.length * (_tables()[0] + 1) / 2
        return times

    @property
    def end(self) -> Array:
        """y at the end."""
        result: Array = self.begin + self.length / 2 * np.tensordot(_tables()[1], self.slopes, 1)
        return result

    def __call__(self, times: Array) -> Array:
        """y at times within the step, one row each."""
        weights = _integrals(2 * (times - self.start) / self.length - 1) @ _tables()[2]
        result: Array = self.begin + self.length / 2 * np.tensordot(weights, self.slopes, 1)
        return result


@dataclass(slots=True)
class Solution:
    """y' = f(y) from y(0), as far as it has been asked for: `extend` takes one more step.

    `rates` maps states, one a row, to their derivatives.  `scale` holds the size of each unknown, in which errors are
    measured: about 1e-15 of it.
    """

    rates: Callable[[Array], Array]
    state: Array
    scale: Array
    length: float
    steps: list[Step]

    def extend(self) -> Step:
        """The next step.  Raises `LimitExceeded` where the steps become too short: at a singularity."""
        start = self.steps[-1].start + self.steps[-1].length if self.steps else 0.0
        shortest = self.length * 1e-9
        while True:
            step = self._attempt(start, self.length)
            tail = np.inf
            if step is not None:
                change = np.tensordot(_tables()[2][-2:], step.slopes, 1) * self.length
                tail = float(np.abs(change / self.scale).max())
            factor = 0.9 * (_TOLERANCE / max(tail, 1e-3 * _TOLERANCE)) ** (1 / STAGES)
            length = self.length * max(0.3, factor)
            if step is not None and tail <= _TOLERANCE:
                self.steps.append(step)
                self.state, self.length = step.end, length
                return step
            self.length = min(length, 0.7 * self.length)
            if not self.length > shortest:
                raise LimitExceeded(f"the steps become too short at t = {start:.6g}: the potential isn't smooth", limit="steps")

    def _attempt(self, start: float, length: float) -> Step | None:
        """One step by Picard's iteration; None if it doesn't converge."""
        nodes, integrate = _tables()[0], _tables()[3] * (length / 2)
        first = self.rates(self.state[None])
        values = self.state + (length / 2) * (nodes + 1).reshape(-1, *[1] * self.state.ndim) * first
        before = np.inf
        for _ in range(_ITERATIONS):
            slopes = self.rates(values)
            corrected = self.state + np.tensordot(integrate, slopes, 1)
            change = float(np.abs((corrected - values) / self.scale).max())
            values = corrected
            if change < 1e-15 or (change < 1e-12 and change > before / 4):  # the rounding errors' plateau
                return Step(start, length, self.state, values, self.rates(values))
            if not change < 1e3:
                return None
            before = change
        return None

    def __call__(self, times: Array) -> Array:
        """y at the given times within the steps taken, shape (n, *y)."""
        starts = np.array([step.start for step in self.steps])
        index = np.clip(np.searchsorted(starts, times, side="right") - 1, 0, len(starts) - 1)
        result = np.empty((len(times), *self.state.shape))
        for k in np.unique(index):
            result[index == k] = self.steps[k](times[index == k])
        return result

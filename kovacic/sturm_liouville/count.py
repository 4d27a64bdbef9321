"""N(E), the number of eigenvalues below E, for separated conditions.

Let the solutions of the ends have n1 zeros in (a, m] and n2 in [m, b), and the angles phi in (0, pi) with cot phi =
Y'/Y at m. The angle of the left one minus that of the right one, pi (n1 + n2) + phi1 - phi2, increases with E and is
pi k at the k-th eigenvalue, k = 0, 1, ...  So N(E) = n1 + n2 + 1 where phi1 > phi2, which is where Y1' Y2 - Y1 Y2' and
Y1 Y2 have opposite signs, and n1 + n2 where they have the same.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from flint import arb

from kovacic.algebra.precision import working_precision
from kovacic.sturm_liouville.discs import Road, march
from kovacic.sturm_liouville.ends import CutEnd, End
from kovacic.sturm_liouville.problem import Span, SturmProblem

_SAMPLES = 65
_MATCH = 0.43
"""The share of the oscillations that lies to the left of the point where the solutions are matched: no symmetric point."""


@dataclass(frozen=True)
class Reading:
    """N(E), and roughly an analytic function that is zero at the eigenvalues; None where the balls are too wide."""

    count: int | None
    mismatch: Any


class SeparatedCounter:
    """Counts for a range of E, with ends cut so that `digits` digits are right."""

    def __init__(self, problem: SturmProblem, ends: tuple[End, End], span: Span, digits: int) -> None:
        self.span = span
        self.digits = digits
        self.ends = ends
        self.road = Road(problem, span)
        with working_precision(64 + 4 * digits):
            self.positions = tuple(end.position(span, digits) for end in ends)
            self.middle = self._matching_point()

    @property
    def is_bracket(self) -> bool:
        """True if the upper and the lower count may differ."""
        return any(isinstance(end, CutEnd) for end in self.ends)

    def _matching_point(self) -> Any:
        """Where a share of the oscillations at the largest E lies to the left; any point would do."""
        low, high = (position.mid() for position in self.positions)
        points = [(low + (high - low) * k / _SAMPLES).mid() for k in range(1, _SAMPLES)]
        depths = [(-self.road.value(point, self.span.high)).max(arb(0)).sqrt() for point in points]
        total = sum(depths)
        if not total > 0:
            return points[int(_SAMPLES * _MATCH)]
        so_far = arb(0)
        for point, depth in zip(points, depths, strict=True):
            so_far += depth
            if so_far > total * _MATCH:
                return point
        return points[-1]

    def at(self, E: Any, prec: int, *, high: bool = False) -> Reading:
        """The lower count, or the upper one if `high`."""
        motions = []
        with working_precision(prec):
            for end in self.ends:
                position = end.position(self.span, self.digits)
                u, v = end.state(E, self.span, position, high=high)
                motions.append(march(self.road.steps(position, self.middle, prec), u, v, E))
            left, right = motions
            if left is None or right is None:
                return Reading(None, None)
            mismatch = left.v * right.u - left.u * right.v
            against = mismatch * left.u * right.u
            zeros = left.zeros + right.zeros
        if against < 0:
            return Reading(zeros + 1, mismatch.mid())
        if against > 0:
            return Reading(zeros, mismatch.mid())
        return Reading(None, mismatch.mid())

    def zeros(self, k: int) -> int:
        """Of the eigenfunction number k, inside the interval."""
        return k

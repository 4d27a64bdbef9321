"""N(E), the number of eigenvalues below E, from zeros of solutions.

Separated conditions: let the solutions of the ends have n1 zeros in (a, m] and n2 in [m, b), and the angles phi in (0, pi)
with cot phi = Y'/Y at m.  The angle of the left one minus that of the right one, pi (n1 + n2) + phi1 - phi2, increases with E
and is pi k at the k-th eigenvalue, k = 0, 1, ...  So N(E) = n1 + n2 + 1 where phi1 > phi2, which is where Y1' Y2 - Y1 Y2' and
Y1 Y2 have opposite signs, and n1 + n2 where they have the same.

Periodic and antiperiodic conditions: let c and s be the solutions with (c, p c') = (1, 0) and (s, p s') = (0, 1) at the left
end, D = c + p s' at the right one, and n the number of zeros of s inside, which is the number of Dirichlet eigenvalues
mu_1 < mu_2 < ... below E.  With periodic eigenvalues P_0 < P_1 <= P_2 < ... and antiperiodic ones A_1 <= A_2 < A_3 <= ...,

    P_0 < A_1 <= mu_1 <= A_2 < P_1 <= mu_2 <= P_2 < A_3 <= mu_3 <= A_4 < ...

(Magnus & Winkler, Hill's Equation, 2.1), D > 2 between P_(2j-1) and P_(2j) and below P_0, and D < -2 between A_(2j-1)
and A_(2j). So D and n tell how many of either kind are below E.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from flint import arb

from kovacic.algebra.precision import working_precision
from kovacic.sturm_liouville.discs import Road, march
from kovacic.sturm_liouville.ends import CutEnd, End
from kovacic.sturm_liouville.problem import Span, SturmProblem, ball

#: Parts of the interval, at whose ends the depth of the well is sampled; 65 avoids its middle.
_DEPTH_SAMPLES = 65
#: The share of the oscillations to the left of the point where the solutions are matched: no symmetric point.
_MATCH = 0.43


@dataclass(frozen=True)
class Reading:
    """N(E), None if the balls are too wide, and the approximate value of an analytic function that is 0 at the eigenvalues."""

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
        """The point with the share `_MATCH` of the oscillations at the largest E to its left; any point would do."""
        low, high = (position.mid() for position in self.positions)
        points = [(low + (high - low) * k / _DEPTH_SAMPLES).mid() for k in range(1, _DEPTH_SAMPLES)]
        depths = [(-self.road.value(point, self.span.high)).max(arb(0)).sqrt() for point in points]
        total = sum(depths)
        if not total > 0:
            return points[int(_DEPTH_SAMPLES * _MATCH)]
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


class PeriodicCounter:
    """Counts for a range of E, by Hill's discriminant."""

    is_bracket = False

    def __init__(self, problem: SturmProblem, span: Span, digits: int) -> None:
        self.problem = problem
        self.digits = digits
        self.road = Road(problem, span)

    def at(self, E: Any, prec: int, *, high: bool = False) -> Reading:
        """The count; upper and lower one are the same."""
        with working_precision(prec):
            low, end = map(ball, self.problem.ends)
            first, last = (ball(self.problem.slope(at)) for at in self.problem.ends)
            steps = self.road.steps(low, end, prec)
            odd = march(steps, arb(0), arb(1), E)
            if odd is None:
                return Reading(None, None)
            c, dc = arb(1), first
            for step in steps:
                c, dc = step.advance(c, dc, E)
            discriminant = c + odd.v - last * odd.u
            excess = discriminant - 2 * self.problem.wrap
            mismatch = excess.mid()
            if excess.contains(0):
                return Reading(None, mismatch)
            is_above = excess > 0
        n = odd.zeros
        return Reading(2 * ((n + 1) // 2) if is_above else 2 * (n // 2) + 1, mismatch)

    def zeros(self, k: int) -> int:
        """Of the eigenfunction number k in one period."""
        if self.problem.wrap == 1:
            return 2 * ((k + 1) // 2)
        return 2 * (k // 2) + 1

"""N(E) for periodic and antiperiodic conditions, from Hill's discriminant.

Let c and s be the solutions with (c, p c') = (1, 0) and (s, p s') = (0, 1) at the left end, D = c + p s' at the right
one, and n the number of zeros of s inside, which is the number of Dirichlet eigenvalues mu_1 < mu_2 < ... below E.
With periodic eigenvalues P_0 < P_1 <= P_2 < ... and antiperiodic ones A_1 <= A_2 < A_3 <= ...,

    P_0 < A_1 <= mu_1 <= A_2 < P_1 <= mu_2 <= P_2 < A_3 <= mu_3 <= A_4 < ...

(Magnus & Winkler, Hill's Equation, 2.1), D > 2 between P_(2j-1) and P_(2j) and below P_0, and D < -2 between A_(2j-1)
and A_(2j). So D and n tell how many of either kind are below E.
"""

from __future__ import annotations

from typing import Any

from flint import arb

from kovacic.algebra.precision import working_precision
from kovacic.sturm_liouville.count import Reading
from kovacic.sturm_liouville.discs import Road, march
from kovacic.sturm_liouville.problem import Span, SturmProblem, ball


class PeriodicCounter:
    """As `kovacic.sturm_liouville.count.SeparatedCounter`."""

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

"""N(E), the number of eigenvalues below E, from zeros of solutions; and the results of `kovacic.eigenvalues`.

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

Eigenfunctions, for pictures, are the solutions of the two ends, joined at the point of the counts; nothing about them is
proven.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import accumulate
from typing import Any, overload

import sympy
from flint import acb, arb

from kovacic.algebra.precision import working_precision
from kovacic.closed_form.jets import BallEvaluator
from kovacic.closed_form.order import ball
from kovacic.enclosure.ball import Ball, ball_to_flint
from kovacic.errors import InputError
from kovacic.sturm_liouville.discs import Road, march
from kovacic.sturm_liouville.ends import CutEnd, End, end_of
from kovacic.sturm_liouville.problem import Span, SturmProblem


@dataclass(frozen=True)
class Count:
    """N at an exact number E, and the approximate value of an analytic function that is 0 at the eigenvalues.

    `count` is None if the balls are too wide, and so is `mismatch` if they are much too wide.
    """

    E: Any
    count: Any
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
            self.middle = self._matching_point(problem)

    @property
    def is_bracket(self) -> bool:
        """True if the upper and the lower count may differ."""
        return any(isinstance(end, CutEnd) for end in self.ends)

    def _matching_point(self, problem: SturmProblem) -> Any:
        """A point with some 43 % of the oscillations at the largest E to its left; any point would do, but symmetric ones."""
        low, high = (position.mid() for position in self.positions)
        points = [(low + (high - low) * k / 65).mid() for k in range(1, 65)]
        # Where nothing oscillates, all points count alike.
        depths = [(self.span.high * W - Q).max(arb(2) ** -200).sqrt() for Q, W in map(problem.around, points)]
        *_, total = so_far = [*accumulate(depths)]
        return next(point for point, depth in zip(points, so_far, strict=True) if depth > total * 0.43)

    def at(self, E: Any, prec: int, *, high: bool = False) -> Count:
        """The lower count, or the upper one if `high`."""
        motions = []
        with working_precision(prec):
            for end in self.ends:
                position = end.position(self.span, self.digits)
                u, v = end.state(E, self.span, position, high=high)
                motions.append(march(self.road.steps(position, self.middle, prec), u, v, E))
            left, right = motions
            if left is None or right is None:
                return Count(E, None, None)
            mismatch = left.v * right.u - left.u * right.v
            against = mismatch * left.u * right.u
            zeros = left.zeros + right.zeros
        return Count(E, None if against.contains(0) else zeros + int(against < 0), mismatch.mid())

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

    def at(self, E: Any, prec: int, *, high: bool = False) -> Count:
        """The count; the upper and the lower one are equal."""
        with working_precision(prec):
            low, end = map(ball, self.problem.ends)
            first, last = (ball(self.problem.slope(at)) for at in self.problem.ends)
            steps = self.road.steps(low, end, prec)
            odd = march(steps, arb(0), arb(1), E)
            if odd is None:
                return Count(E, None, None)
            c, dc = arb(1), first
            for step in steps:
                c, dc = step.advance(c, dc, E)
            discriminant = c + odd.v - last * odd.u
            excess = discriminant - 2 * self.problem.wrap
        if excess.contains(0):
            return Count(E, None, excess.mid())
        n = odd.zeros
        return Count(E, 2 * ((n + 1) // 2) if excess > 0 else 2 * (n // 2) + 1, excess.mid())

    def zeros(self, k: int) -> int:
        """Of the eigenfunction number k in one period."""
        return 2 * ((k + 1) // 2) if self.problem.wrap == 1 else 2 * (k // 2) + 1


@dataclass(frozen=True)
class Level:
    """An eigenvalue.

    Attributes
    ----------
    value : Ball
        A ball that contains the eigenvalue and, if `alone`, no other one.
    zeros : int
        The zeros of the eigenfunction inside the interval (for periodic conditions: in a period), proven.
    alone : bool
        False where the ball contains two eigenvalues that weren't separated: they may coincide, as periodic conditions allow,
        and each of the two is listed with the same ball.
    """

    value: Ball
    zeros: int
    alone: bool = True

    def __str__(self) -> str:
        zeros = "1 zero" if self.zeros == 1 else f"{self.zeros} zeros"
        pair = "" if self.alone else ", one of a pair that wasn't separated"
        return f"{self.value}  ({zeros}{pair})"


@dataclass(frozen=True)
class Eigenvalues(Sequence[Level]):
    """Consecutive eigenvalues as proven numbers, a sequence of `Level`: frozen and picklable.

    Attributes
    ----------
    levels : tuple of Level
        In order; none is left out between the first and the last.
    complete : bool
        True if it is proven that there are no others (below the essential spectrum).
    parameter : str
        The name of the eigenvalue.
    notes : tuple of str
        Assumptions, and claims that aren't proven.

    Examples
    --------
    >>> import kovacic
    >>> well = kovacic.eigenvalues("y'' + lambda*y = 0", "y(0)=0, y(pi)=0", count=3)
    >>> [round(float(level.value), 9) for level in well]
    [1.0, 4.0, 9.0]
    >>> well[2].zeros, well[2].value.contains(9), well.complete
    (2, True, False)
    """

    levels: tuple[Level, ...]
    complete: bool = False
    parameter: str = "lambda"
    notes: tuple[str, ...] = ()
    problem: Any = field(default=None, compare=False, repr=False)

    @overload
    def __getitem__(self, index: int) -> Level: ...

    @overload
    def __getitem__(self, index: slice) -> tuple[Level, ...]: ...

    def __getitem__(self, index: int | slice) -> Level | tuple[Level, ...]:
        return self.levels[index]

    def __len__(self) -> int:
        return len(self.levels)

    def __iter__(self) -> Iterator[Level]:
        return iter(self.levels)

    def __str__(self) -> str:
        lines = [f"{self.parameter} = {level}" for level in self.levels]
        if not lines:
            lines = ["no eigenvalues"] if self.complete else ["no eigenvalues were found"]
        elif self.complete:
            lines.append("these are all eigenvalues")
        return "\n".join([*lines, *self.notes])

    def wave(self, k: int) -> Callable[[Any], Any]:
        """The eigenfunction of level k for pictures: not proven, scaled to a maximum of 1.

        A function for arrays of NumPy, 0 beyond the end of its decay.  Raises `InputError` for periodic problems.

        Parameters
        ----------
        k : int
            Its place in this sequence.

        Examples
        --------
        >>> import kovacic
        >>> y = kovacic.eigenvalues("y'' + lambda*y = 0", "y(0)=0, y(1)=0", count=2).wave(0)
        >>> round(float(y(0.5)), 3)
        1.0
        """
        import numpy as np

        x, y = wave_samples(self.problem, self.levels[k].value)
        return partial(np.interp, xp=np.array(x), fp=np.array(y), left=0.0, right=0.0)

    def to_dict(self) -> dict[str, Any]:
        """For JSON: text, and numbers that are exact."""
        levels = [{"value": lv.value.to_dict(), "zeros": lv.zeros, "alone": lv.alone} for lv in self.levels]
        return {"parameter": self.parameter, "levels": levels, "complete": self.complete, "notes": list(self.notes)}


_PICTURE_BITS = 160


def wave_samples(problem: SturmProblem, value: Ball) -> tuple[list[float], list[float]]:
    """Points x in order, and y there, at most 1 in modulus.  Raises `InputError` for periodic conditions."""
    if problem.wrap:
        raise InputError("functions of periodic problems aren't drawn")
    with working_precision(_PICTURE_BITS):
        E = problem.sign * ball_to_flint(value).real.mid()
        ends = end_of(problem, 0), end_of(problem, 1)
        counter = SeparatedCounter(problem, ends, Span(E, abs(E) + 1), digits=8)
        left, right = (_half_wave(counter, side, E) for side in (0, 1))
        k = 1 if abs(right[-1][1]) > abs(right[-1][2]) else 2  # Y or Y' is made continuous, whichever is larger
        scale = (left[-1][k] / right[-1][k]).mid()
        joined = left + [(x, scale * u, scale * v) for x, u, v in right[-2::-1]]
        exponent = sympy.integrate(-problem.B / 2, problem.x)  # y/Y = exp(-int B/2)
        if exponent.has(sympy.Integral):
            raise InputError(f"the integral of {problem.B} isn't known")
        gauges = (abs(BallEvaluator({problem.x: acb(x)})(sympy.exp(exponent))) for x, *_ in joined)
        values = [u * gauge.mid() for (_, u, _), gauge in zip(joined, gauges, strict=True)]
        most = max(map(abs, values))
        return [float(x) for x, *_ in joined], [float(y / most) for y in values]


def _half_wave(counter: SeparatedCounter, side: int, E: Any) -> list[tuple[Any, Any, Any]]:
    """(x, Y, Y') from an end to the matching point."""
    x, end = counter.positions[side], counter.ends[side]
    u, v = end.state(E, counter.span, x, high=False)
    found = []
    if isinstance(end, CutEnd) and end.place.is_polynomial(end.tau) and u.mid() != 0 and v.mid() != 0:
        # Beyond the cut of an infinite end y decays at the rate y'/y that it has there; the farthest point comes first.
        rate = abs(v.mid() / u.mid())
        for quarter in range(40, 0, -1):
            factor = (-arb(quarter) / 4).exp()
            found.append((x.mid() - end.inwards * quarter / (4 * rate), u.mid() * factor, v.mid() * factor))
    found.append((x, u, v))
    shares = [arb(k) / 32 for k in range(1, 32)]
    for step in counter.road.steps(x, counter.middle, _PICTURE_BITS):
        a = step.series(u, v, E)
        found += [(x + step.t * share, sum(c * share**n for n, c in enumerate(a)), arb(0)) for share in shares]
        u, v = (value.mid() for value in step.advance(u, v, E))
        x = (x + step.t).mid()
        found.append((x, u, v))
    return [(at.mid(), y.mid(), dy.mid()) for at, y, dy in found]

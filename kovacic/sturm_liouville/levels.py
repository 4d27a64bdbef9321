"""The results of `kovacic.eigenvalues`, and eigenfunctions for pictures.

These are the solutions of the two ends, joined at the point of the counts; nothing about them is proven.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, overload

import sympy
from flint import acb, arb

from kovacic.algebra.precision import working_precision
from kovacic.closed_form.balls import BallEvaluator
from kovacic.enclosure.ball import Ball, ball_to_flint
from kovacic.errors import InputError
from kovacic.sturm_liouville.count import SeparatedCounter
from kovacic.sturm_liouville.ends import CutEnd, end_of
from kovacic.sturm_liouville.problem import Span, SturmProblem


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

        x, y = samples(self.problem, self.levels[k].value)
        return partial(np.interp, xp=np.array(x), fp=np.array(y), left=0.0, right=0.0)

    def to_dict(self) -> dict[str, Any]:
        """For JSON: text, and numbers that are exact."""
        levels = [{"value": lv.value.to_dict(), "zeros": lv.zeros, "alone": lv.alone} for lv in self.levels]
        return {"parameter": self.parameter, "levels": levels, "complete": self.complete, "notes": list(self.notes)}


_PICTURE_BITS = 160
#: Points of a step.
_POINTS_OF_STEP = 32
#: Points beyond a cut, at quarters of the length on which y decays.
_POINTS_OF_TAIL = 40


def samples(problem: SturmProblem, value: Ball) -> tuple[list[float], list[float]]:
    """Points x in order, and y there, at most 1 in modulus.  Raises `InputError` for periodic conditions."""
    if problem.wrap:
        raise InputError("functions of periodic problems aren't drawn")
    with working_precision(_PICTURE_BITS):
        E = problem.sign * ball_to_flint(value).real.mid()
        ends = end_of(problem, 0), end_of(problem, 1)
        counter = SeparatedCounter(problem, ends, Span(E, abs(E) + 1), digits=8)
        sides = [_half_wave(counter, side, E) for side in (0, 1)]
        left, right = sides
        k = 1 if abs(right[-1][1]) > abs(right[-1][2]) else 2  # Y or Y' is made continuous, whichever is larger
        scale = (left[-1][k] / right[-1][k]).mid()
        joined = left + [(x, scale * u, scale * v) for x, u, v in right[-2::-1]]
        gauge = _gauge(problem)
        values = [(x, u * gauge(x)) for x, u, _ in joined]
        most = max(abs(y) for _, y in values)
        return [float(x) for x, _ in values], [float(y / most) for _, y in values]


def _half_wave(counter: SeparatedCounter, side: int, E: Any) -> list[tuple[Any, Any, Any]]:
    """(x, Y, Y') from an end to the matching point."""
    x = counter.positions[side]
    u, v = counter.ends[side].state(E, counter.span, x, high=False)
    end = counter.ends[side]
    found = []
    if isinstance(end, CutEnd) and end.place.is_polynomial(end.tau) and u.mid() != 0 and v.mid() != 0:
        # Beyond the cut of an infinite end y decays at the rate y'/y that it has there; the farthest point comes first.
        rate = abs(v.mid() / u.mid())
        points = [(x.mid() - end.inwards * k / (4 * rate), (-arb(k) / 4).exp()) for k in range(_POINTS_OF_TAIL, 0, -1)]
        found = [(at, u.mid() * factor, v.mid() * factor) for at, factor in points]
    found.append((x, u, v))
    for step in counter.road.steps(x, counter.middle, _PICTURE_BITS):
        a = step.series(u, v, E)
        shares = [arb(k) / _POINTS_OF_STEP for k in range(1, _POINTS_OF_STEP)]
        found += [(x + step.t * share, sum(c * share**n for n, c in enumerate(a)), arb(0)) for share in shares]
        u, v = (value.mid() for value in step.advance(u, v, E))
        x = (x + step.t).mid()
        found.append((x, u, v))
    return [(at.mid(), y.mid(), dy.mid()) for at, y, dy in found]


def _gauge(problem: SturmProblem) -> Any:
    """exp(-int B/2), y over Y."""
    if problem.B == 0:
        return lambda x: arb(1)
    exponent = sympy.integrate(-problem.B / 2, problem.x)
    if exponent.has(sympy.Integral):
        raise InputError(f"the integral of {problem.B} isn't known")
    return lambda x: abs(BallEvaluator({problem.x: acb(x)})(sympy.exp(exponent))).mid()

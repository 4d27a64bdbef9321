"""The eigenfunctions for pictures: the solutions of the two ends, joined where the counts are made; nothing here is proven."""

from __future__ import annotations

from typing import Any

import sympy
from flint import acb, arb

from kovacic.algebra.precision import working_precision
from kovacic.closed_form.balls import BallEvaluator
from kovacic.enclosure.ball import Ball, ball_to_flint
from kovacic.errors import InputError
from kovacic.sturm_liouville.count import SeparatedCounter
from kovacic.sturm_liouville.discs import TaylorStep
from kovacic.sturm_liouville.ends import CutEnd, End, end_of
from kovacic.sturm_liouville.problem import Span, SturmProblem

_BITS = 160
#: Points of a step.
_PARTS = 32
#: Points beyond a cut, at quarters of the length on which y decays.
_TAIL = 40


def samples(problem: SturmProblem, value: Ball) -> tuple[list[float], list[float]]:
    """Points x in order, and y there, at most 1 in modulus.  Raises `InputError` for periodic conditions."""
    if problem.wrap:
        raise InputError("functions of periodic problems aren't drawn")
    with working_precision(_BITS):
        E = problem.sign * ball_to_flint(value).real.mid()
        ends = end_of(problem, 0), end_of(problem, 1)
        counter = SeparatedCounter(problem, ends, Span(E, abs(E) + 1), digits=8)
        sides = [_side(counter, side, E) for side in (0, 1)]
        left, right = sides
        k = 1 if abs(right[-1][1]) > abs(right[-1][2]) else 2  # Y or Y' is made continuous, whichever is larger
        scale = (left[-1][k] / right[-1][k]).mid()
        joined = left + [(x, scale * u, scale * v) for x, u, v in right[-2::-1]]
        gauge = _gauge(problem)
        values = [(x, u * gauge(x)) for x, u, _ in joined]
        most = max(abs(y) for _, y in values)
        return [float(x) for x, _ in values], [float(y / most) for _, y in values]


def _side(counter: SeparatedCounter, side: int, E: Any) -> list[tuple[Any, Any, Any]]:
    """(x, Y, Y') from an end to the matching point."""
    x = counter.positions[side]
    u, v = counter.ends[side].state(E, counter.span, x, high=False)
    found = [*_tail(counter.ends[side], x.mid(), u.mid(), v.mid()), (x.mid(), u.mid(), v.mid())]
    for step in counter.road.steps(x, counter.middle, _BITS):
        found += [(x + step.t * k / _PARTS, *_inside(step, u, v, E, k)) for k in range(1, _PARTS)]
        u, v = (value.mid() for value in step.advance(u, v, E))
        x = (x + step.t).mid()
        found.append((x, u, v))
    return [(at.mid(), y.mid(), dy.mid()) for at, y, dy in found]


def _tail(end: End, x: Any, u: Any, v: Any) -> list[tuple[Any, Any, Any]]:
    """Beyond the cut of an infinite end, where y decays at the rate y'/y that it has there; the farthest point first."""
    if not isinstance(end, CutEnd) or not end.place.is_polynomial(end.tau) or u == 0 or v == 0:
        return []
    rate = abs(v / u)
    points = [(x - end.inwards * k / (4 * rate), (-arb(k) / 4).exp()) for k in range(_TAIL, 0, -1)]
    return [(at.mid(), (u * factor).mid(), (v * factor).mid()) for at, factor in points]


def _inside(step: TaylorStep, u: Any, v: Any, E: Any, k: int) -> tuple[Any, Any]:
    a = step.series(u, v, E)
    share = arb(k) / _PARTS
    return sum(c * share**n for n, c in enumerate(a)), arb(0)


def _gauge(problem: SturmProblem) -> Any:
    """exp(-int B/2), y over Y."""
    if problem.B == 0:
        return lambda x: arb(1)
    exponent = sympy.integrate(-problem.B / 2, problem.x)
    if exponent.has(sympy.Integral):
        raise InputError(f"the integral of {problem.B} isn't known")
    return lambda x: abs(BallEvaluator({problem.x: acb(x)})(sympy.exp(exponent))).mid()

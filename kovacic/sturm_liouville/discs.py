"""Solutions of Y'' = (Q - E W) Y along the axis, in balls: Taylor series about a point, with a proven bound of what is
left out.

In |x - x0| <= R let |Q| + |E| |W| <= k^2.  Then |Y| <= (|Y(x0)| + R |Y'(x0)|) exp(k R) =: M there, so the coefficients
are at most M/R^n (Cauchy), and with r = |t|/R <= 1/8 the terms from the N-th on sum up to at most M r^N/(1 - r), those
of t Y' to at most N M r^N/(1 - r)^2.  Two zeros of a solution are at least pi/k apart (Sturm), where k^2 bounds E W -
Q on the axis: while k |t| sums up to less than pi there is at most one zero, and the signs at both ends tell whether
there is one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from operator import mul
from typing import Any

import sympy
from flint import acb, acb_series, arb, ctx

from kovacic.algebra.precision import series_length, working_precision
from kovacic.closed_form.jets import BallEvaluator
from kovacic.closed_form.order import ball
from kovacic.errors import InputError
from kovacic.limits import check_time, count_work
from kovacic.sturm_liouville.problem import Span, Stretch, SturmProblem, kept

Expr = Any
#: k R is at most this, so that the bound M of a solution is at most exp(24) times its size, and 8^-n outweighs it soon.
_STEEPEST_DISC = 24
#: The radius R of a disc over the step: r = 1/8.
_RADIUS_OVER_STEP = 8
#: A lower bound of pi.
_TURN = arb(157) / 50
_SMALLEST_RADIUS = arb(1) / 2**80


@dataclass(frozen=True)
class Passage:
    """Y and Y' at a point, and the zeros of Y that were passed since the start."""

    u: Any
    v: Any
    zeros: int


@dataclass(frozen=True)
class TaylorStep:
    """From x0 to x0 + t: the Taylor coefficients of Q and W, times t^(k+2).  Y' grows by `kick` Y at the end of the step."""

    t: Any
    radius: Any
    q: list[Any]
    w: list[Any]
    terms: int
    tail: Any
    turn: Any
    kick: Any = 0

    def series(self, u: Any, v: Any, E: Any) -> list[Any]:
        """The coefficients of Y about the start, times powers of t."""
        S = self.q[:]
        for k, w in enumerate(self.w):
            S[k] -= E * w
        a = [u, v * self.t]
        for n in range(self.terms - 2):  # (n+1)(n+2) a_(n+2) = sum of S_k a_(n-k)
            a.append(sum(map(mul, S, a[n::-1])) / ((n + 1) * (n + 2)))
        return a

    def advance(self, u: Any, v: Any, E: Any) -> tuple[Any, Any]:
        """(Y, Y') at the other end, for |E| within the span of the step."""
        a = self.series(u, v, E)
        error = arb(0, ((abs(u) + self.radius * abs(v)) * self.tail).upper())
        slopes = sum(n * c for n, c in enumerate(a))
        value = sum(a) + error
        return value, (slopes + error) / self.t + self.kick * value


def march(steps: Sequence[TaylorStep], u: Any, v: Any, E: Any) -> Passage | None:
    """The solution at the end of the steps; None if the balls are too wide to count its zeros."""
    sign = _sign_of_ball(u)
    if u == 0:
        sign = _sign_of_ball(v) * _sign_of_ball(steps[0].t)
    zeros = 0
    turned = arb(0)
    for step in steps:
        u, v = step.advance(u, v, E)
        turned += step.turn
        now = _sign_of_ball(u)
        if now == 0 and step.kick == 0:  # else there may be a zero on each side of the delta function
            continue
        if 0 in (sign, now) or not turned <= _TURN:
            return None
        zeros += int(now != sign)
        sign = now
        turned = arb(0)
    return None if turned != 0 else Passage(u, v, zeros)


def _sign_of_ball(value: Any) -> int:
    """1 or -1; 0 for a ball that contains 0."""
    return int(value > 0) - int(value < 0)


class germ(sympy.Function):  # type: ignore[misc]  # noqa: N801
    """germ(D, t, k) = D/t^k for a function D of t with a zero of order k at t = 0: analytic there, as D is."""

    def _eval_subs(self, old: Any, new: Any) -> Any:
        D, t, k = self.args
        return D.diff(t, k).subs(t, 0) / sympy.factorial(k) if (old, new) == (t, 0) else None


class _GermEvaluator(BallEvaluator):
    """With germs: D/t^k is a mean of D^(k)/k! between 0 and t, with the Taylor coefficients of D from the one of t^k on."""

    def other(self, e: Any) -> Any:
        if not isinstance(e, germ):
            return super().other(e)
        D, t, k = e.args
        at = self.values[t]
        if isinstance(at, acb_series):
            with series_length(ctx.cap + int(k)):
                return acb_series(list(BallEvaluator({t: acb_series([0, 1])})(D))[int(k) :])
        mean = D.diff(t, k) / sympy.factorial(k) if at.contains(0) else D / t**k
        return BallEvaluator(self.values, analytic=self.analytic)(mean)


def taylor_coefficients(e: Expr, x: Expr, x0: Any, terms: int) -> list[Any]:
    """The Taylor coefficients of e about x0, without zeros at the end.  Raises `InputError` unless they are real."""
    with series_length(terms):
        try:
            value = _GermEvaluator({x: acb_series([acb(x0), 1])})(e)
        except (ValueError, ZeroDivisionError) as error:
            raise not_analytic(x, x0) from error
        found = list(value) if isinstance(value, acb_series) else [value]
    if not all(c.is_finite() for c in found):
        raise not_analytic(x, x0)
    if not all(c.imag.is_zero() for c in found):
        raise InputError(f"{e} isn't known to be real near {x} = {x0.mid().str(8, radius=False)}")
    real = [c.real for c in found]
    while len(real) > 1 and real[-1] == 0:
        real.pop()
    return real


def not_analytic(x: Expr, x0: Any) -> InputError:
    """The error for a point near which there may be a singular point."""
    return InputError(f"the coefficients aren't known to be analytic near {x} = {x0.mid().str(10, radius=False)}")


def size_bound(e: Expr, x: Expr, x0: Any, radius: Any) -> Any:
    """An upper bound of |e| in a disc in which e is analytic; infinite if that isn't known.

    Where one box isn't enough, as for 1/cosh(x), the upper half of the disc is in 4 x 4 of them: e(conj x) = conj e(x).
    """
    most = abs(_GermEvaluator({x: acb(x0 + arb(0, radius), arb(0, radius))}, analytic=True)(e)).upper()
    if most.is_finite():
        return most
    half = radius / 8
    most = arb(0)
    for row, column in product(range(1, 8, 2), repeat=2):
        box = acb(x0 + half * (2 * column - 8) + arb(0, 2 * half), half * row + arb(0, half))
        most = most.max(abs(_GermEvaluator({x: box}, analytic=True)(e)).upper())
        if not most.is_finite():
            break
    return most


@dataclass(frozen=True)
class Road:
    """Steps along the pieces of a problem, for a range of E."""

    problem: SturmProblem
    span: Span

    @kept
    def steps(self, start: Any, stop: Any, prec: int) -> tuple[TaylorStep, ...]:
        """From one point to another, which may be balls around the exact ones."""
        found: list[TaylorStep] = []
        with working_precision(prec):
            here, radius = start, _RADIUS_OVER_STEP * abs(stop - start).upper()
            for piece, last, kick in self._parts(start, stop):
                is_last = False
                while not is_last:
                    check_time()
                    count_work(prec)
                    step, is_last = self._step(piece, here, last, radius, prec)
                    found.append(replace(step, kick=kick) if is_last else step)
                    radius = step.radius * 3 / 2
                    here = last if is_last else here + step.t
        return tuple(found)

    def _parts(self, start: Any, stop: Any) -> Iterator[tuple[Stretch, Any, Any]]:
        """The pieces on the way, each with the point at which it is left, and the delta function there."""
        forwards = start < stop
        pieces = self.problem.pieces if forwards else self.problem.pieces[::-1]
        for number, piece in enumerate(pieces):
            end = piece.high if forwards else piece.low
            far = None if end.is_infinite else ball(end)
            if far is not None and not (start < far if forwards else far < start):
                continue
            if far is None or not (far < stop if forwards else stop < far):
                yield piece, stop, 0
                return
            yield piece, far, ball(pieces[number + 1].delta) if forwards else -ball(piece.delta)

    def _step(self, piece: Stretch, here: Any, last: Any, radius: Any, prec: int) -> tuple[TaylorStep, bool]:
        """The largest one whose radius is `radius` over a power of 2, and whether it leads to `last`."""
        distance = last - here
        whole = _RADIUS_OVER_STEP * abs(distance).upper()
        radius = min(radius, whole)
        while True:
            q = size_bound(piece.Q, self.problem.x, here, radius)
            w = size_bound(piece.W, self.problem.x, here, radius)
            k = (q + self.span.size * w).sqrt()
            if (k * radius).is_finite() and k * radius <= _STEEPEST_DISC:
                break
            radius = radius * 3 / 4
            if radius < abs(distance) * _SMALLEST_RADIUS:
                raise not_analytic(self.problem.x, here)
        is_last = radius == whole
        t = distance if is_last else radius / _RADIUS_OVER_STEP * (1 if distance > 0 else -1)
        growth = (k * radius).exp()
        terms = 16 + prec // 3  # 8^12 is above exp(24)
        ratio = abs(t) / radius
        tail = (growth * ratio**terms * terms / (1 - ratio) ** 2).upper()
        series = (taylor_coefficients(e, self.problem.x, here, terms) for e in (piece.Q, piece.W))
        q_t, w_t = ([c * t ** (n + 2) for n, c in enumerate(s)] for s in series)
        q_t += [arb(0)] * (len(w_t) - len(q_t))
        at = BallEvaluator({self.problem.x: acb(here.union(here + t))})
        depth = (self.span.high * at(piece.W) - at(piece.Q)).real.upper()
        turn = (depth.sqrt() * abs(t)).upper() if depth > 0 else arb(0)
        return TaylorStep(t, radius, q_t, w_t, terms, tail, turn), is_last

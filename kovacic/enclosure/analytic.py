"""Ways of equations y'' + b y' + c y = f whose coefficients are analytic functions of x.

A way is covered by discs around points of it (`kovacic.enclosure.jets`).  In each of them balls that contain twice the disc
show that the coefficients are analytic: a pole or a branch point on the way is never passed, since no disc contains it.  Discs
become smaller towards one; where they would be as small as 2^-60 of what lies on either side, the way is refused.

Where the coefficients have values at an end of the way and aren't analytic there, as sqrt(x) at 0, a short piece beside it is
bounded: with |b| <= B, |c| <= C and |f| <= F on a piece of length r, for any s > 0 the vector (y, s y') has the derivative
(s y'/s, -b (s y') - s c y + s f), and with K >= max(1/s, B + s C) it changes by at most

    (exp(K r) - 1) (max(|y|, s |y'|) + s F/K)    [Gronwall].                                                               (1)
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from flint import acb, acb_poly, arb, arb_poly, fmpq

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.constants import Number
from kovacic.enclosure.frame import foreseen_growth
from kovacic.enclosure.jets import CoefficientField, JetBasis
from kovacic.enclosure.matrices import Matrix, State, apply, multiply
from kovacic.enclosure.points import ExactPoint, are_real, around_zero, power_of_two, to_acb
from kovacic.enclosure.problem import NumericProblem
from kovacic.enclosure.start import spread_by, steepness_of
from kovacic.enclosure.way import Forecast, Local, Way, WayStep
from kovacic.errors import InputError
from kovacic.limits import check_time, count_work

_STEEPEST = 40.0
_SHARE = 0.15
"""The growth exp(lambda) in one disc: lambda is at most so large, or that share of the bits."""
_LEAST = 60
_ROUGH = 64
_EDGE = 16
"""The piece beside an end where the coefficients aren't analytic is 2^-16 of the way over 2^bits."""
_START = 512
"""Binary exponents that are tried from the length of the way downwards, at its first point."""


@dataclass(frozen=True)
class AnalyticStep:
    """One disc of a way, entered and left at these points."""

    basis: JetBasis
    enter: ExactPoint
    leave: ExactPoint

    @cached_property
    def _to_centre(self) -> Matrix:
        return self.basis.inverse(self.enter)

    @cached_property
    def matrix(self) -> Matrix:
        """From (y, y') where it is entered to where it is left, without the right-hand side."""
        return multiply(self.basis.matrix(self.leave), self._to_centre)

    @cached_property
    def added(self) -> State:
        """What the right-hand side adds: the particular solution that is zero where the disc is entered."""
        y, dy = apply(self.matrix, self.basis.particular(self.enter))
        p, dp = self.basis.particular(self.leave)
        return p - y, dp - dy

    def local(self, state: State) -> Local:
        """The solution in the disc with this state where it is entered."""
        p, dp = self.basis.particular(self.enter)
        return self.basis.local(apply(self._to_centre, (state[0] - p, state[1] - dp)))


@dataclass(frozen=True)
class Edge:
    """A short piece on which the coefficients are bounded by (1): `change` is exp(K r) - 1, and `pushed` s F/K."""

    enter: ExactPoint
    leave: ExactPoint
    s: arb
    change: arb
    pushed: arb
    real: bool

    @classmethod
    def of(cls, functions: CoefficientField, enter: ExactPoint, leave: ExactPoint) -> Edge:
        """With the bounds on a ball that contains the piece; raises InputError where there are none."""
        middle = to_acb((enter + leave).scaled(fmpq(1, 2)))
        length = abs(to_acb(leave - enter)).upper()
        real = enter.is_real() and leave.is_real()
        b, c, f = functions.values(middle + around_zero(length, real=real))
        if not all(value.is_finite() for value in (b, c, f)):
            raise InputError(f"the coefficients have no bound beside {enter} or {leave}, an end of the path")
        s, K = steepness_of(b, c)
        change = (K * length).expm1().upper()
        # The coefficients are analytic inside the piece, so real on all of it where they are on a part.
        real = real and are_real(functions.values(middle + arb(0, length / 8)))
        return cls(enter, leave, s, change, (s * abs(f) / K).upper(), real)

    def _errors(self, y: arb, dy: arb) -> State:
        """Balls of the changes of y and y' for such sizes of (y, s y')."""
        size = self.change * y.max(dy)
        return around_zero(size.upper(), real=self.real), around_zero((size / self.s).upper(), real=self.real)

    @property
    def matrix(self) -> Matrix:
        """From where it is entered to where it is left, without the right-hand side."""
        first, slope = self._errors(arb(1), arb(0))
        other, second = self._errors(arb(0), self.s)
        return 1 + first, other, slope, 1 + second

    @property
    def added(self) -> State:
        """What the right-hand side adds."""
        return self._errors(self.pushed, arb(0))

    def local(self, state: State) -> Local:
        """The solution on the piece: constant, and so is its derivative."""
        y, dy = state
        error, slope_error = self._errors(abs(y).upper() + self.pushed, (self.s * abs(dy)).upper())
        square = (self.leave - self.enter).norm_squared()
        e = exponent(square) + 1
        real = self.real and are_real(state)
        kind, slope = (
            (arb_poly, arb_poly([dy.real * arb((1, e))])) if real else (acb_poly, acb_poly([dy * arb((1, e))]))
        )
        value = kind([y.real if real else y])
        bounds = abs(error).upper(), (abs(slope_error) * arb((1, e))).upper()
        return Local(self.enter, e, value, slope, *bounds, reach=fmpq(1), precision=2 * _ROUGH)


@dataclass(frozen=True, eq=False)
class AnalyticWay(Way):
    """An equation by the power series of its coefficients and its right-hand side.

    `problem` has its left-hand side where that is rational: its singular points are known, then.
    """

    functions: CoefficientField
    problem: NumericProblem | None = None
    prec: int = 64

    @property
    def is_exact(self) -> bool:
        return self.functions.coefficients.is_exact

    def at(self, prec: int) -> AnalyticWay:
        return replace(self, prec=prec)

    @property
    def _steepest(self) -> float:
        return max(_STEEPEST, _SHARE * self.prec)

    def check(self, a: ExactPoint, b: ExactPoint) -> None:
        if self.problem is not None:
            self.problem.check_segment(a, b)
        for name, end in (("start", a), ("end", b)):
            if not all(value.is_finite() for value in self.functions.values(to_acb(end))):
                said = f"the coefficients have no value at the {name} {end} of the path"
                if self.problem is not None:
                    said = f"the right-hand side has no value at {end}, an end of the path"
                raise InputError(said, hint="choose a point beside it")

    def forecast(self, a: ExactPoint, b: ExactPoint) -> Forecast:
        def rate(x: acb) -> arb:
            b_value, c_value, _ = self.functions.values(x)
            return abs(b_value).max(abs(c_value).sqrt())

        found = Forecast(a, b, lambda: foreseen_growth(rate, a, b), 2 * self._steepest)
        found.refuse()
        return found

    def horizon(self, here: ExactPoint, stop: ExactPoint) -> ExactPoint:
        """The stop itself where the coefficients aren't analytic there."""
        return super().horizon(here, stop) if self.functions.is_regular(to_acb(stop)) else stop

    def spread(self, number: Number, state: State) -> State:
        def coefficients(ball: acb) -> tuple[acb, acb, acb, bool]:
            b, c, f = self.functions.values(ball, analytic=True)
            return b, c, f, are_real(self.functions.values(ball))

        return spread_by(coefficients, number, state)

    def walk(self, a: ExactPoint, b: ExactPoint, *, alone: bool = False) -> Iterator[WayStep]:
        edge = power_of_two(-self.prec - _EDGE)
        length = b - a
        first = a if self.functions.is_regular(to_acb(a)) else a + length.scaled(edge)
        last = b if self.functions.is_regular(to_acb(b)) else b - length.scaled(edge)
        if first != a:
            yield Edge.of(self.functions, a, first)
        yield from self._discs(first, last)
        if last != b:
            yield Edge.of(self.functions, last, b)

    def _discs(self, a: ExactPoint, b: ExactPoint) -> Iterator[WayStep]:
        """The discs from a to b, where the coefficients are analytic."""
        length = b - a
        square = length.norm_squared()
        t = fmpq(0)
        e = exponent(square)
        while t < 1:
            check_time()
            count_work(self.prec)
            rest = 1 - t
            e = min(e + 1, exponent(square * rest * rest))
            while True:
                ratio = power_of_two(2 * e) / square
                k = (ratio.p.bit_length() - ratio.q.bit_length()) // 2
                root = (
                    (ratio * power_of_two(24 - 2 * k)).floor().isqrt()
                )  # 2^e over the length, a dyadic number just below
                half = min(fmpq(root) * power_of_two(k - 12), rest / 2)
                centre = a + length.scaled(t + half)
                jets = self.functions.jets(centre, e, self.prec, self._steepest)
                if jets is not None:
                    break
                e -= 1
                _check_size(a, b, t, e, max(_START, 2 * self.prec))
            enter = a + length.scaled(t)
            t += 2 * half
            yield AnalyticStep(JetBasis(jets), enter, b if t == 1 else a + length.scaled(t))


def exponent(square: Any) -> int:
    """An integer e with 2^(e+1) at least the length whose square this is."""
    return int(square.p.bit_length() - square.q.bit_length() + 1) // 2


def _check_size(a: ExactPoint, b: ExactPoint, t: Any, e: int, start: int) -> None:
    """Raise InputError where steps are too small for what lies behind, or 2^-start of the way, and ahead: a singular point is
    there."""
    square = (b - a).norm_squared()
    behind = square * t * t
    ahead = square * (1 - t) ** 2
    if t == 0:
        behind = square * power_of_two(-2 * start)
    if power_of_two(2 * (e + _LEAST)) < min(behind, ahead):
        where = to_acb(a + (b - a).scaled(t)).mid()
        with working_precision(64):
            shown = where.real.str(10, radius=False)
            if not where.imag.is_zero():
                shown = where.str(10, radius=False)
        raise InputError(
            f"the coefficients aren't known to be analytic near {shown}, on the way to {b}",
            hint="go around it through the complex plane, e.g. path=[...] with a vertex off the axis; "
            "the result depends on the side",
        )

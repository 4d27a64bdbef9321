"""Any solution on a regular real interval as a vectorised NumPy function: a table of Taylor expansions in double-doubles.

For S of every kind, Liouvillian or not.  The interval is covered by pieces [c - H, c + H], H = 2^e at most a quarter of the
distance from c to the nearest singular point and so small that the solutions grow by at most 2^30.  On each piece

    y(c + H u) = sum a_n u^n,    |u| <= 1,

with coefficients whose truncation is proven below 2^-110 (`kovacic.enclosure.taylor`), from enclosures of y(c) and y'(c) to 34
digits.  In the careful variant coefficients and Horner's scheme are double-doubles, so that the error is some 2^-95 of the
largest value on the piece: the value itself keeps its digits near zeros, and where it is far smaller than its neighbours.  In
plain doubles the growth is at most 2^4 a piece, and the error some 2^-52 of the largest value there.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np
from flint import acb, arb

from kovacic.doubles.arrangement import gauge_form
from kovacic.doubles.double_double import Pair, double, horner, scaled, two_sum
from kovacic.doubles.product_form import ProductForm
from kovacic.doubles.region import BLOCK, Measured, Region, hull, in_blocks, region_of
from kovacic.enclosure.ball import ball_from_flint, ball_to_flint
from kovacic.enclosure.closed_form import value
from kovacic.enclosure.constants import as_number, to_ball
from kovacic.enclosure.evaluate import evaluate_states
from kovacic.enclosure.frame import Frame, RayBound, fitting
from kovacic.enclosure.points import Point, as_point, to_acb
from kovacic.enclosure.precision import Evaluation
from kovacic.enclosure.problem import (
    NumericProblem,
    System,
    as_problem,
    check_segment,
)
from kovacic.enclosure.taylor import expand
from kovacic.enclosure.working import working_precision
from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits

_PREC = 116
_DIGITS = 34
_SHARP = 90
_GROWTH = {True: 30.0, False: 4.0}
_KEPT = {True: _PREC, False: 62}
"""Bits of growth on a piece, and below the largest coefficient that count: for the careful variant, and the plain one."""

_SHARE = 0.25
_MAX_PIECES = 5000


@dataclass(frozen=True, eq=False)
class TabulatedFunction:
    """Expansions at `centres`, in (x - centre) 2^-exponent, valid up to the next of `edges`; call it with an array of points.

    `coefficients` has the shape (parts, 2, terms, pieces): real and imaginary part (one part for a real function), high and
    low half.  `gauge` multiplies the result, with its value at `base` taken out.
    """

    region: Region
    base: Point
    edges: Any
    centres: Any
    exponents: Any
    coefficients: Any
    gauge: ProductForm | None = None
    careful: bool = True
    measured: Measured | None = None

    def __call__(self, x: Any) -> Any:
        """y(x) as doubles, or complex doubles; raises InputError outside of the interval."""
        points = self.region.points(x)
        result = in_blocks(self._values, points, 4 * BLOCK)
        base = float(self.base.re) if self.base.is_real() else complex(self.base)
        return result if self.gauge is None else result * (self.gauge(points) / self.gauge(base))

    def _values(self, points: Any) -> Any:
        """Piece by piece, so that the coefficients are numbers."""
        flat = points.reshape(-1)
        index = np.searchsorted(self.edges, flat, side="right")
        order = np.argsort(index, kind="stable")
        flat, ends = flat[order], np.searchsorted(index[order], np.arange(self.centres.size + 1))
        found = np.zeros((len(self.coefficients), flat.size))
        for k in np.flatnonzero(np.diff(ends)):
            run = slice(ends[k], ends[k + 1])
            u = scaled(two_sum(flat[run], -self.centres[k]), -self.exponents[k])
            for row, halves in zip(found, self.coefficients[:, :, ::-1, k], strict=True):
                row[order[run]] = double(horner(map(Pair, *halves), u)) if self.careful else horner(halves[0], u.hi)
        return (found[0] if len(found) == 1 else found[0] + 1j * found[1]).reshape(points.shape)


def tabulate(
    equation: object,
    start: object,
    stop: object,
    *,
    x0: object,
    y0: object,
    dy0: object,
    careful: bool = True,
    limits: Limits | None = None,
) -> TabulatedFunction:
    """The solution with y(x0) = y0, y'(x0) = dy0 on [start, stop] in double precision; the interval must be regular.

    `careful` stands for double-doubles: a unit in the last place, at 20 times the cost of plain ones.  Values may be
    complex.  Raises InputError (an empty interval, a singular point in it or between it and x0) and LimitExceeded (more than
    5,000 pieces, or the time).

    >>> f = tabulate("-1", 0, 10, x0=0, y0=0, dy0=1)
    >>> print(f"{f(10.0):.15f}")      # sin 10
    -0.544021110889370
    """
    problem = as_problem(equation)
    budget = Budget(limits or DEFAULT_LIMITS)
    region, _ = region_of(problem, (start, stop))
    if not region.is_real:
        raise InputError("a table needs an interval of the real axis")
    if any(region.singular):
        raise InputError(
            "an end of the interval is a singular point", hint="a table ends beside it; choose an end at some distance"
        )
    origin, gauge = as_point(x0, "x0"), None
    if problem.gauge is not None:  # z = y G/G(x0): z' = y' + gamma y at x0
        check_segment(System.of(problem.gauge), origin, origin)
        with working_precision(8 * _PREC):
            gamma = value(problem.gauge, None, to_acb(origin))
            dy0 = ball_from_flint(to_ball(as_number(dy0, "dy0")) - gamma * to_ball(as_number(y0, "y0")))
            gauge = gauge_form(problem.gauge, hull(region, origin), origin)
    normal = NumericProblem(problem.system)
    pieces = _pieces(problem.system, region, _GROWTH[careful], budget)
    centres = [frame.centre for frame, _ in pieces]
    states = evaluate_states(normal, centres, x0=origin, y0=y0, dy0=dy0, digits=_DIGITS, limits=budget.share(1).limits)
    with working_precision(_PREC + 60):
        rows = [
            _coefficients(problem.system, piece, state, _KEPT[careful], budget)
            for piece, state in zip(pieces, states, strict=True)
        ]
    gauge = gauge and replace(gauge, careful=careful)
    return _assembled(region, origin, [frame for frame, _ in pieces], rows, gauge, careful)


def _pieces(system: System, region: Region, growth: float, budget: Budget) -> list[tuple[Frame, RayBound]]:
    """Frames that cover the region from left to right, with bounds for the rays to both ends."""
    low, high = Fraction(region.low.real), Fraction(region.high.real)
    position, e, found = low, math.frexp(float(high - low))[1], []
    while True:
        budget.check()
        frame, bound = _piece(system, position, e, growth)
        found.append((frame, bound))
        position, e = frame.centre.re + frame.scale, frame.e + 1
        if position > high:
            return found
        if len(found) > _MAX_PIECES:
            raise LimitExceeded(f"the table needs more than {_MAX_PIECES} pieces", limit="unknown_degree")


def _piece(system: System, position: Fraction, e: int, growth: float) -> tuple[Frame, RayBound]:
    """A piece that contains the position, of scale at most 2^e."""
    for exponent in range(e, e - 2200, -1):
        unit = Fraction(2) ** exponent
        centre = Point((position // unit + 1) * unit)
        ends = (centre - Point(unit), centre + Point(unit))
        found = fitting(system, centre, exponent, _SHARE, growth, ends)
        if found is not None:
            return found[0], found[1][0].worst(found[1][1])
    raise LimitExceeded("no piece of positive size was found for the table", limit="unknown_degree")


def _coefficients(
    system: System, piece: tuple[Frame, RayBound], state: Evaluation, kept: int, budget: Budget
) -> list[acb]:
    """The Taylor coefficients of the solution with this state at the centre, in the variable of the frame."""
    frame, bound = piece
    expansion = expand(system, frame, _PREC, bound, budget)
    unit = acb(arb((1, -expansion.w)))
    y, slope = ball_to_flint(state.y) * unit, ball_to_flint(state.dy) * acb(arb((1, frame.e))) * unit
    first, second = (column[0] for column in expansion.columns)
    found = [y * arb(first[n]) + slope * arb(second[n]) for n in range(max(len(first), len(second)))]
    sizes = [abs(v).mid() for v in found]
    if max((v.real.rad() + v.imag.rad() for v in found), key=float) > max(sizes) * arb((1, -_SHARP)):
        raise LimitExceeded("the initial values are too inaccurate for a table", limit="digits")
    floor = max(sizes) * arb((1, -kept))
    while len(found) > 1 and sizes[len(found) - 1] < floor:
        found.pop()
    return found


def _assembled(
    region: Region, origin: Point, frames: list[Frame], rows: list[list[acb]], gauge: ProductForm | None, careful: bool
) -> TabulatedFunction:
    is_real = all(v.imag.is_zero() for row in rows for v in row)
    table = np.zeros((1 if is_real else 2, 2, max(len(row) for row in rows), len(rows)))
    for k, row in enumerate(rows):
        for n, number in enumerate(row):
            for part, value_ in zip(table, (number.real, number.imag), strict=False):
                pair = Pair.of(value_)
                part[:, n, k] = pair.hi, pair.lo
    edges = np.array([float(frame.centre.re + frame.scale) for frame in frames[:-1]])
    centres = np.array([float(frame.centre.re) for frame in frames])
    exponents = np.array([frame.e for frame in frames])
    for array in (table, edges, centres, exponents):
        array.flags.writeable = False
    return TabulatedFunction(region, origin, edges, centres, exponents, table, gauge, careful)

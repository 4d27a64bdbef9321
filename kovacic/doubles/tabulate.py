"""Any solution on a regular real interval as a vectorised NumPy function: a table of polynomials in double-doubles.

For equations of every kind and every start that `kovacic.evaluate` takes.  The interval is covered by pieces [c - H, c + H],
H = 2^e at most a quarter of the distance from c to the nearest singular point and so small that the solutions grow by at
most 2^4.  On each piece the polynomial

    y(c + H u) = sum a_n u^n,    |u| <= 1,

has the values and slopes of y at Chebyshev's points, from enclosures; a piece is halved until its last coefficients don't
count.  For a function that is analytic in |u| < 4 the error falls by (4 + sqrt(15))^2 with every point [L. N. Trefethen,
Approximation Theory and Approximation Practice, SIAM 2013, chapters 8 and 11].  In the careful variant coefficients and
Horner's scheme are double-doubles, so that the error is some 2^-95 of the largest value on the piece: the value itself keeps
its digits near zeros, and where it is far smaller than its neighbours.  In plain doubles the error is some 2^-52 of the
largest value there.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np
from flint import acb, acb_mat, arb, arb_mat

from kovacic.doubles.double_double import Pair, double, horner, scaled, two_sum
from kovacic.doubles.region import BLOCK, Measured, Region, in_blocks, region_of
from kovacic.enclosure.ball import ball_to_flint
from kovacic.enclosure.frame import fitting
from kovacic.enclosure.points import Point, to_acb, working_precision
from kovacic.enclosure.problem import NumericProblem, System, as_problem, distance_lower
from kovacic.enclosure.states import evaluate_states
from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits

_PREC = 300
_SHARE, _GROWTH = 0.25, 4.0
_MAX_PIECES, _SMALLEST = 5000, -2200


_VARIANTS = {True: (21, 60, 112), False: (12, 32, 62)}
"""Points on a piece, digits of the values, and the bits below the largest coefficient that count: of the careful variant, and
the plain one.  Interpolation costs two bits and a half a point."""


@dataclass(frozen=True, eq=False)
class TabulatedFunction:
    """Polynomials in (x - centre) 2^-exponent, valid up to the next of `edges`; call it with an array of points.

    `coefficients` has the shape (parts, 2, terms, pieces): real and imaginary part (one part for a real function), high and
    low half.  `base` is x0, where that is a regular point.
    """

    region: Region
    base: Point | None
    edges: Any
    centres: Any
    exponents: Any
    coefficients: Any
    careful: bool = True
    measured: Measured | None = None

    def __call__(self, x: Any) -> Any:
        """y(x) as doubles, or complex doubles; raises InputError outside of the interval."""
        return in_blocks(self._values, self.region.points(x), 4 * BLOCK)

    def _values(self, flat: Any) -> Any:
        """Piece by piece, so that the coefficients are numbers."""
        index = np.searchsorted(self.edges, flat, side="right")
        order = np.argsort(index, kind="stable")
        flat, ends = flat[order], np.searchsorted(index[order], np.arange(self.centres.size + 1))
        found = np.zeros((len(self.coefficients), flat.size))
        for k in np.flatnonzero(np.diff(ends)):
            run = slice(ends[k], ends[k + 1])
            u = scaled(two_sum(flat[run], -self.centres[k]), -self.exponents[k])
            for row, halves in zip(found, self.coefficients[:, :, ::-1, k], strict=True):
                row[order[run]] = double(horner(map(Pair, *halves), u)) if self.careful else horner(halves[0], u.hi)
        return found[0] if len(found) == 1 else found[0] + 1j * found[1]


def tabulate(
    equation: object, start: object, stop: object, *, careful: bool = True, limits: Limits | None = None, **given: Any
) -> TabulatedFunction:
    """One solution on [start, stop] in double precision; the interval must be regular.

    The equation and which solution it is are `given` as for `kovacic.evaluate`: x0, which may lie outside of the interval and
    be a singular point, with y0 and dy0, frobenius, or which; params; path.  `careful` stands for double-doubles: a unit in
    the last place, at 20 times the cost of plain ones.  Values may be complex.  Raises InputError (an empty interval, a
    singular point in it or between it and x0) and LimitExceeded (more than 5,000 pieces, or the time).

    >>> f = tabulate("-1", 0, 10, x0=0, y0=0, dy0=1)
    >>> print(f"{f(10.0):.15f}")      # sin 10
    -0.544021110889370
    >>> bessel = tabulate("x^2*y'' + x*y' + x^2*y = 0", 1, 9, x0=0, which="regular")
    >>> print(f"{bessel(5.0):.15f}")      # J0(5)
    -0.177596771314338
    """
    budget = Budget(limits or DEFAULT_LIMITS)
    problem = as_problem(equation, given.pop("params", None), forced=True, constants=True)
    region, _ = region_of(problem, (start, stop))
    if not region.is_real:
        raise InputError("a table needs an interval of the real axis")
    if any(region.singular):
        raise InputError(
            "an end of the interval is a singular point", hint="a table ends beside it; choose an end at some distance"
        )
    return _assembled(region, given.get("x0"), _pieces(problem, region, careful, given, budget), careful)


@dataclass(frozen=True, slots=True)
class _Piece:
    """[centre - 2^e, centre + 2^e], and the coefficients there."""

    centre: Fraction
    e: int
    coefficients: list[acb] | None = None

    @property
    def scale(self) -> Fraction:
        return Fraction(2) ** self.e


def _pieces(
    problem: NumericProblem, region: Region, careful: bool, given: dict[str, Any], budget: Budget
) -> list[_Piece]:
    """Pieces that cover the region from left to right; where the points don't suffice, a piece is halved."""
    n, digits, kept = _VARIANTS[careful]
    nodes = [Fraction(math.cos(math.pi * (2 * k + 1) / (2 * n))) for k in range(n)]
    with working_precision(_PREC):
        at = [to_acb(Point(u)).real for u in nodes]
        values = [[u**j for j in range(2 * n)] for u in at]
        slopes = [[j * u ** max(j - 1, 0) for j in range(2 * n)] for u in at]
        inverse = acb_mat(arb_mat(values + slopes).inv())
    open_, done = _first_pieces(problem, region, budget), list[_Piece]()
    while open_:
        if len(open_) + len(done) > _MAX_PIECES:
            raise LimitExceeded(f"the table needs more than {_MAX_PIECES} pieces", limit="unknown_degree")
        points = [Point(piece.centre + piece.scale * u) for piece in open_ for u in nodes]
        states = evaluate_states(problem, points, digits=digits, limits=budget.share(1).limits, **given)
        halves = []
        with working_precision(_PREC):
            for k, piece in enumerate(open_):
                budget.check()
                own, unit = states[k * n : k * n + n], acb(arb((1, piece.e)))
                data = [[ball_to_flint(s.y)] for s in own] + [[ball_to_flint(s.dy) * unit] for s in own]
                found = _counting((inverse * acb_mat(data)).entries(), kept)
                if found is not None:
                    done.append(replace(piece, coefficients=found))
                else:
                    halves += [_Piece(piece.centre + sign * piece.scale / 2, piece.e - 1) for sign in (-1, 1)]
        open_ = halves
    return sorted(done, key=lambda piece: piece.centre)


def _first_pieces(problem: NumericProblem, region: Region, budget: Budget) -> list[_Piece]:
    gauge = None if problem.gauge is None else System.of(problem.gauge)
    low, high = Fraction(region.low.real), Fraction(region.high.real)
    position, e, found = low, math.frexp(float(high - low))[1], list[_Piece]()
    while position <= high and len(found) <= _MAX_PIECES:
        budget.check()
        while True:
            if e < _SMALLEST:
                raise LimitExceeded("no piece of positive size was found for the table", limit="unknown_degree")
            piece = _Piece((position // Fraction(2) ** e + 1) * Fraction(2) ** e, e)
            centre = Point(piece.centre)
            fits = fitting(problem.system, centre, e, _SHARE, _GROWTH) is not None
            near = distance_lower(gauge, centre) if fits and gauge is not None else None
            if fits and (near is None or near * _SHARE >= arb((1, e))):
                break
            e -= 1
        found.append(piece)
        position, e = piece.centre + piece.scale, e + 1
    return found


def _counting(found: list[acb], kept: int) -> list[acb] | None:
    """The coefficients up to the last that counts; None where the degree is too low.

    The last coefficients for Chebyshev's polynomials are about those of the powers, over 2^degree.
    """
    sizes = [abs(v).mid() for v in found]
    floor = max(sizes) * arb((1, -kept))
    if max((v.real.rad() + v.imag.rad() for v in found), key=float) > floor:
        raise LimitExceeded("the initial values are too inaccurate for a table", limit="digits")
    if any(size > floor * arb((1, len(found) - 2)) for size in sizes[-3:]):
        return None
    while len(found) > 1 and sizes[len(found) - 1] < floor:
        found.pop()
    return found


def _assembled(region: Region, x0: object, pieces: list[_Piece], careful: bool) -> TabulatedFunction:
    rows = [piece.coefficients or [] for piece in pieces]
    is_real = all(v.imag.is_zero() for row in rows for v in row)
    table = np.zeros((1 if is_real else 2, 2, max(map(len, rows)), len(rows)))
    for k, row in enumerate(rows):
        for n, number in enumerate(row):
            for part, value in zip(table, (number.real, number.imag), strict=False):
                pair = Pair.of(value)
                part[:, n, k] = pair.hi, pair.lo
    edges = np.array([float(piece.centre + piece.scale) for piece in pieces[:-1]])
    centres, exponents = (np.array([f(piece) for piece in pieces]) for f in (lambda p: float(p.centre), lambda p: p.e))
    for array in (table, edges, centres, exponents):
        array.flags.writeable = False
    return TabulatedFunction(
        region, x0 if isinstance(x0, Point) else None, edges, centres, exponents, table, careful=careful
    )

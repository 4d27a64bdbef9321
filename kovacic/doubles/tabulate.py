"""Any solution on a regular real interval as a vectorised NumPy function: a table of polynomials in double-doubles.

For equations of every kind and every start that `kovacic.evaluate` takes.  The interval is covered by pieces [c - H, c + H],
H = 2^e at most a quarter of the distance from c to the nearest singular point, which are halved until the solutions grow
little on them and their Taylor series

    y(c + H u) = y(c) y1(u) + H y'(c) y2(u) + y3(u),    |u| <= 1,

end within a fixed number of terms; y1 and y2 solve the homogeneous equation, y3 begins with 0, 0 (a right-hand side is
interpolated at Chebyshev's points).  The states (y, y')(c) are enclosures; the series come from the recurrence of the equation,
in double-doubles for all pieces at once.  Chebyshev's polynomials bring the highest terms down [L. N. Trefethen, Approximation
Theory and Approximation Practice, SIAM 2013, chapter 3].  In the careful variant Horner's scheme is done in double-doubles,
too, so that the error is some 2^-95 of the largest value on the piece: the value itself keeps its digits near zeros, and where
it is far smaller than its neighbours.  In plain doubles the error is some 2^-52 of the largest value there.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from flint import acb, acb_poly, arb, arb_mat, arb_poly
from numpy.polynomial import chebyshev

from kovacic.algebra.rationals import to_fmpq
from kovacic.doubles.chart import Chart, chart_of
from kovacic.doubles.double_double import Pair, double, folded, horner, scaled, two_sum
from kovacic.doubles.region import BLOCK, Measured, Region, in_blocks
from kovacic.enclosure.frame import log2
from kovacic.enclosure.matrices import State
from kovacic.enclosure.points import Point, working_precision
from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits

_PREC = 300
_GROWTH = 12.0
"""The sums of the coefficients of y1 and y2 are at most so large."""
_MAX_PIECES, _SMALLEST = 5000, -1000
_DEPTH = 40
"""How often the interval is halved for a polynomial."""
_ROOM = 900
"""Binary exponents up to here stay in the coefficients."""


class _Variant(NamedTuple):
    """Terms of the series, those that are kept, digits of the states, the bits below the largest coefficient that count."""

    terms: int
    kept: int
    digits: int
    bits: int


_CAREFUL, _PLAIN = _Variant(48, 34, 60, 96), _Variant(32, 22, 32, 60)
Cell = tuple[Fraction, int]  # c, and e where H = 2^e


@dataclass(frozen=True, eq=False)
class TabulatedFunction:
    """Polynomials in (x - centre) 2^-exponent, times 2^power, valid up to the next of `edges`; call it with an array of points.

    `coefficients` has the shape (parts, 2, terms, pieces): real and imaginary part (one part for a real function), high and
    low half.  `base` is x0, where that is a regular point.
    """

    region: Region
    base: Point | None
    edges: Any
    centres: Any
    exponents: Any
    powers: Any
    coefficients: Any
    careful: bool = True
    measured: Measured | None = None

    def __call__(self, x: Any) -> Any:
        """y(x) as doubles, or complex doubles; raises InputError outside of the interval."""
        return in_blocks(self._values, self.region.points(x), 4 * BLOCK)

    def _values(self, flat: Any) -> Any:
        parts, powers = self.parts(flat)
        found = [double(part) if powers is None else np.ldexp(double(part), powers) for part in parts]
        return found[0] if len(found) == 1 else found[0] + 1j * found[1]

    def parts(self, flat: Any) -> tuple[list[Any], Any]:
        """Real and imaginary part as double-doubles or arrays, and the powers of two, None where all are 0.

        Piece by piece, so that the coefficients are numbers.
        """
        index = np.searchsorted(self.edges, flat, side="right")
        order = np.argsort(index, kind="stable")
        sorted_, ends = flat[order], np.searchsorted(index[order], np.arange(self.centres.size + 1))
        found = np.zeros((len(self.coefficients), 1 + self.careful, flat.size))
        for k in np.flatnonzero(np.diff(ends)):
            run = slice(ends[k], ends[k + 1])
            u = scaled(two_sum(sorted_[run], -self.centres[k]), -self.exponents[k])
            for row, halves in zip(found, self.coefficients[:, :, ::-1, k], strict=True):
                value = horner(map(Pair, *halves), u) if self.careful else Pair(horner(halves[0], u.hi))
                for half, numbers in zip(row, (value.hi, value.lo), strict=False):
                    half[order[run]] = numbers
        numbers = [Pair(*row) if self.careful else row[0] for row in found]
        return numbers, self.powers[index] if self.powers.any() else None


def tabulate(
    equation: object, start: object, stop: object, *, careful: bool = True, limits: Limits | None = None, **given: Any
) -> TabulatedFunction:
    """One solution on [start, stop] in double precision; the interval must be regular.

    The equation and which solution it is are `given` as for `kovacic.evaluate`: x0, which may lie outside of the interval and
    be a singular point, with y0 and dy0, frobenius, or which; params; path (y0 and dy0 only where coefficients are rational in
    exp(k x), sin(k x), ...).  `careful` stands for double-doubles: a unit in
    the last place, at 20 times the cost of plain ones.  Values may be complex.  Raises InputError (an empty interval, a
    singular point in it or between it and x0) and LimitExceeded (more than 5,000 pieces, or the time).

    >>> f = tabulate("-1", 0, 10, x0=0, y0=0, dy0=1)
    >>> print(f"{f(10.0):.15f}")      # sin 10
    -0.544021110889370
    >>> bessel = tabulate("x^2*y'' + x*y' + x^2*y = 0", 1, 9, x0=0, which="regular")
    >>> print(f"{bessel(5.0):.15f}")      # J0(5)
    -0.177596771314338
    """
    params = given.pop("params", None)
    return table_of(chart_of(equation, given, params), (start, stop), careful, limits or DEFAULT_LIMITS)


def table_of(chart: Chart, interval: tuple[object, object], careful: bool, limits: Limits) -> TabulatedFunction:
    """As `tabulate`."""
    budget, (region, _) = Budget(limits), chart.region(interval)
    if not region.is_real:
        raise InputError("a table needs an interval of the real axis")
    if any(region.singular):
        raise InputError(
            "an end of the interval is a singular point", hint="a table ends beside it; choose an end at some distance"
        )
    variant = _CAREFUL if careful else _PLAIN
    with working_precision(_PREC):
        cells, series = _pieces(chart, region, variant, budget)
    states = chart.states([Point(centre) for centre, _ in cells], variant.digits, budget.share(1).limits)
    with working_precision(_PREC):
        parts, powers = _combined(cells, series, states, variant)
    x0 = chart.given.get("x0")
    return _assembled(region, x0 if isinstance(x0, Point) else None, cells, parts, powers, variant)


def polynomial_table(P: Callable[[], acb_poly], degree: int, region: Region, careful: bool) -> TabulatedFunction | None:
    """A polynomial on an interval, from its balls; None where it can't be done, as beside a zero of high multiplicity."""
    variant, prec = _CAREFUL if careful else _PLAIN, _PREC + 3 * degree
    while True:
        with working_precision(prec):
            found = _shifted(P(), region, variant)
            if found is None:
                return None
            peaks = {cell: max(abs(v).mid() for v in row) for cell, row in found.items()}
            if all(
                v.rad() < peaks[cell] * arb((1, -variant.bits)) for cell, row in found.items() for v in map(abs, row)
            ):
                break
        prec *= 2
    cells = sorted(found)
    powers = np.array([int(log2(peaks[cell])) for cell in cells])
    rows = [[v * arb((1, -int(k))) for v in found[cell]] for cell, k in zip(cells, powers, strict=True)]
    names = ("real",) if all(v.imag.is_zero() for row in rows for v in row) else ("real", "imag")
    parts = [Pair(*np.stack([_halves([getattr(v, name) for v in row]) for row in rows], axis=-1)) for name in names]
    return _assembled(region, None, cells, parts, powers, variant)


def _shifted(P: acb_poly, region: Region, variant: _Variant) -> dict[Cell, list[acb]] | None:
    """The Taylor series on the pieces: that of a half is that of the whole, without the terms that don't count there."""
    low, high, (centre, e) = Fraction(region.low.real), Fraction(region.high.real), _root(region)
    done, least, open_ = dict[Cell, list[acb]](), e - _DEPTH, list[tuple[Cell, acb_poly]]()
    open_.append(((centre, e), P(acb_poly([arb(to_fmpq(centre)), arb((1, e))]))))
    while open_:
        (c, e), here = open_.pop()
        coefficients: list[Any] = here.coeffs()
        sizes = [abs(v).mid() for v in coefficients]
        peak = max(sizes)
        slow = variant is _CAREFUL or sum(sizes, arb(0)) <= _GROWTH * max(sizes[:2])
        if slow and max(sizes[variant.terms :], default=arb(0)) <= peak * arb((1, -variant.bits)):
            done[c, e] = coefficients[: variant.terms] + [acb(0)] * (variant.terms - len(coefficients))
            continue
        if e <= least or len(done) > _MAX_PIECES:
            return None
        h, floor = Fraction(2) ** e, peak * arb((1, -2 * variant.bits))
        if len(sizes) > 2 * variant.terms:  # the polynomial may be far smaller somewhere on the piece
            us = np.linspace(float((max(low, c - h) - c) / h), float((min(high, c + h) - c) / h), 9)
            slope, share = here.derivative(), arb((1, -2 * len(sizes).bit_length()))
            least_peak = min(max(abs(here(u)).mid(), abs(slope(u)).mid() * share) for u in map(acb, us.tolist()))
            floor = least_peak * arb((1, -variant.bits - 40))
        while sizes[-1] < floor:
            sizes.pop()
        kept = acb_poly(coefficients[: len(sizes)])
        halves = [(sign, c + sign * h / 2) for sign in (-1, 1)]
        open_ += [
            ((middle, e - 1), kept(acb_poly([arb(sign) / 2, arb(1) / 2])))
            for sign, middle in halves
            if middle + h / 2 > low and middle - h / 2 < high
        ]
    return done


def _assembled(
    region: Region, base: Point | None, cells: list[Cell], parts: list[Pair], powers: Any, variant: _Variant
) -> TabulatedFunction:
    """The table with the highest terms lowered."""
    table = []
    for part in parts:
        lowered = np.tensordot(_lowering(*variant[:2]), part.hi[variant.kept :], 1)
        part = part[: variant.kept] + Pair(lowered)
        table.append([part.hi, part.lo])
    edges, exponents = np.array([float(c + Fraction(2) ** e) for c, e in cells[:-1]]), np.array([e for _, e in cells])
    arrays = edges, np.array([float(c) for c, _ in cells]), exponents, powers, np.array(table)
    for array in arrays:
        array.flags.writeable = False
    return TabulatedFunction(region, base, *arrays, careful=variant is _CAREFUL)


def _root(region: Region) -> Cell:
    """A piece that contains the interval."""
    low, high = Fraction(region.low.real), Fraction(region.high.real)
    e = math.frexp(float(high - low))[1]
    # Off the round numbers, at which solutions may be zero: that couldn't be told from other small values.
    grain = max(Fraction(2) ** (e - 24), Fraction(math.ulp(max(-low, high))))
    return (low // grain - Fraction(2) ** e * Fraction(53, 128) // grain) * grain + Fraction(2) ** e, e


def _pieces(chart: Chart, region: Region, variant: _Variant, budget: Budget) -> tuple[list[Cell], Pair]:
    """The pieces from left to right, and y1, y2 and y3 on them: an array of terms, series and pieces."""
    low, high = Fraction(region.low.real), Fraction(region.high.real)
    open_, done = [_root(region)], dict[Cell, Any]()
    while open_:
        e = open_[0][1]
        if len(open_) + len(done) > _MAX_PIECES:
            raise LimitExceeded(f"the table needs more than {_MAX_PIECES} pieces", limit="unknown_degree")
        if e < _SMALLEST:
            raise LimitExceeded("no piece of positive size was found for the table", limit="unknown_degree")
        budget.check()
        good, series = _series(chart, open_, variant)
        good &= np.array([low <= centre <= high for centre, _ in open_])  # there are values in the interval only
        done |= {cell: (series.hi[..., k], series.lo[..., k]) for k, cell in enumerate(open_) if good[k]}
        half = Fraction(2) ** (e - 1)
        halves = (c + sign * half for k, (c, _) in enumerate(open_) if not good[k] for sign in (-1, 1))
        open_ = [(c, e - 1) for c in halves if c + half > low and c - half < high]
    cells = sorted(done)
    hi, lo = (np.stack([done[cell][i] for cell in cells], axis=-1) for i in (0, 1))
    return cells, Pair(hi, lo)


def _series(chart: Chart, cells: list[Cell], variant: _Variant) -> tuple[Any, Pair]:
    """Which of these pieces will do, and y1, y2 and y3 on all of them."""
    terms, found = variant.terms, [chart.local(Point(centre), e, variant.terms) for centre, e in cells]
    length = max(2, *(len(part) + i for local in found if local for i, part in enumerate(local)), 0)
    numbers, source = np.zeros((2, 3, length, len(cells))), np.zeros((2, terms, 3, len(cells)))
    for k, (local, (centre, e)) in enumerate(zip(found, cells, strict=True)):
        for i, part in enumerate(local or ()):
            numbers[:, i, i : i + len(part), k] = _halves(part)
        if local and chart.forcing is not None:
            nodes, inverse = _interpolation(terms)
            values = [[chart.source(Point(centre), e, u) * arb_poly(local[0])(u)] for u in nodes]
            source[:, :, 2, k] = _halves((inverse * arb_mat(values)).entries())
    a, b, c = (Pair(*numbers[:, i]) for i in range(3))
    z = Pair(*np.zeros((2, terms, 3, len(cells))))
    z.hi[0, 0] = z.hi[1, 1] = 1.0
    with np.errstate(all="ignore"):
        for n in range(2, terms):
            j = np.arange(1, min(length, n + 1))
            m = (n - j)[:, None] + 0.0
            weights = a[j] * Pair(m * (m - 1)) + b[j] * Pair(m) + c[j]
            term = (Pair(*source[:, n - 2]) - folded(weights[:, None] * z[n - j])) / Pair(n * (n - 1.0))
            z.hi[n], z.lo[n] = term.hi, term.lo
        sizes = np.abs(z.hi)
        good = (sizes[-4:].max(0) <= sizes.max(0) * 2.0**-variant.bits).all(0)
        good &= (sizes[:, :2].sum(0) <= _GROWTH).all(0)
    return good & np.array([local is not None for local in found]), z


def _halves(numbers: list[arb]) -> Any:
    pairs = [Pair.of(v) for v in numbers]
    return np.array([[p.hi for p in pairs], [p.lo for p in pairs]])


@lru_cache
def _interpolation(count: int) -> tuple[list[arb], arb_mat]:
    """Chebyshev's points, and the matrix that makes coefficients of the values there."""
    nodes = [(arb.pi() * (2 * k + 1) / (2 * count)).cos() for k in range(count)]
    return nodes, arb_mat([[u**j for j in range(count)] for u in nodes]).inv()


@lru_cache
def _lowering(terms: int, kept: int) -> Any:
    """The matrix that replaces u^kept, ..., u^(terms - 1) by their Chebyshev series up to the degree kept - 1."""
    rows = [chebyshev.cheb2poly(chebyshev.poly2cheb([0] * n + [1])[:kept]) for n in range(kept, terms)]
    return np.array([np.pad(row, (0, kept - len(row))) for row in rows]).T


def _combined(cells: list[Cell], series: Pair, states: list[State], variant: _Variant) -> tuple[list[Pair], Any]:
    """The coefficients of the solution, and the powers of two that they are to be multiplied by."""
    data, powers = [], []
    for (y, dy), (_, e) in zip(states, cells, strict=True):
        both = y, dy * arb((1, e))
        size = max(abs(v).mid() for v in both)
        if max(r for v in both for r in (v.real.rad(), v.imag.rad())) > size * arb((1, -variant.bits)):
            raise LimitExceeded("the initial values are too inaccurate for a table", limit="digits")
        power = int(log2(size)) if size > 0 else 0
        powers.append(power if abs(power) > _ROOM else 0)
        data.append([v * arb((1, -powers[-1])) for v in both])
    is_real = all(v.imag.is_zero() for both in data for v in both)
    parts = []
    for part in ("real",) if is_real else ("real", "imag"):
        y, dy = (Pair(*_halves([getattr(both[i], part) for both in data])) for i in (0, 1))
        found = series[:, 0] * y + series[:, 1] * dy
        if part == "real":
            found += scaled(series[:, 2], -np.array(powers))
        parts.append(found)
    return parts, np.array(powers)

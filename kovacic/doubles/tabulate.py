"""Any solution on a regular real interval as a vectorised NumPy function: a table of polynomials in double-doubles.

For equations of every kind and every start that `kovacic.evaluate` takes.  The interval is covered by pieces [c - H, c + H],
H = 2^e at most a quarter of the distance from c to the nearest singular point, which are halved until the solutions grow
little on them and their Taylor series

    y(c + H u) = y(c) y1(u) + H y'(c) y2(u) + y3(u),    |u| <= 1,

end within a fixed number of terms; y1 and y2 solve the homogeneous equation, y3 begins with 0, 0.  The series come from the
recurrence of the equation, in double-doubles for all pieces at once; the states (y, y')(c) are enclosures.

Chebyshev's polynomials bring the highest terms down [L. N. Trefethen, Approximation Theory and Approximation Practice, SIAM
2013, chapter 3].  In the careful variant Horner's scheme is done in double-doubles, too, so that the error is some 2^-95 of the
largest value on the piece: the value itself keeps its digits near zeros, and where it is far smaller than its neighbours.  In
plain doubles the error is some 2^-52 of the largest value there.

An end of the interval may be a regular singular point, beside which the pieces shrink like the distance from it.  There the
table ends at 2^-46 of the larger end, so that the centres of the pieces are doubles.
"""

from __future__ import annotations

import math
import sys
from bisect import bisect_right
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property, lru_cache
from itertools import pairwise
from math import ldexp
from operator import itemgetter
from typing import Any, NamedTuple, Unpack

import numpy as np
from flint import arb, fmpq
from numpy.polynomial import chebyshev

from kovacic.algebra.precision import working_precision
from kovacic.doubles.chart import BLOCK, PRECISION, Measured, PieceChart, Region, chart_of, facts, in_blocks
from kovacic.doubles.double_double import (
    ROOM,
    Complex,
    Pair,
    complex_array,
    double,
    folded,
    halves,
    horner,
    scaled,
    two_sum,
)
from kovacic.enclosure.evaluate import with_variable
from kovacic.enclosure.frame import log2
from kovacic.enclosure.points import ExactPoint, power_of_two
from kovacic.enclosure.request import Keywords, Request, fields_of
from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import Limits, check_time, limited, limits_of

#: Pieces that are treated together, some 10 kilobytes each.
_PIECES_TOGETHER = 10_000
#: Neighbouring points on a piece from which on a plain polynomial with numbers for coefficients is faster (measured).
_POINTS_FOR_ONE_PIECE = 300
#: Bits after the binary point where the argument is a single number.
_FIXED_POINT = 112


class Variant(NamedTuple):
    """Terms of the series, those that must be small at their end, those that are kept, digits of the states, and the bits
    below the largest coefficient that count."""

    terms: int
    tested: int
    kept: int
    digits: int
    bits: int


Cell = tuple[fmpq, int]  # c, and e where H = 2^e


class _OnePiece(NamedTuple):
    """The coefficients of a polynomial from the highest one down, for single numbers: integers, over 2^shift; or doubles,
    without a shift."""

    numbers: list[Any]
    shift: int | None

    @classmethod
    def of(cls, table: Any, careful: bool) -> _OnePiece:
        """From high and low halves by terms."""
        if not careful:
            return cls(table[0, ::-1].tolist(), None)
        exact = [Fraction(high) + Fraction(low) for high, low in table.T[::-1].tolist()]
        size = max(map(abs, exact))
        shift = _FIXED_POINT - (size.numerator.bit_length() - size.denominator.bit_length())
        return cls([round(value * Fraction(2) ** shift) for value in exact], shift)

    def at(self, u: int, power: int) -> float:
        """The value at u, over 2^_FIXED_POINT, times 2^power; infinite beyond the doubles."""
        total: Any = 0
        if self.shift is None:
            total = horner(self.numbers, ldexp(u, -_FIXED_POINT))
        else:
            power -= self.shift
            for number in self.numbers:
                total = (total * u >> _FIXED_POINT) + number
        try:
            return ldexp(total, power)
        except OverflowError:
            return math.copysign(math.inf, total)


@dataclass(frozen=True, eq=False)
class TabulatedFunction:
    """A solution by polynomials, piece by piece: call it with a number or an array.

    A piece is a polynomial in (x - centre) 2^-exponent, times 2^power.  It keeps no state, and threads may share it.

    Attributes
    ----------
    region : Region
        Where it is defined: `low` and `high`.
    base : ExactPoint or None
        x0, where that is a regular point.
    edges, centres, exponents, powers : array
        Of the pieces; one is valid up to the next of the edges.
    coefficients : array
        Of the shape (parts, 2, terms, pieces): real and imaginary part (one part for a real function), high and low half.
    careful : bool
        Double-doubles; else it is plain double arithmetic.
    measured : Measured or None
        The error that `lambdify` found; None if it wasn't measured.

    Examples
    --------
    >>> import kovacic
    >>> sine = kovacic.tabulate("-1", 0, 10, x0=0, y0=0, dy0=1)
    >>> sine
    <TabulatedFunction on [0, 10], 4 pieces>
    >>> print(f"{sine(10.0):.15f}", sine([0.0, 0.0]))
    -0.544021110889370 [0. 0.]
    """

    region: Region
    base: ExactPoint | None
    edges: Any
    centres: Any
    exponents: Any
    powers: Any
    coefficients: Any
    careful: bool = True
    measured: Measured | None = None
    _alone: dict[int, list[_OnePiece]] = field(default_factory=dict, init=False)

    def __call__(self, x: Any) -> Any:
        """y(x), of the shape of x; inf or 0 where the value is beyond the doubles, and NaN for NaN.

        Parameters
        ----------
        x : number or array
            Within the interval.

        Raises
        ------
        InputError
            For an argument outside of the interval, or one that isn't numerical.

        Examples
        --------
        >>> f = tabulate("-1", 0, 10, x0=0, y0=0, dy0=1)                # the sine
        >>> print(f"{f(1.0):.12f}", f([1.0, 2.0]).shape)
        0.841470984808 (2,)
        """
        if isinstance(x, float) and self.region.low.real <= x <= self.region.high.real:
            return self._single(float(x))
        return in_blocks(self._values, self.region.points(x), BLOCK // 2)

    def __repr__(self) -> str:
        return f"<TabulatedFunction on {self.region}, {self.centres.size} pieces>"

    def _repr_html_(self) -> str:
        return facts("polynomials, piece by piece", self.region, self.measured, pieces=str(self.centres.size))

    @property
    def interval(self) -> tuple[float, float]:
        """The ends of the interval, doubles."""
        return self.region.interval

    @cached_property
    def derivative(self) -> TabulatedFunction:
        """y', a table on the same pieces; its error isn't measured, some ten times that of y over the length of a piece."""
        # d/dx = 2^-exponent d/du, and (u^n)' = n u^(n - 1).
        factors = np.arange(1.0, self.coefficients.shape[2])
        product = Pair(*self.coefficients[:, :, 1:].swapaxes(0, 1)) * Pair(factors[:, None])
        table = np.array([product.hi, product.lo]).swapaxes(0, 1)
        power = self.powers - self.exponents
        kept = np.where(np.abs(power) > ROOM, power, 0)
        table = np.ldexp(table, power - kept)
        table.flags.writeable = False
        return replace(self, coefficients=table, powers=kept, measured=None)

    def _single(self, x: float) -> Any:
        """The value at one number within the interval, without arrays."""
        edges, centres, exponents, powers = self._lists
        k = bisect_right(edges, x)
        if k not in self._alone:
            self._alone[k] = [_OnePiece.of(part[:, :, k], self.careful) for part in self.coefficients]
        # x - centre exactly, in units of 2^-_FIXED_POINT of the piece.
        offset = two_sum(x, -centres[k])
        u = sum(int(ldexp(half, _FIXED_POINT - exponents[k])) for half in (offset.hi, offset.lo))
        values = [part.at(u, powers[k]) for part in self._alone[k]]
        return values[0] if len(values) == 1 else complex(*values)

    @cached_property
    def _lists(self) -> tuple[list[float], list[float], list[int], list[int]]:
        """The edges, centres, exponents and powers as Python's numbers."""
        return self.edges.tolist(), self.centres.tolist(), self.exponents.tolist(), self.powers.tolist()

    def _values(self, flat: Any) -> Any:
        """At points of an array of one dimension."""
        index = np.searchsorted(self.edges, flat, side="right")
        found = np.zeros((len(self.coefficients), flat.size))  # real and imaginary part
        runs: list[tuple[slice, Any]] = [(slice(None), index)]
        ends = [0, *np.flatnonzero(np.diff(index)) + 1, index.size]
        if not self.careful and index.size > _POINTS_FOR_ONE_PIECE * len(ends):
            runs = [(slice(first, last), index[first]) for first, last in pairwise(ends)]
        for where, k in runs:
            u = scaled(two_sum(flat[where], -self.centres[k]), -self.exponents[k])
            for row, table in zip(found, self.coefficients[:, :, ::-1, k], strict=True):
                row[where] = double(horner(map(Pair, *table), u)) if self.careful else horner(table[0], u.hi)
        if self.powers.any():
            found = np.ldexp(found, self.powers[index])
        return complex_array(Complex(*found))


@limited
def tabulate(
    equation: object,
    start: object,
    stop: object,
    *,
    careful: bool = True,
    **keywords: Unpack[Keywords],
) -> TabulatedFunction:
    """One solution on [start, stop] in double precision, perhaps with complex values; the interval must be regular.

    Parameters
    ----------
    equation
        S or an equation, as for `kovacic.evaluate`, real for real x.
    start, stop : number
        The ends of the interval, real; no singular point lies between them.  Where one is a regular singular point, the table
        begins beside it, at 1.5e-14 of the larger end.
    careful : bool
        Double-doubles (the default): a unit in the last place, at 20 times the cost of plain ones.
    initial, path, params, var, limits
        As for `kovacic.evaluate`, the fields of `initial` as keywords, too; x0 may lie outside of the interval.

    Raises
    ------
    InputError
        For an empty interval, a singular point in it or between it and x0, and an irregular one at its end.
    LimitExceeded
        For more pieces than 25 times the limit `unknown_degree` (500,000 by default), and where the time is over.

    Examples
    --------
    >>> f = tabulate("-1", 0, 10, x0=0, y0=0, dy0=1)
    >>> print(f"{f(10.0):.15f}")      # sin 10
    -0.544021110889370
    >>> bessel = tabulate("x^2*y'' + x*y' + x^2*y = 0", 0, 9, x0=0, which="regular")
    >>> print(f"{bessel(5.0):.15f}")      # J0(5)
    -0.177596771314338
    """
    initial, accuracy, path, params, var = Request.of("tabulate", keywords, unused=("digits", "method"))
    equation = with_variable(equation, var, accuracy.limits, params)
    chart = chart_of(equation, {**fields_of(initial), "path": path}, params)
    return table_of(chart, chart.region((start, stop))[0], careful, accuracy.limits)


def table_of(chart: PieceChart, region: Region, careful: bool, limits: Limits | None) -> TabulatedFunction:
    """As `tabulate`, within a watched budget."""
    if not region.is_real:
        raise InputError("a table needs an interval of the real axis")
    region = _beside_singular_ends(chart, region)
    variant = Variant(48, 48, 34, 60, 96) if careful else Variant(48, 32, 22, 22, 60)
    with working_precision(PRECISION):
        cells, found = _cells(chart, region, variant, limits)
    rows = []
    for first in range(0, len(cells), _PIECES_TOGETHER):
        some = slice(first, first + _PIECES_TOGETHER)
        # series: (terms, solutions, pieces), states: ((y, H y'), parts, pieces), coefficients: (terms, parts, pieces).
        series = Pair(*np.stack(found[some], axis=-1))
        states, powers = _scaled_states(chart, cells[some], variant, limits)
        coefficients = series[:, 0, None] * states[0] + series[:, 1, None] * states[1]
        if chart.is_forced:
            own = scaled(series[:, 2, None], -powers)
            is_real_part = np.array([1.0, 0.0])[: states.hi.shape[1], None]  # the right-hand side is real
            coefficients += Pair(own.hi * is_real_part, own.lo * is_real_part)
        kept = variant.kept
        lowered = np.tensordot(_lowering(variant.terms, kept), coefficients.hi[kept:], 1)
        coefficients = coefficients[:kept] + Pair(lowered)
        # (halves, terms, parts, pieces) becomes (parts, halves, terms, pieces), the shape of the table.
        rows.append((np.array([coefficients.hi, coefficients.lo]).transpose(2, 0, 1, 3), powers))
    x0 = chart.given.get("x0")
    base = x0 if isinstance(x0, ExactPoint) else None
    parts = max(len(table) for table, _ in rows)  # one for a real function
    tables = [np.pad(table, ((0, parts - len(table)), (0, 0), (0, 0), (0, 0))) for table, _ in rows]
    arrays = (
        np.array([float(c + power_of_two(e)) for c, e in cells[:-1]]),
        np.array([float(c) for c, _ in cells]),
        np.array([e for _, e in cells]),
        np.concatenate([part for _, part in rows]),
        np.concatenate(tables, axis=-1),
    )
    for array in arrays:
        array.flags.writeable = False
    return TabulatedFunction(region, base, *arrays, careful=careful)


def _beside_singular_ends(chart: PieceChart, region: Region) -> Region:
    """The interval without neighbourhoods of singular ends.  Raises `InputError` for an irregular one."""
    low, high = region.interval
    gap = 2.0**-46 * max(abs(low), abs(high))
    ends = [end for end, is_singular in zip(region.interval, region.singular, strict=True) if is_singular]
    if any(abs(complex(point) - end) <= gap for end in ends for point in chart.irregular):
        raise InputError(
            "an end of the interval is an irregular singular point",
            hint="a table ends beside it; choose an end at some distance",
        )
    return Region(complex(low + gap * region.singular[0]), complex(high - gap * region.singular[1]))


def _cells(chart: PieceChart, region: Region, variant: Variant, limits: Limits | None) -> tuple[list[Cell], list[Any]]:
    """The pieces from left to right, no more than the limits allow, and the series on them."""
    low, high = (fmpq(*end.as_integer_ratio()) for end in region.interval)
    # 500,000 by default, of a kilobyte and 0.3 ms each (measured).
    most = 25 * limits_of(limits).unknown_degree
    # The first piece contains the interval, off the round numbers, at which solutions may be zero: that couldn't be told from
    # other small values.  Centres are doubles: multiples of a unit in the last place, or of 2^-24 of the first piece.
    e = math.frexp(float(high - low))[1]
    scale = power_of_two(e)
    grain = max(scale / 2**24, fmpq(*math.ulp(max(-region.low.real, region.high.real)).as_integer_ratio()))
    # From 53/128 2^e before the interval to 203/128 2^e behind its begin: its length is below 2^e.
    before = (low / grain).floor() - (scale * fmpq(53, 128) / grain).floor()
    untried: list[Cell] = [(before * grain + scale, e)]
    done: list[tuple[Cell, Any]] = []
    while untried:
        if len(untried) + len(done) > most:
            raise LimitExceeded(f"the table needs more than {most} pieces", limit="unknown_degree")
        smaller: list[Cell] = []
        for first in range(0, len(untried), _PIECES_TOGETHER):
            some = untried[first : first + _PIECES_TOGETHER]
            for cell, series in zip(some, _series_on(chart, some, variant, (low, high)), strict=True):
                if series is None:
                    smaller += _halves(cell, low, high)
                else:
                    done.append((cell, series))
        untried = smaller
    done.sort(key=itemgetter(0))
    return [cell for cell, _ in done], [item for _, item in done]


def _halves(cell: Cell, low: fmpq, high: fmpq) -> list[Cell]:
    """Those that meet the interval.  Raises `LimitExceeded` where they are too small."""
    c, e = cell[0], cell[1] - 1
    if e < sys.float_info.min_exp:
        raise LimitExceeded("no piece of positive size was found for the table", limit="unknown_degree")
    half = power_of_two(e)
    return [(m, e) for m in (c - half, c + half) if m + half > low and m - half < high]


def _series_on(chart: PieceChart, cells: list[Cell], variant: Variant, interval: tuple[fmpq, fmpq]) -> list[Any]:
    """y1, y2, and beside a right-hand side y3, on each of these pieces: high and low halves, terms, series.

    None for a piece on which they don't end or grow too much, or whose centre is outside of the interval.  The equation
    a y'' + b y' + c y = f has the coefficients of u^j at a[j], b[j + 1] and c[j + 2].
    """
    terms = variant.terms
    low, high = interval
    nothing = [[arb(1)], [], [arb("nan")], []]  # outside, or too near to a singular point
    equations = []
    for c, e in cells:
        check_time()
        is_covered = low <= c <= high and chart.is_regular(ExactPoint(c), e)
        equations.append(chart.local(ExactPoint(c), e, terms) if is_covered else nothing)
    length = max(2, *(len(part) + i for local in equations for i, part in enumerate(local[:3])))
    numbers = np.zeros((2, 3, length, len(cells)))
    source = np.zeros((2, terms, 3 if chart.is_forced else 2, len(cells)))
    for k, local in enumerate(equations):
        for i, part in enumerate(local[:3]):
            numbers[:, i, i : i + len(part), k] = halves(part)
        if chart.is_forced:
            source[:, : len(local[3]), 2, k] = halves(local[3])
    with np.errstate(all="ignore"):
        z = _series_recurrence(numbers, source, variant)
        sizes = np.abs(z[0, : variant.tested])
        # By four terms, since some equations have zeros in between: even solutions, or every fourth power only.
        converges = (sizes[-4:].max(0) <= sizes.max(0) * 2.0**-variant.bits).all(0)
        is_bounded = (sizes[:, :2].sum(0) <= 12).all(0)
    return [z[..., k] if will_do else None for k, will_do in enumerate(converges & is_bounded)]


def _series_recurrence(equation: Any, source: Any, variant: Variant) -> Any:
    """The coefficients of the series, shaped as those of the source, from the first two of y1, y2 and y3: 1, 0; 0, 1; 0, 0."""
    a, b, c = (Pair(*equation[:, i]) for i in range(3))
    length = equation.shape[2]
    z = np.zeros(source.shape)  # halves, terms, solutions, pieces
    z[0, 0, 0] = z[0, 1, 1] = 1.0
    for n in range(2, variant.terms):
        j = np.arange(1, min(length, n + 1))
        m = (n - j)[:, None] + 0.0
        weights = c[j]
        for function, factor in ((b, m), (a, m * (m - 1))):
            if function.hi[1:].any():
                weights += function[j] * Pair(factor)
        if n < variant.tested:
            rest = Pair(*source[:, n - 2]) - folded(weights[:, None] * Pair(*z[:, n - j]))
            term = rest * Pair.of(1 / arb(n * (n - 1)))
            z[:, n] = term.hi, term.lo
        else:  # as small as the last half of the digits
            z[0, n] = (source[0, n - 2] - (weights.hi[:, None] * z[0, n - j]).sum(0)) / (n * (n - 1))
    return z


@lru_cache
def _lowering(terms: int, kept: int) -> Any:
    """The matrix that replaces u^kept, ..., u^(terms - 1) by their Chebyshev series up to the degree kept - 1."""
    rows = [chebyshev.cheb2poly(chebyshev.poly2cheb([0] * n + [1])[:kept]) for n in range(kept, terms)]
    return np.array([np.pad(row, (0, kept - len(row))) for row in rows]).T


def _scaled_states(chart: PieceChart, cells: list[Cell], variant: Variant, limits: Limits | None) -> tuple[Pair, Any]:
    """(y, H y') at the centres over powers of two, an array of both, parts and pieces; and these powers."""
    balls = chart.states([ExactPoint(c) for c, _ in cells], variant.digits, limits)
    numbers = list[arb]()
    powers = np.zeros(len(cells), dtype=int)
    with working_precision(PRECISION):
        for k, ((_, e), (y, dy)) in enumerate(zip(cells, balls, strict=True)):
            row = (y, dy * arb((1, e)))
            # The larger of |y| and |H y'|: a power of two about that is taken out of both.
            size = max(abs(v).mid() for v in row)
            if max(abs(v).rad() for v in row) > size * arb((1, -variant.bits)):
                raise LimitExceeded("the initial values are too inaccurate for a table", limit="digits")
            # 0 for the zero solution, or where one with a right-hand side has a double zero.
            powers[k] = int(log2(size)) if size > 0 else 0
            scale = arb((1, -int(powers[k])))
            for v in row:
                imaginary = v.imag * 0 if v.imag.contains(0) else v.imag
                numbers += [v.real * scale, imaginary * scale]
        # From (halves, pieces, (y, H y'), (re, im)) to (halves, (y, H y'), (re, im), pieces).
        table = halves(numbers).reshape(2, len(cells), 2, 2).transpose(0, 2, 3, 1)
    # Small powers go into the coefficients, which stay doubles.
    kept = np.where(np.abs(powers) > ROOM, powers, 0)
    # Imaginary parts that are all zero are left out.
    return scaled(Pair(*table[:, :, : 1 + table[:, :, 1].any()]), powers - kept), kept

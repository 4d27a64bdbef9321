"""Where a double-precision function is defined: a real interval, or a rectangle of the complex plane."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.points import ExactPoint, as_point, to_acb
from kovacic.enclosure.problem import NumericProblem
from kovacic.enclosure.system import name_of
from kovacic.errors import InputError
from kovacic.writing.document import FORMATS, Table

_PREC = 240

MEDIAN = 8.0
WORST = 1000.0
"""What is promised, in units in the last place."""

BLOCK = 16384
"""Points that are treated together (measured: half as many take a third longer, as many again no less)."""


class Measured(NamedTuple):
    """Errors in units in the last place of |y|.

    Attributes
    ----------
    median, worst : float
        Of all points.
    points : int
        Where there is a value to compare with.
    """

    median: float
    worst: float
    points: int

    @property
    def keeps_the_promise(self) -> bool:
        """At most `MEDIAN` and `WORST`."""
        return self.points > 0 and self.median <= MEDIAN and self.worst <= WORST

    def __str__(self) -> str:
        return f"median {self.median:.3g}, worst {self.worst:.3g} of {self.points} points"


def facts(kind: str, region: Region, measured: Measured | None, **more: str) -> str:
    """What a notebook shows of a function: where it is defined, and its error in units in the last place."""
    error = "not measured" if measured is None else f"{measured}, in units in the last place"
    rows = [("function", kind), ("defined on", str(region)), *more.items(), ("error", error)]
    return FORMATS["html"].render([Table((), rows)]).rstrip()


@dataclass(frozen=True)
class Region:
    """A real interval [low, high], or the closed rectangle with these corners (lower left, upper right).

    `singular` says which of the two are singular points, where there is no value.
    """

    low: complex
    high: complex
    singular: tuple[bool, bool] = (False, False)

    def __str__(self) -> str:
        low, high = (self.low.real, self.high.real) if self.is_real else (self.low, self.high)
        return f"[{low:g}, {high:g}]"

    @property
    def is_real(self) -> bool:
        """Is this an interval of the real axis?"""
        return self.low.imag == 0 == self.high.imag

    def points(self, x: Any) -> Any:
        """The argument as an array of doubles or complex doubles; raises InputError where it leaves the region.

        What is masked stays masked, and may be anything.
        """
        points: Any = np.asanyarray(x) if np.ma.isMaskedArray(x) else np.asarray(x)
        if not np.issubdtype(points.dtype, np.number):
            raise InputError(f"the argument isn't numerical ({points.dtype})")
        if self.is_real and np.iscomplexobj(points):
            raise InputError(
                "complex arguments need a rectangle of the complex plane", hint="give two opposite corners as interval"
            )
        kind = float if self.is_real else complex
        points = points.astype(kind, copy=False)
        if np.ma.is_masked(points):
            middle: Any = (self.low + self.high) / 2
            points = np.ma.array(points.filled(middle.real if self.is_real else middle), mask=points.mask)
        # By the extremes, but for NaN, which has the value NaN.
        inside = not points.size or _between(self.low.real, points.real, self.high.real)
        if not self.is_real and points.size:
            inside = inside and _between(self.low.imag, points.imag, self.high.imag)
        ends = zip((self.low, self.high), self.singular, strict=True)
        if not inside or any(singular and np.any(points == end) for end, singular in ends):
            shown = (self.low.real, self.high.real) if self.is_real else (self.low, self.high)
            raise InputError(f"a point lies outside of the interval {shown} of this function, or on a singular point")
        return points

    @property
    def interval(self) -> tuple[float, float]:
        """The ends, of a real interval."""
        return self.low.real, self.high.real


def _between(low: float, values: Any, high: float) -> bool:
    """Do all of these that are numbers lie there?"""
    least = np.fmin.reduce(values, axis=None)
    largest = np.fmax.reduce(values, axis=None)
    return not (least < low or largest > high)


def in_blocks(function: Callable[[Any], Any], points: Any, block: int = BLOCK) -> Any:
    """The function of the points, so many at a time: what is formed on the way stays in the processor's cache."""
    if np.ma.isMaskedArray(points):
        return np.ma.array(in_blocks(function, points.data, block), mask=points.mask)
    flat = points.reshape(-1)
    with np.errstate(all="ignore"):  # inf or 0 where a value is beyond the range of doubles
        first = function(flat[:block])
        if flat.size <= block:
            return first.reshape(points.shape)[()]
        result = np.empty(flat.shape, first.dtype)  # once: for a list of parts memory is cleared and given back
        result[:block] = first
        for start in range(block, flat.size, block):
            result[start : start + block] = function(flat[start : start + block])
    return result.reshape(points.shape)


def region_of(problem: NumericProblem | None, interval: tuple[object, object]) -> tuple[Region, list[ExactPoint]]:
    """The region in doubles, the nearest ones to its ends, and some points near its middle.

    Raises InputError if it is empty, or contains a singular point of the problem other than its two ends.
    """
    try:
        first, second = interval
    except (TypeError, ValueError):
        raise InputError("the interval must be a pair of numbers") from None
    a, b = (as_point(v, "an end of the interval") for v in (first, second))
    low = ExactPoint(min(a.re, b.re), min(a.im, b.im))
    high = ExactPoint(max(a.re, b.re), max(a.im, b.im))
    is_reversed = a.is_real() and b.is_real() and a != low
    if a == b or is_reversed:
        raise InputError("the interval is empty", hint="give two real numbers, the smaller one first")
    singular = (False, False)
    if problem is not None:
        with working_precision(_PREC):
            singular = _singular_ends(problem, low, high)
    left, right = _doubles(low.re, high.re, singular)
    bottom, top = _doubles(low.im, high.im, singular)
    if left > right or bottom > top:
        raise InputError("the interval contains no double")
    if problem is not None and not any(singular):
        with working_precision(_PREC):  # a double may lie beyond the end that it stands for
            _singular_ends(problem, as_point(complex(left, bottom), "an end"), as_point(complex(right, top), "an end"))
    near = [low + (high - low).scaled(Fraction(k, 64)) for k in (32, 31, 34, 27, 39)]
    return Region(complex(left, bottom), complex(right, top), singular), near


def _singular_ends(problem: NumericProblem, low: ExactPoint, high: ExactPoint) -> tuple[bool, bool]:
    """Is it singular at these corners?  Raises InputError where it may be at another point."""
    at_low = False
    at_high = False
    a = to_acb(low)
    b = to_acb(high)
    systems = (problem.system, problem.further_poles)
    for root in problem.enclosures(_PREC):
        is_low = root.overlaps(a)
        is_high = root.overlaps(b)
        is_beside = root.real < a.real or root.real > b.real
        is_above_or_below = root.imag < a.imag or root.imag > b.imag
        is_outside = is_beside or is_above_or_below
        if not (is_low or is_high or is_outside):
            raise InputError(f"the interval contains the singular point {name_of(systems, root)}")
        at_low = at_low or is_low
        at_high = at_high or is_high
    return at_low, at_high


def _doubles(low: Fraction, high: Fraction, singular: tuple[bool, bool]) -> tuple[float, float]:
    """The nearest doubles, so that "0.3" and 0.3 are one end; inside of the interval where an end is a singular point."""
    try:
        a = float(low)
        b = float(high)
    except OverflowError:
        raise InputError("an end of the interval is beyond the range of doubles") from None
    if singular[0] and Fraction(a) < low:
        a = math.nextafter(a, math.inf)
    if singular[1] and Fraction(b) > high:
        b = math.nextafter(b, -math.inf)
    return a, b

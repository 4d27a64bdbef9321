"""An equation seen from the middle of a piece, x = c + H u, |u| <= 1, and the states of one of its solutions in balls.

A `Region` is where a double-precision function is defined: a real interval, or a rectangle of the complex plane.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from flint import acb, arb, fmpq_poly

from kovacic.algebra.precision import working_precision
from kovacic.answer import Answer
from kovacic.enclosure.analytic import way_of
from kovacic.enclosure.ball import ball_from_flint
from kovacic.enclosure.closed_form import Exponential, exponential_solutions, finite_base, omega
from kovacic.enclosure.frame import name_of
from kovacic.enclosure.functions import coefficients_of_any
from kovacic.enclosure.jets import CoefficientField
from kovacic.enclosure.matrices import State
from kovacic.enclosure.points import ExactPoint, Points, as_point, in_balls, midpoint, power_of_two, to_acb
from kovacic.enclosure.precision import start_bits
from kovacic.enclosure.problem import Coefficients, NumericProblem, as_problem
from kovacic.enclosure.request import Params
from kovacic.enclosure.states import evaluate_states
from kovacic.enclosure.way import States
from kovacic.errors import InputError, NotRational
from kovacic.limits import DEFAULT_LIMITS, Limits, check_time, count_work
from kovacic.reading.change_of_variable import function_of_x, without_change
from kovacic.writing.document import notebook_table

#: Bits for whatever becomes a double-double: more than twice those of one.
PRECISION = 256
#: The promised errors, in units in the last place.
MEDIAN, WORST = 8.0, 1000.0
#: Points that are treated together (measured: half as many take a third longer, twice as many no less).
BLOCK = 16384


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
    """The HTML of a function for notebooks: where it is defined, and its error in units in the last place."""
    error = "not measured" if measured is None else f"{measured}, in units in the last place"
    return notebook_table([("function", kind), ("defined on", str(region)), *more.items(), ("error", error)])


@dataclass(frozen=True)
class Region:
    """A real interval [low, high], or the closed rectangle with these corners (lower left, upper right).

    `singular` is True for each of the two that is a singular point, where there is no value.
    """

    low: complex
    high: complex
    singular: tuple[bool, bool] = (False, False)

    def __str__(self) -> str:
        low, high = self.corners
        return f"[{low:g}, {high:g}]"

    @property
    def corners(self) -> tuple[complex, complex]:
        """Both corners, doubles on the real axis."""
        return self.interval if self.is_real else (self.low, self.high)

    @property
    def is_real(self) -> bool:
        """True for an interval of the real axis."""
        return self.low.imag == 0 == self.high.imag

    def points(self, x: Any) -> Any:
        """The argument as an array of doubles or complex doubles; raises InputError if it leaves the region.

        Masked entries stay masked, and may be anything.
        """
        points: Any = np.asanyarray(x) if np.ma.isMaskedArray(x) else np.asarray(x)
        if not np.issubdtype(points.dtype, np.number):
            raise InputError(f"the argument isn't numerical ({points.dtype})")
        if self.is_real and np.iscomplexobj(points):
            raise InputError(
                "complex arguments need a rectangle of the complex plane", hint="give two opposite corners as interval"
            )
        low, high = self.corners
        points = points.astype(type(low), copy=False)
        # Any point of the region will do for a value that stays masked.
        if np.ma.is_masked(points):
            points = np.ma.array(points.filled((low + high) / 2), mask=points.mask)
        # By the extremes; fmin and fmax leave NaN out, which has the value NaN.
        planes = (low.real, points.real, high.real), (low.imag, points.imag, high.imag)
        outside = points.size and any(
            np.fmin.reduce(values, axis=None) < least or np.fmax.reduce(values, axis=None) > most
            for least, values, most in planes
        )
        ends = zip((low, high), self.singular, strict=True)
        if outside or any(singular and np.any(points == end) for end, singular in ends):
            raise InputError(
                f"a point lies outside of the interval {(low, high)} of this function, or on a singular point"
            )
        return points

    @property
    def interval(self) -> tuple[float, float]:
        """The ends, of a real interval."""
        return self.low.real, self.high.real


def in_blocks(function: Callable[[Any], Any], points: Any, block: int = BLOCK) -> Any:
    """The function at the points, in chunks whose intermediate arrays stay in the processor's cache."""
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
    singular = _singular_ends(problem, low, high)
    left, right = _doubles(low.re, high.re, singular)
    bottom, top = _doubles(low.im, high.im, singular)
    if left > right or bottom > top:
        raise InputError("the interval contains no double")
    if not any(singular):  # a double may lie beyond the end that it stands for
        _singular_ends(problem, as_point(complex(left, bottom), "an end"), as_point(complex(right, top), "an end"))
    # The middle, and other places in case a solution is zero there.
    near = [low + (high - low).scaled(Fraction(k, 64)) for k in (32, 31, 34, 27, 39)]
    return Region(complex(left, bottom), complex(right, top), singular), near


@working_precision(PRECISION)
def _singular_ends(problem: NumericProblem | None, low: ExactPoint, high: ExactPoint) -> tuple[bool, bool]:
    """True for each of the two corners that is a singular point.  Raises InputError if another point may be one."""
    at_low = at_high = False
    a, b = to_acb(low), to_acb(high)
    if problem is None:
        return at_low, at_high
    for root in problem.enclosures(PRECISION):
        # A root that overlaps an end is taken for it; others have to be apart from the rectangle.
        is_low, is_high = root.overlaps(a), root.overlaps(b)
        outside = [root.real < a.real, root.real > b.real, root.imag < a.imag, root.imag > b.imag]
        if not any([is_low, is_high, *outside]):
            raise InputError(f"the interval contains the singular point {name_of(problem.places, root)}")
        at_low |= is_low
        at_high |= is_high
    return at_low, at_high


def _doubles(low: Fraction, high: Fraction, singular: tuple[bool, bool]) -> tuple[float, float]:
    """The nearest doubles, so that "0.3" and 0.3 are one end; inside of the interval where an end is a singular point."""
    try:
        a = float(low)
        b = float(high)
    except OverflowError:
        raise InputError("an end of the interval is beyond the range of doubles") from None
    # A singular end itself has no value, nor what lies beyond it.
    if singular[0] and Fraction(a) < low:
        a = math.nextafter(a, math.inf)
    if singular[1] and Fraction(b) > high:
        b = math.nextafter(b, -math.inf)
    return a, b


#: Precision of an initial slope, for Taylor steps: its error, times the growth of the dominant solution, contaminates a
#: recessive one.
_SLOPE_BITS = 4000

_COMPLEX = "functions of real numbers need an equation with real coefficients"


@dataclass(frozen=True)
class PieceChart:
    """An equation a y'' + b y' + c y = f, and one of its solutions, by the options of `evaluate` that are `given`.

    It is rational (`problem`), or has any functions of x as `coefficients`.  If these are rational in a function t of x, and
    the equation was solved, `problem` is that in t, and `read` the equation with the change of the variable.
    """

    given: dict[str, Any]
    problem: NumericProblem | None = None
    coefficients: Coefficients | None = None
    read: Any = None
    branch: Exponential | None = None

    def region(self, interval: tuple[object, object]) -> tuple[Region, list[ExactPoint]]:
        """See `region_of`; raises InputError if a singular point is in the interval or on the way to it."""
        found = region_of(self._rational, interval)
        if self.coefficients is not None and self.given and found[0].is_real:
            self.states([as_point(end, "x") for end in found[0].interval], 3, None)
        return found

    @property
    def _rational(self) -> NumericProblem | None:
        """The equation if it is rational in x."""
        return self.problem if self.coefficients is None else None

    @working_precision(_SLOPE_BITS + 200)
    def _in_t(self, x: ExactPoint) -> tuple[ExactPoint, acb]:
        """About t, and dt/dx."""
        if self.coefficients is None:
            return x, acb(1)
        t = function_of_x(self.read)
        known = self.coefficients.at(to_acb(x))
        return midpoint(in_balls(t, known)), in_balls(t.diff(self.coefficients.variable), known)

    def base(self, which: int, candidates: list[ExactPoint]) -> ExactPoint:
        """The first of the points where the logarithmic derivative number `which` is finite."""
        assert self.problem is not None
        places = [self._in_t(x)[0] for x in candidates]
        return candidates[places.index(finite_base(self.problem, which, places))]

    def beginning(self, which: int, base: ExactPoint) -> PieceChart:
        """The solution with this logarithmic derivative, 1 at the base."""
        assert self.problem is not None
        branches = exponential_solutions(self.problem) if self.coefficients is None else []
        if branches:
            return replace(self, given={"x0": base}, branch=branches[which])
        place, rate = self._in_t(base)
        slope = omega(self.problem, which, place, _SLOPE_BITS)
        with working_precision(_SLOPE_BITS + 200):
            return replace(self, given={"x0": base, "y0": 1, "dy0": ball_from_flint(slope * rate)})

    def states(self, points: Points, digits: int, limits: Limits | None, **options: Any) -> list[State]:
        """y and dy/dx, to the given digits where that is possible; with any functions along the real axis."""
        if self.branch is not None:
            return self._closed(self.branch, points, digits)
        options |= {"digits": digits, "limits": limits, **self.given}
        if self.coefficients is not None:
            options["path"] = self.given.get("path")
        return [s.state for s in evaluate_states(self.coefficients or self.problem, points, **options)]

    def _closed(self, branch: Exponential, points: Points, digits: int) -> list[State]:
        """y = exp(int theta) P/P(base) and y' from the certificate, without the zeros of P.

        It isn't integrated, where the dominant solution would grow: a call of `lambdify` takes 5 ms in place of 30 to 2,600.
        """
        # Without the guard bits.
        goal = start_bits(digits) - 24
        prec = 2 * start_bits(digits) + branch.P.degree
        found: States = {}
        while len(found) < len({*points}):
            with working_precision(prec):
                z = to_acb(self.given["x0"])
                for point in (point for point in points if point not in found):
                    check_time()
                    count_work(prec)
                    (y0, _), (y, dy) = branch.states(z, to_acb(point))
                    if (y / y0).rel_accuracy_bits() > goal or prec > _SLOPE_BITS + 4 * branch.P.degree:
                        found[point] = y / y0, dy / y0
            prec *= 2
        return [found[point] for point in points]

    @property
    def is_forced(self) -> bool:
        """True if there is a right-hand side."""
        if self.coefficients is not None:
            return bool(self.coefficients.f != 0)
        return self.problem is not None and self.problem.right is not None

    @cached_property
    def _exact(self) -> Sequence[fmpq_poly]:
        """a, b and c if they are polynomials over Q and there is no right-hand side; else nothing."""
        problem = self._rational
        return () if problem is None or problem.right is not None or not problem.is_rational else problem.equation

    @cached_property
    def _functions(self) -> CoefficientField:
        """The coefficients in balls."""
        if self.coefficients is not None:
            return CoefficientField(self.coefficients)
        assert self.problem is not None
        return way_of(self.problem).functions

    @cached_property
    def singular(self) -> list[ExactPoint]:
        """The midpoints of enclosures of the singular points; of other functions none is known, but ways refuse them."""
        return [] if self._rational is None else self._rational.singular_points(128)

    @property
    def irregular(self) -> list[ExactPoint]:
        """Those near which solutions may be as large as exp(1/distance)."""
        poles = () if self._rational is None else self._rational.poles(128)
        return [midpoint(root) for root, order in poles if order > 2]

    def is_regular(self, centre: ExactPoint, e: int) -> bool:
        """True if four times the disc with the scale 2^e is free of singular points, or other functions are provably analytic
        in twice the disc."""
        if self.coefficients is not None:
            with working_precision(64):
                return self._functions.sizes(centre, arb((1, e + 1))) is not None
        return all((point - centre).norm_squared() > power_of_two(2 * e + 4) for point in self.singular)

    def local(self, centre: ExactPoint, e: int, terms: int) -> list[list[arb]]:
        """a, H b, H^2 c and H^2 f over a(c), at least the first `terms` terms in u, or all; NaN if they aren't finite.

        f is left out where it is zero and all are short polynomials.  Raises `InputError` unless they are real.
        """
        if max((part.degree() for part in self._exact), default=terms) < terms:
            line = fmpq_poly([centre.x, power_of_two(e)])
            found = [[arb(v) for v in part(line).coeffs()] for part in self._exact]
            # a, H b and H^2 c over a(c).
            factors = [arb((1, k * e)) / found[0][0] for k in range(3)]
            return [[v * factor for v in part] for part, factor in zip(found, factors, strict=True)]
        parts = self._functions.series(centre, e, terms)
        if parts is None:
            return [[arb(1)], [], [arb("nan")], []]
        rows = [[acb(v) for v in part.coeffs()] or [acb(0)] for part in parts]
        if not all(v.imag.contains(0) for row in rows for v in row):
            raise InputError(_COMPLEX, hint="evaluate takes others")
        # The first one is of a/a(c) - 1.
        (_, *a), *others = ([v.real for v in row] for row in rows)
        return [[arb(1), *a], *others]


def chart_of(equation: object, given: dict[str, Any], params: Params, *, constants: bool = True) -> PieceChart:
    """The chart of an equation, as `evaluate` takes it; right-hand sides and constants only where a solution is `given`."""
    try:
        return PieceChart(given, _real_problem(equation, params, constants))
    except NotRational:
        pass
    coefficients = coefficients_of_any(equation, params, DEFAULT_LIMITS)
    problem = None
    if isinstance(equation, Answer) and not constants:
        problem = _real_problem(without_change(equation), params, constants)
    return PieceChart(given, problem, coefficients, getattr(equation, "equation", None))


def _real_problem(equation: object, params: Params, constants: bool) -> NumericProblem:
    problem = as_problem(equation, params, forced=constants, constants=constants)
    if not problem.is_real:
        raise InputError(_COMPLEX, hint="evaluate takes others")
    return problem

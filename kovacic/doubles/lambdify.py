"""Solutions as vectorised NumPy functions in double precision, in a numerically stable arrangement, with a measured error.

Which arrangement, by what the certificate says, where no initial values are given:

- case 1, omega = theta + P'/P: the product exp(int theta) P over the zeros of P, in x (`kovacic.doubles.product_form`);
  real where omega is real, for real or for complex arguments;
- everything else on the real axis (cases 2 and 3, P of degree above 200): a table (`kovacic.doubles.tabulate`).

The error is measured, not proven, in units in the last place against 50 digits: of the closed form in balls in case 1, else of
the Taylor route (without initial values a constant factor is free: it is fixed as the median of the quotients).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from operator import attrgetter
from typing import Any, Unpack

import numpy as np
from flint import acb

from kovacic.algebra.precision import working_precision
from kovacic.api import find_answer
from kovacic.doubles.chart import PRECISION, Measured, PieceChart, Region, chart_of
from kovacic.doubles.product_form import ProductForm, product_form
from kovacic.doubles.tabulate import TabulatedFunction, table_of
from kovacic.enclosure.ball import ball_from_flint
from kovacic.enclosure.evaluate import with_variable
from kovacic.enclosure.points import ExactPoint, as_point, to_acb
from kovacic.enclosure.precision import AccuracyWarning
from kovacic.enclosure.request import Keywords, Params, Path, Request, Start, fields_of
from kovacic.errors import InputError, LimitExceeded, warn_user
from kovacic.limits import DEFAULT_LIMITS, Limits, bounded_work, limited
from kovacic.numbers.exact import exact_real, whole

#: The sizes of values whose errors count.
TINY, HUGE = 2.0**-960, 2.0**1020
#: Digits of the reference values.
_DIGITS_OF_REFERENCE = 50
#: Steps of Taylor's method, or values of closed forms, times their bits, for the reference values of one measurement: 20 s.
_MOST_WORK_FOR_REFERENCE = 1_500_000
#: The least distance from a zero at which errors are measured, over that to the next zero.
_BESIDE_ZEROS = 0.01
#: The solutions that `solutions` prints.
_PRINTED = ("y1", "y2")

DoubleFunction = ProductForm | TabulatedFunction


@limited
def lambdify(
    solution: object,
    *,
    interval: tuple[object, object],
    careful: bool | None = None,
    check: bool = True,
    **keywords: Unpack[Keywords],
) -> DoubleFunction:
    """A solution as a vectorised NumPy function in double precision, with its error measured.

    Real solutions give doubles, others complex doubles.  A function keeps no state: threads may share it.  Making one sets
    python-flint's precision, under the package's lock.

    Parameters
    ----------
    solution
        What `kovacic.solve` returned.  With initial values also S or an equation, as text, SymPy expression or coefficients:
        all that `kovacic.evaluate` takes.
    interval : pair
        Two real numbers between which there is no singular point; or, in case 1, two opposite corners of a rectangle of the
        complex plane, for complex arguments.  The ends may be singular points, of a table regular ones: it begins beside them.
    which : int or str
        Without initial values: the number of the logarithmic derivative omega, 0 by default.  In case 1 it numbers the
        conjugates of omega, or the two rational ones; in cases 2 and 3 the roots of the polynomial of omega near the middle of
        the interval, by real and then imaginary part.  The constant factor is that of `kovacic.doubles.product_form`; tables
        are 1 near the middle.  "y1" or "y2": the solution that `solutions` prints, as a table.  With x0 the field of `Start`.
    careful : bool or None
        True: the arithmetic is that of double-doubles, 20 times slower; False: that of plain doubles.  By default (None) plain
        doubles, unless the measured error is above 8 (median) or 1,000 (worst) units.
    check : bool
        By default the error is measured; False leaves that out, which is faster, and `measured` is None.
    initial, path, params, var, limits
        As for `kovacic.evaluate`, the fields of `initial` as keywords, too: with a start the solution becomes a table.

    Returns
    -------
    ProductForm or TabulatedFunction
        Called with a number or an array.  `measured` has the error in units in the last place of |y|: at 24 points, which are
        the ends of the interval (if they are singular, a thousandth of its length beside them), a point on either side of up to
        three zeros of a real solution, at a hundredth of the distance to the next zero, and others in between; and at four of
        thousands, no nearer to zeros, where plain doubles differ most from double-doubles.

    Raises
    ------
    InputError
        Without a Liouvillian solution and without initial values; for an interval that is empty or has a singular point
        inside, for complex arguments in cases 2 and 3, for a table up to an irregular singular point, for constants that aren't
        rational.
    TypeError
        For a keyword that isn't known.

    Warns
    -----
    AccuracyWarning
        Where the error is above these bounds after all, or measuring it would take more steps than some 20 s have.

    Examples
    --------
    Without initial values; `which` chooses between two solutions, and complex arguments are those of a rectangle:

    >>> import kovacic
    >>> f = lambdify(kovacic.solve("x^2 + 3"), interval=(0, 2))   # x exp(x^2/2)
    >>> print(f"{f(1.0):.12f}", f.measured.worst < 8)
    1.648721270700 True
    >>> second = lambdify(kovacic.solve("1"), interval=(0, 1), which=1, check=False)
    >>> print(f"{second(1.0)/second(0.0):.12f}")
    0.367879441171
    >>> y1 = lambdify(kovacic.solve("2/x^2 - 1"), interval=(1, 9), which="y1")  # (x cos(x) - sin(x))/x
    >>> print(f"{y1(2.0):.12f}")
    -0.870795549960
    >>> wave = lambdify(kovacic.solve("x^2 + 3"), interval=(0, 1 + 1j), check=False)
    >>> print(f"{wave(0.5 + 0.5j):.10f}")
    0.3607542312+0.6081581905j

    With initial values, for any equation; and the solution that is regular at a singular point:

    >>> airy = lambdify("a*x", interval=(-9, 2), params={"a": 1}, x0=0, y0=1, dy0=0)
    >>> print(f"{airy(1.0):.12f}")
    1.172299970058
    >>> J0 = lambdify("x^2*y'' + x*y' + x^2*y = 0", interval=(1, 5), x0=0, which="regular")
    >>> print(f"{J0(2.0):.12f}")
    0.223890779141
    """
    initial, accuracy, path, params, var = Request.of("lambdify", keywords, unused=("digits", "method"))
    limits, which = accuracy.limits, initial.which
    start, number = _start_or_number(initial, path)
    chart = _chart(with_variable(solution, var, limits, params), start, params, limits)
    region, candidates = chart.region(interval)
    base = None
    if isinstance(which, str) and which in _PRINTED:
        chart = replace(chart, given=_printed(solution, which, candidates, params))
    elif not start:
        base = chart.base(number, candidates)
        chart = chart.beginning(number, base)
    form = None
    if base is not None and chart.problem is not None and chart.coefficients is None:
        form = product_form(chart.problem, number, region, base)
    if form is None and not region.is_real:
        raise InputError("complex arguments need a solution of case 1", hint="evaluate treats every complex point")

    def made(careful: bool) -> DoubleFunction:
        return table_of(chart, region, careful, limits) if form is None else replace(form, careful=careful)

    function = made(bool(careful))
    if not check:
        return function
    begin = chart.given if base is None else None
    found, complaint = _measured(function, chart, begin, limits)
    if careful is None and found is not None and complaint:
        function = made(True)
        found, complaint = _measured(function, chart, begin, limits)
    if complaint:
        warn_user(complaint, AccuracyWarning)
    return replace(function, measured=found)


def _start_or_number(initial: Start, path: Path) -> tuple[dict[str, Any], int]:
    """The keywords of the start and the path, if there are any, or else the number of the solution."""
    which = initial.which
    start = fields_of(initial) | ({} if path is None else {"path": path})
    if isinstance(which, str) and which in _PRINTED:
        if len(start) > 1:
            raise InputError(f"which={which!r} is a solution without initial values")
        return {}, 0
    number = 0 if isinstance(which, str) else whole(start.pop("which", 0), "which")
    if start and "x0" not in start:
        raise InputError(f"{', '.join(start)} without a point: x0 is needed", hint="x0=0, y0=1, dy0=0, for instance")
    if start and number:
        raise InputError("which= numbers the solutions where no initial values are given")
    return start, number


def _printed(solution: object, which: str, candidates: Sequence[ExactPoint], params: Params) -> dict[str, Any]:
    """The start of y1 or y2 of the closed form, from its balls at the first of the points where they are finite."""
    import sympy

    from kovacic.closed_form.jets import jet

    pair = getattr(solution, "solutions", ())
    if not pair:
        raise InputError(f"which={which!r} needs what kovacic.solve returns for an equation with closed forms")
    values = {sympy.Symbol(name): sympy.Rational(exact_real(value, name)) for name, value in (params or {}).items()}
    y = pair[_PRINTED.index(which)].xreplace(values)
    with working_precision(PRECISION):
        for point in candidates:
            value, slope, _ = jet(y, sympy.Symbol(solution.variable), to_acb(point))  # type: ignore[attr-defined]
            if value.is_finite() and slope.is_finite():
                return {"x0": point, "y0": ball_from_flint(value), "dy0": ball_from_flint(slope)}
    raise InputError(f"{y} has no value near the middle of the interval")


def _chart(solution: object, start: dict[str, Any], params: Params, limits: Limits | None) -> PieceChart:
    """The equation with the values of its parameters; without initial values, with a decision."""
    chart = chart_of(solution, start, params, constants=bool(start))
    if start:
        return chart
    problem = chart.problem
    if params and problem is not None:
        # The answer was one for generic values.
        problem = replace(problem, decision=find_answer(problem.S, limits=limits or DEFAULT_LIMITS).decision)
        chart = replace(chart, problem=problem)
    if problem is None or problem.decision is None or problem.decision.semi_invariant is None:
        raise InputError(
            "lambdify needs a Liouvillian solution, found by kovacic.solve, or initial values",
            hint="x0=, y0= and dy0= serve every S",
        )
    return chart


def _measured(
    function: DoubleFunction, chart: PieceChart, start: dict[str, Any] | None, limits: Limits | None
) -> tuple[Measured | None, str]:
    """The error of the function, and a complaint unless it is as small as promised."""
    unknown = "the error of this function couldn't be measured"
    try:
        with bounded_work(_MOST_WORK_FOR_REFERENCE):
            found = measure(function, chart, start=start, limits=limits)
    except LimitExceeded as limit:
        return None, f"{unknown}: {limit}"
    if found.keeps_the_promise:
        return found, ""
    if not found.points:
        return found, f"{unknown}: all samples are beyond the range of doubles"
    return found, f"measured error of this function in units in the last place: {found}"


def measure(
    function: DoubleFunction,
    equation: object,
    points: Sequence[Any] | Any = None,
    *,
    which: int = 0,
    start: Mapping[str, Any] | None = None,
    limits: Limits | None = None,
) -> Measured:
    """The errors at `points` (by default those of `lambdify`) of a function made by it with this `which` or start.

    Points where the solution is 0 or beyond the range of doubles don't count; a wrong 0, inf or NaN does.  Raises
    LimitExceeded where the reference isn't found within the limits.
    """
    chart = equation if isinstance(equation, PieceChart) else chart_of(equation, dict(start or {}), None)
    if not chart.given:
        assert function.base is not None
        chart = chart.beginning(which, function.base)
    extra = np.empty(0)
    if points is None:
        near = _zeros_and_gaps(function)
        points, extra = measured_points(function, near), _suspects(function, *near)
    # Suspects count for the worst error, not for the median.
    given = np.append(np.atleast_1d(points), extra)
    found = function(given)
    places = [as_point(complex(x), "x") for x in given]
    reference = [y for y, _ in chart.states(places, _DIGITS_OF_REFERENCE, limits, method="taylor")]
    if not all(y.contains(0) or y.rel_accuracy_bits() >= _DIGITS_OF_REFERENCE * math.log2(10) for y in reference):
        raise LimitExceeded("the reference values weren't found to 50 digits", limit="digits")
    with working_precision(PRECISION):
        errors = _errors(found, reference, normed=bool(start))
    typical = [e for e in errors[: len(errors) - extra.size] if e is not None]
    counted = [e for e in errors if e is not None]
    return Measured(float(np.median(typical or [math.inf])), max(counted, default=math.inf), len(counted))


def _errors(found: Any, reference: list[acb], *, normed: bool) -> list[float | None]:
    """In units in the last place, None if the solution may be 0 or is beyond the range of normal doubles.

    Unless `normed`, up to the factor that fits most of them.
    """
    with np.errstate(all="ignore"):
        sizes = np.abs(found)
    triples = [(complex(v), size, y) for v, size, y in zip(found, sizes, reference, strict=True)]
    quotients = [(acb(v) / y).mid() for v, size, y in triples if TINY < size < math.inf and not y.contains(0)]
    if not quotients:
        return []
    factor = acb(1)
    if not normed:  # the median by the real or the imaginary parts, whichever is the larger of the first one
        part = "real" if abs(quotients[0].real) >= abs(quotients[0].imag) else "imag"
        factor = sorted(quotients, key=attrgetter(part))[len(quotients) // 2]

    def units(value: complex, size: float, y: acb) -> float | None:
        exact = (y * factor).mid()
        if y.contains(0) or not TINY < abs(exact) < HUGE:
            return None
        if not math.isfinite(size):
            return math.inf
        return float(abs(value - exact) / float(np.spacing(float(abs(exact)))))

    return [units(*triple) for triple in triples]


def measured_points(function: DoubleFunction, near: tuple[Any, Any] | None = None) -> Any:
    """The points at which a function is measured, wherever its errors are: see `lambdify`."""
    region: Region = function.region
    size = region.high - region.low

    def shares(count: int) -> Any:
        """No round shares of the interval, at which solutions are often 0."""
        return (np.arange(count) + 0.5) / (count + 0.13)

    if not region.is_real:
        return region.low + size.real * shares(24) + 1j * size.imag * ((shares(24) * 7.3) % 1)
    left, right = (size.real / 1000 * singular for singular in region.singular)
    zeros, gaps = near or _zeros_and_gaps(function)
    chosen = np.unique(np.linspace(0, len(zeros) - 1, 3 if len(zeros) else 0).astype(int))
    beside = [zeros[chosen] + way * gaps[chosen] for way in (-_BESIDE_ZEROS, _BESIDE_ZEROS)]
    between = region.low.real + size.real * shares(24 - 2 - 2 * len(chosen))
    return np.concatenate([[region.low.real + left, region.high.real - right], *beside, between])


def _suspects(function: DoubleFunction, zeros: Any, gaps: Any) -> Any:
    """The points where plain arithmetic differs most from double-doubles, a constant factor apart, out of thousands: none is
    nearer to a zero than a hundredth of the distance to the next one."""
    if not isinstance(function, DoubleFunction) or function.careful:
        return np.empty(0)
    exact = replace(function, careful=True)
    points = _dense_points(function)
    if len(zeros):
        starts, stops = (np.searchsorted(zeros + way * gaps, points) for way in (-_BESIDE_ZEROS, _BESIDE_ZEROS))
        # As near to zeros as is measured, where plain doubles lose most.
        beside = [zeros + way * _BESIDE_ZEROS * gaps for way in (-2.0, -1.5, -1.2, -1.0, 1.0, 1.2, 1.5, 2.0)]
        points = np.concatenate([points[starts == stops], *beside])
    with np.errstate(all="ignore"):
        y = exact(points)
        sizes = np.abs(y)
        quotients = function(points) / y
        # Normal doubles, with room: else the units are those of the underflow.
        within = np.flatnonzero((sizes > TINY) & (sizes < HUGE) & np.isfinite(quotients))
        sizes = sizes[within]
        quotients = quotients[within]
        factor = np.median(quotients) if within.size else 1
        # |f/y - factor| |y| in units in the last place of y.
        errors = np.abs(quotients - factor) * sizes / np.spacing(sizes)
    return points[within[np.argsort(errors)[-4:]]]


def _dense_points(function: DoubleFunction) -> Any:
    """Thousands of points all over the region, and on each piece of a table."""
    region = function.region
    low = region.low.real
    size = region.high - region.low
    # Eight points, at no round shares, in each of 400 parts.
    knots = np.append(getattr(function, "edges", ()), low + size.real * np.linspace(0, 1, 401))
    knots = np.unique(np.clip(knots, low, region.high.real))
    x = (knots[:-1, None] + np.diff(knots)[:, None] * (np.arange(8) + 0.53) / 8.07).reshape(-1)
    return x if region.is_real else x + 1j * (region.low.imag + size.imag * (np.arange(x.size) * 0.618 % 1))


def _zeros_and_gaps(function: DoubleFunction) -> tuple[Any, Any]:
    """Changes of sign of a real function on an interval, and the distances to the next ones or the ends; none of others."""
    if isinstance(function, DoubleFunction):
        function = replace(function, careful=False)
    x = _dense_points(function)
    y = function(x)
    if np.iscomplexobj(y):
        return np.empty(0), np.empty(0)
    # Changes of sign between neighbouring points of the grid.
    k = np.flatnonzero(np.sign(y[1:]) * np.sign(y[:-1]) < 0)
    with np.errstate(all="ignore"):
        quotient = np.abs(y[k + 1] / y[k])
    # The zero of the line through both points, |y_k|/(|y_k| + |y_(k+1)|) of the way.
    zeros = x[k] + (x[k + 1] - x[k]) / (1 + np.where(np.isfinite(quotient), quotient, 1.0))
    gaps = np.diff([function.region.low.real, *zeros, function.region.high.real])
    return zeros, np.minimum(gaps[:-1], gaps[1:])

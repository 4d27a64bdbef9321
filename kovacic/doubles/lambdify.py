"""Solutions as vectorised NumPy functions in double precision, in a numerically stable arrangement, with a measured error.

Which arrangement, by what the certificate says, where no initial values are given:

- case 1, omega = theta + P'/P: the product exp(int theta) P over the zeros of P, in x (`kovacic.doubles.product_form`);
  real where omega is real, for real or for complex arguments;
- case 2 on a rational curve s^2 = g, deg g <= 2: the same product in the parameter of the curve, since the integral in
  the exponent is elementary there (`kovacic.doubles.arrangement`); for an interval of the real axis;
- everything else on the real axis (case 2 on other curves, case 3, P of degree above 200): a table
  (`kovacic.doubles.tabulate`).

The error is measured, not proven, in units in the last place against 50 digits: of the closed form in balls in case 1, else of
the Taylor route (without initial values a constant factor is free: it is fixed as the median of the quotients).
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from flint import acb

from kovacic.api import find_answer
from kovacic.doubles.arrangement import product_form
from kovacic.doubles.chart import PieceChart, chart_of
from kovacic.doubles.product_form import ProductForm
from kovacic.doubles.region import Measured, Region
from kovacic.doubles.tabulate import TabulatedFunction, table_of
from kovacic.enclosure.evaluate import StartOptions
from kovacic.enclosure.points import as_point, working_precision
from kovacic.enclosure.precision import AccuracyWarning
from kovacic.errors import InputError, LimitExceeded, check_keywords
from kovacic.exact import whole
from kovacic.limits import DEFAULT_LIMITS, Limits, bounded_work, limited

TINY, HUGE = 2.0**-960, 2.0**1020
"""Where values count."""

_DIGITS = 50
_PREC = 240
_BITS = 166
"""The bits of 50 digits."""

_MOST_WORK = 1_500_000
"""Steps of Taylor's method, or values of closed forms, times their bits: for the reference values of one measurement."""

_SAMPLES, _ZEROS, _WORST = 24, 3, 4
"""Points at which a function is measured, zeros that are looked at from both sides, and points that are suspected."""

_MANY, _EACH, _BESIDE = 400, 8, 0.01
"""Parts of a region, points of each that suspects are chosen from, and the distance from a zero over that to the next one."""

Function = ProductForm | TabulatedFunction


@limited
def lambdify(
    solution: object,
    *,
    interval: tuple[object, object],
    which: object = 0,
    careful: bool | None = None,
    check: bool = True,
    params: Mapping[str, object] | None = None,
    x0: object = None,
    limits: Limits | None = None,
    **given: Any,
) -> Function:
    """A solution as a NumPy function on an interval without singular points, with its error measured.

    `interval` is a pair of real numbers; or two opposite corners of a rectangle of the complex plane, for complex
    arguments (case 1 only).  The solution is

    - the one that starts as `kovacic.evaluate` says it: x0 with y0 and dy0, with frobenius, or with which="regular" or
      "decaying": a table, for every equation that `evaluate` takes;
    - else the one with the logarithmic derivative number `which`.  In case 1 `which` numbers the conjugates of omega, or the
      two rational ones; in cases 2 and 3 the roots of the polynomial of omega near the middle of the interval, by real and
      then imaginary part.  The constant factor is that of `kovacic.doubles.product_form`; y = 1 near the middle for tables.
      The ends of a product form may be singular points.  Constants must be rational, and the values of `params`.

    Real solutions give doubles, others complex doubles.  With `check` the error is measured, in units in the last place of
    |y|, and stands in `measured`: at 24 points, which are the ends of the interval (if they are singular, a thousandth of its
    length beside them), a point on either side of up to three zeros of a real solution, at a hundredth of the distance to
    the next zero, and others in between; and at four of thousands, no nearer to zeros, where plain doubles differ most from
    double-doubles.  The arithmetic is that of plain doubles, unless this error is above 8 (median) or 1,000 (worst): then it
    is that of double-doubles, 20 times slower; `careful` True or False chooses.  An AccuracyWarning says where the error is
    above these bounds after all, or where measuring it would take more steps than some 20 s have.  A function keeps no state:
    threads may share it.  Making one sets python-flint's precision, under the package's lock.

    Raises InputError without a Liouvillian solution and without initial values, for an interval that is empty or has a
    singular point inside, for complex arguments in cases 2 and 3, and for a table up to a singular point.

    >>> import kovacic
    >>> f = lambdify(kovacic.solve("x^2 + 3"), interval=(0, 2))   # x exp(x^2/2)
    >>> print(f"{f(1.0):.12f}", f.measured.worst < 8)
    1.648721270700 True
    >>> airy = lambdify("a*x", interval=(-9, 2), params={"a": 1}, x0=0, y0=1, dy0=0)
    >>> print(f"{airy(1.0):.12f}")
    1.172299970058
    """
    check_keywords("lambdify", given, StartOptions.__annotations__)
    start: dict[str, Any] = {**given}
    if isinstance(which, str):
        start["which"] = which
        number = 0
    else:
        number = whole(which, "which")
    if start and x0 is None:
        raise InputError(f"{', '.join(start)} without a point: x0 is needed", hint="x0=0, y0=1, dy0=0, for instance")
    if start and number:
        raise InputError("which= numbers the solutions where no initial values are given")
    if x0 is not None:
        start["x0"] = x0
    chart = chart_of(solution, start, params, constants=bool(start))
    problem = chart.problem
    if not start and params and problem.S is not None:
        problem = replace(problem, decision=find_answer(problem.S, limits=limits or DEFAULT_LIMITS).decision)
        chart = replace(chart, problem=problem)
    if not start and (problem.decision is None or problem.decision.semi_invariant is None):
        raise InputError(
            "lambdify needs a Liouvillian solution, found by kovacic.solve, or initial values",
            hint="x0=, y0= and dy0= serve every S",
        )
    region, candidates = chart.region(interval)
    variants = (careful,) if careful is not None else (False, True) if check else (False,)
    base = None if start else chart.base(number, candidates)
    if base is not None:
        chart = chart.beginning(number, base)
    form: ProductForm | None = None
    found: Measured | str | None
    for variant in variants:
        if base is not None and chart.answer is None and (form is None or form.polynomial is not None):
            with working_precision(_PREC):
                form = product_form(problem, number, region, base, variant)
        if form is None and not region.is_real:
            raise InputError("complex arguments need a solution of case 1", hint="evaluate treats every complex point")
        function: Function = (
            table_of(chart, interval, variant, limits) if form is None else replace(form, careful=variant)
        )
        try:
            with bounded_work(_MOST_WORK):
                found = measure(function, chart, start=start, limits=limits) if check else None
        except LimitExceeded as limit:
            found = str(limit)
        if not isinstance(found, Measured) or found.keeps_the_promise:
            break
    if found is None:
        return function
    text = f"measured error of this function in units in the last place: {found}"
    if isinstance(found, str) or not found.points:
        reason = found if isinstance(found, str) else "all samples are beyond the range of doubles"
        text = f"the error of this function couldn't be measured: {reason}"
    if isinstance(found, str) or not found.keeps_the_promise:
        warnings.warn(text, AccuracyWarning, stacklevel=3)
    return replace(function, measured=found) if isinstance(found, Measured) else function


def measure(
    function: Function,
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
    near = _zeros(function) if points is None else ()
    extra = _suspects(function, *near) if near else np.empty(0)
    given = np.append(samples(function, near) if near else np.atleast_1d(points), extra)
    exact = [as_point(complex(x), "x") for x in given]
    found = [complex(v) for v in function(given)]
    reference = [y for y, _ in chart.states(exact, _DIGITS, limits, method="taylor")]
    if not all(y.contains(0) or y.rel_accuracy_bits() >= _BITS for y in reference):
        raise LimitExceeded("the reference values weren't found to 50 digits", limit="digits")
    with working_precision(_PREC):
        pairs = list(zip(found, reference, strict=True))
        quotients = [(acb(v) / y).mid() for v, y in pairs if TINY < _size(v) < math.inf and not y.contains(0)]
        if not quotients:
            return Measured(math.inf, math.inf, 0)
        by_real = abs(quotients[0].real) >= abs(quotients[0].imag)
        quotients.sort(key=lambda q: q.real if by_real else q.imag)
        factor = acb(1) if start else quotients[len(quotients) // 2]
        errors = [None if y.contains(0) else _units(v, (y * factor).mid()) for v, y in pairs]
    typical, counted = ([e for e in some if e is not None] for some in (errors[: len(errors) - extra.size], errors))
    return Measured(float(np.median(typical or [math.inf])), max(counted, default=math.inf), len(counted))


def samples(function: Function, near: tuple[Any, Any] | None = None) -> Any:
    """The points at which a function is measured, wherever its errors are: see `lambdify`."""
    region: Region = function.region
    low, size = region.low, region.high - region.low
    if not region.is_real:
        share = (np.arange(_SAMPLES) + 0.5) / (_SAMPLES + 0.13)
        return low + size.real * share + 1j * size.imag * ((share * 7.3) % 1)
    left, right = (size.real / 1000 * singular for singular in region.singular)
    zeros, gaps = near or _zeros(function)
    chosen = np.unique(np.linspace(0, len(zeros) - 1, _ZEROS if len(zeros) else 0).astype(int))
    beside = [zeros[chosen] + way * gaps[chosen] for way in (-_BESIDE, _BESIDE)]
    count = _SAMPLES - 2 - 2 * len(chosen)
    between = low.real + size.real * (np.arange(count) + 0.5) / (count + 0.13)
    return np.concatenate([[low.real + left, region.high.real - right], *beside, between])


def _suspects(function: Function, zeros: Any, gaps: Any) -> Any:
    """The points where plain arithmetic differs most from double-doubles, a constant factor apart, out of thousands: none is
    nearer to a zero than a hundredth of the distance to the next one."""
    if not isinstance(function, Function) or function.careful:
        return np.empty(0)
    exact, points = replace(function, careful=True), _grid(function)
    if isinstance(exact, ProductForm) and exact.polynomial is not None:
        exact = replace(exact, polynomial=replace(exact.polynomial, careful=True))
    if len(zeros):
        starts, stops = (np.searchsorted(zeros + way * gaps, points) for way in (-_BESIDE, _BESIDE))
        beside = [zeros + way * _BESIDE * gaps for way in (-2.0, -1.5, -1.2, -1.0, 1.0, 1.2, 1.5, 2.0)]
        points = np.concatenate([points[starts == stops], *beside])
    with np.errstate(all="ignore"):
        sizes, quotients = np.abs(y := exact(points)), function(points) / y
        within = np.flatnonzero((sizes > TINY) & (sizes < HUGE) & np.isfinite(quotients))
        sizes, quotients = sizes[within], quotients[within]
        errors = np.abs(quotients - (np.median(quotients) if within.size else 1)) * sizes / np.spacing(sizes)
    return points[within[np.argsort(errors)[-_WORST:]]]


def _grid(function: Function) -> Any:
    """Thousands of points all over the region, and on each piece of a table."""
    region, table = function.region, getattr(function, "polynomial", function)
    low, size = region.low.real, region.high - region.low
    knots = np.append(getattr(table, "edges", ()), low + size.real * np.linspace(0, 1, _MANY + 1))
    knots = np.unique(np.clip(knots, low, region.high.real))
    x = (knots[:-1, None] + np.diff(knots)[:, None] * (np.arange(_EACH) + 0.53) / (_EACH + 0.07)).reshape(-1)
    return x if region.is_real else x + 1j * (region.low.imag + size.imag * (np.arange(x.size) * 0.618 % 1))


def _zeros(function: Function) -> tuple[Any, Any]:
    """Changes of sign of a real function on an interval, and the distances to the next ones or the ends; none of others."""
    if isinstance(function, Function):
        function = replace(function, careful=False)
    x = _grid(function)
    y = function(x)
    if np.iscomplexobj(y):
        return np.empty(0), np.empty(0)
    k = np.flatnonzero(np.sign(y[1:]) * np.sign(y[:-1]) < 0)
    (a, b), (p, q) = x[[k, k + 1]], y[[k, k + 1]]
    for _ in range(4):
        with np.errstate(all="ignore"):
            quotient = np.abs(q / p)
        zeros = a + (b - a) / (1 + np.where(np.isfinite(quotient), quotient, 1.0))
        left = np.sign(values := function(zeros)) == np.sign(p)
        (a, p), (b, q) = np.where(left, (zeros, values), (a, p)), np.where(left, (b, q), (zeros, values))
    gaps = np.diff([function.region.low.real, *zeros, function.region.high.real])
    return zeros, np.minimum(gaps[:-1], gaps[1:])


def _units(value: complex, exact: acb) -> float | None:
    """The error of one value; None where the exact value is beyond the range of normal doubles."""
    size = abs(exact)
    if not TINY < size < HUGE:
        return None
    if not math.isfinite(_size(value)):
        return math.inf
    return float(abs(value - exact) / float(np.spacing(float(size))))


def _size(value: complex) -> float:
    """|value|, infinite or NaN where it is; Python's `abs` raises beyond the doubles, and for a NaN after any overflow."""
    return math.hypot(value.real, value.imag)

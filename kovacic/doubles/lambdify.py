"""Solutions as vectorised NumPy functions in double precision, in a numerically stable arrangement, with a measured error.

Which arrangement, by what the certificate says, where no initial values are given:

- case 1, omega = theta + P'/P: the product exp(int theta) P over the zeros of P, in x (`kovacic.doubles.product_form`);
  real where omega is real, for real or for complex arguments;
- case 2 on a rational curve s^2 = g, deg g <= 2: the same product in the parameter of the curve, since the integral in
  the exponent is elementary there (`kovacic.doubles.arrangement`); for an interval of the real axis;
- everything else on the real axis (case 2 on other curves, case 3, P of degree above 200): a table of proven Taylor
  expansions (`kovacic.doubles.tabulate`).

The error is measured, not proven, in units in the last place against 50 digits: of the closed form in balls in case 1, else of
the Taylor route (without initial values a constant factor is free: it is fixed as the median of the quotients).
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from flint import acb

from kovacic.doubles.arrangement import product_form
from kovacic.doubles.product_form import ProductForm
from kovacic.doubles.region import Measured, Region, region_of
from kovacic.doubles.tabulate import TabulatedFunction, tabulate
from kovacic.enclosure.ball import ball_from_flint, ball_to_flint
from kovacic.enclosure.closed_form import exponentials, finite_base, omega
from kovacic.enclosure.evaluate import AccuracyWarning, evaluate_states
from kovacic.enclosure.exponential import LogDerivative, embed
from kovacic.enclosure.points import Point, as_point, to_acb
from kovacic.enclosure.problem import NumericProblem, as_problem
from kovacic.enclosure.working import working_precision
from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits

TINY, HUGE = 2.0**-960, 2.0**1020
"""Where values count."""

_DIGITS = 50
_PREC = 240
_SLOPE_BITS = 4000
"""Precision of an initial slope, for Taylor steps: its error, times the growth of the dominant solution, contaminates a
recessive one."""

_SAMPLES = 24


def lambdify(
    solution: object,
    *,
    interval: tuple[object, object],
    which: int = 0,
    x0: object = None,
    y0: object = None,
    dy0: object = None,
    careful: bool | None = None,
    check: bool = True,
    limits: Limits | None = None,
) -> ProductForm | TabulatedFunction:
    """A solution as a NumPy function on an interval without singular points, with its error measured.

    `interval` is a pair of real numbers; or two opposite corners of a rectangle of the complex plane, for complex
    arguments (case 1 only).  The solution is

    - the one with y(x0) = y0, y'(x0) = dy0, where these are given: a table, for every S;
    - else the one with the logarithmic derivative number `which`.  In case 1 `which` numbers the conjugates of omega, or the
      two rational ones; in cases 2 and 3 the roots of the polynomial of omega near the middle of the interval, by real and
      then imaginary part.  The constant factor is that of `kovacic.doubles.product_form`; y = 1 near the middle for tables.
      The ends of a product form may be singular points.

    Real solutions give doubles, others complex doubles.  With `check` the error is measured at 24 points, and stands in
    `measured`.  The arithmetic is that of plain doubles, unless its error is above 8 units in the last place (median) or 1,000
    (worst): then it is that of double-doubles, 20 times slower; `careful` True or False chooses.  An AccuracyWarning says
    where the error is above these bounds after all, or couldn't be measured within 20 s.  A function keeps no state: threads
    may share it.  Making one sets python-flint's precision, under the package's lock.

    Raises InputError without a Liouvillian solution and without initial values, for an interval that is empty or has a
    singular point inside, for complex arguments in cases 2 and 3, and for a table up to a singular point.

    >>> import kovacic
    >>> f = lambdify(kovacic.solve("x^2 + 3"), interval=(0, 2))   # x exp(x^2/2)
    >>> print(f"{f(1.0):.12f}", f.measured.worst < 8)
    1.648721270700 True
    >>> airy = lambdify("x", interval=(-9, 2), x0=0, y0=1, dy0=0)
    >>> print(f"{airy(1.0):.12f}")
    1.172299970058
    """
    problem = as_problem(solution)
    budget = Budget(limits or DEFAULT_LIMITS)
    start = None if x0 is None else Start(x0, y0, dy0)
    certificate = problem.decision is not None and problem.decision.semi_invariant is not None
    if start is None and not certificate:
        raise InputError(
            "lambdify needs a Liouvillian solution, found by kovacic.solve, or initial values",
            hint="x0=, y0= and dy0= serve every S",
        )
    with budget.watched():
        make = _maker(problem, interval, which, start, budget)
        function = make(bool(careful))
        if not check:
            return function
        found = _measured(function, problem, which, start, budget)
        if careful is None and isinstance(found, Measured) and not found.keeps_the_promise:
            function = make(True)
            found = _measured(function, problem, which, start, budget)
    _warn(found)
    return replace(function, measured=found) if isinstance(found, Measured) else function


class Start(NamedTuple):
    """y(x0) = y0 and y'(x0) = dy0."""

    x0: object
    y0: object
    dy0: object


Maker = Callable[[bool], ProductForm | TabulatedFunction]
"""The careful variant of a function, or the plain one."""


def _maker(
    problem: NumericProblem, interval: tuple[object, object], which: int, start: Start | None, budget: Budget
) -> Maker:
    region, candidates = region_of(problem, interval)
    form = None
    if start is None:
        base = finite_base(problem, which, candidates)
        with working_precision(_PREC):
            form = product_form(problem, which, region, base)
        if form is None:
            if not region.is_real:
                raise InputError(
                    "complex arguments need a solution of case 1", hint="evaluate treats every complex point"
                )
            start = Start(base, 1, ball_from_flint(omega(problem, which, base, _SLOPE_BITS)))

    def make(careful: bool) -> ProductForm | TabulatedFunction:
        if form is not None:
            return replace(form, careful=careful)
        assert start is not None
        options: dict[str, Any] = {**start._asdict(), "careful": careful, "limits": budget.share(1).limits}
        return tabulate(problem, *interval, **options)

    return make


def measure(
    function: ProductForm | TabulatedFunction,
    equation: object,
    points: Sequence[Any] | Any = None,
    *,
    which: int = 0,
    start: Start | None = None,
    limits: Limits | None = None,
) -> Measured:
    """The errors at `points` (by default 24 of the region) of a function made by `lambdify` with this `which` or start.

    Points where the solution is 0 or beyond the range of doubles don't count; a wrong 0, inf or NaN does.  Raises
    LimitExceeded where the reference isn't found within the limits.
    """
    problem = as_problem(equation)
    given = samples(function.region) if points is None else np.atleast_1d(points)
    exact = [as_point(complex(x), "x") for x in given]
    found = [complex(v) for v in function(given)]
    reference = None if start else _exponentials(problem, which, function.base, exact)
    if reference is None:
        slope = None if start else ball_from_flint(omega(problem, which, function.base, _SLOPE_BITS))
        begin = (start or Start(function.base, 1, slope))._asdict()
        states = evaluate_states(problem, exact, **begin, digits=_DIGITS, method="taylor", limits=limits)
        if not all(state.reached or state.y.contains_zero() for state in states):
            raise LimitExceeded("the reference values weren't found to 50 digits", limit="digits")
        reference = [ball_to_flint(state.y) for state in states]
    with working_precision(_PREC):
        pairs = [(v, y) for v, y in zip(found, reference, strict=True) if not y.contains(0)]
        quotients = [(acb(v) / y).mid() for v, y in pairs if TINY < abs(v) < math.inf]
        if not quotients:
            return Measured(math.inf, math.inf, 0)
        by_real = abs(quotients[0].real) >= abs(quotients[0].imag)
        quotients.sort(key=lambda q: q.real if by_real else q.imag)
        factor = acb(1) if start else quotients[len(quotients) // 2]
        errors = [error for v, y in pairs if (error := _units(v, (y * factor).mid())) is not None]
    return Measured(float(np.median(errors)), max(errors), len(errors))


def _exponentials(problem: NumericProblem, which: int, base: Point, points: Sequence[Point]) -> list[acb] | None:
    """y/y(base) = exp(int theta) P/P(base) in balls, to 50 digits or 0; None in cases 2 and 3.

    From the certificate, without the zeros of P, and without an integration of the equation, in which the dominant solution
    would grow.
    """
    prec, branches = _PREC, exponentials(problem)
    while branches:
        with working_precision(prec):
            c = branches[which].constant()
            theta, P, z = LogDerivative.make(branches[which].theta, c), embed(branches[which].P, c), to_acb(base)
            found = [theta.growth(z, x) * P(x) / P(z) for x in map(to_acb, points)]
        if prec > _SLOPE_BITS or all(
            y.rel_accuracy_bits() > 166 or (y.contains(0) and prec > 2 * _PREC) for y in found
        ):
            return found
        prec *= 2
    return None


def samples(region: Region) -> Any:
    """The default points: 24 of the interval, or of the rectangle."""
    share = (np.arange(_SAMPLES) + 0.5) / (_SAMPLES + 0.13)
    real = region.low.real + (region.high.real - region.low.real) * share
    if region.is_real:
        return real
    other = (share * 7.3) % 1.0
    return real + 1j * (region.low.imag + (region.high.imag - region.low.imag) * other)


def _units(value: complex, exact: acb) -> float | None:
    """The error of one value; None where the exact value is beyond the range of normal doubles."""
    size = abs(exact)
    if not TINY < size < HUGE:
        return None
    if not math.isfinite(abs(value)):
        return math.inf
    return float(abs(value - exact) / float(np.spacing(float(size))))


def _measured(
    function: ProductForm | TabulatedFunction, problem: NumericProblem, which: int, start: Start | None, budget: Budget
) -> Measured | str:
    """The error on the default points, or why it couldn't be measured."""
    try:
        limits = Limits(seconds=min(20.0, budget.seconds_left))
        return measure(function, problem, which=which, start=start, limits=limits)
    except LimitExceeded as limit:
        return str(limit)


def _warn(found: Measured | str) -> None:
    """An AccuracyWarning where the promise isn't kept or can't be checked."""
    reason = found if isinstance(found, str) else "" if found.points else "all samples are beyond the range of doubles"
    if reason:
        warnings.warn(f"the error of this function couldn't be measured: {reason}", AccuracyWarning, stacklevel=4)
    elif isinstance(found, Measured) and not found.keeps_the_promise:
        warnings.warn(
            f"measured error of this function in units in the last place: {found}", AccuracyWarning, stacklevel=4
        )

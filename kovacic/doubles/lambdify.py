"""Solutions as vectorised NumPy functions in double precision, in a numerically stable arrangement, with a measured error.

Which arrangement, by what the certificate says:

- case 1, omega = theta + P'/P: the product exp(int theta) P over the zeros of P, in x (`kovacic.doubles.product_form`);
  real where omega is real, for real or for complex arguments;
- case 2 on a rational curve s^2 = g, deg g <= 2: the same product in the parameter of the curve, since the integral in
  the exponent is elementary there (`kovacic.doubles.arrangement`); for an interval of the real axis;
- everything else on the real axis (case 2 on other curves, case 3, P of degree above 200): a table of proven Taylor
  expansions (`kovacic.doubles.tabulate`).

The error is measured, not proven, in units in the last place against the Taylor route at 50 digits (a constant factor is free:
it is fixed as the median of the quotients); an AccuracyWarning is given where it exceeds 8 in the median, or 1,000 at worst.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from flint import acb

from kovacic.doubles.arrangement import product_form
from kovacic.doubles.product_form import ProductForm
from kovacic.doubles.region import Region, region_of
from kovacic.doubles.tabulate import TabulatedFunction, tabulate
from kovacic.enclosure.ball import ball_from_flint, ball_to_flint
from kovacic.enclosure.closed_form import finite_base, omega
from kovacic.enclosure.evaluate import AccuracyWarning, evaluate_states
from kovacic.enclosure.points import as_point
from kovacic.enclosure.problem import as_problem
from kovacic.enclosure.working import working_precision
from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits

MEDIAN, WORST = 8.0, 1000.0
"""What is promised, in units in the last place."""

TINY, HUGE = 2.0**-960, 2.0**1020
"""Where values count."""

_DIGITS = 50
_PREC = 240
_SLOPE_BITS = 4000
"""Precision of an initial slope: a recessive solution is contaminated by its error times the growth of the dominant one."""

_SAMPLES = 24


def lambdify(
    solution: object,
    *,
    interval: tuple[object, object],
    which: int = 0,
    check: bool = True,
    limits: Limits | None = None,
) -> ProductForm | TabulatedFunction:
    """The solution with the logarithmic derivative number `which`, as a NumPy function on an interval without singular points.

    `interval` is a pair of real numbers; or two opposite corners of a rectangle of the complex plane, for complex
    arguments (case 1 only).  The ends of a product form may be singular points.  In case 1 `which` numbers the conjugates of
    omega, or the two rational ones; in cases 2 and 3 the roots of the polynomial of omega near the middle of the interval,
    by real and then imaginary part.  The constant factor is that of `kovacic.doubles.product_form`; y = 1 near the middle
    for tables.  Real solutions give doubles, others complex doubles.

    With `check` the error is measured at 24 points, and an AccuracyWarning is given above 8 units in the last place
    (median) or 1,000 (worst), or where the Taylor route needs more than 20 s.

    Raises InputError without a Liouvillian solution (`tabulate` treats every S), for an interval that is empty or has a
    singular point inside, for complex arguments in cases 2 and 3, and for a table up to a singular point.

    >>> import kovacic
    >>> f = lambdify(kovacic.solve("x^2 + 3"), interval=(0, 2))   # x exp(x^2/2)
    >>> print(f"{f(1.0):.15f}")
    1.648721270700128
    """
    problem = as_problem(solution)
    if problem.decision is None or problem.decision.semi_invariant is None:
        raise InputError(
            "lambdify needs a Liouvillian solution, found by kovacic.solve",
            hint="kovacic.doubles.tabulate.tabulate treats every S, by initial values",
        )
    budget = Budget(limits or DEFAULT_LIMITS)
    with budget.watched():
        region, candidates = region_of(problem, interval)
        base = finite_base(problem, which, candidates)
        with working_precision(_PREC):
            found: ProductForm | TabulatedFunction | None = product_form(problem, which, region, base)
        if found is None:
            if not region.is_real:
                raise InputError(
                    "complex arguments need a solution of case 1", hint="evaluate treats every complex point"
                )
            slope = ball_from_flint(omega(problem, which, base, _SLOPE_BITS))
            ends = region.low.real, region.high.real
            found = tabulate(problem, *ends, x0=base, y0=1, dy0=slope, limits=budget.share(1).limits)
    if check:
        warn_unless_accurate(found, problem, which, budget.seconds_left)
    return found


class Measured(NamedTuple):
    """Errors in units in the last place of |y|, at so many `points` where there is a value to compare with."""

    median: float
    worst: float
    points: int


def measure(
    function: ProductForm | TabulatedFunction,
    equation: object,
    points: Sequence[Any] | Any = None,
    *,
    which: int = 0,
    limits: Limits | None = None,
) -> Measured:
    """The errors at `points` (by default 24 of the region) of a function made by `lambdify` with this `which`.

    Points where the solution is 0 or beyond the range of doubles don't count; a wrong 0, inf or NaN does.  Raises
    LimitExceeded where the Taylor route doesn't arrive within the limits.
    """
    problem = as_problem(equation)
    given = samples(function.region) if points is None else np.atleast_1d(points)
    exact = [as_point(complex(x), "x") for x in given]
    found = [complex(v) for v in function(given)]
    slope = ball_from_flint(omega(problem, which, function.base, _SLOPE_BITS))
    states = evaluate_states(
        problem, exact, x0=function.base, y0=1, dy0=slope, digits=_DIGITS, method="taylor", limits=limits
    )
    if not all(state.reached or state.y.contains_zero() for state in states):
        raise LimitExceeded("the reference values weren't found to 50 digits", limit="digits")
    with working_precision(_PREC):
        pairs = [(v, ball_to_flint(s.y)) for v, s in zip(found, states, strict=True) if not s.y.contains_zero()]
        quotients = [(acb(v) / y).mid() for v, y in pairs if TINY < abs(v) < math.inf]
        if not quotients:
            return Measured(math.inf, math.inf, 0)
        by_real = abs(quotients[0].real) >= abs(quotients[0].imag)
        quotients.sort(key=lambda q: q.real if by_real else q.imag)
        factor = quotients[len(quotients) // 2]
        errors = [error for v, y in pairs if (error := _units(v, (y * factor).mid())) is not None]
    return Measured(float(np.median(errors)), max(errors), len(errors))


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


def warn_unless_accurate(
    function: ProductForm | TabulatedFunction, equation: object, which: int, seconds: float = math.inf
) -> None:
    """Measure on the default points, and give an AccuracyWarning where the promise isn't kept or can't be checked."""
    try:
        found = measure(function, equation, which=which, limits=Limits(seconds=max(0.0, min(20.0, seconds))))
    except LimitExceeded as limit:
        text = f"the error of this function couldn't be measured: {limit}"
    else:
        if found.points and found.median <= MEDIAN and found.worst <= WORST:
            return
        text = "the error of this function couldn't be measured: all samples are beyond the range of doubles"
        if found.points:
            text = (
                f"measured error of this function in units in the last place: median {found.median:.3g}, "
                f"worst {found.worst:.3g} of {found.points} points"
            )
    warnings.warn(text, AccuracyWarning, stacklevel=3)

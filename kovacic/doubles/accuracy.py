"""The error of double-precision functions, measured in units in the last place against route (b) at 50 digits.

A constant factor is free: it is fixed as the median of the quotients.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any, NamedTuple

from kovacic.enclosure.ball import Ball, ball_from_flint
from kovacic.enclosure.certificate import omega
from kovacic.enclosure.evaluate import AccuracyWarning, evaluate_states
from kovacic.enclosure.points import as_point
from kovacic.enclosure.problem import as_problem
from kovacic.errors import LimitExceeded
from kovacic.limits import Limits

if TYPE_CHECKING:
    from kovacic.doubles.product_form import ProductForm
    from kovacic.doubles.tabulate import TabulatedFunction

MEDIAN, WORST = 8.0, 1000.0
"""What is promised, in units in the last place."""

TINY, HUGE = 2.0**-960, 2.0**1020
"""Where values count."""

_DIGITS = 50
_BITS = 4000
"""Of the initial slope: a recessive solution is contaminated by its error times the growth of the dominant one."""

_SAMPLES = 24


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
    LimitExceeded where route (b) doesn't arrive within the limits.
    """
    import numpy as np

    problem = as_problem(equation)
    given = samples(function) if points is None else np.atleast_1d(points)
    exact = [as_point(complex(x), "x") for x in given]
    values = [complex(v) for v in function(given)]
    slope = ball_from_flint(omega(problem, which, function.base, _BITS))
    states = evaluate_states(
        problem, exact, x0=function.base, y0=1, dy0=slope, digits=_DIGITS, method="taylor", limits=limits
    )
    if not all(state.reached or state.y.contains_zero() for state in states):
        raise LimitExceeded("the reference values weren't found to 50 digits", limit="digits")
    pairs = [(v, state.y) for v, state in zip(values, states, strict=True) if not state.y.contains_zero()]
    usual = [_quotient(v, y) for v, y in pairs if TINY < abs(v) < math.inf]
    if not usual:
        return Measured(math.inf, math.inf, 0)
    factor = _median(usual)
    errors = [error for v, y in pairs if (error := _units(v, y, factor)) is not None]
    return Measured(float(np.median(errors)), max(errors), len(errors))


def samples(function: ProductForm | TabulatedFunction) -> Any:
    """The default points: 24 of the interval, or of the rectangle."""
    import numpy as np

    region = function.region
    share = (np.arange(_SAMPLES) + 0.5) / (_SAMPLES + 0.13)
    real = region.low.real + (region.high.real - region.low.real) * share
    if region.is_real:
        return real
    other = (share * 7.3) % 1.0
    return real + 1j * (region.low.imag + (region.high.imag - region.low.imag) * other)


Gaussian = tuple[Fraction, Fraction]


def _quotient(value: complex, ball: Ball) -> Gaussian:
    """value/midpoint, exactly."""
    a, b = Fraction(value.real), Fraction(value.imag)
    c, d = ball.midpoint
    norm = c * c + d * d
    return (a * c + b * d) / norm, (b * c - a * d) / norm


def _median(quotients: list[Gaussian]) -> Gaussian:
    """The quotient whose larger part is the median: the constant factor, without the outliers."""
    part = 0 if abs(quotients[0][0]) >= abs(quotients[0][1]) else 1
    return sorted(quotients, key=lambda q: q[part])[len(quotients) // 2]


def _units(value: complex, ball: Ball, factor: Gaussian) -> float | None:
    """The error of one value; None where the exact value is beyond the range of normal doubles."""
    import numpy as np

    c, d = ball.midpoint
    x, y = c * factor[0] - d * factor[1], c * factor[1] + d * factor[0]
    square = x * x + y * y
    if not Fraction(TINY) ** 2 < square < Fraction(HUGE) ** 2:
        return None
    if not math.isfinite(abs(value)):
        return math.inf
    x, y = Fraction(value.real) - x, Fraction(value.imag) - y
    e = (square.numerator.bit_length() - square.denominator.bit_length()) // 2
    size = math.ldexp(math.sqrt(square / Fraction(4) ** e), e)
    return math.sqrt(float((x * x + y * y) / square)) * size / float(np.spacing(size))


def warn_unless_accurate(function: ProductForm | TabulatedFunction, equation: object, which: int) -> None:
    """Measure on the default points, and give an AccuracyWarning where the promise isn't kept or can't be checked."""
    try:
        found = measure(function, equation, which=which, limits=Limits(seconds=20))
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

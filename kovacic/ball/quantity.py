"""What the numerical modules take from users: one number, or times; exact ones (text, SymPy) as well as floats.

A motion is computed in floating-point arithmetic (`direct.integrate_precisely`: in mpmath's), and so its initial values,
times and tolerances may be floats, taken as they are.  The body isn't: see `kovacic.ball.ball.exact`.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from numbers import Real
from typing import Any

import mpmath
import numpy as np
import sympy as sp
from numpy.typing import NDArray

from kovacic.ball.ball import exact
from kovacic.errors import InputError

Array = NDArray[np.float64]


def as_float(value: Any, name: str) -> float:
    """A real number as a float, which may be infinite or not a number; text is read as an exact number.

    Raises `InputError` for anything else.

    >>> as_float("sqrt(2)/2", "u")
    0.7071067811865476
    """
    return float(_number(value, name))


def as_mpf(value: Any, name: str) -> Any:
    """The same in mpmath's current precision: text and SymPy's numbers lose nothing."""
    number = _number(value, name)
    if isinstance(number, sp.Expr):
        return mpmath.mpmathify(sp.N(number, mpmath.mp.dps + 5))
    return mpmath.mpf(number.numerator) / number.denominator if isinstance(number, Fraction) else mpmath.mpf(number)


def as_tolerance(value: Any, name: str) -> float:
    """A positive, finite number."""
    number = as_float(value, name)
    if not 0 < number < np.inf:
        raise InputError(f"{name} must be positive, not {value}")
    return number


def as_times(values: Iterable[Any]) -> Array:
    """Finite numbers from 0 on, increasing, at least one."""
    times = np.array([as_float(value, "a time") for value in np.atleast_1d(np.asarray(values, dtype=object))])
    if not times.size:
        raise InputError("there are no times to integrate to")
    if not np.isfinite(times).all() or times[0] < 0 or (np.diff(times) <= 0).any() or times[-1] == 0:
        raise InputError("times must increase from 0 on, up to a positive one, and be finite")
    return times


def _number(value: Any, name: str) -> Any:
    if isinstance(value, str | sp.Expr) and not (isinstance(value, sp.Expr) and value.has(sp.Float)):
        number = exact(value, name)
        if not number.is_number:
            raise InputError(f"{name} = {value} isn't a number")
        return number
    if isinstance(value, Real | sp.Expr | mpmath.mpf) and not isinstance(value, bool | np.bool_):
        try:
            return float(value) if isinstance(value, sp.Expr | np.floating) else value
        except TypeError:
            pass
    raise InputError(f"{name} = {value!r} isn't a real number")

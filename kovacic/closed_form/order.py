"""Real numbers in order, decided by balls, and rational numbers between them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cmp_to_key
from itertools import pairwise
from typing import Any

import sympy

from kovacic.algebra.rationals import to_fraction
from kovacic.closed_form.jets import BallEvaluator
from kovacic.errors import InputError

Expr = Any


def ball(e: Expr) -> Any:
    """The value of a constant, a real ball.  Raises `InputError` unless it is known to be real."""
    found = BallEvaluator({})(e)
    if not found.imag.is_zero():
        raise InputError(f"{e} isn't known to be real")
    return found.real


def is_below(a: Expr, b: Expr) -> bool:
    """True if a < b, for real numbers or infinity.  Raises `InputError` if that depends on letters."""
    if a.is_infinite or b.is_infinite:
        return bool(a != b and (a == -sympy.oo or b == sympy.oo))
    e = b - a
    if not e.free_symbols:
        return bool(ball(e) > 0)
    if e.is_positive is None:
        raise InputError(f"it isn't known whether {e} is positive")
    return bool(e.is_positive)


def from_left_to_right(points: Iterable[Expr]) -> list[Expr]:
    """Real numbers in order."""
    return sorted(points, key=cmp_to_key(lambda a, b: -1 if is_below(a, b) else 1))


def between(breaks: Sequence[Expr]) -> list[Expr]:
    """A rational point between each two breaks, and one beyond them on each side."""
    return [point_between(low, high) for low, high in pairwise([-sympy.oo, *breaks, sympy.oo])]


def point_between(low: Expr, high: Expr) -> Expr:
    """A rational number between two ends, at 3/7 of the way, where nothing is likely to vanish."""
    if low.is_infinite and high.is_infinite:
        return sympy.Rational(3, 7)
    if low.is_infinite:
        return (high if high.free_symbols else sympy.floor(high)) - sympy.Rational(10, 7)
    if high.is_infinite:
        return (low if low.free_symbols else sympy.ceiling(low)) + sympy.Rational(10, 7)
    middle = low + (high - low) * sympy.Rational(3, 7)
    if middle.free_symbols:
        return middle
    if not is_below(low, high):
        raise InputError(f"the interval is empty: {low} isn't below {high}")
    return middle if middle.is_Rational else dyadic_midpoint(ball(middle))


def dyadic_midpoint(value: Any) -> Expr:
    """The midpoint of a ball, exactly."""
    return sympy.Rational(to_fraction(value.mid().fmpq()))

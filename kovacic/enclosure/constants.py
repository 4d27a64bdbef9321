"""Numbers that are known by balls: constants such as sqrt(2) and pi to every precision, and the balls that users have.

SymPy expressions of numbers, and of numbers and x, are computed by FLINT's balls, operation by operation: nothing of SymPy's
own numerical evaluation, whose digits aren't proven, goes in.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from flint import acb, arb

from kovacic.enclosure.points import ExactPoint, as_point, midpoint, to_acb
from kovacic.errors import InputError
from kovacic.numbers.numerals import plain_text


@dataclass(frozen=True)
class Constant:
    """A number in a ball: `value()` at the working precision in force, or always the same if `fixed`."""

    text: str
    value: Callable[[], acb]
    fixed: bool = False

    def point(self) -> ExactPoint:
        """The midpoint, an exact point."""
        ball = self.value()
        if not ball.is_finite():
            raise InputError(f"{self.text} isn't a finite number")
        return midpoint(ball)

    def __str__(self) -> str:
        return self.text


Number = ExactPoint | Constant


def as_number(value: Any, name: str) -> Number:
    """The exact point, or the number known by balls, that `value` stands for.

    Beside what `as_point` accepts: balls (ours, python-flint's arb and acb, mpmath's intervals), SymPy constants and text
    such as "sqrt(2)" or "1 + 2*I".  Raises InputError for anything else (`name` says which argument it was).

    >>> print(as_number("1 + 2*I", "x"), as_number("sqrt(2)", "x"))
    1 + 2i sqrt(2)
    """
    if isinstance(value, ExactPoint | Constant):
        return value
    fixed = _given_ball(value)
    if fixed is not None:
        if not fixed.is_finite():
            raise InputError(f"{name} isn't a finite ball: {value}")
        return Constant(str(value), lambda: fixed, True)
    try:
        return as_point(value, name)
    except InputError:
        found = _symbolic(value, name)
        if found is None:
            raise
        return found


def _symbolic(value: Any, name: str) -> Number | None:
    """The number that a SymPy expression or a text stands for; None for anything else."""
    expression = value
    if isinstance(value, str):
        from kovacic.reading.symbolic import read_expression

        expression = read_expression(value, names={}, what=name)
        if expression.is_number and all(part.is_Rational for part in expression.expand().as_real_imag()):
            return as_point(expression.expand(), name)
    if not getattr(expression, "is_number", False) or getattr(expression, "is_finite", None) is False:
        return None
    number = Constant(plain_text(value), lambda: in_balls(expression, {}))
    number.value()  # raises for functions that aren't known
    return number


def _given_ball(value: Any) -> acb | None:
    """The ball that the user has: ours (without importing it), python-flint's or mpmath's; None for anything else."""
    if hasattr(value, "to_flint") and not value.is_exact():
        return acb(value.to_flint())
    if isinstance(value, arb | acb):
        return acb(value)
    if getattr(value, "_mpci_", None):  # mpmath's complex intervals
        re, im = value._mpci_
        return acb(_of_interval(re), _of_interval(im))
    if hasattr(value, "_mpi_"):
        return acb(_of_interval(value._mpi_))
    return None


def _of_interval(interval: Any) -> arb:
    """The ball with the ends of an mpmath interval, (sign, mantissa, exponent, bits) each."""
    if any(not mantissa and exponent for _, mantissa, exponent, _ in interval):
        raise InputError("an interval isn't finite")
    e = min(exponent for _, _, exponent, _ in interval)
    low, high = ((-1) ** sign * (int(mantissa) << (exponent - e)) for sign, mantissa, exponent, _ in interval)
    return arb((low + high, e - 1), (high - low, e - 1))


def to_ball(number: Number) -> acb:
    """The ball of the working precision in force."""
    return to_acb(number) if isinstance(number, ExactPoint) else number.value()


def in_balls(expression: Any, values: Mapping[Any, Any], *, analytic: bool = False) -> acb:
    """A SymPy expression at these values of its symbols, at the working precision in force.

    With `analytic` the result isn't finite where the expression isn't analytic on the balls, for quadratures.  Values may be
    power series, too: then the result is one, or a ball where it is a number.  Raises InputError for functions that aren't
    known here.
    """
    from kovacic.closed_form.balls import BallEvaluator  # imports SymPy

    value: acb = BallEvaluator(values, analytic=analytic)(expression)
    return value

"""Values through a change of variable: an equation that is rational in t = exp(k x + c) is evaluated in t.

The guarantee is that of `kovacic.enclosure.journey`, for y(x) = Y(t(x)).  Where k and x are real, t is real, positive and
monotone: a segment of the x-axis is mapped onto a segment of the t-axis, so that the straight way in t continues the same
solution.  Points are carried through as balls, and y' = t' Y'.

What a wave exp(i k x) makes of a segment is no segment; its discs in x serve as well.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import sympy
from flint import acb

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.constants import Constant, Number, in_balls, to_ball
from kovacic.enclosure.points import are_real
from kovacic.enclosure.precision import PointValue
from kovacic.enclosure.problem import Coefficients, NumericProblem, as_problem
from kovacic.enclosure.start import Start
from kovacic.errors import NotRational
from kovacic.reading.change_of_variable import function_of_x, without_change

_BITS = 64


@dataclass(frozen=True)
class Substitution:
    """t as a function of x, and the equation in t."""

    t: Any
    x: Any
    problem: NumericProblem

    @classmethod
    def of(cls, coefficients: Coefficients) -> Substitution | None:
        """None unless the equation is rational in an exponential of x."""
        changed: Any = coefficients.changed
        if changed is None or getattr(changed, "letters", None):
            return None
        t = function_of_x(changed.equation)
        if t.func is not sympy.exp or t.free_symbols != {coefficients.variable}:
            return None
        values: dict[str, object] = dict(coefficients.values)
        try:
            problem = as_problem(without_change(changed), values or None, forced=True, constants=True)
        except NotRational:
            return None
        return cls(t, coefficients.variable, problem)

    def image(self, x: Number) -> Number:
        """t at a number, to every precision that this has."""
        return Constant(f"t({x})", lambda: in_balls(self.t, {self.x: to_ball(x)}), getattr(x, "fixed", False))

    def slope(self, x: Number) -> acb:
        """dt/dx at a number, at the working precision in force."""
        return in_balls(self.t.diff(self.x), {self.x: to_ball(x)})

    def start(self, x0: Number, data: tuple[Number, Number]) -> Start:
        """The start in t with these values of y and y'."""
        y, dy = data
        fixed = any(getattr(number, "fixed", False) for number in (dy, x0))
        return Start(self.image(x0), (y, Constant("y'/t'", lambda: to_ball(dy) / self.slope(x0), fixed)))

    def is_real(self, numbers: Sequence[Number]) -> bool:
        """True if these numbers, and t and its derivative there, are real."""
        with working_precision(_BITS):
            return are_real([f(x) for x in numbers for f in (to_ball, lambda x: to_ball(self.image(x)), self.slope)])

    def seen(self, target: Number, value: PointValue) -> PointValue:
        """The value at t(target) as one at the target: y' = t' Y'."""
        with working_precision(value.route.bits + 2 * _BITS):
            y, dy = value.state
            return replace(value, x=target, state=(y, dy * self.slope(target)))

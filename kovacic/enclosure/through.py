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

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.constants import Constant, Number, in_balls, to_ball
from kovacic.enclosure.journey import Journey
from kovacic.enclosure.points import are_real
from kovacic.enclosure.precision import Method, PointValue
from kovacic.enclosure.problem import Coefficients, as_problem
from kovacic.enclosure.start import Start
from kovacic.enclosure.states import AskedSolution
from kovacic.errors import NotRational
from kovacic.limits import Limits
from kovacic.reading.change_of_variable import function_of_x, without_change

_BITS = 64


@dataclass(frozen=True)
class Through:
    """The solution Y in t, and t as a function of x."""

    journey: Journey
    t: Any
    variable: Any

    @classmethod
    def of(
        cls, coefficients: Coefficients, x0: Number, data: tuple[Number, Number], *, chain: bool = False
    ) -> Through | None:
        """The solution with these values of y and y'; None unless t is real and the equation rational in t."""
        changed: Any = coefficients.changed
        if changed is None or getattr(changed, "letters", None):
            return None
        t = function_of_x(coefficients.changed.equation)
        x = coefficients.variable
        if t.func is not sympy.exp or t.free_symbols != {x} or not _are_real(t, x, [x0]):
            return None
        values: dict[str, object] = dict(coefficients.values)
        try:
            problem = as_problem(without_change(coefficients.changed), values or None, forced=True, constants=True)
        except NotRational:
            return None
        y, dy = data
        slope = t.diff(x)
        fixed = _is_fixed(dy) or _is_fixed(x0)
        start = Constant("y'/t'", lambda: to_ball(dy) / in_balls(slope, {x: to_ball(x0)}), fixed)
        return cls(Journey(problem, Start(_image(t, x, x0), (y, start)), (), chain), t, x)

    def states(
        self, targets: Sequence[Number], digits: int, method: Method | None, limits: Limits
    ) -> tuple[PointValue, ...] | None:
        """y and y' with the circumstances; None for targets that aren't real."""
        if not _are_real(self.t, self.variable, targets):
            return None
        images = [_image(self.t, self.variable, target) for target in targets]
        found = AskedSolution(self.journey, digits, method, limits).states_at(images)
        return tuple(map(self._in_x, targets, found))

    def _in_x(self, target: Number, value: PointValue) -> PointValue:
        with working_precision(value.route.bits):
            slope = in_balls(self.t.diff(self.variable), {self.variable: to_ball(target)})
            y, dy = value.state
            return replace(value, x=target, state=(y, dy * slope))


def _image(t: Any, variable: Any, x: Number) -> Number:
    """t at a number, to every precision that this has."""
    return Constant(f"t({x})", lambda: in_balls(t, {variable: to_ball(x)}), _is_fixed(x))


def _are_real(t: Any, variable: Any, numbers: Sequence[Number]) -> bool:
    """True if these numbers, and t and its derivative there, are real."""
    with working_precision(_BITS):
        balls = [to_ball(number) for number in numbers]
        images = [in_balls(part, {variable: ball}) for part in (t, t.diff(variable)) for ball in balls]
        return are_real([*balls, *images])


def _is_fixed(number: Number) -> bool:
    return isinstance(number, Constant) and number.fixed

"""An equation seen from the middle of a piece, x = c + H u, |u| <= 1, and the states of one of its solutions in balls.

Where a Y'' + b Y' + c Y = f has the variable t = exp(k x), sin(k x), ..., the equation for y(x) = Y(t(x)) is

    y'' + (b t'/a - t''/t') y' + (c t'^2/a) y = t'^2 f/a,    ' = d/du.                                                    (1)
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from flint import acb, acb_series, arb, arb_poly, ctx, fmpq_poly

from kovacic.doubles.double_double import horner
from kovacic.doubles.region import Region, region_of
from kovacic.enclosure.ball import ball_from_flint, ball_to_flint
from kovacic.enclosure.closed_form import Exponential, exponentials, finite_base, omega
from kovacic.enclosure.constants import in_balls
from kovacic.enclosure.forcing import Forcing, forcing_of
from kovacic.enclosure.log_derivative import LogDerivative, embed
from kovacic.enclosure.matrices import State
from kovacic.enclosure.points import ExactPoint, as_point, midpoint, power_of_two, to_acb, to_double, working_precision
from kovacic.enclosure.precision import start_bits
from kovacic.enclosure.problem import NumericProblem, as_problem, change_of
from kovacic.enclosure.states import evaluate_states
from kovacic.errors import InputError, NotRational
from kovacic.limits import Limits, check_time, count_work
from kovacic.reading.read import read_input

_SLOPE_BITS = 4000
"""Precision of an initial slope, for Taylor steps: its error, times the growth of the dominant solution, contaminates a
recessive one."""

_NOISE = 2.0**-40
"""Errors of the value of a polynomial in plain doubles, over the sum of the sizes of its terms."""


@dataclass(frozen=True)
class PieceChart:
    """The equation a y'' + b y' + c y = f, and which solution: the options of `evaluate`.

    Where `answer`, the equation or solution in x, has a change of variable, the problem is that in t; else t = x.
    """

    problem: NumericProblem
    given: dict[str, Any]
    branch: Exponential | None = None
    answer: Any = None
    params: Mapping[str, object] | None = None

    @cached_property
    def _functions(self) -> tuple[Any, Callable[[Any, Any], Any]]:
        """t, a SymPy expression, and expressions as functions of x in balls or series."""
        import sympy

        from kovacic.enclosure.change import function_with_values
        from kovacic.reading.change_of_variable import user_variable

        x = user_variable(self.answer.equation)
        t = function_with_values(self.answer.equation, self.params).rewrite([sympy.sinh, sympy.cosh], sympy.exp)
        return t, lambda f, at: in_balls(f, {x: at})

    def _values(self, x: acb) -> tuple[acb, acb]:
        """t and dt/dx."""
        if self.answer is None:
            return x, acb(1)
        t, at = self._functions
        return at(t, x), at(t.diff(), x)

    def region(self, interval: tuple[object, object]) -> tuple[Region, list[ExactPoint]]:
        """See `region_of`; raises InputError, with the reason, where t isn't known to be real and monotone."""
        found = region_of(self.problem if self.answer is None else None, interval)
        if self.answer is not None and self.given:
            self.states([as_point(end.real, "x") for end in (found[0].low, found[0].high)], 3, None)
        return found

    def _in_t(self, x: ExactPoint) -> ExactPoint:
        with working_precision(_SLOPE_BITS + 200):
            return x if self.answer is None else midpoint(self._values(acb(x.x))[0])

    def base(self, which: int, candidates: list[ExactPoint]) -> ExactPoint:
        """The first of the points where the logarithmic derivative number `which` is finite."""
        points = [self._in_t(x) for x in candidates]
        return candidates[points.index(finite_base(self.problem, which, points))]

    def beginning(self, which: int, base: ExactPoint) -> PieceChart:
        """The solution with this logarithmic derivative, 1 at the base."""
        branches = exponentials(self.problem) if self.answer is None else []
        if branches:
            return replace(self, given={"x0": base}, branch=branches[which])
        slope = omega(self.problem, which, self._in_t(base), _SLOPE_BITS)
        with working_precision(_SLOPE_BITS + 200):
            slope *= self._values(to_acb(base))[1]
        return replace(self, given={"x0": base, "y0": 1, "dy0": ball_from_flint(slope)})

    def states(self, points: Sequence[ExactPoint], digits: int, limits: Limits | None, **options: Any) -> list[State]:
        """y and dy/dx, to so many digits where they can be had."""
        if self.branch is not None:
            return self._closed(self.branch, points, digits)
        options |= {"digits": digits, "limits": limits, **self.given}
        if self.answer is None:
            return [s.state for s in evaluate_states(self.problem, points, **options)]
        from kovacic.enclosure.change import evaluate_in_x

        options |= {"params": self.params, "derivative": True, "path": self.given.get("path")}  # along the real axis
        found = evaluate_in_x(self.answer, [*points], **options)
        return [(ball_to_flint(y), ball_to_flint(dy)) for y, dy in found]

    def _closed(self, branch: Exponential, points: Sequence[ExactPoint], digits: int) -> list[State]:
        """y = exp(int theta) P/P(base) and y' from the certificate: without the zeros of P, and without an integration of the
        equation, in which the dominant solution would grow."""
        goal, prec, found = start_bits(digits) - 24, 2 * start_bits(digits) + branch.P.degree, dict[ExactPoint, State]()
        while True:
            with working_precision(prec):
                c, z = branch.constant(), to_acb(self.given["x0"])
                theta, P = LogDerivative.make(branch.theta, c), embed(branch.P, c)
                slope, factor = P.derivative(), 1 / P(z)
                for point in (point for point in points if point not in found):
                    check_time()
                    count_work(prec)
                    x = to_acb(point)
                    growth = theta.growth(z, x) * factor
                    y = growth * P(x)
                    if y.rel_accuracy_bits() > goal or prec > _SLOPE_BITS + 4 * branch.P.degree:
                        found[point] = y, theta.value(x) * y + growth * slope(x)
            if all(point in found for point in points):
                return [found[point] for point in points]
            prec *= 2

    @cached_property
    def forcing(self) -> Forcing | None:
        """f/a, None where it is zero."""
        return forcing_of(self.problem)

    @cached_property
    def _equation(self) -> Sequence[Any]:
        return self.problem.equation if self.problem.embedded is None else self.problem.embedded.equation()

    @cached_property
    def singular(self) -> list[ExactPoint]:
        """The midpoints of enclosures; values beyond one are refused where there is a change of variable."""
        return self.problem.singular_points(128) if self.answer is None else []

    def steepness(self, x: Any, h: Any) -> Any:
        """Lower bounds of the larger characteristic root |r|, a r^2 + h b r + h^2 c = 0, at points x: by |r1 r2| and
        |r1 + r2|, in plain doubles with room for their errors; infinite where a singular point is nearer than 4 h."""
        if self.answer is not None:
            return 0.0 * x
        parts = [[arb(v) for v in reversed(part.coeffs())] for part in self._equation]
        largest = max(abs(v).mid() for part in parts for v in part)
        doubles = [np.array([float(v / largest) for v in part]) for part in parts]
        with np.errstate(all="ignore"):
            sizes = [(np.abs(np.polyval(p, x)), _NOISE * np.polyval(np.abs(p), np.abs(x))) for p in doubles]
            (a, b, c), (p, q, r) = zip(*sizes, strict=True)
            found = np.fmax(np.sqrt(np.fmax(c - r, 0.0) / (a + p)) * h, (b - q) / (a + p) * h / 2)
            for point in self.singular:
                found[np.abs(x - to_double(point)) + _NOISE * np.abs(x) < 4 * h] = np.inf
            return found

    def local(self, centre: ExactPoint, e: int, terms: int) -> list[list[arb]]:
        """a, H b and H^2 c over a(c), so many terms in u; not numbers where a(c) may be zero."""
        if self.answer is not None:
            return self._changed(centre, e, terms)
        line: Any = fmpq_poly([centre.x, power_of_two(e)])
        line = line if self.problem.embedded is None else arb_poly(line)
        found = [[arb(v) for v in part(line).coeffs()[:terms]] for part in self._equation]
        factors = [arb((1, k * e)) / found[0][0] for k in range(3)]
        return [[v * factor for v in part] for part, factor in zip(found, factors, strict=True)]

    def _changed(self, centre: ExactPoint, e: int, terms: int) -> list[list[arb]]:
        """Equation (1); not numbers where a(c) or t'(c) may be zero.  Raises InputError where it isn't real."""
        (t, at), cap = self._functions, ctx.cap
        ctx.cap = terms + 2  # FLINT's series end there
        try:
            s = at(t, acb_series([centre.x, arb((1, e))]))
            a, b, c = (horner(reversed(p.coeffs()), s) if p else acb_series([]) for p in self._equation)
            d = s.derivative()
            found = [(b * d / a - d.derivative() / d).coeffs()[:terms], (c * d * d / a).coeffs()[:terms]]
        except (ZeroDivisionError, ValueError):
            return [[arb(1)], [], [arb("nan")]]
        finally:
            ctx.cap = cap
        if not all(v.imag.contains(0) for part in found for v in part):
            raise InputError("a table needs an equation that is real for real x", hint="evaluate has its values")
        return [[arb(1)], *([v.real for v in part] for part in found)]

    def source(self, centre: ExactPoint, e: int, u: arb) -> arb:
        """t'^2 f/a at u."""
        assert self.forcing is not None
        t, slope = self._values(acb(centre.x) + acb(u) * acb(arb((1, e))))
        return (self.forcing.value(t) * slope**2).real * arb((1, 2 * e))


def chart_of(
    equation: object, given: dict[str, Any], params: Mapping[str, object] | None, *, constants: bool = True
) -> PieceChart:
    """The chart of an equation, as `evaluate` takes it; right-hand sides and constants only where a solution is `given`."""
    answer: Any = equation
    if change_of(equation) is None:
        try:
            return PieceChart(_real_problem(equation, params, constants), given)
        except NotRational as reason:
            answer = read_input(equation, exponentials=True)
            if answer.equation is None or answer.equation.change is None:
                raise reason from None
    from kovacic.reading.change_of_variable import without_change  # imports SymPy

    return PieceChart(_real_problem(without_change(answer), params, constants), given, None, answer, params)


def _real_problem(equation: object, params: Mapping[str, object] | None, constants: bool) -> NumericProblem:
    problem = as_problem(equation, params, forced=constants, constants=constants)
    if not problem.is_real:
        raise InputError(
            "functions of real numbers need an equation with real coefficients", hint="evaluate takes others"
        )
    return problem

"""Values of a solution whose equation is rational in t = exp(k x), sin(k x), ...: y(x) = Y(t(x)), y'(x) = t'(x) Y'(t(x)).

Where t is real on an interval of real x, without a pole, and t' has no zero there, the straight path from t(x0) to t(x) is the
image of the interval from x0 to x: the values are those of the solution that is continued along the real axis.  exp(i kappa x)
runs on the unit circle; a polygon in it will do, if no singular point lies between both: if its chords are nearer to the
circle than every singular point in the disc.
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any

import sympy
from flint import acb, arb

from kovacic.closed_form.atoms import Atoms
from kovacic.enclosure.ball import Ball, finite_ball
from kovacic.enclosure.constants import as_number, in_balls, to_ball
from kovacic.enclosure.points import ExactPoint, to_acb, working_precision
from kovacic.enclosure.precision import AccuracyWarning, PointValue, number_of_digits, start_bits
from kovacic.enclosure.problem import as_problem
from kovacic.enclosure.states import evaluate_states
from kovacic.equation import Equation
from kovacic.errors import InputError
from kovacic.limits import limits_of
from kovacic.reading.change_of_variable import function_of_x, user_variable, without_change
from kovacic.reading.symbolic import read_expression

_BALLS = 5000  # bits of what is computed from a slope that is a ball

#: t(u) is monotone, without poles, for u between neighbouring numbers (n + shift) pi.
_SHIFTS = {"cos": arb(0), "sin": arb(0.5), "tan": arb(0.5)}


def evaluate_in_x(
    answer: Any,
    x: Any,
    *,
    x0: Any,
    y0: Any = None,
    dy0: Any = None,
    derivative: bool = False,
    digits: int = 15,
    params: Mapping[str, Any] | None = None,
    **options: Any,
) -> Any:
    """A ball that contains y(x), or a pair with y'(x), from y(x0) and y'(x0); for a list of points a tuple.

    `answer` is a solution, or an equation that was read, whose variable t is a function of x.  Numbers are real: exact numbers
    or constants such as "sqrt(2)"; from x0 to x the function t must be real and monotone.  Raises `InputError` where it isn't,
    and what `kovacic.evaluate` raises.
    """
    if y0 is None or dy0 is None:
        raise InputError("both y0 and dy0 are needed where coefficients are functions of x")
    for name in ("path", "which", "frobenius"):
        if options.pop(name, None) is not None:
            raise InputError(
                f"{name} isn't for equations whose coefficients are functions of x", hint="give y0 and dy0"
            )
    digits = number_of_digits(digits, limits_of(options.get("limits")))
    t = function_with_values(answer.equation, params)
    variable = user_variable(answer.equation)
    slope, rate = t.diff(variable), t.args[0].diff(variable)
    circle = isinstance(t, sympy.exp) and bool(in_balls(rate, {}).real.is_zero())
    many = isinstance(x, list | tuple | range)
    start, *places = (_exact(value, "x") for value in (x0, *(x if many else [x])))
    cells = [_cell(t.args[0].subs(variable, place), t, circle) for place in (start, *places)]
    if None in cells or len(set(cells)) > 1:
        hint = f"give points between neighbouring zeros and poles of {slope}, or evaluate the solutions with SymPy"
        raise InputError(f"{t} isn't known to be real and monotone from x0 to x", hint=hint)
    given = without_change(answer)
    options |= {"x0": t.subs(variable, start), "y0": y0, "digits": digits, "params": params}
    options["dy0"] = _over(dy0, slope.subs(variable, start))
    real = (
        circle
        and all(to_ball(as_number(v, "y0")).imag.is_zero() for v in (y0, dy0))
        and _is_real(answer.equation, rate)
    )
    found: list[Ball | tuple[Ball, Ball]] = []
    widest = _widest_chord(given, params) if circle else None
    for place, state in zip(places, _states(given, t, variable, start, places, widest, options), strict=True):
        if state.note is not None:
            warnings.warn(f"at {variable} = {place}: {state.note}", AccuracyWarning, stacklevel=3)
        with working_precision(2 * start_bits(digits)):
            both = state.state[0], in_balls(slope.subs(variable, place), {}) * state.state[1]
        y, dy = (finite_ball(acb(value.real) if real else value, state.route) for value in both)
        found.append((y, dy) if derivative else y)
    return tuple(found) if many else found[0]


def function_with_values(equation: Equation, params: Mapping[str, Any] | None) -> Any:
    """t as a SymPy expression in x, with these values of its parameters."""
    values = {sympy.Symbol(name): _exact(value, f"the parameter {name}") for name, value in (params or {}).items()}
    return function_of_x(equation).xreplace(values)


def _over(dy0: Any, slope: Any) -> Any:
    """dy0/t', exactly or in a ball that is given."""
    number = as_number(dy0, "dy0")
    if isinstance(number, ExactPoint) or not number.fixed:
        return _exact(dy0, "dy0") / slope
    with working_precision(_BALLS):
        return number.value() / in_balls(slope, {})


def _exact(value: Any, name: str) -> Any:
    """A real number that the user gives, as SymPy's."""
    number = as_number(value, name)
    if not to_ball(number).imag.is_zero():
        raise InputError(f"{name} = {number} isn't real")
    if isinstance(number, ExactPoint):
        return sympy.Rational(number.re)
    if number.fixed:
        raise InputError(f"{name} is a ball", hint="an exact number is needed, where coefficients aren't rational")
    return read_expression(value, names={}) if isinstance(value, str) else value


def _is_real(equation: Any, rate: Any) -> bool:
    """Are the coefficients of y' and y and the right-hand side real for real x, where t = exp(rate x) runs on the unit circle?

    Exact: a function of t is real there if t -> 1/t and conjugate coefficients leave it the same.
    """
    t = sympy.Dummy(real=True)
    atoms = Atoms(t)
    b, c, f = (atoms.ratio(part / equation.a) for part in (equation.b, equation.c, equation.f))
    for value in (rate * (t * b - 1), (rate * t) ** 2 * c, (rate * t) ** 2 * f):
        here = value.xreplace({s: sympy.Dummy(real=True) for s in value.free_symbols if s != t})
        if sympy.cancel(here - sympy.conjugate(here).xreplace({t: 1 / t})) != 0:
            return False
    return equation.h is None


def _states(
    given: Any, t: Any, variable: Any, start: Any, places: list[Any], widest: arb | None, options: dict[str, Any]
) -> list[PointValue]:
    """The states at these places; on the circle from one to the next on either side of the start, along chords."""
    if widest is None:
        return list(evaluate_states(given, [t.subs(variable, place) for place in places], **options))
    found: dict[Any, PointValue] = {}
    for side in ([p for p in places if p >= start], [p for p in places if p < start]):
        here, way = start, list[tuple[Any, Any]]()
        for place in sorted(side, key=lambda p: abs(p - start)):
            angle = abs(in_balls((place - here) * t.args[0].diff(variable), {})).upper()
            count = 1 + int((angle / widest).upper().ceil().unique_fmpz())
            way += [(here + (place - here) * sympy.Rational(k, count), None) for k in range(1, count)] + [
                (place, place)
            ]
            here = place
        states = evaluate_states(given, [t.subs(variable, x) for x, _ in way], path="chain", **options) if way else ()
        found |= {place: state for (_, place), state in zip(way, states, strict=True) if place is not None}
    return [found[place] for place in places]


def _widest_chord(answer: Any, params: Mapping[str, Any] | None) -> arb:
    """Chords over angles up to twice this are nearer to the circle than the singular points inside.

    Raises `InputError` for singular points on the circle.
    """
    problem = as_problem(answer, params, forced=True, constants=True)
    radii = [abs(to_acb(z)) for z in problem.singular_points(128)] if problem.embedded is None else [arb(1)]
    if any(radius.overlaps(arb(1)) for radius in radii):
        raise InputError(f"a singular point at a real x, or constants in the equation in {answer.variable}")
    inner = max((radius for radius in radii if radius < 1), default=arb(0))
    widest: arb = arb(1).min(inner.acos())
    assert (widest / 2).cos() > inner
    return widest


def _cell(argument: Any, t: Any, circle: bool) -> int | None:
    """Which interval of monotony of t its argument lies in; None where that isn't known, or t is off the path."""
    u, name = in_balls(argument, {}), type(t).__name__
    if not (u.real if circle else u.imag).is_zero():
        return None
    if name == "cosh":
        return 1 if u.real > 0 else -1 if u.real < 0 else None
    if name not in _SHIFTS:  # exp and sinh
        return 0
    cell = (u.real / arb.pi() - _SHIFTS[name]).floor().unique_fmpz()
    return None if cell is None else int(cell)

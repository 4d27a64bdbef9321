"""Initial values as a user writes them, and the constants that they determine."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import sympy

from kovacic.closed_form.atoms import Atoms
from kovacic.errors import InputError
from kovacic.general_solution.variation import simplified
from kovacic.reading.given import Equation


@dataclass(frozen=True)
class Start:
    """y(point) = value and y'(point) = slope; None where it isn't given."""

    point: Any
    value: Any
    slope: Any

    @property
    def names(self) -> set[str]:
        """The symbols that occur in the values."""
        return {
            symbol.name
            for value in (self.point, self.value, self.slope)
            if value is not None
            for symbol in value.free_symbols
        }


def read_initial_values(ics: Mapping[Any, Any], function: Any, equation: Equation) -> Start:
    points, given = set(), {}
    for key, value in ics.items():
        point, order = _text_key(key, equation) if isinstance(key, str) else _sympy_key(key, function)
        points.add(point)
        given[order] = _constant(value)
    if len(points) != 1:
        raise InputError("the initial values belong to one point")
    (point,) = points
    x = sympy.Symbol(equation.variable)
    for coefficient in (equation.a, equation.b, equation.c):
        quotient = coefficient / equation.a
        if sympy.simplify(Atoms(x).poly(quotient.den).subs(x, point)) == 0:
            raise ValueError(f"{point} is a singular point of the equation")
    return Start(point, given.get(0), given.get(1))


def _constant(value: Any) -> Any:
    if isinstance(value, str):
        from kovacic.reading.symbolic import read_expression

        return read_expression(value, what="the initial value")
    if isinstance(value, float):
        raise InputError(f"the initial value {value!r} is a float", hint="give an exact number, or text such as '0.1'")
    return value if hasattr(value, "free_symbols") else sympy.Rational(value)


def _text_key(key: str, equation: Equation) -> tuple[Any, int]:
    """`y(0)` and `y'(0)`."""
    head, separator, rest = key.partition("(")
    name = head.strip()
    order = len(name) - len(name.rstrip("'"))
    if name.rstrip("'") != equation.unknown or not separator or not rest.rstrip().endswith(")") or order > 1:
        y = equation.unknown
        raise InputError(f"{key!r} isn't an initial value", hint=f"write {{'{y}(0)': 1, \"{y}'(0)\": 2}}")
    return _constant(rest.rstrip()[:-1]), order


def _sympy_key(key: Any, function: Any) -> tuple[Any, int]:
    """y(x0), and y(x).diff(x).subs(x, x0) in either form that SymPy gives it."""
    if getattr(key, "func", None) == function.func and len(key.args) == 1:
        return key.args[0], 0
    is_substitution = type(key).__name__ == "Subs"
    if is_substitution or getattr(key, "is_Derivative", False):
        derivative = key.expr if is_substitution else key
        point = key.point[0] if is_substitution else derivative.expr.args[0]
        orders = [int(count) for _, count in derivative.variable_count]
        if derivative.expr.func == function.func and orders == [1]:
            return point, 1
    raise InputError(f"{key} isn't an initial value", hint="write {y(0): 1, y(x).diff(x).subs(x, 0): 2}")


def constants(start: Start, y1: Any, y2: Any, particular: Any, x: Any, names: tuple[Any, Any]) -> dict[Any, Any]:
    """The constants that the initial values determine."""
    equations = []
    for order, value in enumerate((start.value, start.slope)):
        if value is not None:
            u, v, w = (_value_at(sympy.diff(y, x, order) if order else y, x, start.point) for y in (y1, y2, particular))
            equations.append(sympy.Eq(names[0] * u + names[1] * v + w, value))
    found = sympy.solve(equations, names, dict=True)
    if not found:
        raise InputError("there is no solution with these initial values")
    return {name: simplified(value) for name, value in found[0].items()}


def _value_at(expression: Any, x: Any, point: Any) -> Any:
    """The value at an ordinary point, where the expression may be of the form 0/0."""
    expression = sympy.sympify(expression, strict=True)
    value = expression.subs(x, point)
    if value.has(sympy.nan, sympy.zoo, sympy.oo, -sympy.oo):
        value = sympy.limit(expression, x, point)
    return value.doit() if value.has(sympy.Integral) else value

"""The change of variable t = t(x) of an equation whose coefficients are rational in exp(k x), a sine, ...

`exponentials` reads such an equation as one in t = exp(k x + c), or in a cosine, a sine or a tangent, and keeps the function
as `Equation.change`; everything is then computed in t.  `closed_form.way_back` takes the results to the user's x.  Every
function serves where the equation has no change, too: there t = x.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import sympy

from kovacic.equation import Equation
from kovacic.errors import NotRational
from kovacic.reading.symbolic import written_expression

#: (dt/du)^2 for functions t of u = k x + c, in t.
SQUARES: dict[Any, Any] = {
    sympy.exp: lambda t: t**2,
    sympy.sin: lambda t: 1 - t**2,
    sympy.cos: lambda t: 1 - t**2,
    sympy.tan: lambda t: (1 + t**2) ** 2,
    sympy.sinh: lambda t: t**2 + 1,
    sympy.cosh: lambda t: t**2 - 1,
}

#: Values that t has for positive x, for functions that don't have all.
_VALUES_OF_T = {
    sympy.exp: (Fraction(7, 2),),
    sympy.cosh: (Fraction(7, 2),),
    sympy.sin: (Fraction(2, 7), Fraction(-2, 7)),
    sympy.cos: (Fraction(2, 7), Fraction(-2, 7)),
    sympy.Pow: (Fraction(2, 7), Fraction(7, 2)),
}


def real_values(equation: Equation) -> tuple[Fraction, ...]:
    """Some values of t for real x; none where every number is one."""
    return _VALUES_OF_T.get(function_of_x(equation).func, ())


def function_of_x(equation: Equation) -> Any:
    """t, a SymPy expression in x."""
    if equation.change is None:
        return sympy.Symbol(equation.variable)
    return written_expression(equation.change.expression)


def user_variable(equation: Equation) -> Any:
    """x as a SymPy symbol."""
    return sympy.Symbol(equation.variable if equation.change is None else equation.change.variable)


def is_of_a_line(equation: Equation) -> bool:
    """True if t is a function of k x + c, not a power or a function of a power."""
    t = function_of_x(equation)
    x = user_variable(equation)
    return t == x or (t.func in SQUARES and not t.args[0].diff(x).has(x))


def is_in_power(equation: Equation) -> bool:
    """True if t = x^k."""
    t = function_of_x(equation)
    return bool(t.is_Pow and t.func not in SQUARES)


def slope_squared(equation: Equation) -> Any:
    """(dt/dx)^2, a SymPy expression in t, of an equation with a change of variable."""
    t = function_of_x(equation)
    rate = t.args[0].diff(user_variable(equation))
    return SQUARES[t.func](sympy.Symbol(equation.variable)) * rate**2


def without_change(given: Any) -> Any:
    """The equation in t alone, of a read input or an answer.  Raises `NotRational` if the right-hand side isn't rational."""
    if not is_of_a_line(given.equation):
        t = function_of_x(given.equation)
        raise NotRational(f"numbers where the variable is {t} aren't known", hint="dsolve has formulas")
    if given.equation.h is not None:
        said = f"a right-hand side that isn't rational in {given.equation.change.expression}, as the coefficients are"
        raise NotRational(said, hint="dsolve takes any right-hand side")
    plain = replace(given.equation, change=None)
    return replace(given, equation=plain) if hasattr(given, "decision") else plain

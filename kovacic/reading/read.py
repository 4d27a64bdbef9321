"""One door for every form of input."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.equation import Equation
from kovacic.errors import InputError
from kovacic.limits import DEFAULT_LIMITS, Limits
from kovacic.reading.equation_parser import is_equation, parse_equation
from kovacic.reading.parsed import DEFAULT_VARIABLE, Parsed
from kovacic.reading.parser import parse_rational


def read_input(S: Any, *, var: Any = None, limits: Limits = DEFAULT_LIMITS) -> Parsed:
    """S as a rational function with the name of its variable, from whatever the user has.

    S is a string, a SymPy expression, a pair (numerator, denominator) of coefficient sequences from low to high powers,
    an integer, a fraction, or a `RatFunc`; or it is an equation, as a string with derivatives of an unknown function, as a
    SymPy `Eq` or expression with a function y(x), or as an `Equation`, and then the result has it.  `var` is a name or a
    SymPy symbol; by default it is the only symbol, else x.  SymPy isn't imported unless S comes from it.  Raises
    `InputError` and `LimitExceeded`.

    >>> str(read_input("x^2 + 3").S), str(read_input(([3, 0, 1], [1])).S)
    ('x**2 + 3', 'x**2 + 3')
    """
    variable = _variable_name(var)
    if isinstance(S, str):
        if is_equation(S):
            return _with_equation(*parse_equation(S, variable=variable, limits=limits))
        return parse_rational(S, variable=variable, limits=limits)
    if isinstance(S, RatFunc):
        return Parsed(S, variable or DEFAULT_VARIABLE)
    if isinstance(S, int | Fraction):
        return Parsed(RatFunc(QQ.poly([S])), variable or DEFAULT_VARIABLE)
    if isinstance(S, Equation):
        return _with_equation(S, ())
    if _is_sympy(S):
        from kovacic.reading.equation_sympy import is_sympy_equation, parse_sympy_equation

        if is_sympy_equation(S):
            equation, notices, _ = parse_sympy_equation(S, variable=variable, limits=limits)
            return _with_equation(equation, notices)
        from kovacic.reading.from_sympy import parse_sympy

        return parse_sympy(S, variable=variable, limits=limits)
    if isinstance(S, tuple | list) and len(S) == 2:
        from kovacic.reading.coefficients import parse_coefficients

        return parse_coefficients(S[0], S[1], variable=variable, limits=limits)
    raise InputError(
        f"{type(S).__name__!r} isn't a form of S that can be read",
        hint='give a string "x^2 + 3", a SymPy expression, or the pair of coefficient sequences ([3, 0, 1], [1])',
    )


def read_coefficients(a: Any, b: Any, c: Any, f: Any, *, var: Any = None, limits: Limits = DEFAULT_LIMITS) -> Parsed:
    """The equation a y'' + b y' + c y = f; each coefficient is a string, a number, a `RatFunc` or a SymPy expression.

    Raises `InputError` and `LimitExceeded`; positions refer to the equation as it was put together.
    """
    given = (a, b, c, f)
    if any(_is_sympy(value) for value in given) and not any(isinstance(value, str | RatFunc) for value in given):
        import sympy

        symbols = sorted({s for value in given if _is_sympy(value) for s in value.free_symbols}, key=str)
        name = _variable_name(var)
        chosen = [s for s in symbols if s.name == (name or DEFAULT_VARIABLE)] or (symbols if name is None else [])
        x = chosen[0] if len(chosen) == 1 else sympy.Symbol(name or DEFAULT_VARIABLE)
        y = sympy.Function("y" if "y" not in {s.name for s in symbols} else "y_")(x)
        from kovacic.reading.equation_sympy import parse_sympy_equation

        equation, notices, _ = parse_sympy_equation(a * y.diff(x, 2) + b * y.diff(x) + c * y - f, limits=limits)
        return _with_equation(equation, notices)
    texts = [value.to_str() if isinstance(value, RatFunc) else str(value) for value in given]
    line = "({})*y'' + ({})*y' + ({})*y = {}".format(*texts)
    return read_input(line, var=var, limits=limits)


def _with_equation(equation: Equation, notices: tuple[str, ...]) -> Parsed:
    return Parsed(equation.S, equation.variable, notices, equation)


def _is_sympy(value: Any) -> bool:
    return any(str(cls.__module__).partition(".")[0] == "sympy" for cls in type(value).__mro__)


def _variable_name(var: Any) -> str | None:
    if var is None or isinstance(var, str):
        name: str | None = var
    elif _is_sympy(var) and getattr(var, "is_Symbol", False):
        name = str(var.name)
    else:
        raise InputError(f"{var!r} can't be a variable", hint="give its name, or a SymPy symbol")
    if name is not None and not name.isidentifier():
        raise InputError(f"{name!r} can't be the name of a variable", hint="take a letter or a word: x, t, x1")
    return name

"""What a user gives to `dsolve`: an equation in one of several forms, and the function."""

from __future__ import annotations

from typing import Any

import sympy
from sympy.core.function import AppliedUndef, UndefinedFunction

from kovacic.errors import InputError, NotRational
from kovacic.limits import Limits
from kovacic.reading.equation import parse_equation, parse_sympy_equation
from kovacic.reading.exponential import in_exponentials
from kovacic.reading.from_sympy import function_of
from kovacic.reading.given import Equation


def read_equation(eq: Any, func: Any, var: str | None, limits: Limits) -> tuple[Equation, Any]:
    """The equation and the unknown function as the user writes it."""
    try:
        return _rational(eq, func, var, limits)
    except NotRational:
        found = in_exponentials(eq, variable=var, limits=limits)
        if found is None or found.equation is None or found.equation.change is None:
            raise
        x = sympy.Symbol(found.equation.change.variable)
        name = sympy.Function(found.equation.unknown)(x)
        return found.equation, name if isinstance(eq, str) else function_of(eq)


def _rational(eq: Any, func: Any, var: str | None, limits: Limits) -> tuple[Equation, Any]:
    applied = func if isinstance(func, AppliedUndef) else None
    name = func if applied is None else applied.func  # y of y(x)
    if func is not None and not isinstance(name, UndefinedFunction):
        raise InputError(f"{func!r} isn't a function", hint="give y(x), or y = Function('y')")
    if isinstance(eq, str):
        variable = var if applied is None else str(applied.args[0])
        unknown = None if func is None else str(name)
        eq, _ = parse_equation(eq, variable=variable, unknown=unknown, limits=limits)
    if isinstance(eq, Equation):
        return eq, applied or (name or sympy.Function(eq.unknown))(sympy.Symbol(eq.variable))
    if not hasattr(eq, "free_symbols"):
        raise InputError(f"{type(eq).__name__!r} isn't an equation", hint="give text or a SymPy equation")
    if func is not None and applied is None:
        found = sorted((f for f in eq.atoms(AppliedUndef) if f.func == func), key=str)
        whole = [f for f in found if f.args[0].is_Symbol]
        if not whole:
            raise InputError(f"{func} isn't a function in the equation")
        applied = whole[0]
    try:
        equation, _, function = parse_sympy_equation(eq, variable=var, unknown=applied, limits=limits)
    except NotRational:
        divided = _divided(eq)
        if divided is None:
            raise
        equation, _, function = parse_sympy_equation(divided, variable=var, unknown=applied, limits=limits)
    return equation, function


def _divided(eq: Any) -> Any:
    """An equation divided by the coefficient of its second derivative, where a common factor isn't rational; None without."""
    expression = eq.lhs - eq.rhs if isinstance(eq, sympy.Equality) else eq
    second = [d for d in expression.atoms(sympy.Derivative) if d.derivative_count == 2]
    leading = sympy.expand(expression).coeff(second[0]) if second else sympy.Integer(0)
    if not leading.has(sympy.Function):
        return None
    return sympy.Add(*(sympy.cancel(term / leading) for term in sympy.Add.make_args(sympy.expand(expression))))


def radical_of(eq: Any) -> tuple[Any, Any, Any, Any] | None:
    """A square root r of an expression that is linear in a parameter p, p, p in terms of r, and the symbol r; None without."""
    if not isinstance(eq, sympy.Basic):
        return None
    roots = [power for power in eq.atoms(sympy.Pow) if power.exp.is_Rational and power.exp.q == 2]
    variables = {symbol for f in eq.atoms(AppliedUndef) for symbol in f.free_symbols} if roots else set()
    for power in sorted(roots, key=str):
        base = power.base
        if not base.free_symbols & variables:
            for symbol in sorted(base.free_symbols, key=str):
                slope = base.diff(symbol)
                if slope.is_Rational:
                    new = sympy.Symbol(f"sqrt_{symbol.name}", positive=True)
                    rest = (base - slope * symbol).expand()
                    return sympy.sqrt(base), symbol, (new**2 - rest) / slope, new
    return None
